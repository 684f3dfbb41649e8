/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The radial distribution. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "measure.h"

/* Without RMAX these are tried until one leaves centres far enough from the walls. */
static const double tries[] = {5, 4, 3, 2.5, 2};
enum { TRIES = sizeof tries / sizeof tries[0] };

static packing_status measure_up_to(measure_job *job, double r_max)
{
  rdf_found *found = &job->rdf;
  packing_rdf_def def;
  packing_rdf_def_init(&def);
  packing_rdf_report_init(&found->report);
  def.r_max = found->r_max = r_max;
  def.bins = job->asked->rdf_bins;
  return packing_measure_rdf(job->context, &def, job->domain, &job->view, found->bins,
                             def.bins, &found->report);
}

int rdf_measure(measure_job *job)
{
  const double asked = job->asked->rdf_max;
  packing_status status = PACKING_OK;
  job->rdf.bins = program_take(job->asked->rdf_bins, sizeof *job->rdf.bins);
  if (asked > 0)
    status = measure_up_to(job, asked);
  for (int k = 0; asked == 0 && k < TRIES && status == PACKING_OK; k++) {
    status = measure_up_to(job, tries[k]);
    if (job->rdf.report.centres > 0)
      break;
  }
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--rdf");
}

cJSON *rdf_report(const measure_job *job)
{
  const rdf_found *found = &job->rdf;
  if (!found->bins)
    return NULL;
  const size_t bins = found->report.bins;
  cJSON *made = report_new();
  report_add_real(made, "r_max", found->r_max);
  report_add_real(made, "mean_diameter", found->report.mean_d);
  report_add_count(made, "centres", found->report.centres);
  report_add_real(made, "margin", found->report.margin);
  report_add_real(made, "density", found->report.density);
  const size_t peak = found->report.peak;
  report_add_real(made, "peak_r",
                  peak < bins ? 0.5 * (found->bins[peak].lo + found->bins[peak].hi)
                              : (double)NAN);
  cJSON *r = report_add_list(made, "r"), *g = report_add_list(made, "g");
  cJSON *sum = report_add_list(made, "cumulative");
  for (size_t i = 0; i < bins; i++) {
    report_append_real(r, 0.5 * (found->bins[i].lo + found->bins[i].hi));
    report_append_real(g, found->bins[i].g);
    report_append_real(sum, found->bins[i].cumulative);
  }
  return made;
}
