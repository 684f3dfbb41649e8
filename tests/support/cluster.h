/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_CLUSTER_H
#define PACKING_TEST_CLUSTER_H

/* A shape of the user's own: two equal spheres (discs) that share their middle and reach
 * to the ends of a diameter of the circumscribed sphere, along x where the orientation is
 * 1, 0, 0, 0. Everything about it is exact. It knows itself and spheres. */
#include "test.h"

/* A cluster whose spheres have the radius `share` r, share in [0.5, 1]; with share 1 it
 * is a sphere. `with_distance` 0: the directional distance is left to the library. */
packing_shape *test_cluster(double share, int with_distance);

/* The same through a context, which may fail. */
packing_status test_cluster_create(packing_context *context, double share,
                                   int with_distance, packing_shape **shape);

/* Clusters made and not yet released. */
int test_clusters_alive(void);

/* A cluster as a body, turned by the unit quaternion. */
packing_body test_cluster_body(const packing_shape *shape, packing_vec3 centre, double r,
                               const double orientation[4]);

#endif
