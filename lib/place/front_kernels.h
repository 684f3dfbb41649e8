/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FRONT_KERNELS_H
#define PACKING_FRONT_KERNELS_H

/* The vector work of the pocket front. Arrays are 64-byte aligned and padded to a multiple of
 * PACKING_I_FRONT_WIDTH entries; what stands in the padding does not matter but may be read. All
 * instruction sets give the same bits: each operation is one IEEE operation a lane. */

#include "front_curve.h"
#include <packing/base.h>
#include <stddef.h>
#include <stdint.h>

enum { PACKING_I_FRONT_WIDTH = 8 };

/* Spheres of one cell of the grid. Empty places have x = infinity. */
typedef struct packing_i_front_bin {
  double x[PACKING_I_FRONT_WIDTH];
  double y[PACKING_I_FRONT_WIDTH];
  double z[PACKING_I_FRONT_WIDTH];
  double r[PACKING_I_FRONT_WIDTH];
  uint32_t pockets[PACKING_I_FRONT_WIDTH]; /* first pocket owned; 0: none */
  uint32_t index[PACKING_I_FRONT_WIDTH];   /* in the store */
  uint32_t count;
  uint32_t next; /* further bin of the cell; 0: none */
  uint32_t unused[14];
} packing_i_front_bin;

/* What is near a sphere: bodies relative to its centre (front_curve.h), spheres first, then walls.
 * The fields of `a body` are filled for all. */
typedef struct packing_i_front_halo {
  double *x, *y, *z; /* p of a body */
  double *a, *b;     /* of a body */
  double *r;         /* radius; of a wall: infinite */
  uint32_t *id;      /* place of the sphere; a wall's number with the highest bit set */
  size_t count;
  size_t capacity;
} packing_i_front_halo;

/* The bodies close enough to make triples with at the reference radius, widest cap first. */
typedef struct packing_i_front_caps {
  double *x, *y, *z;
  double *square; /* |p|^2 */
  double *top;    /* a + b r at the reference radius: free where c . p <= top */
  double *room;   /* top and what rounding or a wall's curvature may take */
  double *reach;  /* r + reference radius */
  uint32_t *halo; /* which body of the halo */
  double *
      cosine; /* of the half angle, in the order of the halo: wide caps have small ones */
  uint32_t *order; /* of the halo */
  size_t count;
  size_t capacity;
} packing_i_front_caps;

/* No body of a halo. */
#define PACKING_I_FRONT_NO_BODY SIZE_MAX

/* Centres that touch the sphere and two bodies at the reference radius. */
typedef struct packing_i_front_candidates {
  double *x, *y, *z;
  uint32_t *pair; /* first cap << 16 | second cap << 1 | (side < 0) */
  size_t count;
  size_t capacity;
} packing_i_front_candidates;

/* The interval of radii that fit on a curve. */
typedef struct packing_i_front_interval {
  double lo;
  double exit[3]; /* the radii at which the next bodies are met, rising; infinite: none */
} packing_i_front_interval;

/* Curves of several pockets, and one body for each. */
typedef struct packing_i_front_curves {
  double *base[3], *slope[3], *side[3], *s2[3], *lo;
  double *x, *y, *z, *a, *b;
  double *room, *first, *second; /* the result, as of packing_i_front_bound */
} packing_i_front_curves;

typedef struct packing_i_front_kernels {
  /* Adds the spheres of `count` bins whose surface is within `reach` of `centre`; x, y, z, r and
   * id. place[n]: that of the first sphere of bin n. Returns 0 when the halo has no room. */
  int (*gather)(const packing_i_front_bin *const *bin, const uint32_t *place,
                size_t count, const packing_vec3 *centre, double reach,
                packing_i_front_halo *halo);
  /* a and b of the first `count` bodies, which are spheres. */
  void (*bodies)(packing_i_front_halo *halo, size_t count, double sphere_r);
  /* The bodies of a halo that a particle of radius r, `distance` from the sphere's centre, can
   * touch, widest cap first; the body `plane`, which it always touches, before all. Of x, y, z,
   * square, top, reach, halo. Bodies beyond the capacity are left out. */
  void (*caps)(const packing_i_front_halo *halo, size_t plane, double r, double distance,
               packing_i_front_caps *caps);
  /* The two centres of each of the first `firsts` caps with each of the later ones, where they
   * exist and there is room for them. */
  void (*pairs)(const packing_i_front_caps *caps, size_t firsts, double distance,
                packing_i_front_candidates *candidates);
  /* Keeps the candidates that are free of all caps. */
  void (*sieve)(const packing_i_front_caps *caps, packing_i_front_candidates *candidates);
  /* The interval from radius r on; `j` and `k` are the curve's own bodies. Exits beyond the cap
   * may be missing. */
  void (*interval)(const packing_i_front_curve *curve, const packing_i_front_halo *halo,
                   size_t j, size_t k, double r, double cap, double slack,
                   packing_i_front_interval *interval);
  /* The bounds that the bodies set to the first `count` curves. */
  void (*bounds)(const packing_i_front_curves *curves, size_t count);
} packing_i_front_kernels;

/* A vector and the result of comparing two, inside the kernels. */
typedef double packing_i_front_vector
    __attribute__((vector_size(8 * PACKING_I_FRONT_WIDTH), may_alias));
typedef int64_t packing_i_front_mask
    __attribute__((vector_size(8 * PACKING_I_FRONT_WIDTH), may_alias));

extern const packing_i_front_kernels packing_i_front_kernels_baseline;
extern const packing_i_front_kernels packing_i_front_kernels_avx2;
extern const packing_i_front_kernels packing_i_front_kernels_avx512;

/* The kernels of a set that the machine has. */
const packing_i_front_kernels *packing_i_front_kernels_for(packing_isa isa);

#endif
