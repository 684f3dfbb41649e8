/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What profiles, maps and sections share: checks, periodic images. */
#include "measure/porosity_internal.h"

/* Periods that a particle may reach over, and images of one that a box may have. */
static const double most_periods = 250, most_images = 1e6;

packing_i_copies packing_i_copies_of(const packing_domain *domain, unsigned periodic,
                                     const packing_bounds *box, packing_vec3 centre,
                                     double r)
{
  packing_i_copies c = {centre, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}};
  double period[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    if (!(periodic & domain->body.periodic & 1u << k))
      continue;
    const double x = packing_i_component(centre, k);
    period[k] = packing_i_component(domain->body.period, k);
    c.first[k] = ceil((packing_i_component(box->lo, k) - r - x) / period[k]);
    const double last = floor((packing_i_component(box->hi, k) + r - x) / period[k]);
    c.count[k] = last >= c.first[k] ? (size_t)(last - c.first[k]) + 1 : 0;
  }
  c.period = packing_i_vec(period[0], period[1], period[2]);
  return c;
}

static packing_status check_images(packing_context *context, const packing_domain *domain,
                                   const packing_view *view)
{
  const packing_vec3 p = domain->body.period;
  const double least = fmin(fmin(p.x, p.y), p.z);
  for (size_t i = 0; i < view->count && domain->body.periodic != 0; i++)
    if (packing_i_view_r(view, i) > most_periods * least)
      return packing_i_fail(context, PACKING_ERR_RANGE, "r", i,
                            "%g of particle %zu reaches over too many periods of %g",
                            packing_i_view_r(view, i), i, least);
  return PACKING_OK;
}

packing_status packing_i_porosity_begin(packing_context *context, double tolerance,
                                        const packing_domain *domain,
                                        const packing_view *view, packing_view *copy)
{
  PACKING_I_TRY(packing_i_check_positive(context, "tolerance", tolerance));
  if (tolerance >= 1)
    return packing_i_fail(context, PACKING_ERR_RANGE, "tolerance", PACKING_NO_INDEX,
                          "%g must be below 1", tolerance);
  PACKING_I_TRY(packing_i_check_given(context, "domain", domain));
  PACKING_I_TRY(packing_i_measure_view(context, view, copy));
  PACKING_I_TRY(packing_i_measure_check(context, copy, domain->body.dim == 2));
  return check_images(context, domain, copy);
}

packing_status packing_i_porosity_list(packing_context *context, const char *field,
                                       const void *list, size_t capacity,
                                       const size_t *count, void *report)
{
  if (list == NULL && capacity > 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX, "NULL");
  PACKING_I_TRY(packing_i_check_given(context, "count", count));
  const size_t nothing = 0;
  return packing_i_report_write(context, report, &nothing, sizeof nothing);
}

packing_status packing_i_porosity_range(packing_context *context, double from, double to)
{
  PACKING_I_TRY(packing_i_check_finite(context, "from", from));
  PACKING_I_TRY(packing_i_check_finite(context, "to", to));
  if ((from == 0 && to == 0) || (from < to && isfinite(to - from)))
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, "to", PACKING_NO_INDEX,
                        "%g must be above from, %g", to, from);
}

packing_status packing_i_porosity_axis(packing_context *context, packing_axis axis,
                                       int dim)
{
  if ((int)axis >= 0 && (int)axis < dim)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, "axis", PACKING_NO_INDEX,
                        "%d is no axis of a container of %d dimensions", (int)axis, dim);
}

packing_status packing_i_porosity_images(packing_context *context, const char *field,
                                         const packing_domain *domain, unsigned periodic,
                                         const packing_bounds *box)
{
  double images = 1;
  for (int k = 0; k < 3; k++)
    if (periodic & domain->body.periodic & 1u << k)
      images *= 2 + (packing_i_component(box->hi, k) - packing_i_component(box->lo, k)) /
                        packing_i_component(domain->body.period, k);
  if (images <= most_images)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "reaches over %g cells of the period, more than %g", images,
                        most_images);
}

packing_i_cell packing_i_porosity_cell(void)
{
  const packing_i_cell cell = {
      PACKING_I_CELL_BOX,
      {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}},
      PACKING_AXIS_Z,
      {0, 0, 0},
      0};
  return cell;
}

packing_status packing_i_porosity_misbehaves(packing_context *context)
{
  return packing_i_fail(context, PACKING_ERR_GEOMETRY, "domain", PACKING_NO_INDEX,
                        "a distance to the container's wall is no number");
}
