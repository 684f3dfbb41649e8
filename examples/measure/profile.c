/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Porosity along an axis or a radius, and on a grid of cells. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "measure.h"

static packing_status measure_one(measure_job *job, const profile_ask *ask,
                                  profile_found *found)
{
  packing_profile_def def;
  packing_profile_def_init(&def);
  packing_profile_report_init(&found->report);
  def.kind = ask->kind;
  def.axis = ask->axis;
  def.bins = ask->bins;
  found->bins = program_take(ask->bins, sizeof *found->bins);
  return packing_measure_profile(job->context, &def, job->domain, &job->view, found->bins,
                                 ask->bins, &found->count, &found->report);
}

int profiles_measure(measure_job *job)
{
  const measure_options *o = job->asked;
  packing_status status = PACKING_OK;
  job->profiles = program_take(o->profile_count, sizeof *job->profiles);
  for (size_t i = 0; i < o->profile_count && status == PACKING_OK; i++)
    status = measure_one(job, &o->profiles[i], &job->profiles[i]);
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--profile");
}

static cJSON *report_one(const profile_ask *ask, const profile_found *found)
{
  cJSON *made = report_new();
  report_add_text(made, "along", ask->name);
  report_add_real(made, "porosity", found->report.porosity);
  report_add_real(made, "error", found->report.error);
  cJSON *from = report_add_list(made, "from"), *to = report_add_list(made, "to");
  cJSON *list = report_add_list(made, "porosities");
  for (size_t k = 0; k < found->count; k++) {
    report_append_real(from, found->bins[k].from);
    report_append_real(to, found->bins[k].to);
    report_append_real(list, found->bins[k].porosity);
  }
  return made;
}

void profiles_report(const measure_job *job, cJSON *list)
{
  for (size_t i = 0; job->profiles && i < job->asked->profile_count; i++)
    report_append_item(list, report_one(&job->asked->profiles[i], &job->profiles[i]));
}

int map_measure(measure_job *job)
{
  packing_porosity_map_def def;
  map_found *found = &job->map;
  packing_porosity_map_def_init(&def);
  packing_porosity_map_report_init(&found->report);
  def.nx = (size_t)job->asked->map[0];
  def.ny = (size_t)job->asked->map[1];
  def.nz = (size_t)job->asked->map[2];
  if (job->spec.dim == 2 && def.nz != 1)
    return program_fail(PROGRAM_BAD_INPUT, "--map: NZ must be 1 in two dimensions");
  const size_t cells = def.nx * def.ny * def.nz;
  found->cells = program_take(cells, sizeof *found->cells);
  const packing_status status =
      packing_measure_porosity_map(job->context, &def, job->domain, &job->view,
                                   found->cells, cells, &found->count, &found->report);
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--map");
}

cJSON *map_report(const measure_job *job)
{
  const map_found *found = &job->map;
  double least = (double)INFINITY, most = -(double)INFINITY;
  if (!found->cells)
    return NULL;
  for (size_t k = 0; k < found->count; k++) {
    least = fmin(least, found->cells[k].porosity);
    most = fmax(most, found->cells[k].porosity);
  }
  cJSON *made = report_new();
  report_add_count(made, "nx", found->report.nx);
  report_add_count(made, "ny", found->report.ny);
  report_add_count(made, "nz", found->report.nz);
  report_add_real(made, "mean", found->report.mean);
  report_add_real(made, "sd", found->report.sd);
  report_add_real(made, "min", least);
  report_add_real(made, "max", most);
  report_add_real(made, "error", found->report.error);
  return made;
}
