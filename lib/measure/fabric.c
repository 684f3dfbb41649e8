/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fabric tensor F = (1 / N) sum n n^T of contact normals (M. Oda, Soils and Foundations 12,
 * 1972, 1; eq. 13 of the advancing-front paper), with trace 1. Each contact counts once: n and -n
 * are one. Walls, whose normals are those of the container, are kept apart unless asked for.
 * Beside it stands the noise: for N random directions <n_z^4> - <n_z^2>^2 is 1/5 - 1/9 = 4/45 on
 * the sphere and 3/8 - 1/4 = 1/8 on the circle, over N the variance of a diagonal term. Linear. */
#include "measure/contacts_internal.h"

typedef struct fabric {
  const packing_contacts *contacts;
  packing_i_fabric *parts; /* of each block, those of pairs first */
  size_t pair_blocks;
} fabric;

void packing_fabric_def_fill(packing_fabric_def *def, size_t size)
{
  packing_fabric_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_i_contacts_check_of(packing_context *context,
                                           packing_contacts_of of)
{
  const int value = (int)of;
  if (value < PACKING_CONTACTS_OF_PAIRS || value > PACKING_CONTACTS_OF_ALL)
    return packing_i_fail(context, PACKING_ERR_RANGE, "of", PACKING_NO_INDEX,
                          "%d is no PACKING_CONTACTS_OF_", value);
  return PACKING_OK;
}

void packing_i_fabric_add(packing_i_fabric *f, const double sum[6], size_t count)
{
  for (int k = 0; k < 6 && count > 0; k++)
    packing_i_sum_add(&f->sum[k], sum[k]);
  f->count += count;
}

/* The z of the plane is no direction. */
static packing_vec3 flatten(const packing_contacts *c, packing_vec3 d)
{
  if (c->dim == 2)
    d.z = 0;
  return d;
}

static void add_pairs(const packing_contacts *c, size_t place, packing_i_fabric *part)
{
  double sum[6] = {0, 0, 0, 0, 0, 0};
  size_t count = 0;
  for (size_t k = c->start[place]; k < c->start[place + 1]; k++)
    count +=
        packing_i_fabric_direct(sum, flatten(c, packing_i_contacts_vector(c, place, k)));
  packing_i_fabric_add(part, sum, count);
}

static void add_walls(const packing_contacts *c, size_t place, packing_i_fabric *part)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  double sum[6] = {0, 0, 0, 0, 0, 0};
  size_t count = 0;
  const int walls = packing_i_contacts_walls(c, place, near);
  for (int w = 0; w < walls; w++)
    count += packing_i_fabric_direct(sum, flatten(c, near[w].normal));
  packing_i_fabric_add(part, sum, count);
}

static void sum_block(void *arg, size_t block)
{
  const fabric *f = arg;
  const packing_contacts *c = f->contacts;
  const int pairs = block < f->pair_blocks;
  const size_t b = pairs ? block : block - f->pair_blocks;
  const size_t end =
      packing_i_measure_block_end(b, pairs ? c->grid->count : c->wall_places);
  packing_i_fabric part = {{{0, 0}}, 0};
  for (size_t p = b * PACKING_I_MEASURE_BLOCK; p < end; p++) {
    if (pairs)
      add_pairs(c, p, &part);
    else
      add_walls(c, c->wall_place[p], &part);
  }
  f->parts[block] = part;
}

/* All NaN: there is no direction. */
static void fill_nothing(packing_fabric_report *report)
{
  for (int i = 0; i < 3; i++) {
    report->eigenvalues[i] = (double)NAN;
    for (int j = 0; j < 3; j++)
      report->tensor[i][j] = report->eigenvectors[i][j] = (double)NAN;
  }
  report->sd = report->noise_floor = (double)NAN;
}

static double deviation(const double *values, int count)
{
  double mean = 0, squares = 0;
  for (int k = 0; k < count; k++)
    mean += values[k] / count;
  for (int k = 0; k < count; k++)
    squares += (values[k] - mean) * (values[k] - mean);
  return sqrt(squares / (count - 1));
}

/* In the plane z comes last even where the other eigenvalue is 0 (or, rounded, below). */
static void order_plane(packing_fabric_report *report)
{
  static const double z[3] = {0, 0, 1};
  for (int k = 0; k < 2; k++)
    if (report->eigenvectors[k][2] != 0) {
      memmove(report->eigenvectors[k], report->eigenvectors[k + 1],
              (size_t)(2 - k) * sizeof report->eigenvectors[k]);
      memmove(&report->eigenvalues[k], &report->eigenvalues[k + 1],
              (size_t)(2 - k) * sizeof report->eigenvalues[k]);
      break;
    }
  memcpy(report->eigenvectors[2], z, sizeof z);
  report->eigenvalues[2] = 0;
}

void packing_i_fabric_report(const packing_i_fabric *parts, size_t count, int dim,
                             packing_fabric_report *report)
{
  static const int place[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  packing_i_fabric all = {{{0, 0}}, 0};
  for (size_t b = 0; b < count; b++) {
    double sum[6];
    for (int k = 0; k < 6; k++)
      sum[k] = packing_i_sum_value(&parts[b].sum[k]);
    packing_i_fabric_add(&all, sum, parts[b].count);
  }
  report->count = all.count;
  report->dim = dim;
  if (all.count == 0) {
    fill_nothing(report);
    return;
  }
  const double n = (double)all.count;
  double matrix[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      report->tensor[i][j] = packing_i_sum_value(&all.sum[place[i][j]]) / n;
  memcpy(matrix, report->tensor, sizeof matrix);
  packing_i_eigen(matrix, report->eigenvalues, report->eigenvectors);
  if (dim == 2)
    order_plane(report);
  report->sd = deviation(report->eigenvalues, dim);
  report->noise_floor = dim == 2 ? sqrt(1 / (8 * n)) : sqrt(4 / (45 * n));
}

packing_status packing_contacts_fabric(const packing_contacts *c,
                                       const packing_fabric_def *def,
                                       packing_fabric_report *report)
{
  packing_fabric_def d;
  packing_fabric_report found;
  if (c == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(PACKING_I_DEF_READ(c->context, packing_fabric, of, def, &d));
  PACKING_I_TRY(packing_i_contacts_check_of(c->context, d.of));
  const size_t pair_blocks =
      d.of == PACKING_CONTACTS_OF_WALLS ? 0 : packing_i_measure_blocks(c->grid->count);
  const size_t wall_blocks =
      d.of == PACKING_CONTACTS_OF_PAIRS ? 0 : packing_i_measure_blocks(c->wall_places);
  fabric f = {c, NULL, pair_blocks};
  f.parts = packing_i_alloc(c->allocator, pair_blocks + wall_blocks, sizeof *f.parts);
  if (f.parts == NULL)
    return packing_i_nomem(c->context);
  packing_i_parallel(c->context, pair_blocks + wall_blocks, sum_block, &f);
  packing_fabric_report_init(&found);
  packing_i_fabric_report(f.parts, pair_blocks + wall_blocks, c->dim, &found);
  packing_i_free(c->allocator, f.parts);
  return packing_i_report_write(c->context, report, &found, sizeof found);
}
