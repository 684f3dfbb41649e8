/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lowering the volume fraction of a finished pack.
 *
 * I. Perez Morales, R. Rosello Valera, C. Recarey and others, section 3, step 4 and Figure 12:
 * "remove or shrink", no more is said. Shrinking: all radii times (wanted / present)^(1 / dim).
 * Removing: N f particles, f the share of the volume that goes. The order by radius, equal ones
 * at random, is cut into as many equal parts, and one of each goes; where f > 1/2, one of each of
 * N (1 - f) stays. The parts are disjoint ranges of sizes, so the volume that goes differs from
 * what is wanted by no more than some two of the largest particle, whatever the distribution;
 * what is left of that is met by a few particles of the right size.
 *
 * Cost: linear; 41 bytes a particle. */
#include "ranks.h"
#include "sum.h"
#include "vec.h"
#include "particles/particles_internal.h"
#include "rng/rng_internal.h"
#include <float.h>
#include <packing/loosen.h>
#include <string.h>

enum { MOST_CHOSEN = 16 };

/* A fraction is above another if by more than this share: sums differ by rounding. */
static const double rounding = 1e-12;

/* A pack some of which goes. */
typedef struct thinning {
  int dim;
  size_t count;
  packing_i_rank *rank; /* the particles by radius */
  packing_i_rank *spare;
  unsigned char *gone; /* of each particle */
  size_t *indices;     /* of those that go, rising */
} thinning;

void packing_loosen_def_fill(packing_loosen_def *def, size_t size)
{
  packing_loosen_def defaults = {0};
  defaults.how = PACKING_LOOSEN_SHRINK;
  defaults.seed = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static double solid_volume(const packing_particles *store)
{
  packing_i_sum sum = {0, 0};
  for (size_t i = 0; i < store->count; i++)
    packing_i_sum_add(&sum, packing_i_ball_volume(store->dim, store->r[i]));
  return packing_i_sum_value(&sum);
}

static packing_status check(packing_context *context, const packing_loosen_def *d,
                            const packing_domain *domain, const packing_particles *store)
{
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_check_given(context, "particles", store));
  if (d->how != PACKING_LOOSEN_SHRINK && d->how != PACKING_LOOSEN_REMOVE)
    return packing_i_fail(context, PACKING_ERR_RANGE, "how", PACKING_NO_INDEX,
                          "%d is no way to loosen", (int)d->how);
  PACKING_I_TRY(packing_i_check_positive(context, "volume_fraction", d->volume_fraction));
  if (packing_domain_dim(domain) != store->dim)
    return packing_i_fail(context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "the store has %d dimensions, the domain %d", store->dim,
                          packing_domain_dim(domain));
  return PACKING_OK;
}

static packing_status shrink(packing_context *context, packing_particles *store,
                             double share)
{
  const double factor = store->dim == 2 ? sqrt(share) : cbrt(share);
  for (size_t i = 0; i < store->count; i++)
    if (store->r[i] * factor < DBL_MIN)
      return packing_i_fail(context, PACKING_ERR_RANGE, "volume_fraction",
                            PACKING_NO_INDEX, "the radius of particle %zu would vanish",
                            i);
  for (size_t i = 0; i < store->count; i++)
    store->r[i] *= factor;
  return PACKING_OK;
}

/* The particles by radius, those of equal radius in a random order. */
static void set_order(thinning *t, const double *r, packing_i_stream *stream)
{
  for (size_t i = 0; i < t->count; i++) {
    const size_t j = (size_t)packing_i_stream_below(stream, i + 1);
    t->rank[i] = (packing_i_rank){r[i], i};
    const packing_i_rank swap = t->rank[j];
    t->rank[j] = t->rank[i];
    t->rank[i] = swap;
  }
  packing_i_ranks_sort(t->rank, t->spare, t->count);
}

/* Marks `remove` particles, spread evenly over the order. */
static void mark(thinning *t, size_t remove, packing_i_stream *stream)
{
  const size_t keep = t->count - remove;
  const int few = remove <= keep;
  const size_t parts = few ? remove : keep; /* of two particles at least */
  memset(t->gone, !few, t->count);
  for (size_t i = 0, next = 0; i < parts; i++) {
    const double at = ((double)i + packing_i_stream_uniform(stream)) / (double)parts;
    size_t k = (size_t)(at * (double)t->count);
    if (k >= t->count)
      k = t->count - 1;
    if (k < next) /* one that lies in two parts */
      k = next;
    next = k + 1;
    t->gone[t->rank[k].index] = (unsigned char)few;
  }
}

static double volume_at(const thinning *t, size_t k)
{
  return packing_i_ball_volume(t->dim, t->rank[k].r);
}

/* The place in the order of the particle, gone or not as asked, whose volume is nearest to
 * `volume`; t->count: there is none. */
static size_t nearest(const thinning *t, double volume, unsigned char gone)
{
  size_t below = 0, above = t->count;
  while (below < above) {
    const size_t middle = below + (above - below) / 2;
    if (volume_at(t, middle) <= volume)
      below = middle + 1;
    else
      above = middle;
  }
  while (below > 0 && t->gone[t->rank[below - 1].index] != gone)
    below--;
  while (above < t->count && t->gone[t->rank[above].index] != gone)
    above++;
  if (below == 0 || (above < t->count &&
                     volume_at(t, above) - volume < volume - volume_at(t, below - 1)))
    return above;
  return below - 1;
}

/* Lets particles go or come back until their volume is what is wanted. */
static void settle(thinning *t, double wanted)
{
  packing_i_sum short_by = {wanted, 0};
  for (size_t k = 0; k < t->count; k++)
    if (t->gone[t->rank[k].index])
      packing_i_sum_add(&short_by, -volume_at(t, k));
  for (int step = 0; step < MOST_CHOSEN; step++) {
    const double more = packing_i_sum_value(&short_by);
    const unsigned char back = more < 0;
    const size_t k = nearest(t, fabs(more), back);
    if (k == t->count || !(fabs(fabs(more) - volume_at(t, k)) < fabs(more)))
      return;
    t->gone[t->rank[k].index] = !back;
    packing_i_sum_add(&short_by, back ? volume_at(t, k) : -volume_at(t, k));
  }
}

static packing_status remove_some(packing_context *context, const packing_loosen_def *d,
                                  packing_particles *store, double share, double solid)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t n = store->count;
  thinning t = {store->dim, n, NULL, NULL, NULL, NULL};
  packing_status status = PACKING_ERR_NOMEM;
  t.rank = packing_i_alloc(allocator, n, sizeof *t.rank);
  t.spare = packing_i_alloc(allocator, n, sizeof *t.spare);
  t.gone = packing_i_alloc(allocator, n, sizeof *t.gone);
  t.indices = packing_i_alloc(allocator, n, sizeof *t.indices);
  if (t.rank == NULL || t.spare == NULL || t.gone == NULL || t.indices == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  packing_i_stream stream;
  packing_i_stream_open(&stream, d->seed, d->stream, PACKING_PURPOSE_SAMPLE, 0);
  set_order(&t, store->r, &stream);
  mark(&t, (size_t)((1 - share) * (double)n + 0.5), &stream);
  settle(&t, solid * (1 - share));
  size_t count = 0;
  for (size_t i = 0; i < n; i++)
    if (t.gone[i])
      t.indices[count++] = i;
  status = packing_particles_remove(store, t.indices, count);
out:
  packing_i_free(allocator, t.rank);
  packing_i_free(allocator, t.spare);
  packing_i_free(allocator, t.gone);
  packing_i_free(allocator, t.indices);
  return status;
}

packing_status packing_loosen(packing_context *context, const packing_loosen_def *def,
                              const packing_domain *domain, packing_particles *particles,
                              double *reached)
{
  packing_loosen_def d;
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_loosen, stream, def, &d));
  PACKING_I_TRY(check(context, &d, domain, particles));
  const double whole = packing_domain_volume(domain);
  const double solid = solid_volume(particles), present = solid / whole;
  if (!(d.volume_fraction <= present * (1 + rounding)))
    return packing_i_fail(context, PACKING_ERR_RANGE, "volume_fraction", PACKING_NO_INDEX,
                          "%.12g is above the %.12g of the pack", d.volume_fraction,
                          present);
  const double share = d.volume_fraction / present;
  if (share < 1 && d.how == PACKING_LOOSEN_SHRINK)
    PACKING_I_TRY(shrink(context, particles, share));
  if (share < 1 && d.how == PACKING_LOOSEN_REMOVE)
    PACKING_I_TRY(remove_some(context, &d, particles, share, solid));
  if (reached != NULL)
    *reached = solid_volume(particles) / whole;
  return PACKING_OK;
}
