/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ball in a container that is known by its distance alone, where its wall is nearly a plane.
 * (Subdivision, subdivide.c, takes 35 times as long there.)
 *
 * The ball is taken as columns along the wall's normal. A distance changes by no more than the way
 * gone, so the distances at both ends of a column say how much of either end lies on one side;
 * what is in doubt between is halved until it is little, and then the wall is where a plane would
 * be. Columns stand at Gauss's points in rho^2, inside and outside of the circle where the plane that
 * distance and normal at the centre give leaves the ball, and at equal angles. Their sum is taken
 * as a difference from that of the plane, of which the cap is known. The next, closer set of
 * columns tells the error, except for walls along the columns, where they may agree by chance;
 * but such walls show in the distances at their ends. */
#include "domain_kinds.h"

enum { MOST_RADII = 8, SETS = 4 };
static const double DOUBT = 1.0 / 64; /* that is left of a column, over r */
static const double NEAR = 0.15;      /* of another wall to the ball's surface, over r */

/* Gauss's points on [0, 1]. */
typedef struct columns {
  int radii, angles;
  double square[MOST_RADII], weight[MOST_RADII];
} columns;

static const columns sets[SETS] = {
    {2, 7, {0.2113248654051871, 0.7886751345948129}, {0.5, 0.5}},
    {3,
     9,
     {0.1127016653792583, 0.5, 0.8872983346207417},
     {0.2777777777777778, 0.4444444444444444, 0.2777777777777778}},
    {5,
     15,
     {0.04691007703066802, 0.2307653449471584, 0.5, 0.7692346550528415,
      0.9530899229693319},
     {0.1184634425280947, 0.2393143352496831, 0.2844444444444445, 0.2393143352496831,
      0.1184634425280947}},
    {8,
     25,
     {0.01985507175123191, 0.1016667612931866, 0.2372337950418355, 0.4082826787521751,
      0.5917173212478248, 0.7627662049581645, 0.8983332387068134, 0.9801449282487681},
     {0.05061426814518834, 0.1111905172266872, 0.1568533229389435, 0.1813418916891809,
      0.1813418916891809, 0.1568533229389435, 0.1111905172266872, 0.05061426814518834}}};

typedef struct ball {
  const packing_i_domain_body *body;
  packing_vec3 centre, along, u, v;
  double r, d;
} ball;

typedef struct end {
  double z, f;
} end;

static end end_at(const ball *b, packing_vec3 foot, double z)
{
  const packing_vec3 p = packing_i_add(foot, packing_i_scale(b->along, z));
  return (end){z, b->body->ops->signed_distance(b->body, &p, NULL)};
}

/* How much of a column's stretch is inside. Recursion halves what is in doubt. */
static double inside(const ball *b, packing_vec3 foot, end low, end high)
{
  const double length = high.z - low.z;
  const double doubt = length - fabs(low.f) - fabs(high.f);
  if (doubt > DOUBT * b->r) {
    const end middle = end_at(b, foot, low.z + fabs(low.f) + 0.5 * doubt);
    return inside(b, foot, low, middle) + inside(b, foot, middle, high);
  }
  if ((low.f > 0) == (high.f > 0))
    return low.f > 0 ? length : 0;
  return length * fmax(low.f, high.f) / (fabs(low.f) + fabs(high.f));
}

/* Another wall than the plane is about to cut the ball, or does. */
static int is_odd(const ball *b, end at)
{
  const double near = NEAR * b->r;
  return !(fabs(at.f) >= near) && !(fabs(at.f - b->d - at.z) <= near);
}

/* What a column has more than the plane leaves of it. */
static double excess(const ball *b, double x, double y, int *odd)
{
  const double half = sqrt(b->r * b->r - x * x - y * y);
  const packing_vec3 across =
      packing_i_add(packing_i_scale(b->u, x), packing_i_scale(b->v, y));
  const packing_vec3 foot = packing_i_add(b->centre, across);
  const end low = end_at(b, foot, -half), high = end_at(b, foot, half);
  *odd += is_odd(b, low) || is_odd(b, high);
  return inside(b, foot, low, high) - fmin(fmax(half + b->d, 0), 2 * half);
}

/* Over the ring from the square of one radius to that of another. */
static double ring(const ball *b, const columns *of, double from, double to, int *odd)
{
  double sum = 0;
  for (int i = 0; i < of->radii; i++)
    for (int k = 0; k < of->angles; k++) {
      const double rho = sqrt(from + (to - from) * of->square[i]);
      const double angle = 2 * PACKING_I_PI * k / of->angles;
      sum += of->weight[i] * excess(b, rho * cos(angle), rho * sin(angle), odd);
    }
  return PACKING_I_PI * (to - from) / of->angles * sum;
}

int packing_i_cut_columns(const packing_i_domain_body *body, const packing_vec3 *centre,
                          double r, double d, packing_vec3 normal, double enough,
                          double *volume, double *error)
{
  const packing_vec3 aside =
      fabs(normal.x) < 0.5 ? packing_i_vec(1, 0, 0) : packing_i_vec(0, 1, 0);
  packing_vec3 u = packing_i_cross(normal, aside);
  u = packing_i_scale(u, 1 / packing_i_norm(u));
  const ball b = {body, *centre, normal, u, packing_i_cross(normal, u), r, d};
  const double rim = fmax((r - d) * (r + d), 0);
  double before = HUGE_VAL;
  int odd = 0;
  for (int i = 0; i < SETS; i++) {
    const double more =
        ring(&b, &sets[i], 0, rim, &odd) + ring(&b, &sets[i], rim, r * r, &odd);
    *volume = packing_i_cap(3, r, r + d) + more;
    *error = 2 * fabs(more - before);
    before = more;
    if (odd > 0 || *error <= enough)
      return odd == 0;
  }
  return 0;
}
