/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One-dimensional quadrature of areas over heights. The half-integer powers at the ends of an
 * interval go with h = middle + half sin(t), after which the 15 points of Gauss-Kronrod
 * (QUADPACK's qk15) converge fast; bisection takes care of the rest. The error is four times
 * the sum of the differences to the 7 points of Gauss; as a rule far above the true one, and
 * the four is for differences that are small by chance. Intervals are taken from left to right,
 * so that the sum is always the same. */
#include "domain_kinds.h"

/* Rounding can keep the rules from agreeing, in every part of an interval alike: then no more
 * parts than these are tried. */
enum { MOST_PARTS = 400 };

typedef struct integral {
  double (*f)(const void *arg, double h);
  const void *arg;
  double centre, reach; /* of the heights */
} integral;

/* The integral over [low, high] in t, 7 and 15 points. */
static double kronrod(const integral *q, double low, double high, double *difference)
{
  static const double node[8] = {
      0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
      0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
      0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
      0.207784955007898467600689403773245, 0};
  static const double kronrod_weight[8] = {
      0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
      0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
      0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static const double gauss_weight[4] = {
      0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
      0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  double k = 0, g = 0;
  for (int i = 0; i < 8; i++)
    for (int side = -1; side <= (i == 7 ? -1 : 1); side += 2) {
      const double t = middle + side * half * node[i];
      const double f = q->f(q->arg, q->centre + q->reach * sin(t)) * cos(t);
      k += kronrod_weight[i] * f;
      if (i % 2 == 1)
        g += gauss_weight[i / 2] * f;
    }
  *difference = 4 * fabs(k - g) * half * q->reach;
  return k * half * q->reach;
}

/* An interval of t that waits for its turn. */
typedef struct interval {
  double low, high;
  int depth;
} interval;

double packing_i_integrate(double (*f)(const void *arg, double h), const void *arg,
                           const double h[2], packing_i_depths depths, double tolerance,
                           double *error)
{
  const integral q = {f, arg, 0.5 * (h[0] + h[1]), 0.5 * (h[1] - h[0])};
  interval stack[PACKING_I_DEEPEST + 1] = {{-0.5 * PACKING_I_PI, 0.5 * PACKING_I_PI, 0}};
  double sum = 0;
  int waiting = 1;
  for (int parts = 0; waiting > 0; parts++) {
    const interval now = stack[waiting - 1];
    double difference;
    const double part = kronrod(&q, now.low, now.high, &difference);
    const double allowed = tolerance * (now.high - now.low) / PACKING_I_PI;
    if (now.depth < depths.least ||
        (now.depth < depths.most && parts < MOST_PARTS && difference > allowed)) {
      const double middle = 0.5 * (now.low + now.high);
      stack[waiting - 1] = (interval){middle, now.high, now.depth + 1};
      stack[waiting++] = (interval){now.low, middle, now.depth + 1};
      continue;
    }
    waiting--;
    sum += part;
    *error += difference;
  }
  return sum;
}
