/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The third-order invariant w_l = sum over m1 + m2 + m3 = 0 of (l l l; m1 m2 m3) q_m1 q_m2 q_m3
 * (Steinhardt, Nelson and Ronchetti, Phys. Rev. B 28, 784, 1983, equation 1.5), Wigner's 3j symbols by
 * Racah's formula (A. Messiah, Quantum Mechanics II, 1962, appendix C, equation 21). For even l
 * a symbol does not change with the order of the three m nor with their common sign, so the sum
 * runs over m1 <= m2 <= m3 only: 25 terms for l = 6. */
#include "measure/order_internal.h"

/* Up to 37 = 3 * 12 + 1: a double holds it with the usual relative error. */
static double factorial(int n)
{
  double f = 1;
  for (int k = 2; k <= n; k++)
    f *= k;
  return f;
}

static double wigner_3j(int l, int m1, int m2)
{
  const int m3 = -m1 - m2;
  const int from = m2 > -m1 ? (m2 > 0 ? m2 : 0) : (-m1 > 0 ? -m1 : 0);
  const int shortest = l - m1 < l + m2 ? l - m1 : l + m2;
  const int to = shortest < l ? shortest : l;
  double sum = 0;
  for (int t = from; t <= to; t++)
    sum += (t % 2 == 0 ? 1 : -1) /
           (factorial(t) * factorial(t + m1) * factorial(t - m2) * factorial(l - t) *
            factorial(l - m1 - t) * factorial(l + m2 - t));
  const double f = factorial(l);
  return (m3 % 2 == 0 ? sum : -sum) * sqrt(f * f * f / factorial(3 * l + 1)) *
         sqrt(factorial(l + m1) * factorial(l - m1)) *
         sqrt(factorial(l + m2) * factorial(l - m2)) *
         sqrt(factorial(l + m3) * factorial(l - m3));
}

void packing_i_wigner_init(packing_i_wigner *w, int l)
{
  w->terms = 0;
  for (int m1 = -l; m1 <= 0; m1++)
    for (int m2 = m1; 2 * m2 <= -m1; m2++) {
      const int m3 = -m1 - m2;
      if (m3 > l)
        continue;
      const int orders = m1 == m2 && m2 == m3 ? 1 : m1 == m2 || m2 == m3 ? 3 : 6;
      w->term[w->terms].m[0] = m1;
      w->term[w->terms].m[1] = m2;
      w->term[w->terms].m[2] = m3;
      w->term[w->terms].factor = orders * wigner_3j(l, m1, m2);
      w->terms++;
    }
}

typedef struct complex_number {
  double re;
  double im;
} complex_number;

static complex_number moment(const packing_i_moments *c, int m)
{
  const int k = m < 0 ? -m : m;
  const double sign = m < 0 && k % 2 == 1 ? -1 : 1;
  const complex_number q = {sign * c->re[k], (m < 0 ? -sign : sign) * c->im[k]};
  return q;
}

/* The imaginary parts of a term and of that with all signs turned cancel. */
static double real_product(const packing_i_moments *c, const int m[3])
{
  const complex_number q1 = moment(c, m[0]), q2 = moment(c, m[1]), q3 = moment(c, m[2]);
  return (q1.re * q2.re - q1.im * q2.im) * q3.re -
         (q1.re * q2.im + q1.im * q2.re) * q3.im;
}

double packing_i_wigner_sum(const packing_i_wigner *w, int l, const packing_i_moments *c)
{
  const double square = packing_i_harmonics_square(l, c);
  double sum = 0;
  if (!(sqrt(square) > PACKING_I_NO_SHAPE))
    return 0;
  for (int k = 0; k < w->terms; k++)
    sum += w->term[k].factor * real_product(c, w->term[k].m);
  return sum / (square * sqrt(square));
}
