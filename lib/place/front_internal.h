/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_INTERNAL_H
#define PACKING_FRONT_INTERNAL_H

/* The two engines of the advancing front (the seed paper's, and pockets) and what they share. */

#include "place_internal.h"
#include "source.h"
#include <packing/front.h>

/* The head of placer->method of both engines. */
typedef struct packing_i_front {
  packing_i_source *source; /* owned */
  size_t count;             /* particles asked; 0: no limit */
  double solid_volume;      /* asked; 0: no limit */
  packing_vec3 innermost;   /* the point farthest from the walls */
  double room;              /* its distance from them; +infinity: there are none */
  /* packing_front_members(). */
  packing_status (*members)(const packing_placer *placer, size_t capacity, size_t *index,
                            size_t *count);
} packing_i_front;

/* Whether a particle of volume `next` is still asked for. */
int packing_i_front_wants(const packing_i_front *front,
                          const packing_placer_report *tally, double next);

/* The share of the goal that is reached; without one, of what the container may take. */
double packing_i_front_progress(const packing_i_front *front,
                                const packing_placer *placer);

/* ---- front_turn.c ---- */

/* A random rotation, uniform: a unit quaternion; in the plane about z. */
void packing_i_front_turn(packing_i_stream *stream, int dim, double q[4]);
/* A random unit vector, uniform. */
packing_vec3 packing_i_front_direction(packing_i_stream *stream, int dim);
/* Turns points about the origin by one random rotation. */
void packing_i_front_turn_points(packing_i_stream *stream, int dim, packing_vec3 *point,
                                 size_t count);

/* ---- front_corner.c: places at the walls ---- */

/* Moves x to where a sphere of radius r touches up to three bodies; 0: it did not get there, to
 * `slack`. */
int packing_i_front_settle(double slack, double r, const packing_body *body,
                           size_t bodies, packing_vec3 *x);
/* A wall of a container as a body; -1: the nearest. */
packing_body packing_i_front_wall_of(packing_domain *domain, int wall);
/* A corner: moves x to the place nearby that touches most walls, of equal ones the nearest; a wall
 * counts that the container tells apart (of meshes, those near x). */
void packing_i_front_move_to_corner(packing_domain *domain, double slack, double r,
                                    packing_vec3 *x);

/* Fill placer->method, whose head is a copy of `head`, and placer->ops is theirs. On failure
 * method is NULL and the source is still the caller's. */
packing_status packing_i_front_paper_start(packing_placer *placer,
                                           const packing_front_def *def,
                                           const packing_i_front *head);
packing_status packing_i_front_pockets_start(packing_placer *placer,
                                             const packing_front_def *def,
                                             const packing_i_front *head);

extern const packing_i_placer_ops packing_i_front_paper_ops;
extern const packing_i_placer_ops packing_i_front_pockets_ops;

#endif
