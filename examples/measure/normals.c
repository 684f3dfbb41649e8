/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The histogram of contact normals. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "measure.h"

static packing_status take(measure_job *job, const packing_normals_def *def)
{
  normals_found *found = &job->normals;
  packing_status status =
      packing_normals_layout(job->context, def, job->spec.dim, NULL, 0, &found->count);
  if (status != PACKING_OK)
    return status;
  found->bins = program_take(found->count, sizeof *found->bins);
  found->counts = program_take(found->count, sizeof *found->counts);
  status = packing_normals_layout(job->context, def, job->spec.dim, found->bins,
                                  found->count, &found->count);
  if (status == PACKING_OK)
    status = packing_contacts_normals(job->contacts, def, found->counts, found->count,
                                      &found->count);
  for (size_t k = 0; k < found->count; k++)
    found->sum += found->counts[k];
  return status;
}

/* From 6 to 18 bands, with some 40 entries a bin in between. */
static int bands_of(const measure_job *job)
{
  const double entries = 2 * (double)packing_contacts_count(job->contacts);
  const int bands = 2 * (int)floor(0.5 * sqrt(entries / 40));
  return bands < 6 ? 6 : bands > 18 ? 18 : bands;
}

int normals_measure(measure_job *job)
{
  packing_normals_def def;
  packing_normals_def_init(&def);
  def.bands = job->asked->normals ? job->asked->normals : bands_of(job);
  def.sectors = 2 * def.bands;
  const packing_status status = take(job, &def);
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--normals");
}

cJSON *normals_report(const measure_job *job)
{
  const normals_found *found = &job->normals;
  if (!found->bins)
    return NULL;
  cJSON *made = report_new();
  cJSON *z_lo = report_add_list(made, "z_lo"), *z_hi = report_add_list(made, "z_hi");
  cJSON *from = report_add_list(made, "azimuth_lo");
  cJSON *to = report_add_list(made, "azimuth_hi");
  cJSON *counts = report_add_list(made, "count");
  for (size_t k = 0; k < found->count; k++) {
    report_append_real(z_lo, found->bins[k].z_lo);
    report_append_real(z_hi, found->bins[k].z_hi);
    report_append_real(from, found->bins[k].azimuth_lo);
    report_append_real(to, found->bins[k].azimuth_hi);
    report_append_count(counts, found->counts[k]);
  }
  return made;
}
