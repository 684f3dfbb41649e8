/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_ORDER_INTERNAL_H
#define PACKING_ORDER_INTERNAL_H

/* What the measures of order share: lists of neighbours, spherical harmonics, Wigner's 3j. */

#include "domain/domain_internal.h"
#include "measure/measure_internal.h"
#include "vec.h"
#include <packing/order.h>

/* A neighbour of a particle: that at place j, moved by so many periods. 16 bytes. */
typedef struct packing_i_bond {
  size_t j;
  int16_t image[3];
} packing_i_bond;

/* Particles stand at places, in an order that keeps near ones near: whoever looks at the
 * neighbours of one place after another finds them in the cache. */
struct packing_neighbours {
  packing_context *context;
  const packing_allocator *allocator;
  packing_neighbours_kind kind;
  int flat;
  size_t count;
  packing_vec3 period;  /* 0 where not periodic */
  size_t *index;        /* in the view, of each place */
  size_t *place;        /* of each index in the view */
  packing_vec3 *centre; /* inside the cell; on the plane where flat */
  size_t *start; /* bonds of place i: [start[i], start[i + 1]), sorted by (j, image) */
  packing_i_bond *bonds;
  unsigned char *counts; /* whether a particle counts in means */
};

/* The vector of a bond of place i. */
static inline packing_vec3 packing_i_bond_vector(const packing_neighbours *n, size_t i,
                                                 const packing_i_bond *b)
{
  const packing_vec3 p = n->period, from = n->centre[i], to = n->centre[b->j];
  return packing_i_vec((to.x - from.x) + b->image[0] * p.x,
                       (to.y - from.y) + b->image[1] * p.y,
                       (to.z - from.z) + b->image[2] * p.z);
}

/* Puts particles in an order that keeps near ones near; it depends on the pack only. */
packing_status packing_i_measure_places(packing_context *context,
                                        const packing_domain *domain,
                                        const packing_view *view, size_t *index);

/* -1, 0 or 1: how bonds are sorted. */
int packing_i_bond_compare(const packing_i_bond *a, const packing_i_bond *b);

/* Fill start and bonds of *n, whose other members are set. `view` has the places' centres and
 * radii. What is allocated goes with *n. */
packing_status packing_i_neighbours_within(packing_context *context,
                                           packing_neighbours *n,
                                           const packing_domain *domain,
                                           const packing_view *view, double factor,
                                           double gap);
packing_status packing_i_neighbours_nearest(packing_context *context,
                                            packing_neighbours *n,
                                            const packing_view *view, size_t nearest);

/* The distance from a point to the nearest wall or, where that is less, down from the open top;
 * +infinity where there is neither. */
double packing_i_measure_depth(const packing_domain *domain, packing_vec3 p);

enum { PACKING_I_ORDER_L = 12 /* highest degree of a bond order */ };

/* C_lm = sqrt(4 pi / (2 l + 1)) Y_lm of one l, for m = 0 .. l; with negative m they are
 * (-1)^m conj(C_lm). */
typedef struct packing_i_harmonics {
  int l;
  double top[PACKING_I_ORDER_L + 1]; /* C_mm / (x + i y)^m */
  /* C_km = up[m][k] z C_(k-1)m - down[m][k] C_(k-2)m, k > m */
  double up[PACKING_I_ORDER_L + 1][PACKING_I_ORDER_L + 1];
  double down[PACKING_I_ORDER_L + 1][PACKING_I_ORDER_L + 1];
} packing_i_harmonics;

/* One per m. */
typedef struct packing_i_moments {
  double re[PACKING_I_ORDER_L + 1];
  double im[PACKING_I_ORDER_L + 1];
} packing_i_moments;

/* l is even, 2 to PACKING_I_ORDER_L. */
void packing_i_harmonics_init(packing_i_harmonics *h, int l);

/* Adds C_lm of a direction, a vector of any length; nothing for the zero vector. */
void packing_i_harmonics_add(const packing_i_harmonics *h, packing_vec3 d,
                             packing_i_moments *sum);

/* The sum over m = -l .. l of abs(C_lm)^2. */
double packing_i_harmonics_square(int l, const packing_i_moments *c);

/* Terms of w_l: products of C_l,m1 C_l,m2 C_l,m3 with m1 <= m2 <= m3 and m1 + m2 + m3 = 0, each
 * with Wigner's symbol times how often the product occurs. */
enum { PACKING_I_WIGNER_TERMS = 128 };

typedef struct packing_i_wigner {
  int terms;
  struct {
    int m[3];
    double factor;
  } term[PACKING_I_WIGNER_TERMS];
} packing_i_wigner;

void packing_i_wigner_init(packing_i_wigner *w, int l);

/* A bond order below is what rounding leaves of 0; it has no w_l. */
#define PACKING_I_NO_SHAPE 1e-12

/* w_l / (sum of squares)^(3/2); 0 where there is no shape. */
double packing_i_wigner_sum(const packing_i_wigner *w, int l, const packing_i_moments *c);

#endif
