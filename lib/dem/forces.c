/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The forces of a step: slabs of even number side by side, then those of odd number. A slab's
 * pairs are screened, gathered into batches, handed to the laws in their order, and their forces
 * added to both particles (Campello and Cassares, equations 2, 3, 5, 7, 12 and 15). */
#include "stepper_internal.h"

typedef struct pass {
  packing_dem *dem;
  size_t colour;
  int tally;
} pass;

static void fill_up(packing_i_batch *b)
{
  double *const columns[] = {b->dx, b->dy, b->dz, b->distance, b->ri, b->rj};
  packing_i_batch_repeat(columns, sizeof columns / sizeof *columns, b->count);
  for (size_t k = b->count; k % 8 != 0; k++) {
    b->i[k] = b->i[b->count - 1];
    b->j[k] = b->j[b->count - 1];
  }
}

static void set_materials(const packing_dem *dem, packing_i_batch *b)
{
  const packing_i_pair_table *table = dem->materials;
  const size_t whole = (b->count + 7) / 8 * 8;
  for (size_t k = 0; k < whole; k++) {
    const size_t entry = dem->one_material ? 0
                                           : dem->material[b->i[k]] * (table->count + 1) +
                                                 dem->material[b->j[k]];
    b->pair[k] = (uint32_t)entry;
    b->share[k] = table->share[entry];
  }
}

static void tally_contacts(packing_i_slab *slab, const packing_i_batch *b)
{
  slab->contacts += b->count;
  for (size_t k = 0; k < b->count; k++) {
    const double share = b->overlap[k] / fmin(b->ri[k], b->rj[k]);
    slab->max_overlap = share > slab->max_overlap ? share : slab->max_overlap;
  }
}

/* A full batch of pairs; `only`: the law of distance that it is for, NULL: contacts. */
static void flush(const pass *p, packing_i_slab *slab, const packing_law *only,
                  packing_i_batch *b)
{
  packing_dem *dem = p->dem;
  double *history = NULL;
  if (b->count == 0)
    return;
  fill_up(b);
  set_materials(dem, b);
  dem->kernels->motion(dem->motion, only == NULL, dem->def.arm == PACKING_ARM_RADIUS, b);
  if (only == NULL)
    history = packing_i_history_fetch(dem, (size_t)(slab - dem->slab), b, 0);
  packing_i_dem_apply(dem, only, dem->materials->pair, history, b);
  if (only == NULL)
    packing_i_history_store(dem, history, b, 0);
  dem->kernels->add(dem->force, b);
  if (p->tally && only == NULL)
    tally_contacts(slab, b);
  b->count = 0;
}

static void work_through(const pass *p, packing_i_slab *slab, const packing_law *only,
                         packing_i_batch *b)
{
  const packing_dem *dem = p->dem;
  const double reach = only == NULL ? 0 : only->reach;
  const size_t end = slab->list_first + slab->list_count;
  for (size_t k = slab->list_first; k < end;) {
    const size_t room = PACKING_I_BATCH - b->count,
                 take = end - k < room ? end - k : room;
    dem->kernels->screen(dem->position, &dem->images, reach, dem->list_i, dem->list_j, k,
                         take, b);
    k += take;
    if (b->count > PACKING_I_BATCH - 32)
      flush(p, slab, only, b);
  }
  flush(p, slab, only, b);
}

static void slab_forces(void *arg, size_t block)
{
  const pass *p = arg;
  packing_dem *dem = p->dem;
  packing_i_slab *slab = &dem->slab[2 * block + p->colour];
  packing_i_batch batch;
  batch.count = 0;
  if (p->tally) {
    slab->contacts = slab->wall_contacts = 0;
    slab->max_overlap = 0;
  }
  work_through(p, slab, NULL, &batch);
  for (size_t l = 0; l < dem->law_count; l++)
    if (dem->laws[l]->reach > 0)
      work_through(p, slab, dem->laws[l], &batch);
  packing_i_dem_wall_forces(dem, slab, &batch, p->tally);
}

/* At once, since the slabs change when the list is made again. */
static void add_up(packing_dem *dem)
{
  dem->contacts = dem->wall_contacts = 0;
  dem->max_overlap = 0;
  for (int s = 0; s < dem->cut.slabs; s++) {
    const packing_i_slab *slab = &dem->slab[s];
    dem->contacts += slab->contacts;
    dem->wall_contacts += slab->wall_contacts;
    dem->max_overlap = fmax(dem->max_overlap, slab->max_overlap);
  }
}

void packing_i_dem_forces(packing_dem *dem, int tally)
{
  const size_t slabs = (size_t)dem->cut.slabs;
  for (size_t colour = 0; colour < 2; colour++) {
    pass p = {dem, colour, tally};
    packing_i_dem_run(dem, (slabs + 1 - colour) / 2, slab_forces, &p);
  }
  if (tally)
    add_up(dem);
}
