/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_PAPER_RING_H
#define PACKING_FRONT_PAPER_RING_H

/* The places of a sphere that touches two spheres, as a ring, and where other spheres let it be.
 *
 * All lengths are in units of R = r_i + r, seen from the centre of sphere i; r is the radius to be
 * placed. A place is a unit vector q. Sphere l, at p with r_l + r = t, leaves those free with
 *
 *   q . p <= a,   a = (1 + p . p - t t) / 2,
 *
 * equality where it is touched. Those that also touch sphere j are the ring
 * q = h n + w (x e + y f), x x + y y = 1, and on it sphere l leaves free A x + B y <= C. The ring's
 * places in contact with a third sphere are the two ends of the arc that this one takes. In the
 * plane the ring is the unit circle itself, and its ends touch two discs. */

#include "vec.h"
#include <stddef.h>

/* A sphere beside sphere i. */
typedef struct packing_i_ring_body {
  packing_vec3 p;
  double d; /* |p| */
  double t; /* r_l + r */
  double a;
  double slack;        /* by which a may be exceeded: rounding */
  double cosine, sine; /* of the cap that it takes of all places */
  size_t index;        /* of the particle */
  int done;            /* 1: no place touches it */
} packing_i_ring_body;

/* The part of the ring that a body leaves. */
typedef struct packing_i_ring_bound {
  double a, b, c;
  double most; /* c with slack */
  size_t body; /* which */
} packing_i_ring_bound;

typedef struct packing_i_ring {
  packing_vec3 n, e, f;
  double h, w;
} packing_i_ring;

/* A bound of which one end, or both, are free (1: the first, 2: the second). */
typedef struct packing_i_ring_end {
  size_t bound;
  unsigned sides;
} packing_i_ring_end;

/* A body at p (absolute lengths, from the centre of i) of radius r_l; `unit` is R. */
packing_i_ring_body packing_i_ring_body_of(packing_vec3 p, double r_l, double r,
                                           double unit, double slack);

/* Whether the cap of body l lies within that of body k: then l neither bounds nor is touched. Caps
 * that all but fill one another's are told apart by more than rounding. */
static inline int packing_i_ring_hides(const packing_i_ring_body *k,
                                       const packing_i_ring_body *l)
{
  const double apart = packing_i_dot(k->p, l->p);
  return k->cosine < l->cosine &&
         apart > k->d * l->d * (k->cosine * l->cosine + k->sine * l->sine + 1e-9);
}

/* The ring of body j; 0: it is no longer than rounding. */
int packing_i_ring_of(const packing_i_ring_body *j, packing_i_ring *ring);

/* The circle of the plane. */
packing_i_ring packing_i_ring_flat(void);

/* How the bodies but `skip` bound the ring: those that do, in `bounds`, which has room for all.
 * Returns 0 where one of them leaves nothing. */
int packing_i_ring_bounds(const packing_i_ring *ring, const packing_i_ring_body *bodies,
                          size_t count, size_t skip, packing_i_ring_bound *bounds,
                          size_t *bounding);

/* The free ends of bounds [from, upto) whose bodies are not done; `ends` has room for all. */
size_t packing_i_ring_ends(const packing_i_ring_body *bodies,
                           const packing_i_ring_bound *bounds, size_t bounding,
                           size_t from, size_t upto, packing_i_ring_end *ends);

/* The end of a bound on a side (1 or 2). */
packing_vec3 packing_i_ring_at(const packing_i_ring *ring,
                               const packing_i_ring_bound *bound, unsigned side);

/* Newton's step for q . q = 1, q . p_j = a_j, q . p_k = a_k; in the plane p_j is 0, 0, 1. */
packing_vec3 packing_i_ring_polish(packing_vec3 q, packing_vec3 p_j, double a_j,
                                   packing_vec3 p_k, double a_k);

#endif
