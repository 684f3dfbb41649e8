/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parallel sections at equal distances and the mean of their areal porosities (section.c), as
 * seed 001 takes 5 of each pack (its table 14). They lie in the middles of equal parts of the
 * range: the midpoint rule for Cavalieri's integral of areas over heights. */
#include "measure/section_internal.h"

void packing_sections_def_fill(packing_sections_def *def, size_t size)
{
  packing_sections_def defaults = {0};
  defaults.axis = PACKING_AXIS_Z;
  defaults.sections = 5;
  defaults.tolerance = 1e-10;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static void set_plane(packing_i_section *s, int axis, double height)
{
  double *const origin[] = {&s->plane.origin.x, &s->plane.origin.y, &s->plane.origin.z};
  *origin[axis] = height;
}

/* Mean and deviation of the sections that meet the container. */
static void summarise(const packing_section_entry *entries, size_t count,
                      packing_sections_report *report)
{
  packing_i_sum sum = {0, 0}, squares = {0, 0}, solid = {0, 0}, area = {0, 0};
  for (size_t k = 0; k < count; k++)
    if (entries[k].container_area > 0) {
      report->sections++;
      packing_i_sum_add(&sum, entries[k].porosity);
      packing_i_sum_add(&solid, entries[k].solid_area);
      packing_i_sum_add(&area, entries[k].container_area);
    }
  const double n = (double)report->sections;
  report->mean = report->sections > 0 ? packing_i_sum_value(&sum) / n : (double)NAN;
  report->porosity = report->sections > 0
                         ? 1 - packing_i_sum_value(&solid) / packing_i_sum_value(&area)
                         : (double)NAN;
  for (size_t k = 0; k < count; k++)
    if (entries[k].container_area > 0)
      packing_i_sum_add(&squares, (entries[k].porosity - report->mean) *
                                      (entries[k].porosity - report->mean));
  report->sd =
      report->sections > 1 ? sqrt(packing_i_sum_value(&squares) / (n - 1)) : (double)NAN;
}

static packing_status measure_all(packing_context *context, packing_i_section *s,
                                  const packing_sections_def *d,
                                  packing_section_entry *entries,
                                  packing_sections_report *report)
{
  for (size_t k = 0; k < d->sections; k++) {
    packing_section_report one;
    size_t discs;
    const double height = report->from + (report->to - report->from) *
                                             (((double)k + 0.5) / (double)d->sections);
    set_plane(s, (int)d->axis, height);
    PACKING_I_TRY(packing_i_section_measure(context, s, NULL, 0, &discs, &one));
    entries[k] =
        (packing_section_entry){height, one.container_area, one.solid_area, one.porosity};
    report->error = fmax(report->error, one.error);
  }
  summarise(entries, d->sections, report);
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_sections_def *d)
{
  PACKING_I_TRY(packing_i_porosity_axis(context, d->axis, 3));
  PACKING_I_TRY(packing_i_porosity_range(context, d->from, d->to));
  if (d->sections == 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "sections", PACKING_NO_INDEX,
                          "0, at least 1 is needed");
  return PACKING_OK;
}

packing_status packing_measure_sections(packing_context *context,
                                        const packing_sections_def *def,
                                        packing_domain *domain, const packing_view *view,
                                        packing_section_entry *entries, size_t capacity,
                                        size_t *count, packing_sections_report *report)
{
  const packing_allocator *a = packing_i_allocator(context);
  packing_sections_def d;
  packing_section_def plane;
  packing_view v;
  packing_i_section section;
  packing_sections_report found;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_sections, tolerance, def, &d));
  PACKING_I_TRY(check(context, &d));
  packing_section_def_init(&plane);
  packing_section_def_across(&plane, d.axis, 0);
  plane.tolerance = d.tolerance;
  PACKING_I_TRY(packing_i_section_begin(context, &plane, domain, view, &v, &section));
  PACKING_I_TRY(
      packing_i_porosity_list(context, "entries", entries, capacity, count, report));
  packing_sections_report_init(&found);
  found.from = d.from;
  found.to = d.to;
  if (d.from == 0 && d.to == 0) {
    found.from = packing_i_component(domain->body.bounds.lo, (int)d.axis);
    found.to = packing_i_component(domain->body.bounds.hi, (int)d.axis);
  }
  packing_section_entry *all = packing_i_alloc(a, d.sections, sizeof *all);
  if (all == NULL)
    return packing_i_nomem(context);
  packing_status status = measure_all(context, &section, &d, all, &found);
  if (status == PACKING_OK) {
    if (capacity > 0)
      memcpy(entries, all, (capacity < d.sections ? capacity : d.sections) * sizeof *all);
    *count = d.sections;
    status = packing_i_report_write(context, report, &found, sizeof found);
  }
  packing_i_free(a, all);
  return status;
}
