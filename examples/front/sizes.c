/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sizes placed beside those asked: of all, of each component of a mixture, of each part of
 * the container. Particles that stood there before do not count. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "front.h"

static void skip(packing_column *column, size_t count)
{
  if (column->data)
    column->data = (const char *)column->data + count * column->stride;
}

static packing_view placed_view(const front_job *job)
{
  packing_view view;
  packing_particles_view(job->particles, &view);
  packing_column *const columns[] = {&view.x, &view.y, &view.z, &view.r, &view.component};
  for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
    skip(columns[i], job->standing);
  view.count -= job->standing;
  return view;
}

static int measure_components(front_job *job, const packing_view *view)
{
  const size_t parts = packing_psd_components(job->psd);
  if (parts < 2)
    return 0;
  job->components = program_take(parts, sizeof *job->components);
  const packing_status status =
      packing_measure_components(job->context, job->psd, view, job->components);
  return status == PACKING_OK ? 0 : program_status(job->context, status, "measures");
}

static int measure_whole(front_job *job, const packing_view *view)
{
  packing_sizes_report sizes;
  report *r = &job->report;
  packing_sizes_report_init(&sizes);
  const packing_status status =
      packing_measure_sizes(job->context, job->psd, view, &sizes);
  r->ks = sizes.ks;
  r->ks_limit = sizes.ks_limit;
  r->ks_mass = sizes.ks_mass;
  r->mean_relative_error = sizes.mean_relative_error;
  return status == PACKING_OK ? measure_components(job, view)
                              : program_status(job->context, status, "measures");
}

/* ---- parts of the container ---- */

/* The part that holds a centre; their number: none does. */
static size_t grade_of(const front_job *job, packing_vec3 centre)
{
  size_t i = 0;
  while (i < job->asked->grade_count &&
         !packing_domain_holds(job->grades[i].domain, &centre, 0))
    i++;
  return i;
}

static int measure_grade(front_job *job, front_grade *g, const double *r)
{
  packing_sizes_report sizes;
  packing_view view;
  if (g->count == 0)
    return 0;
  packing_view_init(&view);
  packing_sizes_report_init(&sizes);
  view.count = g->count;
  view.x = view.y = view.r = (packing_column){r, sizeof *r};
  const packing_status status =
      packing_measure_sizes(job->context, g->psd, &view, &sizes);
  g->ks = sizes.ks;
  g->ks_limit = sizes.ks_limit;
  return status == PACKING_OK ? 0 : program_status(job->context, status, "measures");
}

/* The radii in each part, one after the other. */
static int measure_grades(front_job *job, const packing_view *view)
{
  const pack p = {.view = *view};
  double *r = program_take(view->count, sizeof *r);
  int code = 0;
  for (size_t g = 0; g < job->asked->grade_count && !code; g++) {
    front_grade *grade = &job->grades[g];
    for (size_t i = 0; i < view->count; i++)
      if (grade_of(job, pack_centre(&p, i)) == g)
        r[grade->count++] = pack_radius(&p, i);
    code = measure_grade(job, grade, r);
  }
  free(r);
  return code;
}

int front_measure_sizes(front_job *job)
{
  const packing_view view = placed_view(job);
  if (view.count == 0)
    return 0;
  if (job->asked->grade_count)
    return measure_grades(job, &view);
  return job->psd ? measure_whole(job, &view) : 0;
}
