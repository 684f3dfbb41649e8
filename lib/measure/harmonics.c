/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spherical harmonics in Racah's normalisation, C_lm = sqrt((l - m)! / (l + m)!) P_l^m(cos theta)
 * exp(i m phi), by the recurrence in l at fixed m, which is stable upwards (NIST Digital Library
 * of Mathematical Functions, 14.10.3):
 *   sqrt(l^2 - m^2) C_lm = (2 l - 1) z C_(l-1)m - sqrt((l-1)^2 - m^2) C_(l-2)m.
 * Only + - * / and sqrt: the same bits everywhere. The sign (-1)^m of P_l^m (Condon and Shortley)
 * is left out, which no invariant feels: q_l takes squares, and in w_l the three m sum to 0. */
#include "measure/order_internal.h"

void packing_i_harmonics_init(packing_i_harmonics *h, int l)
{
  memset(h, 0, sizeof *h);
  h->l = l;
  h->top[0] = 1;
  for (int m = 1; m <= l; m++)
    h->top[m] = h->top[m - 1] * sqrt((2 * m - 1) / (2.0 * m));
  for (int m = 0; m <= l; m++)
    for (int k = m + 1; k <= l; k++) {
      const double root = sqrt((double)(k * k - m * m));
      h->up[m][k] = (2 * k - 1) / root;
      h->down[m][k] = k == m + 1 ? 0 : sqrt((double)((k - 1) * (k - 1) - m * m)) / root;
    }
}

void packing_i_harmonics_add(const packing_i_harmonics *h, packing_vec3 d,
                             packing_i_moments *sum)
{
  const double length = packing_i_norm(d);
  if (!(length > 0))
    return;
  const double x = d.x / length, y = d.y / length, z = d.z / length;
  double re = 1, im = 0; /* (x + i y)^m */
  for (int m = 0; m <= h->l; m++) {
    double last = 0, c = h->top[m];
    for (int k = m + 1; k <= h->l; k++) {
      const double next = h->up[m][k] * z * c - h->down[m][k] * last;
      last = c;
      c = next;
    }
    sum->re[m] += c * re;
    sum->im[m] += c * im;
    const double turned = re * x - im * y;
    im = re * y + im * x;
    re = turned;
  }
}

double packing_i_harmonics_square(int l, const packing_i_moments *c)
{
  double square = 0;
  for (int m = 1; m <= l; m++)
    square += c->re[m] * c->re[m] + c->im[m] * c->im[m];
  return 2 * square + c->re[0] * c->re[0];
}
