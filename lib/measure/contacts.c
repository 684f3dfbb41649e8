/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finding the contact network: contacts of each place are counted, then listed, block by block.
 * Linear in particles and contacts; beside the grid 8 bytes a particle and 4 a contact. */
#include "measure/contacts_internal.h"
#include <float.h>

/* The grid is asked a little farther than the criterion goes, whose rounding differs. */
#define ROUNDING (1.0 + 8.0 * DBL_EPSILON)

void packing_contacts_def_fill(packing_contacts_def *def, size_t size)
{
  packing_contacts_def defaults = {0};
  defaults.tolerance = 1e-9;
  defaults.walls = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* Surfaces at most `tolerance` radii (one or two) and `gap` apart. */
static int touches(const packing_contacts *c, double distance, double radii)
{
  return distance - radii <= c->tolerance * radii + c->gap;
}

static int is_contact(const packing_contacts *c, const packing_i_grid_pair *p)
{
  return touches(c, p->distance, c->grid->r[p->own] + c->grid->r[p->other]);
}

/* Blocks own their places, so no two threads count in one. */
static void count_contact(void *arg, const packing_i_grid_pair *p)
{
  const packing_contacts *c = arg;
  c->start[p->own] += (size_t)is_contact(c, p);
}

/* start[] runs down from the end of what a place owns to its beginning. */
static void list_contact(void *arg, const packing_i_grid_pair *p)
{
  const packing_contacts *c = arg;
  if (!is_contact(c, p))
    return;
  const size_t at = --c->start[p->own];
  c->other[at] = (uint32_t)p->other;
  if (c->image == NULL)
    return;
  for (int k = 0; k < 3; k++)
    c->image[at][k] = (int16_t)p->image[k];
}

static void count_block(void *arg, size_t block)
{
  const packing_contacts *c = arg;
  packing_i_grid_visit(c->grid, packing_i_images_reach(c->images), block, count_contact,
                       arg);
}

static void list_block(void *arg, size_t block)
{
  const packing_contacts *c = arg;
  packing_i_grid_visit(c->grid, packing_i_images_reach(c->images), block, list_contact,
                       arg);
}

static packing_status find_pairs(packing_contacts *c)
{
  const size_t blocks = packing_i_images_blocks(c->images);
  c->start = packing_i_calloc(c->allocator, c->grid->count + 1, sizeof *c->start);
  if (c->start == NULL)
    return packing_i_nomem(c->context);
  packing_i_parallel(c->context, blocks, count_block, c);
  for (size_t p = 0; p < c->grid->count; p++) {
    c->count += c->start[p];
    c->start[p] = c->count;
  }
  c->start[c->grid->count] = c->count;
  c->other = packing_i_alloc(c->allocator, c->count, sizeof *c->other);
  if (packing_i_images_are_many(c->images))
    c->image = packing_i_alloc(c->allocator, c->count, sizeof *c->image);
  if (c->other == NULL || (packing_i_images_are_many(c->images) && c->image == NULL))
    return packing_i_nomem(c->context);
  packing_i_parallel(c->context, blocks, list_block, c);
  return PACKING_OK;
}

packing_vec3 packing_i_contacts_vector(const packing_contacts *c, size_t own,
                                       size_t contact)
{
  const packing_grid *g = c->grid;
  const packing_i_grid_axis *axis = g->axis;
  const size_t other = c->other[contact];
  const packing_vec3 d = {g->x[own] - g->x[other], g->y[own] - g->y[other],
                          g->z[own] - g->z[other]};
  if (c->image != NULL) {
    const int16_t *image = c->image[contact];
    return packing_i_vec(image[0] * axis[0].period - d.x, image[1] * axis[1].period - d.y,
                         image[2] * axis[2].period - d.z);
  }
  return packing_i_vec(0.0 - packing_i_grid_nearest(&axis[0], d.x),
                       0.0 - packing_i_grid_nearest(&axis[1], d.y),
                       0.0 - packing_i_grid_nearest(&axis[2], d.z));
}

int packing_i_contacts_walls(const packing_contacts *c, size_t place,
                             packing_i_near_wall near[PACKING_I_NEAR_WALLS])
{
  const packing_grid *g = c->grid;
  const packing_vec3 p = {g->x[place], g->y[place], g->z[place]};
  const double r = g->r[place];
  const double reach = (r * (1 + c->tolerance) + c->gap) * ROUNDING;
  if (packing_i_measure_is_clear(packing_i_domain_planar(c->domain), p, reach))
    return 0;
  const int found = packing_i_domain_near_walls(c->domain, &p, reach, near);
  int kept = 0;
  for (int k = 0; k < found; k++)
    if (touches(c, near[k].distance, r))
      near[kept++] = near[k];
  return kept;
}

static packing_status find_walls(packing_contacts *c)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  size_t places = 0;
  for (size_t p = 0; p < c->grid->count; p++) {
    const int walls = packing_i_contacts_walls(c, p, near);
    c->wall_count += (size_t)walls;
    places += (size_t)(walls > 0);
  }
  c->wall_place = packing_i_alloc(c->allocator, places, sizeof *c->wall_place);
  if (c->wall_place == NULL)
    return packing_i_nomem(c->context);
  for (size_t p = 0; p < c->grid->count && c->wall_places < places; p++)
    if (packing_i_contacts_walls(c, p, near) > 0)
      c->wall_place[c->wall_places++] = (uint32_t)p;
  return PACKING_OK;
}

static packing_status check_def(packing_context *context, const packing_contacts_def *d)
{
  PACKING_I_TRY(packing_i_check_not_negative(context, "tolerance", d->tolerance));
  PACKING_I_TRY(packing_i_check_not_negative(context, "gap", d->gap));
  PACKING_I_TRY(packing_i_check_switch(context, "walls", d->walls));
  if (d->dim != 0 && d->dim != 2 && d->dim != 3)
    return packing_i_fail(context, PACKING_ERR_RANGE, "dim", PACKING_NO_INDEX,
                          "%d, must be 2 or 3, or 0 for that of the container", d->dim);
  return PACKING_OK;
}

/* Today's copy of the view, without z where the pack is flat by the caller's word alone. */
static packing_status read_view(packing_context *context, const packing_view *view,
                                int flat, packing_view *copy)
{
  PACKING_I_TRY(packing_i_measure_view(context, view, copy));
  if (copy->count > UINT32_MAX)
    return packing_i_fail(context, PACKING_ERR_RANGE, "view", PACKING_NO_INDEX,
                          "%zu particles, at most %lu can be linked", copy->count,
                          (unsigned long)UINT32_MAX);
  if (flat)
    copy->z.data = NULL;
  return PACKING_OK;
}

packing_status packing_contacts_create(packing_context *context,
                                       const packing_contacts_def *def,
                                       packing_domain *domain, const packing_view *view,
                                       packing_contacts **contacts)
{
  packing_contacts_def d;
  packing_view v;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_contacts, dim, def, &d));
  PACKING_I_TRY(check_def(context, &d));
  PACKING_I_TRY(read_view(context, view, domain == NULL && d.dim == 2, &v));
  PACKING_I_TRY(packing_i_check_given(context, "contacts", contacts));
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_contacts *c = packing_i_calloc(allocator, 1, sizeof *c);
  if (c == NULL)
    return packing_i_nomem(context);
  c->context = packing_i_context_hold(context);
  c->allocator = allocator;
  c->tolerance = d.tolerance;
  c->gap = d.gap;
  c->dim = d.dim != 0 ? d.dim : domain != NULL ? packing_domain_dim(domain) : 3;
  c->domain = domain == NULL ? NULL : packing_domain_retain(domain);
  packing_status status = packing_i_images_create(
      context, domain, &v, (1 + d.tolerance) * ROUNDING, d.gap * ROUNDING, &c->images);
  if (status == PACKING_OK) {
    c->grid = packing_i_images_grid(c->images);
    status = find_pairs(c);
  }
  if (status == PACKING_OK && domain != NULL && d.walls)
    status = find_walls(c);
  if (status == PACKING_OK)
    *contacts = c;
  else
    packing_contacts_destroy(c);
  return status;
}

void packing_contacts_destroy(packing_contacts *c)
{
  if (c == NULL)
    return;
  packing_context *context = c->context;
  packing_i_images_destroy(c->images);
  packing_domain_destroy(c->domain);
  packing_i_free(c->allocator, c->start);
  packing_i_free(c->allocator, c->other);
  packing_i_free(c->allocator, c->image);
  packing_i_free(c->allocator, c->wall_place);
  packing_i_free(c->allocator, c);
  packing_context_destroy(context);
}
