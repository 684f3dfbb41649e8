/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The network in the order of the view: how many, how many of each particle, and which. Linear;
 * the contacts of one particle are sorted among themselves. */
#include "measure/contacts_internal.h"
#include <gsl/gsl_heapsort.h>

/* The part of the list that is asked for: whole particles first, whose contacts are sorted, then
 * cut to [first, end). */
typedef struct listing {
  const packing_contacts *contacts;
  size_t first;
  size_t end;
  size_t *start; /* of each particle i in the list; one more */
  size_t whole_first;
  packing_contact *whole;
} listing;

size_t packing_contacts_particles(const packing_contacts *contacts)
{
  return contacts->grid->count;
}

size_t packing_contacts_count(const packing_contacts *contacts)
{
  return contacts->count;
}

size_t packing_contacts_wall_count(const packing_contacts *contacts)
{
  return contacts->wall_count;
}

void packing_i_contacts_count_degrees(const packing_contacts *c, uint32_t *degree)
{
  for (size_t p = 0; p < c->grid->count; p++)
    degree[p] = (uint32_t)(c->start[p + 1] - c->start[p]);
  for (size_t k = 0; k < c->count; k++)
    degree[c->other[k]]++;
}

packing_status packing_contacts_degrees(const packing_contacts *c, size_t *degrees,
                                        size_t *walls)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  if (c == NULL)
    return PACKING_ERR_INVALID;
  const packing_grid *g = c->grid;
  for (size_t p = 0; degrees != NULL && p < g->count; p++)
    degrees[g->index[p]] = c->start[p + 1] - c->start[p];
  for (size_t k = 0; degrees != NULL && k < c->count; k++)
    degrees[g->index[c->other[k]]]++;
  for (size_t p = 0; walls != NULL && p < g->count; p++)
    walls[p] = 0;
  for (size_t k = 0; walls != NULL && k < c->wall_places; k++)
    walls[g->index[c->wall_place[k]]] =
        (size_t)packing_i_contacts_walls(c, c->wall_place[k], near);
  return PACKING_OK;
}

/* By i, j, then the image or the wall. */
static int compare(const void *a, const void *b)
{
  const packing_contact *p = a, *q = b;
  if (p->i != q->i)
    return p->i < q->i ? -1 : 1;
  if (p->j != q->j)
    return p->j < q->j ? -1 : 1;
  for (int k = 0; k < 3; k++)
    if (p->image[k] != q->image[k])
      return p->image[k] < q->image[k] ? -1 : 1;
  return p->wall < q->wall ? -1 : p->wall > q->wall;
}

/* How many periods the other particle is moved by along axis k. */
static int32_t image_of(const packing_contacts *c, size_t contact, int k, double own,
                        double other)
{
  const packing_i_grid_axis *axis = &c->grid->axis[k];
  if (c->image != NULL)
    return c->image[contact][k];
  return own - other > axis->half ? 1 : own - other < -axis->half ? -1 : 0;
}

static packing_contact describe(const packing_contacts *c, size_t own, size_t contact)
{
  const packing_grid *g = c->grid;
  const size_t other = c->other[contact];
  const packing_vec3 d = packing_i_contacts_vector(c, own, contact);
  const int swap = g->index[own] > g->index[other], sign = swap ? -1 : 1;
  const packing_contact it = {
      g->index[swap ? other : own],
      g->index[swap ? own : other],
      packing_i_contacts_unit(swap ? packing_i_sub(packing_i_vec(0, 0, 0), d) : d),
      packing_i_norm(d) - (g->r[own] + g->r[other]),
      {sign * image_of(c, contact, 0, g->x[own], g->x[other]),
       sign * image_of(c, contact, 1, g->y[own], g->y[other]),
       sign * image_of(c, contact, 2, g->z[own], g->z[other])},
      -1};
  return it;
}

static size_t lower_index(const packing_contacts *c, size_t own, size_t contact)
{
  const size_t i = c->grid->index[own], j = c->grid->index[c->other[contact]];
  return i < j ? i : j;
}

/* Where the contacts of each particle i begin in the list. */
static void find_starts(listing *l)
{
  const packing_contacts *c = l->contacts;
  for (size_t p = 0; p < c->grid->count; p++)
    for (size_t k = c->start[p]; k < c->start[p + 1]; k++)
      l->start[lower_index(c, p, k) + 1]++;
  for (size_t i = 0; i < c->grid->count; i++)
    l->start[i + 1] += l->start[i];
}

/* Whether any contact of particle i is asked for; before its contacts are put in place. */
static int is_wanted(const listing *l, size_t i)
{
  return l->start[i] < l->end && l->start[i + 1] > l->first;
}

/* Allocates what holds the contacts of all particles asked for. */
static packing_status make_room(listing *l)
{
  const packing_contacts *c = l->contacts;
  size_t last = 0;
  l->whole_first = c->count;
  for (size_t i = 0; i < c->grid->count; i++)
    if (is_wanted(l, i) && l->start[i] < l->start[i + 1]) {
      l->whole_first = l->start[i] < l->whole_first ? l->start[i] : l->whole_first;
      last = l->start[i + 1];
    }
  l->whole = packing_i_alloc(
      c->allocator, last > l->whole_first ? last - l->whole_first : 0, sizeof *l->whole);
  return l->whole == NULL ? packing_i_nomem(c->context) : PACKING_OK;
}

/* Puts contacts where they belong, in any order within a particle, and sorts those of each. */
static void place_pairs(listing *l, size_t *placed)
{
  const packing_contacts *c = l->contacts;
  for (size_t p = 0; p < c->grid->count; p++)
    for (size_t k = c->start[p]; k < c->start[p + 1]; k++) {
      const size_t i = lower_index(c, p, k);
      if (is_wanted(l, i))
        l->whole[l->start[i] + placed[i]++ - l->whole_first] = describe(c, p, k);
    }
  for (size_t i = 0; i < c->grid->count; i++)
    if (placed[i] > 1)
      gsl_heapsort(l->whole + (l->start[i] - l->whole_first), placed[i], sizeof *l->whole,
                   compare);
}

/* Contacts [first, end) between particles, found behind l->whole + first - l->whole_first. */
static packing_status list_pairs(listing *l)
{
  const packing_contacts *c = l->contacts;
  size_t *placed = packing_i_calloc(c->allocator, c->grid->count, sizeof *placed);
  l->start = packing_i_calloc(c->allocator, c->grid->count + 1, sizeof *l->start);
  packing_status status = PACKING_OK;
  if (placed == NULL || l->start == NULL) {
    status = packing_i_nomem(c->context);
    goto out;
  }
  find_starts(l);
  status = make_room(l);
  if (status == PACKING_OK)
    place_pairs(l, placed);
out:
  packing_i_free(c->allocator, placed);
  packing_i_free(c->allocator, l->start);
  return status;
}

/* All contacts with walls. */
static packing_status list_walls(const packing_contacts *c, packing_contact **list)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  packing_contact *all = packing_i_alloc(c->allocator, c->wall_count, sizeof *all);
  size_t count = 0;
  if (all == NULL)
    return packing_i_nomem(c->context);
  for (size_t k = 0; k < c->wall_places; k++) {
    const size_t place = c->wall_place[k];
    const int walls = packing_i_contacts_walls(c, place, near);
    for (int w = 0; w < walls; w++)
      all[count++] =
          (packing_contact){c->grid->index[place],
                            PACKING_NO_INDEX,
                            packing_i_sub(packing_i_vec(0, 0, 0), near[w].normal),
                            near[w].distance - c->grid->r[place],
                            {0, 0, 0},
                            near[w].wall};
  }
  gsl_heapsort(all, count, sizeof *all, compare);
  *list = all;
  return PACKING_OK;
}

packing_status packing_contacts_list(const packing_contacts *c, size_t first,
                                     size_t capacity, packing_contact *list,
                                     size_t *count)
{
  if (c == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(packing_i_check_given(c->context, "count", count));
  if (capacity > 0)
    PACKING_I_TRY(packing_i_check_given(c->context, "list", list));
  const size_t all = c->count + c->wall_count;
  first = first < all ? first : all;
  const size_t end = capacity < all - first ? first + capacity : all;
  listing l = {c, first, end < c->count ? end : c->count, NULL, 0, NULL};
  packing_contact *walls = NULL;
  packing_status status = PACKING_OK;
  if (l.first < l.end)
    status = list_pairs(&l);
  if (status == PACKING_OK && end > c->count && first < end)
    status = list_walls(c, &walls);
  if (status != PACKING_OK)
    goto out;
  const size_t pairs = l.first < l.end ? l.end - l.first : 0;
  if (pairs > 0)
    memcpy(list, l.whole + (first - l.whole_first), pairs * sizeof *list);
  if (walls != NULL)
    memcpy(list + pairs, walls + (first + pairs - c->count),
           (end - first - pairs) * sizeof *list);
  *count = end - first;
out:
  packing_i_free(c->allocator, l.whole);
  packing_i_free(c->allocator, walls);
  return status;
}
