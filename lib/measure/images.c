/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs with all their images: the grid's visit, in the view's numbers. Where a periodic cell is
 * wider than twice the reach the nearest image is the only one; narrower directions are met
 * image by image, as shifts of the grid itself, so no copies of particles are made. Linear in
 * particles, pairs and images. */
#include "measure/images.h"
#include "measure/measure_internal.h"
#include "vec.h"

/* Fits image[] with room to spare. */
#define MOST_PERIODS 32000

struct packing_i_images {
  packing_grid *grid;
  packing_i_grid_reach reach;
};

typedef struct translation {
  const packing_grid *grid;
  packing_i_image_function fn;
  void *arg;
} translation;

/* The farthest that any pair is asked for. */
static double farthest(const packing_i_images *images)
{
  double r_max = 0;
  for (int l = 0; l < images->grid->levels; l++)
    r_max = fmax(r_max, images->grid->level[l].r_max);
  return 2 * r_max * images->reach.factor + images->reach.gap;
}

static packing_status check_reach(packing_context *context,
                                  const packing_i_images *images)
{
  const double reach = farthest(images);
  for (int k = 0; k < 3; k++) {
    const double period = images->grid->axis[k].period;
    if (period > 0 && reach > MOST_PERIODS * period)
      return packing_i_fail(context, PACKING_ERR_RANGE, "gap", PACKING_NO_INDEX,
                            "pairs up to %g apart span more than %d periods of %g", reach,
                            MOST_PERIODS, period);
  }
  return PACKING_OK;
}

packing_status packing_i_images_create(packing_context *context,
                                       const packing_domain *domain,
                                       const packing_view *view, double factor,
                                       double gap, packing_i_images **images)
{
  packing_view v;
  PACKING_I_TRY(packing_i_check_not_negative(context, "factor", factor));
  PACKING_I_TRY(packing_i_check_finite(context, "gap", gap));
  PACKING_I_TRY(packing_i_measure_view(context, view, &v));
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_images *made = packing_i_calloc(allocator, 1, sizeof *made);
  if (made == NULL)
    return packing_i_nomem(context);
  made->reach.factor = factor;
  made->reach.gap = gap;
  made->reach.all_images = 1;
  packing_status status = packing_i_grid_build(context, PACKING_I_GRID_LEVELS, domain, &v,
                                               NULL, v.count, &made->reach, &made->grid);
  if (status == PACKING_OK)
    status = check_reach(context, made);
  if (status == PACKING_OK) {
    *images = made;
  } else {
    packing_grid_destroy(made->grid);
    packing_i_free(allocator, made);
  }
  return status;
}

void packing_i_images_destroy(packing_i_images *images)
{
  if (images == NULL)
    return;
  packing_grid *grid = images->grid;
  packing_i_free(grid->allocator, images);
  packing_grid_destroy(grid);
}

size_t packing_i_images_blocks(const packing_i_images *images)
{
  return packing_i_grid_blocks(images->grid);
}

/* From the grid's places to the view's indices, the lower one first. */
static void translate(void *arg, const packing_i_grid_pair *p)
{
  const translation *t = arg;
  const packing_grid *g = t->grid;
  const packing_vec3 none = {0, 0, 0};
  const int swap = g->index[p->own] > g->index[p->other], sign = swap ? -1 : 1;
  const size_t a = swap ? p->other : p->own, b = swap ? p->own : p->other;
  const packing_i_image pair = {g->index[a],
                                g->index[b],
                                swap ? packing_i_sub(none, p->d) : p->d,
                                p->distance,
                                g->r[a],
                                g->r[b],
                                {(int16_t)(sign * p->image[0]),
                                 (int16_t)(sign * p->image[1]),
                                 (int16_t)(sign * p->image[2])}};
  t->fn(t->arg, &pair);
}

void packing_i_images_visit(const packing_i_images *images, size_t block,
                            packing_i_image_function fn, void *arg)
{
  translation t = {images->grid, fn, arg};
  packing_i_grid_visit(images->grid, &images->reach, block, translate, &t);
}

const packing_grid *packing_i_images_grid(const packing_i_images *images)
{
  return images->grid;
}

const packing_i_grid_reach *packing_i_images_reach(const packing_i_images *images)
{
  return &images->reach;
}

int packing_i_images_are_many(const packing_i_images *images)
{
  const double reach = farthest(images);
  for (int k = 0; k < 3; k++)
    if (packing_i_grid_is_narrow(&images->grid->axis[k], reach))
      return 1;
  return 0;
}
