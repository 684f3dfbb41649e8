/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lattice placer: sites in order, cut to the container and to what stands there already.
 * Cost: linear in the sites of the bounding box. */
#include "lattice_internal.h"
#include <assert.h>

enum { SITES_A_UNIT = 4096 };

/* Touching a wall is allowed; a site that rounding puts outside by less than this share of the
 * spacing still counts as touching. */
static const double touching = 1e-12;

void packing_lattice_def_fill(packing_lattice_def *def, size_t size)
{
  packing_lattice_def defaults = {0};
  defaults.kind = PACKING_LATTICE_CELLS;
  defaults.seed = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check(packing_context *context, const packing_lattice_def *def)
{
  if (packing_lattice_kind_name(def->kind) == NULL)
    return packing_i_fail(context, PACKING_ERR_RANGE, "kind", PACKING_NO_INDEX,
                          "%d is no lattice", (int)def->kind);
  PACKING_I_TRY(packing_i_check_not_negative(context, "spacing_r", def->spacing_r));
  PACKING_I_TRY(packing_i_check_not_negative(context, "cell", def->cell));
  return PACKING_OK;
}

static int fits(const packing_placer *placer, const packing_i_lattice *lattice,
                packing_vec3 site, double r)
{
  const double room = packing_domain_signed_distance(placer->domain, &site, NULL);
  if (room < r - touching * lattice->spacing_r)
    return 0;
  return !lattice->obstacles ||
         packing_i_index_free(&lattice->index, site, r * (1 - touching));
}

/* Fills the next site, if it can take a particle. */
static packing_status fill_site(packing_placer *placer, packing_i_lattice *lattice)
{
  packing_particles *store = placer->particles;
  if (store->count == store->capacity)
    PACKING_I_TRY(
        packing_particles_reserve(store, store->count + store->count / 2 + 256));
  if (lattice->pending_r == 0)
    lattice->pending_r =
        packing_i_psd_draw(placer->psd, &lattice->sizes, &lattice->pending_component);
  const double r = lattice->pending_r;
  const size_t i = lattice->next++;
  const packing_vec3 site = lattice->random
                                ? packing_i_cells_site(lattice, i, r, store->dim)
                                : packing_i_crystal_site(&lattice->crystal, i);
  placer->tally.attempts++;
  if (!fits(placer, lattice, site, r))
    return PACKING_OK;
  PACKING_I_TRY(packing_i_placer_put(placer, site, r, lattice->pending_component));
  lattice->pending_r = 0;
  return PACKING_OK;
}

static packing_status lattice_step(packing_placer *placer, size_t budget)
{
  packing_i_lattice *lattice = placer->method;
  for (; budget > 0; budget--)
    for (int i = 0; i < SITES_A_UNIT; i++) {
      const int enough = lattice->count != 0 && placer->tally.placed == lattice->count;
      if (enough || lattice->next == lattice->sites) {
        placer->tally.state = enough || lattice->count == 0 ? PACKING_PLACER_DONE
                                                            : PACKING_PLACER_SATURATED;
        return PACKING_OK;
      }
      PACKING_I_TRY(fill_site(placer, lattice));
    }
  placer->tally.progress = (double)lattice->next / (double)lattice->sites;
  return PACKING_OK;
}

static void lattice_release(packing_placer *placer)
{
  packing_i_lattice *lattice = placer->method;
  packing_i_index_release(&lattice->index);
  packing_i_free(packing_i_allocator(placer->context), lattice);
}

static const packing_i_placer_ops lattice_ops = {
    "lattice", "Liu and You, equations 1 to 4 (cells); crystallography (the rest)",
    lattice_step, lattice_release};

static packing_status start(packing_placer *placer, const packing_lattice_def *def)
{
  packing_context *context = placer->context;
  packing_i_lattice *lattice =
      packing_i_calloc(packing_i_allocator(context), 1, sizeof *lattice);
  if (lattice == NULL)
    return packing_i_nomem(context);
  placer->method = lattice;
  const double max_r = packing_psd_max_r(placer->psd);
  const packing_particles *store = placer->particles;
  double top_r = max_r;
  for (size_t i = 0; i < store->count; i++)
    if (store->r[i] > top_r)
      top_r = store->r[i];
  lattice->count = def->count;
  lattice->spacing_r = def->spacing_r == 0 ? max_r : def->spacing_r;
  lattice->random = def->kind == PACKING_LATTICE_CELLS;
  lattice->obstacles = store->count > 0;
  packing_i_index_init(&lattice->index, context, placer->domain, top_r, store->count);
  if (max_r > lattice->spacing_r)
    return packing_i_fail(context, PACKING_ERR_RANGE, "spacing_r", PACKING_NO_INDEX,
                          "%g is smaller than the largest radius %g", lattice->spacing_r,
                          max_r);
  PACKING_I_TRY(packing_i_placer_check_room(placer));
  packing_i_stream_open(&lattice->sizes, def->seed, def->stream, PACKING_PURPOSE_SIZE, 0);
  packing_i_stream_open(&lattice->positions, def->seed, def->stream,
                        PACKING_PURPOSE_POSITION, 0);
  PACKING_I_TRY(packing_i_index_add_store(&lattice->index, placer->domain, store));
  return lattice->random ? packing_i_cells_start(placer, lattice, def->cell)
                         : packing_i_crystal_start(placer, lattice, def->kind);
}

packing_status packing_lattice_create(packing_context *context,
                                      const packing_lattice_def *def,
                                      packing_domain *domain, packing_psd *psd,
                                      packing_particles *particles,
                                      packing_placer **placer)
{
  packing_lattice_def d;
  packing_placer *p = NULL;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_lattice, cell, def, &d));
  PACKING_I_TRY(check(context, &d));
  PACKING_I_TRY(packing_i_placer_create(context, &lattice_ops, domain, psd, particles,
                                        placer == NULL ? NULL : &p));
  assert(p != NULL);
  const packing_status status = start(p, &d);
  if (status != PACKING_OK) {
    packing_placer_destroy(p);
    return status;
  }
  *placer = p;
  return PACKING_OK;
}
