/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One zone: draws by strata, and the stock. A mixture draws its parts by strata and the radii of
 * each part by strata of its own, so that shares and parts each keep to the law. */
#include "source_zone.h"
#include <math.h>
#include <string.h>

/* A bin of less is joined to its neighbour: its share in the stock would be noise. */
static const double least_due = 1.0 / 64;

static double draw_psd(packing_i_zone *zone, size_t *component)
{
  const size_t parts = packing_psd_components(zone->psd);
  size_t part = 0, inner;
  if (parts > 1) {
    const double v = packing_i_strata_uniform_open(&zone->choice);
    while (part + 1 < parts && zone->upto[part] < v)
      part++;
  }
  const packing_psd *law = packing_i_psd_part(zone->psd, part);
  packing_i_strata *strata = &zone->strata[part];
  double u = packing_i_strata_uniform_open(strata), v = 0.5;
  if (law->ops->numbers > 1) { /* v chooses, a radius of a sample or a part of a part */
    v = u;
    u = packing_i_strata_second(strata);
  }
  *component = part;
  return packing_i_psd_radius(law, PACKING_BY_NUMBER, u, v, &inner);
}

/* 0: the list has come to its end. */
static int draw(packing_i_zone *zone, double *r, size_t *component)
{
  if (!zone->listed)
    *r = draw_psd(zone, component);
  else if (zone->list.undrawn > 0)
    *r =
        packing_i_list_draw(&zone->list, packing_i_strata_bits(&zone->choice), component);
  else
    return 0;
  return 1;
}

/* Edges and shares of the bins. */
static void set_bins(packing_i_stock *stock, const packing_psd *psd)
{
  double edge = 0, upto = 0; /* of the last bin that is not empty */
  size_t last = 0;
  for (size_t b = 0; b < PACKING_I_STOCK_BINS; b++) {
    const double p = (double)(b + 1) / PACKING_I_STOCK_BINS;
    const double next = packing_psd_quantile(psd, PACKING_BY_NUMBER, p);
    const double share = packing_psd_cdf(psd, PACKING_BY_NUMBER, next);
    stock->due[b] = 0;
    if (share - upto >= least_due) {
      stock->due[b] = share - upto;
      edge = next;
      upto = share;
      last = b;
    }
    stock->edge[b] = edge;
  }
  stock->due[last] += 1 - upto;
  for (size_t b = last; b < PACKING_I_STOCK_BINS; b++)
    stock->edge[b] = packing_psd_max_r(psd);
}

static void weigh_bins(packing_i_stock *stock)
{
  for (size_t b = 0; b < PACKING_I_STOCK_BINS; b++) {
    const double due = (double)stock->count * stock->due[b];
    stock->weight[b] = due > 0 ? 1 / due : 0;
  }
}

/* Moves the stock's radii between the place that falls empty and the one that is needed. */
static void replace(packing_i_stock *stock, size_t empty, double r, size_t component)
{
  size_t place = packing_i_stock_below(stock, r);
  if (place > empty) {
    place--;
    memmove(&stock->r[empty], &stock->r[empty + 1], (place - empty) * sizeof *stock->r);
    memmove(&stock->component[empty], &stock->component[empty + 1],
            (place - empty) * sizeof *stock->component);
  } else {
    memmove(&stock->r[place + 1], &stock->r[place], (empty - place) * sizeof *stock->r);
    memmove(&stock->component[place + 1], &stock->component[place],
            (empty - place) * sizeof *stock->component);
  }
  stock->r[place] = r;
  stock->component[place] = (int32_t)component;
  stock->held[packing_i_stock_bin(stock, r)]++;
}

static void find_full(packing_i_stock *stock)
{
  double most = -1;
  size_t below = 0;
  for (size_t b = 0; b < PACKING_I_STOCK_BINS; b++) {
    const double excess = (double)stock->held[b] * stock->weight[b];
    below += stock->held[b];
    if (excess > most) {
      most = excess;
      stock->full = below;
    }
  }
}

static void close_gap(packing_i_stock *stock, size_t empty)
{
  const size_t after = --stock->count - empty;
  memmove(&stock->r[empty], &stock->r[empty + 1], after * sizeof *stock->r);
  memmove(&stock->component[empty], &stock->component[empty + 1],
          after * sizeof *stock->component);
  weigh_bins(stock);
}

static void fill_stock(packing_i_zone *zone, size_t size)
{
  packing_i_stock *stock = &zone->stock;
  set_bins(stock, zone->psd);
  double r;
  size_t component;
  while (stock->count < size && draw(zone, &r, &component)) {
    stock->r[stock->count] = INFINITY; /* the place that is empty */
    replace(stock, stock->count++, r, component);
  }
  weigh_bins(stock);
  find_full(stock);
}

/* Shares and strata of the parts. */
static packing_status start_parts(packing_context *context, packing_i_zone_key key,
                                  packing_i_zone *zone)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t parts = packing_psd_components(zone->psd);
  zone->strata = packing_i_alloc(allocator, parts, sizeof *zone->strata);
  zone->upto = packing_i_alloc(allocator, parts, sizeof *zone->upto);
  if (zone->strata == NULL || zone->upto == NULL)
    return packing_i_nomem(context);
  const uint64_t index = (uint64_t)key.zone << 32;
  double upto = 0;
  packing_i_strata_open(&zone->choice, key.seed, key.stream, index);
  for (size_t i = 0; i < parts; i++) {
    packing_i_strata_open(&zone->strata[i], key.seed, key.stream, index + 1 + i);
    zone->upto[i] = upto += packing_i_psd_part_share(zone->psd, PACKING_BY_NUMBER, i);
  }
  return PACKING_OK;
}

packing_status packing_i_zone_start(packing_context *context, packing_psd *psd,
                                    const packing_front_def *def, size_t stock,
                                    packing_i_zone_key key, packing_i_zone *zone)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  zone->listed = psd == NULL;
  if (zone->listed) {
    PACKING_I_TRY(
        packing_i_list_start(context, def->classes, def->class_count, &zone->list));
    PACKING_I_TRY(packing_i_list_psd(context, &zone->list, &zone->psd));
  } else {
    zone->psd = packing_psd_retain(psd);
  }
  PACKING_I_TRY(start_parts(context, key, zone));
  zone->stock.r = packing_i_alloc(allocator, stock, sizeof *zone->stock.r);
  zone->stock.component =
      packing_i_alloc(allocator, stock, sizeof *zone->stock.component);
  if (zone->stock.r == NULL || zone->stock.component == NULL)
    return packing_i_nomem(context);
  fill_stock(zone, stock);
  return PACKING_OK;
}

void packing_i_zone_finish(const packing_allocator *allocator, packing_i_zone *zone)
{
  packing_i_free(allocator, zone->stock.r);
  packing_i_free(allocator, zone->stock.component);
  packing_i_free(allocator, zone->strata);
  packing_i_free(allocator, zone->upto);
  packing_i_list_finish(allocator, &zone->list);
  packing_psd_destroy(zone->psd);
}

static void count_taken(packing_i_zone *zone, size_t component)
{
  if (!zone->listed)
    return;
  zone->list.left[component]--;
  zone->list.unplaced--;
}

void packing_i_zone_take(packing_i_zone *zone, size_t index, double *r, size_t *component)
{
  packing_i_stock *stock = &zone->stock;
  *r = stock->r[index];
  *component = (size_t)stock->component[index];
  stock->held[packing_i_stock_bin(stock, *r)]--;
  count_taken(zone, *component);
  double next;
  size_t part;
  if (draw(zone, &next, &part))
    replace(stock, index, next, part);
  else
    close_gap(stock, index);
  find_full(stock);
}

int packing_i_zone_next(packing_i_zone *zone, double *r, size_t *component)
{
  if (zone->returned > 0) {
    zone->returned--;
    *r = zone->returned_r[zone->returned];
    *component = zone->returned_component[zone->returned];
    count_taken(zone, *component);
    return 1;
  }
  const size_t held = zone->stock.count;
  if (held == 0)
    return 0;
  const size_t any =
      held == 1 ? 0 : (size_t)packing_i_stream_below(&zone->choice.stream, held);
  packing_i_zone_take(zone, any, r, component);
  return 1;
}

void packing_i_zone_return(packing_i_zone *zone, double r, size_t component)
{
  zone->returned_r[zone->returned] = r;
  zone->returned_component[zone->returned] = component;
  zone->returned++;
  if (zone->listed) {
    zone->list.left[component]++;
    zone->list.unplaced++;
  }
}
