/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eigenvalues and eigenvectors of a symmetric matrix of three rows by cyclic Jacobi rotations
 * (C. G. J. Jacobi, Crelle's Journal 30, 1846, 51; stable form of H. Rutishauser, Numer. Math. 9,
 * 1966, 1). Vectors are orthogonal to rounding also where values are equal, which the closed
 * form of the cubic does not give; only + - * / and sqrt are used. */
#include "measure/contacts_internal.h"

/* Convergence is quadratic: 4 or 5 sweeps reach the last place. */
enum { MOST_SWEEPS = 30 };

/* A rotation in the plane of axes p and q that makes a[p][q] 0. The third axis is r. */
static void rotate(double a[3][3], double v[3][3], int p, int q)
{
  const int r = 3 - p - q;
  if (a[p][q] == 0)
    return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t =
      (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1)); /* tan */
  const double c = 1 / sqrt(t * t + 1), s = t * c;
  const double arp = a[r][p], arq = a[r][q];
  a[p][p] -= t * a[p][q];
  a[q][q] += t * a[p][q];
  a[p][q] = a[q][p] = 0;
  a[r][p] = a[p][r] = c * arp - s * arq;
  a[r][q] = a[q][r] = s * arp + c * arq;
  for (int k = 0; k < 3; k++) {
    const double vp = v[p][k], vq = v[q][k];
    v[p][k] = c * vp - s * vq;
    v[q][k] = s * vp + c * vq;
  }
}

/* The largest component is positive. */
static void orient(double v[3])
{
  int largest = 0;
  for (int k = 1; k < 3; k++)
    if (fabs(v[k]) > fabs(v[largest]))
      largest = k;
  for (int k = 0; k < 3 && v[largest] < 0; k++)
    v[k] = 0.0 - v[k];
}

void packing_i_eigen(double a[3][3], double values[3], double vectors[3][3])
{
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  int order[3] = {0, 1, 2};
  for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
    rotate(a, v, 0, 1);
    rotate(a, v, 0, 2);
    rotate(a, v, 1, 2);
  }
  for (int i = 1; i < 3; i++)
    for (int k = i; k > 0 && a[order[k]][order[k]] > a[order[k - 1]][order[k - 1]]; k--) {
      const int swap = order[k];
      order[k] = order[k - 1];
      order[k - 1] = swap;
    }
  for (int k = 0; k < 3; k++) {
    values[k] = a[order[k]][order[k]];
    memcpy(vectors[k], v[order[k]], sizeof vectors[k]);
    orient(vectors[k]);
  }
}
