/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Closed parts: one whose volume is positive must stand in the open, one whose volume is negative
 * is a cavity and must stand within one other. Since parts do not meet, one corner decides where a
 * part stands: the winding number of all others there. */
#include "mesh_internal.h"
#include "delaunay/expansion.h"

/* What is to be known of a part. */
typedef struct body {
  packing_i_two volume;
  size_t first; /* of its triangles */
} body;

/* Volumes are taken against a corner of the part itself, lest they drown where it is far off. */
static void add_volumes(const packing_mesh *mesh, const uint32_t *part, body *bodies,
                        uint32_t parts)
{
  for (uint32_t p = 0; p < parts; p++)
    bodies[p] = (body){{0, 0}, PACKING_NO_INDEX};
  for (size_t t = 0; t < mesh->triangles; t++) {
    body *b = &bodies[part[t]];
    double area;
    if (b->first == PACKING_NO_INDEX)
      b->first = t;
    const packing_vec3 tip = packing_i_mesh_vec(packing_i_mesh_corner(mesh, b->first, 0));
    const packing_vec3 n = packing_i_mesh_normal(mesh, t, &area);
    const packing_vec3 a = packing_i_mesh_vec(packing_i_mesh_corner(mesh, t, 0));
    const packing_i_two pyramid = {packing_i_dot(n, packing_i_sub(a, tip)) * area, 0};
    b->volume = packing_i_double_add(b->volume, pyramid);
  }
}

static packing_i_mesh_finding find_inverted(const packing_mesh *mesh,
                                            const uint32_t *part, const body *bodies,
                                            uint32_t parts)
{
  packing_i_mesh_finding found = packing_i_mesh_nothing();
  for (uint32_t p = 0; p < parts; p++) {
    const double *corner = packing_i_mesh_corner(mesh, bodies[p].first, 0);
    const int around = parts == 1 ? 0 : packing_i_mesh_winding(mesh, corner, part, p);
    const int wanted = bodies[p].volume.hi > 0 ? 0 : 1;
    if (around != wanted)
      packing_i_mesh_find(&found, bodies[p].first, PACKING_NO_INDEX,
                          packing_i_mesh_vec(corner));
  }
  return found;
}

packing_status packing_i_mesh_check_parts(packing_context *context,
                                          const packing_mesh *mesh, const uint32_t *twin,
                                          packing_i_mesh_finding *inverted, size_t *parts)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_status status = PACKING_OK;
  body *bodies = NULL;
  uint32_t count = 0;
  uint32_t *part = packing_i_alloc(allocator, mesh->triangles, sizeof *part);
  if (part != NULL) {
    count = packing_i_mesh_parts(mesh, twin, part);
    bodies = packing_i_alloc(allocator, count, sizeof *bodies);
  }
  if (bodies == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  add_volumes(mesh, part, bodies, count);
  *inverted = find_inverted(mesh, part, bodies, count);
  *parts = count;
out:
  packing_i_free(allocator, part);
  packing_i_free(allocator, bodies);
  return status;
}
