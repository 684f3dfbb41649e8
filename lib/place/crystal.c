/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crystals with nearest neighbours 2 r apart, by their conventional orthogonal cells:
 *   simple cubic       2r             body-centred cubic  4r/sqrt 3
 *   face-centred cubic 2 sqrt 2 r     square              2r
 *   hexagonal          2r x 2 sqrt 3 r, two rows
 *   simple hexagonal   the same layers, 2r apart
 *   hexagonal close    the same layers, 2 sqrt(8/3) r for two layers
 * They are the known answers of every measure. */
#include "lattice_internal.h"

/* Rows are given from the bottom layer up and along y: y and x offset in parts of the cell. */
typedef struct crystal_kind {
  const char *name;
  int dim;
  double cell[3]; /* in radii */
  size_t layers, rows;
  double offset[8];
} crystal_kind;

static const crystal_kind kinds[PACKING_LATTICE_END] = {
    [PACKING_LATTICE_CELLS] = {"cells", 0, {0, 0, 0}, 0, 0, {0}},
    [PACKING_LATTICE_SC] = {"sc", 3, {2, 2, 2}, 1, 1, {0, 0}},
    [PACKING_LATTICE_BCC] = {"bcc",
                             3,
                             {2.3094010767585030, 2.3094010767585030, 2.3094010767585030},
                             2,
                             1,
                             {0, 0, 0.5, 0.5}},
    [PACKING_LATTICE_FCC] = {"fcc",
                             3,
                             {2.8284271247461901, 2.8284271247461901, 2.8284271247461901},
                             2,
                             2,
                             {0, 0, 0.5, 0.5, 0, 0.5, 0.5, 0}},
    [PACKING_LATTICE_HCP] = {"hcp",
                             3,
                             {2, 3.4641016151377546, 3.2659863237109041},
                             2,
                             2,
                             {0, 0, 0.5, 0.5, 1.0 / 6, 0.5, 2.0 / 3, 0}},
    [PACKING_LATTICE_SIMPLE_HEXAGONAL] =
        {"simple-hexagonal", 3, {2, 3.4641016151377546, 2}, 1, 2, {0, 0, 0.5, 0.5}},
    [PACKING_LATTICE_HEXAGONAL] =
        {"hexagonal", 2, {2, 3.4641016151377546, 0}, 1, 2, {0, 0, 0.5, 0.5}},
    [PACKING_LATTICE_SQUARE] = {"square", 2, {2, 2, 0}, 1, 1, {0, 0}},
};

/* A box this close to a whole number of periods holds them (relative). */
static const double commensurate = 1e-9;

const char *packing_lattice_kind_name(packing_lattice_kind kind)
{
  if ((int)kind < 0 || kind >= PACKING_LATTICE_END)
    return NULL;
  return kinds[kind].name;
}

/* A periodic axis takes a whole number of cells, stretched to fit. */
static packing_status tile(packing_context *context, const char *axis, double length,
                           double *cell, size_t *n)
{
  const double periods = floor(length / *cell + 0.5);
  if (periods < 1 || fabs(periods * *cell - length) > commensurate * length)
    return packing_i_fail(context, PACKING_ERR_GEOMETRY, "domain", PACKING_NO_INDEX,
                          "its %s period %.17g is no multiple of the lattice's %.17g",
                          axis, length, *cell);
  *n = (size_t)periods;
  *cell = length / periods;
  return PACKING_OK;
}

packing_status packing_i_crystal_start(packing_placer *placer, packing_i_lattice *lattice,
                                       packing_lattice_kind kind)
{
  static const char *const axes[3] = {"x", "y", "z"};
  const crystal_kind *k = &kinds[kind];
  const unsigned periodic = packing_domain_periodic(placer->domain);
  packing_i_crystal *c = &lattice->crystal;
  packing_bounds b;
  packing_domain_bounds(placer->domain, &b);
  if (k->dim != placer->particles->dim)
    return packing_i_fail(placer->context, PACKING_ERR_RANGE, "kind", PACKING_NO_INDEX,
                          "%s is a lattice in %d dimensions", k->name, k->dim);
  double cell[3], origin[3], total = 1;
  for (int axis = 0; axis < 3; axis++) {
    const double lo = packing_i_component(b.lo, axis);
    const double length = packing_i_component(b.hi, axis) - lo;
    cell[axis] = k->cell[axis] * lattice->spacing_r;
    origin[axis] = lo;
    c->n[axis] = 1;
    if (axis >= k->dim)
      continue;
    if (periodic >> axis & 1U) {
      PACKING_I_TRY(tile(placer->context, axes[axis], length, &cell[axis], &c->n[axis]));
    } else {
      origin[axis] += lattice->spacing_r;
      c->n[axis] = length / cell[axis] < 1e6 ? (size_t)(length / cell[axis]) + 1 : 0;
    }
    total *= (double)c->n[axis];
  }
  total *= (double)(k->layers * k->rows);
  if (total > 1e15 || total < 1)
    return packing_i_fail(placer->context, PACKING_ERR_RANGE, "spacing_r",
                          PACKING_NO_INDEX, "%g is too small for the container",
                          lattice->spacing_r);
  c->cell = packing_i_vec(cell[0], cell[1], cell[2]);
  c->origin = packing_i_vec(origin[0], origin[1], origin[2]);
  c->layers = k->layers;
  c->rows = k->rows;
  c->offset = k->offset;
  lattice->sites = (size_t)total;
  return PACKING_OK;
}

packing_vec3 packing_i_crystal_site(const packing_i_crystal *c, size_t i)
{
  const size_t ix = i % c->n[0];
  i /= c->n[0];
  const size_t row = i % c->rows;
  i /= c->rows;
  const size_t iy = i % c->n[1];
  i /= c->n[1];
  const size_t layer = i % c->layers;
  const size_t iz = i / c->layers;
  const double *offset = &c->offset[2 * (layer * c->rows + row)];
  const double z = (double)iz + (double)layer / (double)c->layers;
  return packing_i_vec(c->origin.x + ((double)ix + offset[1]) * c->cell.x,
                       c->origin.y + ((double)iy + offset[0]) * c->cell.y,
                       c->origin.z + z * c->cell.z);
}
