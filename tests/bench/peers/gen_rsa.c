/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random sequential addition in a box [0,L]x[0,L]x[0,H]: the common start of the DEM comparison.
 * On purpose not made with libpacking: the peers are timed on a start that owes it nothing.
 * usage: gen_rsa N RADIUS L PHI SEED LAMMPS.data YADE.txt; prints N, H and the tries */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct box {
  double edge, height, hx, hz; /* cells of at least a diameter */
  int nx, nz;
  int *head, *next;
  double *x;
} box;

static unsigned long long state;

static double uniform(void)
{
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (double)(state >> 11) / 9007199254740992.0;
}

static int at_least_one(double n)
{
  return n < 1 ? 1 : (int)n;
}

static int below(int i, int n)
{
  return i < n ? i : n - 1;
}

static int cell_is_free(const box *b, int cell, const double *p, double r)
{
  for (int q = b->head[cell]; q >= 0; q = b->next[q]) {
    const double dx = p[0] - b->x[3 * q], dy = p[1] - b->x[3 * q + 1],
                 dz = p[2] - b->x[3 * q + 2];
    if (dx * dx + dy * dy + dz * dz < 4 * r * r)
      return 0;
  }
  return 1;
}

static int is_free(const box *b, const int *c, const double *p, double r)
{
  for (int i = c[0] - 1; i <= c[0] + 1; i++)
    for (int j = c[1] - 1; j <= c[1] + 1; j++)
      for (int k = c[2] - 1; k <= c[2] + 1; k++)
        if (i >= 0 && j >= 0 && k >= 0 && i < b->nx && j < b->nx && k < b->nz &&
            !cell_is_free(b, (k * b->nx + j) * b->nx + i, p, r))
          return 0;
  return 1;
}

static int add(box *b, int n, double r)
{
  double p[3];
  p[0] = r + uniform() * (b->edge - 2 * r);
  p[1] = r + uniform() * (b->edge - 2 * r);
  p[2] = r + uniform() * (b->height - 2 * r);
  const int c[3] = {below((int)(p[0] / b->hx), b->nx), below((int)(p[1] / b->hx), b->nx),
                    below((int)(p[2] / b->hz), b->nz)};
  if (!is_free(b, c, p, r))
    return 0;
  const int cell = (c[2] * b->nx + c[1]) * b->nx + c[0];
  for (int d = 0; d < 3; d++)
    b->x[3 * n + d] = p[d];
  b->next[n] = b->head[cell];
  b->head[cell] = n;
  return 1;
}

static int write_lammps(const box *b, int n, double r, const char *name)
{
  FILE *f = fopen(name, "w");
  if (f == NULL)
    return 0;
  fprintf(f, "rsa\n\n%d atoms\n1 atom types\n\n0 %g xlo xhi\n0 %g ylo yhi\n", n, b->edge,
          b->edge);
  fprintf(f, "0 %g zlo zhi\n\nAtoms # sphere\n\n", b->height * 1.02);
  for (int i = 0; i < n; i++)
    fprintf(f, "%d 1 %.17g 1000 %.17g %.17g %.17g\n", i + 1, 2 * r, b->x[3 * i],
            b->x[3 * i + 1], b->x[3 * i + 2]);
  return fclose(f) == 0;
}

static int write_yade(const box *b, int n, double r, const char *name)
{
  FILE *f = fopen(name, "w");
  if (f == NULL)
    return 0;
  for (int i = 0; i < n; i++)
    fprintf(f, "%.17g %.17g %.17g %.17g\n", b->x[3 * i], b->x[3 * i + 1], b->x[3 * i + 2],
            r);
  return fclose(f) == 0;
}

int main(int argc, char **argv)
{
  if (argc != 8) {
    fprintf(stderr, "usage: gen_rsa N RADIUS L PHI SEED LAMMPS.data YADE.txt\n");
    return 2;
  }
  const int count = atoi(argv[1]);
  const double r = atof(argv[2]), edge = atof(argv[3]), phi = atof(argv[4]);
  state = strtoull(argv[5], NULL, 10) * 2654435761U + 88172645463325252ULL;
  box b = {.edge = edge};
  b.height = count * 4 / 3. * 3.14159265358979323846 * r * r * r / (phi * edge * edge);
  b.nx = at_least_one(edge / (2 * r));
  b.nz = at_least_one(b.height / (2 * r));
  b.hx = edge / b.nx;
  b.hz = b.height / b.nz;
  const size_t cells = (size_t)b.nx * (size_t)b.nx * (size_t)b.nz;
  b.head = malloc(sizeof *b.head * cells);
  b.next = malloc(sizeof *b.next * (size_t)count);
  b.x = malloc(sizeof *b.x * 3 * (size_t)count);
  if (b.head == NULL || b.next == NULL || b.x == NULL)
    return 3;
  for (size_t i = 0; i < cells; i++)
    b.head[i] = -1;
  int n = 0;
  long tries = 0;
  for (; n < count && tries < 2000000000L; tries++)
    n += add(&b, n, r);
  const int written = write_lammps(&b, n, r, argv[6]) && write_yade(&b, n, r, argv[7]);
  printf("%d %g %ld\n", n, b.height, tries);
  free(b.head);
  free(b.next);
  free(b.x);
  return written ? 0 : 3;
}
