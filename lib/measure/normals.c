/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The histogram of contact normals in bins of equal area (Figure 28 of the advancing-front paper
 * redone, so that an isotropic pack is flat). Bands of latitude, a whole one at each pole, the
 * others cut into sectors: in the manner of P. Leopardi, Electron. Trans. Numer. Anal. 25, 2006,
 * 309. By Archimedes a zone's area is its height in z, so a band of m bins out of n is 2 m / n
 * high, exactly; the angles below only choose how many sectors make bins about as wide as high.
 * Sectors are even in number and bands mirror each other, so -n is in the bin opposite to that
 * of n: one of the two is looked up. Linear in contacts. */
#include "measure/contacts_internal.h"

enum { MOST_BANDS = 1000, MOST_SECTORS = 10000 };

/* A pole's cap is 2 / sqrt(pi) times as wide, seen from its rim, as a square of its area. */
#define CAP 0.5641895835477563

/* Bins of band k: first[k] .. first[k + 1] - 1. In the plane: one band. */
typedef struct layout {
  int dim;
  int bands;
  size_t first[MOST_BANDS + 1];
} layout;

typedef struct histogram {
  const packing_contacts *contacts;
  const layout *layout;
  size_t *counts;
  size_t capacity;
} histogram;

void packing_normals_def_fill(packing_normals_def *def, size_t size)
{
  packing_normals_def defaults = {0};
  defaults.bands = 18;
  defaults.sectors = 36;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* sin(pi t) within 0.2 % (Bhaskara I), of arithmetic that rounds alike everywhere. */
static double sine(double t)
{
  return 16 * t * (1 - t) / (5 - 4 * t * (1 - t));
}

static size_t sectors_of(int bands, int band)
{
  if (band == 0 || band == bands - 1)
    return 1;
  const int nearer = band < bands - 1 - band ? band : bands - 1 - band;
  const double wide = bands - 2 + 2 * CAP; /* bins from pole to pole */
  const double half = floor(wide * sine((CAP + nearer - 0.5) / wide) + 0.5);
  return half < 1 ? 2 : 2 * (size_t)half;
}

static void lay_out(const packing_normals_def *d, int dim, layout *l)
{
  l->dim = dim;
  l->bands = dim == 2 ? 1 : d->bands;
  l->first[0] = 0;
  for (int k = 0; k < l->bands; k++)
    l->first[k + 1] =
        l->first[k] + (dim == 2 ? (size_t)d->sectors : sectors_of(d->bands, k));
}

static size_t bins_of(const layout *l)
{
  return l->first[l->bands];
}

static packing_status read_def(packing_context *context, const packing_normals_def *def,
                               packing_normals_def *d)
{
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_normals, sectors, def, d));
  PACKING_I_TRY(packing_i_contacts_check_of(context, d->of));
  if (d->bands < 2 || d->bands > MOST_BANDS)
    return packing_i_fail(context, PACKING_ERR_RANGE, "bands", PACKING_NO_INDEX,
                          "%d, must be 2 to %d", d->bands, MOST_BANDS);
  if (d->sectors < 2 || d->sectors > MOST_SECTORS || d->sectors % 2 != 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "sectors", PACKING_NO_INDEX,
                          "%d, must be even, 2 to %d", d->sectors, MOST_SECTORS);
  return PACKING_OK;
}

static packing_normals_bin bin_of(const layout *l, int band, size_t sector)
{
  const double bins = (double)bins_of(l),
               sectors = (double)(l->first[band + 1] - l->first[band]);
  packing_normals_bin bin = {0, 0, 2 * PACKING_I_PI * ((double)sector / sectors),
                             2 * PACKING_I_PI * ((double)(sector + 1) / sectors)};
  if (l->dim == 3) {
    bin.z_lo = (2 * (double)l->first[band] - bins) / bins;
    bin.z_hi = (2 * (double)l->first[band + 1] - bins) / bins;
  }
  return bin;
}

packing_status packing_normals_layout(packing_context *context,
                                      const packing_normals_def *def, int dim,
                                      packing_normals_bin *bins, size_t capacity,
                                      size_t *count)
{
  packing_normals_def d;
  layout l;
  PACKING_I_TRY(read_def(context, def, &d));
  if (dim != 2 && dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3", dim);
  PACKING_I_TRY(packing_i_check_given(context, "count", count));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(context, "bins", bins));
  lay_out(&d, dim, &l);
  for (int band = 0; band < l.bands; band++)
    for (size_t k = l.first[band]; k < l.first[band + 1] && k < capacity; k++)
      bins[k] = bin_of(&l, band, k - l.first[band]);
  *count = bins_of(&l);
  return PACKING_OK;
}

/* The band of z in [-1, 1]. */
static int band_of(const layout *l, double z)
{
  const double at = 0.5 * (z + 1) * (double)bins_of(l);
  int low = 0, high = l->bands;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    if (at >= (double)l->first[middle])
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* atan(t) / (2 pi), 0 <= t <= 1: a quarter of the angle by half-angle formulas, tan(pi / 16) < 0.2 at
 * most, then the series to t^23 / 23. Libraries round atan2() as they like; this decides. */
static double turn_of_slope(double t)
{
  if (t == 1)
    return 0.125;
  for (int halving = 0; halving < 2; halving++)
    t /= 1 + sqrt(1 + t * t);
  double sum = 0;
  for (int n = 23; n > 0; n -= 2)
    sum = 1.0 / n - t * t * sum;
  return 2 / PACKING_I_PI * t * sum;
}

/* The angle from x towards y, as a share of a whole turn. */
static double turn_of(double x, double y)
{
  const double u = fabs(x), v = fabs(y);
  if (u == 0 && v == 0)
    return 0;
  double turn = v > u ? 0.25 - turn_of_slope(u / v) : turn_of_slope(v / u);
  turn = x < 0 ? 0.5 - turn : turn;
  return y < 0 ? 1 - turn : turn;
}

/* The sector, out of `sectors`, of a direction. */
static size_t sector_of(double x, double y, size_t sectors)
{
  const size_t sector = (size_t)(turn_of(x, y) * (double)sectors);
  return sector < sectors ? sector : sectors - 1;
}

static void count_bin(const histogram *h, size_t bin)
{
  if (bin < h->capacity)
    h->counts[bin]++;
}

/* d and -d. */
static void count_direction(const histogram *h, packing_vec3 d)
{
  const layout *l = h->layout;
  if (l->dim == 2)
    d.z = 0;
  if (!(packing_i_dot(d, d) > 0))
    return;
  if (d.z < 0 || (d.z == 0 && (d.y < 0 || (d.y == 0 && d.x < 0))))
    d = packing_i_sub(packing_i_vec(0, 0, 0), d);
  const int band = band_of(l, packing_i_contacts_unit(d).z), mirror = l->bands - 1 - band;
  const size_t sectors = l->first[band + 1] - l->first[band];
  const size_t sector = sector_of(d.x, d.y, sectors);
  count_bin(h, l->first[band] + sector);
  count_bin(h, l->first[mirror] + (sector + sectors / 2) % sectors);
}

static void count_all(const histogram *h, packing_contacts_of of)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_contacts *c = h->contacts;
  for (size_t p = 0; of != PACKING_CONTACTS_OF_WALLS && p < c->grid->count; p++)
    for (size_t k = c->start[p]; k < c->start[p + 1]; k++)
      count_direction(h, packing_i_contacts_vector(c, p, k));
  for (size_t k = 0; of != PACKING_CONTACTS_OF_PAIRS && k < c->wall_places; k++) {
    const int walls = packing_i_contacts_walls(c, c->wall_place[k], near);
    for (int w = 0; w < walls; w++)
      count_direction(h, near[w].normal);
  }
}

packing_status packing_contacts_normals(const packing_contacts *c,
                                        const packing_normals_def *def, size_t *counts,
                                        size_t capacity, size_t *count)
{
  packing_normals_def d;
  layout l;
  if (c == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(read_def(c->context, def, &d));
  PACKING_I_TRY(packing_i_check_given(c->context, "count", count));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(c->context, "counts", counts));
  lay_out(&d, c->dim, &l);
  const size_t bins = bins_of(&l);
  const histogram h = {c, &l, counts, capacity < bins ? capacity : bins};
  for (size_t k = 0; k < h.capacity; k++)
    counts[k] = 0;
  if (h.capacity > 0)
    count_all(&h, d.of);
  *count = bins;
  return PACKING_OK;
}
