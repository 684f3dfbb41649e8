/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planar sections: areal porosity (the binary occupation ratio, black being void), the same of
 * the image, and the image. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "../common/moments.h"
#include "../common/program.h"
#include "measure.h"

/* Pixels of an image's longer edge: one alone, or many. */
enum { LARGE = 900, SMALL = 450 };

static double along(const packing_vec3 *v, packing_axis axis)
{
  return axis == PACKING_AXIS_X ? v->x : axis == PACKING_AXIS_Y ? v->y : v->z;
}

const char *section_say(char text[SECTION_TEXT], packing_axis axis,
                        const plane_found *plane)
{
  const double porosity = plane->report.porosity;
  const int length =
      snprintf(text, SECTION_TEXT, "%s = %.6g: ", axis_name(axis), plane->height);
  char *rest = text + length;
  if (isfinite(porosity))
    snprintf(rest, SECTION_TEXT - (size_t)length, "void %.4f", porosity);
  else
    snprintf(rest, SECTION_TEXT - (size_t)length, "outside of the container");
  return text;
}

/* Where plane k of a section lies. */
static double height_of(const measure_job *job, const section_ask *ask, size_t k)
{
  packing_bounds b;
  if (ask->one)
    return ask->height;
  packing_domain_bounds(job->domain, &b);
  const double lo = along(&b.lo, ask->axis), hi = along(&b.hi, ask->axis);
  return lo + (hi - lo) * ((double)k + 0.5) / (double)ask->count;
}

/* As many pixels as the plane's rectangle is long, `longest` at most. */
static void size_image(packing_section_image_def *def, const packing_section_report *r,
                       size_t longest)
{
  const double u = r->hi_u - r->lo_u, v = r->hi_v - r->lo_v, most = fmax(u, v);
  def->columns = (size_t)fmax(1, floor((double)longest * u / most + 0.5));
  def->rows = (size_t)fmax(1, floor((double)longest * v / most + 0.5));
}

static packing_status take_image(measure_job *job, const packing_section_def *plane,
                                 plane_found *found, size_t longest)
{
  packing_section_image_def def;
  size_t count = 0;
  packing_section_image_report_init(&found->image);
  found->image.occupation = (double)NAN;
  if (!(found->report.container_area > 0))
    return PACKING_OK;
  packing_section_image_def_init(&def);
  size_image(&def, &found->report, longest);
  const size_t pixels = def.rows * def.columns;
  found->pixels = program_take(pixels, 1);
  return packing_measure_section_image(job->context, plane, &def, job->domain, &job->view,
                                       found->pixels, pixels, &count, &found->image);
}

static packing_status cut(measure_job *job, const section_ask *ask, size_t k,
                          plane_found *found)
{
  packing_section_def def;
  size_t discs = 0;
  packing_section_def_init(&def);
  packing_section_report_init(&found->report);
  found->height = height_of(job, ask, k);
  packing_section_def_across(&def, ask->axis, found->height);
  const packing_status status = packing_measure_section(
      job->context, &def, job->domain, &job->view, NULL, 0, &discs, &found->report);
  if (status != PACKING_OK)
    return status;
  const int alone = job->asked->section_count == 1 && (ask->one || ask->count == 1);
  return take_image(job, &def, found, alone ? LARGE : SMALL);
}

static packing_status measure_one(measure_job *job, const section_ask *ask,
                                  section_found *found)
{
  packing_status status = PACKING_OK;
  found->count = ask->one ? 1 : ask->count;
  found->planes = program_take(found->count, sizeof *found->planes);
  for (size_t k = 0; k < found->count && status == PACKING_OK && !interrupted(); k++)
    status = cut(job, ask, k, &found->planes[k]);
  return status;
}

int sections_measure(measure_job *job)
{
  const measure_options *o = job->asked;
  packing_status status = PACKING_OK;
  if (job->spec.dim == 2)
    return program_fail(PROGRAM_BAD_INPUT, "--section: there are none in two dimensions");
  job->sections = program_take(o->section_count, sizeof *job->sections);
  for (size_t i = 0; i < o->section_count && status == PACKING_OK; i++)
    status = measure_one(job, &o->sections[i], &job->sections[i]);
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--section");
}

static void report_planes(cJSON *list, const section_found *found)
{
  for (size_t k = 0; k < found->count; k++) {
    const plane_found *plane = &found->planes[k];
    cJSON *entry = report_new();
    report_append_item(list, entry);
    report_add_real(entry, "height", plane->height);
    report_add_real(entry, "container_area", plane->report.container_area);
    report_add_real(entry, "solid_area", plane->report.solid_area);
    report_add_real(entry, "occupation_ratio", plane->report.porosity);
    report_add_real(entry, "image_occupation_ratio", plane->image.occupation);
  }
}

/* Of the planes that meet the container. */
static moments mean_of(const section_found *found)
{
  double *ratios = program_take(found->count, sizeof *ratios);
  size_t met = 0;
  for (size_t k = 0; k < found->count; k++)
    if (isfinite(found->planes[k].report.porosity))
      ratios[met++] = found->planes[k].report.porosity;
  const moments m = moments_of(ratios, met);
  free(ratios);
  return m;
}

static cJSON *report_one(const measure_job *job, const section_ask *ask,
                         const section_found *found)
{
  cJSON *made = report_new();
  const moments m = mean_of(found);
  report_add_text(made, "across", axis_name(ask->axis));
  report_add_real(made, "mean", m.mean);
  report_add_real(made, "sd", m.sd);
  report_add_real(made, "porosity", 1 - job->report.volume_fraction);
  report_planes(report_add_list(made, "planes"), found);
  return made;
}

void sections_report(const measure_job *job, cJSON *list)
{
  for (size_t i = 0; job->sections && i < job->asked->section_count; i++)
    report_append_item(list,
                       report_one(job, &job->asked->sections[i], &job->sections[i]));
}
