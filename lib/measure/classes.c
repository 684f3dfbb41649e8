/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Non stable, stable and firm particles, as in Figure 1 of the trilateration paper (seed 003):
 * "a sphere should have at least three contacts with its neighbours to find a statically stable
 * position, or four contacts to be kept firmly". Three hold it up only when the line from its
 * centre along gravity meets their triangle below it: strictly inside, since on an edge it rolls.
 * In the plane two contacts and their segment take the place of three and their triangle. Linear
 * in particles and contacts. */
#include "measure/contacts_internal.h"

#define NONE UINT32_MAX

/* The contacts of a particle that has as many as there are dimensions. */
typedef struct stand {
  packing_vec3 normal[3];
  int count;
} stand;

typedef struct sorting {
  const packing_contacts *contacts;
  int walls;
  uint32_t *degree; /* of each place, then the number of its stand */
  stand *stands;
  uint32_t count; /* of stands */
} sorting;

void packing_classes_def_fill(packing_classes_def *def, size_t size)
{
  packing_classes_def defaults = {0};
  defaults.walls = 1;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* Barycentric weights of the foot of the line through the centre, times twice the area; the
 * height of the foot is the mean height with them. */
static int is_supported(const stand *s, packing_vec3 up, int dim)
{
  double weight[3], height = 0, sum = 0;
  for (int k = 0; k < dim; k++) {
    const packing_vec3 a = s->normal[(k + 1) % dim], b = s->normal[(k + 2) % dim];
    weight[k] = dim == 3 ? packing_i_dot(up, packing_i_cross(a, b))
                         : (k == 0 ? 1 : -1) * (up.x * a.y - up.y * a.x);
    height += weight[k] * packing_i_dot(up, s->normal[k]);
    sum += weight[k];
  }
  for (int k = 0; k < dim; k++)
    if (!(weight[k] * weight[0] > 0))
      return 0;
  return sum > 0 ? height < 0 : height > 0;
}

static void add_normal(sorting *s, size_t place, packing_vec3 normal)
{
  if (s->degree[place] == NONE)
    return;
  stand *at = &s->stands[s->degree[place]];
  at->normal[at->count++] = normal;
}

static void count_walls(sorting *s)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_contacts *c = s->contacts;
  for (size_t k = 0; s->walls && k < c->wall_places; k++)
    s->degree[c->wall_place[k]] +=
        (uint32_t)packing_i_contacts_walls(c, c->wall_place[k], near);
}

/* Counts particles by their degree and numbers those that have `dim` contacts. */
static void count_degrees(sorting *s, packing_classes_report *report)
{
  const uint32_t dim = (uint32_t)s->contacts->dim;
  for (size_t p = 0; p < s->contacts->grid->count; p++) {
    const uint32_t degree = s->degree[p];
    report->degree[degree < 4 ? degree : 4]++;
    report->non_stable += (size_t)(degree <= dim);
    report->firm += (size_t)(degree > dim);
    s->degree[p] = degree == dim ? s->count++ : NONE;
  }
}

static void collect_normals(sorting *s)
{
  packing_i_near_wall near[PACKING_I_NEAR_WALLS];
  const packing_vec3 none = {0, 0, 0};
  const packing_contacts *c = s->contacts;
  for (size_t p = 0; p < c->grid->count; p++)
    for (size_t k = c->start[p]; k < c->start[p + 1]; k++) {
      if (s->degree[p] == NONE && s->degree[c->other[k]] == NONE)
        continue;
      const packing_vec3 n = packing_i_contacts_unit(packing_i_contacts_vector(c, p, k));
      add_normal(s, p, n);
      add_normal(s, c->other[k], packing_i_sub(none, n));
    }
  for (size_t k = 0; s->walls && k < c->wall_places; k++) {
    const int walls = packing_i_contacts_walls(c, c->wall_place[k], near);
    for (int w = 0; w < walls; w++)
      add_normal(s, c->wall_place[k], packing_i_sub(none, near[w].normal));
  }
}

static packing_status sort_particles(sorting *s, packing_vec3 up,
                                     packing_classes_report *report)
{
  const packing_contacts *c = s->contacts;
  packing_i_contacts_count_degrees(c, s->degree);
  count_walls(s);
  count_degrees(s, report);
  s->stands = packing_i_calloc(c->allocator, s->count, sizeof *s->stands);
  if (s->stands == NULL)
    return packing_i_nomem(c->context);
  collect_normals(s);
  for (uint32_t k = 0; k < s->count; k++)
    report->supported += (size_t)is_supported(&s->stands[k], up, c->dim);
  report->stable = report->supported;
  report->non_stable -= report->supported;
  return PACKING_OK;
}

/* The direction as a unit vector, in the plane without z. */
static packing_status read_up(const packing_contacts *c, packing_vec3 *up)
{
  static const char *const fields[3] = {"up.x", "up.y", "up.z"};
  PACKING_I_TRY(packing_i_check_point(c->context, fields, up));
  const int is_default = up->x == 0 && up->y == 0 && up->z == 0;
  if (is_default)
    *up = c->dim == 2 ? packing_i_vec(0, 1, 0) : packing_i_vec(0, 0, 1);
  if (c->dim == 2)
    up->z = 0;
  const double largest = fmax(fabs(up->x), fmax(fabs(up->y), fabs(up->z)));
  if (largest == 0)
    return packing_i_fail(c->context, PACKING_ERR_INVALID, "up", PACKING_NO_INDEX,
                          "along z, which the plane does not have");
  *up = packing_i_contacts_unit(
      packing_i_vec(up->x / largest, up->y / largest, up->z / largest));
  return PACKING_OK;
}

packing_status packing_contacts_classes(const packing_contacts *c,
                                        const packing_classes_def *def,
                                        packing_classes_report *report)
{
  packing_classes_def d;
  packing_classes_report found;
  if (c == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(PACKING_I_DEF_READ(c->context, packing_classes, walls, def, &d));
  PACKING_I_TRY(packing_i_check_switch(c->context, "walls", d.walls));
  PACKING_I_TRY(read_up(c, &d.up));
  packing_classes_report_init(&found);
  sorting s = {c, d.walls, NULL, NULL, 0};
  s.degree = packing_i_alloc(c->allocator, c->grid->count, sizeof *s.degree);
  if (s.degree == NULL)
    return packing_i_nomem(c->context);
  packing_status status = sort_particles(&s, d.up, &found);
  packing_i_free(c->allocator, s.degree);
  packing_i_free(c->allocator, s.stands);
  if (status != PACKING_OK)
    return status;
  const double one = c->grid->count == 0 ? (double)NAN : 1.0 / (double)c->grid->count;
  found.non_stable_share = (double)found.non_stable * one;
  found.stable_share = (double)found.stable * one;
  found.firm_share = (double)found.firm * one;
  return packing_i_report_write(c->context, report, &found, sizeof found);
}
