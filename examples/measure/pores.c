/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pores, constrictions and their distributions by number. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "measure.h"

/* The radius that a share k / 40 of `count` rising ones does not exceed. */
static void take_points(double *points, const double *radii, size_t count)
{
  for (size_t k = 0; k < PORE_POINTS; k++) {
    const double rank = ceil((double)count * (double)k / (PORE_POINTS - 1)) - 1;
    points[k] = count == 0 ? (double)NAN : radii[rank < 0 ? 0 : (size_t)rank];
  }
}

static packing_status take_sizes(const packing_pores *network, packing_pores_part part,
                                 double *points)
{
  size_t count = 0;
  packing_status status =
      packing_pores_sizes(network, part, PACKING_BY_NUMBER, 0, NULL, NULL, &count);
  if (status != PACKING_OK)
    return status;
  double *radii = program_take(count, sizeof *radii);
  status =
      packing_pores_sizes(network, part, PACKING_BY_NUMBER, count, radii, NULL, &count);
  take_points(points, radii, count);
  free(radii);
  return status;
}

int pores_measure(measure_job *job)
{
  pores_found *found = &job->pores;
  packing_pores_def def;
  packing_pores_def_init(&def);
  packing_pores_report_init(&found->report);
  def.dim = job->spec.dim;
  if (!isnan(job->asked->pores_overlap)) {
    def.merge = PACKING_PORES_MERGE_OVERLAP;
    def.overlap = job->asked->pores_overlap;
  }
  packing_status status =
      packing_pores_create(job->context, &def, job->domain, &job->view, &found->network);
  if (status == PACKING_OK)
    status = packing_pores_summary(found->network, &found->report);
  if (status == PACKING_OK)
    status = take_sizes(found->network, PACKING_PORES_PORES, found->pore_r);
  if (status == PACKING_OK)
    status =
        take_sizes(found->network, PACKING_PORES_CONSTRICTIONS, found->constriction_r);
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--pores");
}

static void report_points(cJSON *all, const pores_found *found)
{
  cJSON *made = report_add_object(all, "distribution");
  cJSON *share = report_add_list(made, "share");
  for (size_t k = 0; k < PORE_POINTS; k++)
    report_append_real(share, (double)k / (PORE_POINTS - 1));
  report_add_reals(made, "pore_r", found->pore_r, PORE_POINTS);
  report_add_reals(made, "constriction_r", found->constriction_r, PORE_POINTS);
}

cJSON *pores_report(const measure_job *job)
{
  const packing_pores_report *r = &job->pores.report;
  if (!job->pores.network)
    return NULL;
  cJSON *made = report_new();
  report_add_count(made, "pores", r->pores);
  report_add_count(made, "constrictions", r->constrictions);
  report_add_real(made, "mean_coordination", r->mean_coordination);
  report_add_real(made, "min_r", r->min_r);
  report_add_real(made, "mean_r", r->mean_r);
  report_add_real(made, "max_r", r->max_r);
  report_add_real(made, "min_constriction_r", r->min_constriction_r);
  report_add_real(made, "mean_constriction_r", r->mean_constriction_r);
  report_add_real(made, "max_constriction_r", r->max_constriction_r);
  report_add_count(made, "blocked", r->blocked);
  report_add_count(made, "cut", r->cut);
  report_add_count(made, "closed_constrictions", r->closed_constrictions);
  report_add_count(made, "open_constrictions", r->open_constrictions);
  report_points(made, &job->pores);
  return made;
}
