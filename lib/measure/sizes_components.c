/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mixture and what was placed of it, component by component: shares by number and by mass, and
 * the Kolmogorov-Smirnov distance of each component's radii from its own law. Radii are sorted
 * into one array, component after component, by counting. N log N. */
#include "measure/sizes_internal.h"
#include "view.h"

typedef struct grouped {
  size_t components;
  size_t *start; /* of each component in r, and the end: components + 1 */
  double *r;
} grouped;

static size_t component_of(const packing_view *v, size_t i)
{
  if (v->component.data == NULL)
    return 0;
  const char *entry = (const char *)v->component.data + i * v->component.stride;
  const int32_t component = *(const int32_t *)(const void *)entry;
  return component < 0 ? SIZE_MAX : (size_t)component;
}

static packing_status check_components(packing_context *context, const packing_psd *psd,
                                       const packing_view *v)
{
  if (psd->components > 1)
    PACKING_I_TRY(packing_i_check_given(context, "component", v->component.data));
  for (size_t i = 0; i < v->count; i++)
    if (component_of(v, i) >= psd->components)
      return packing_i_fail(context, PACKING_ERR_RANGE, "component", i,
                            "of particle %zu is not one of the %zu there are", i,
                            psd->components);
  return PACKING_OK;
}

/* After counting into start[c + 1], start[c] is where the next radius of c goes; at the end it
 * is where c + 1 begins, so all move up by one. */
static void group(const packing_view *v, grouped *g)
{
  for (size_t i = 0; i < v->count; i++)
    g->start[component_of(v, i) + 1]++;
  for (size_t c = 0; c < g->components; c++)
    g->start[c + 1] += g->start[c];
  for (size_t i = 0; i < v->count; i++)
    g->r[g->start[component_of(v, i)]++] = packing_i_view_r(v, i);
  for (size_t c = g->components; c > 0; c--)
    g->start[c] = g->start[c - 1];
  g->start[0] = 0;
}

/* Mass of sorted radii, in units of a particle of radius `unit`. */
static double mass_of(const packing_i_sizes *sizes, double unit, int dim)
{
  packing_i_sum sum = {0, 0};
  for (size_t i = 0; i < sizes->count; i++)
    packing_i_sum_add(&sum, packing_i_sizes_mass(sizes->sorted[i] / unit, dim));
  return packing_i_sum_value(&sum);
}

/* One component; its mass goes to mass_placed. */
static packing_status measure_one(packing_context *context, const packing_psd *psd,
                                  const grouped *g, size_t c, packing_size_component *to)
{
  const packing_column radii = {g->r + g->start[c], sizeof *g->r};
  packing_i_sizes sizes;
  to->count = g->start[c + 1] - g->start[c];
  to->ks = to->ks_p = (double)NAN;
  to->mass_placed = 0;
  if (to->count == 0)
    return PACKING_OK;
  packing_status status =
      packing_i_sizes_make(context, &radii, to->count, psd->dim, &sizes);
  if (status == PACKING_OK) {
    to->mass_placed = mass_of(&sizes, packing_psd_max_r(psd), psd->dim);
    to->ks =
        packing_i_sizes_distance(&sizes, PACKING_BY_NUMBER, packing_i_psd_part(psd, c));
    status = packing_kolmogorov_p(context, to->count, to->ks, &to->ks_p);
  }
  packing_i_sizes_free(&sizes);
  return status;
}

static void share(const packing_psd *psd, size_t particles, packing_size_component *list)
{
  packing_i_sum mass = {0, 0};
  for (size_t c = 0; c < psd->components; c++)
    packing_i_sum_add(&mass, list[c].mass_placed);
  for (size_t c = 0; c < psd->components; c++) {
    packing_size_component *to = &list[c];
    const double asked = packing_i_psd_part_share(psd, PACKING_BY_NUMBER, c);
    to->number_asked = asked;
    to->number_placed = (double)to->count / (double)particles;
    to->number_sd = sqrt(asked * (1 - asked) / (double)particles);
    to->mass_asked = packing_i_psd_part_share(psd, PACKING_BY_MASS, c);
    to->mass_placed /= packing_i_sum_value(&mass);
  }
}

static packing_status measure(packing_context *context, const packing_psd *psd,
                              const packing_view *v, packing_size_component *list)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  const size_t n = psd->components;
  grouped g = {n, NULL, NULL};
  packing_status status = PACKING_OK;
  packing_size_component *found = packing_i_calloc(allocator, n, sizeof *found);
  g.start = packing_i_calloc(allocator, n + 1, sizeof *g.start);
  g.r = packing_i_alloc(allocator, v->count, sizeof *g.r);
  if (found == NULL || g.start == NULL || g.r == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  group(v, &g);
  for (size_t c = 0; c < n && status == PACKING_OK; c++)
    status = measure_one(context, psd, &g, c, &found[c]);
  if (status != PACKING_OK)
    goto out;
  share(psd, v->count, found);
  memcpy(list, found, n * sizeof *list);
out:
  packing_i_free(allocator, found);
  packing_i_free(allocator, g.start);
  packing_i_free(allocator, g.r);
  return status;
}

packing_status packing_measure_components(packing_context *context, packing_psd *psd,
                                          const packing_view *view,
                                          packing_size_component *components)
{
  packing_view v;
  PACKING_I_TRY(packing_i_check_given(context, "psd", psd));
  PACKING_I_TRY(packing_i_check_given(context, "components", components));
  PACKING_I_TRY(packing_i_sizes_view(context, view, &v));
  PACKING_I_TRY(check_components(context, psd, &v));
  return measure(context, psd, &v, components);
}
