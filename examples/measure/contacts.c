/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the contact network says beside coordination and fabric, and the list of bonds. */
#include <math.h>
#include <stdio.h>
#include "../common/measures.h"
#include "measure.h"

static packing_status measure_classes(measure_job *job)
{
  packing_classes_def def;
  packing_classes_def_init(&def);
  packing_classes_report_init(&job->classes);
  def.up = job->asked->up;
  return packing_contacts_classes(job->contacts, &def, &job->classes);
}

static packing_status measure_wall_fabric(measure_job *job)
{
  packing_fabric_def def;
  packing_fabric_report found;
  packing_fabric_def_init(&def);
  packing_fabric_report_init(&found);
  def.of = PACKING_CONTACTS_OF_WALLS;
  const packing_status status = packing_contacts_fabric(job->contacts, &def, &found);
  if (status == PACKING_OK)
    measures_keep_fabric(&job->wall_fabric, &found);
  return status;
}

static packing_status measure_orientations(measure_job *job)
{
  packing_orientations_def def;
  packing_fabric_report found;
  if (!job->view.qw.data)
    return PACKING_OK;
  packing_orientations_def_init(&def);
  packing_fabric_report_init(&found);
  def.dim = job->spec.dim;
  const packing_status status =
      packing_measure_orientations(job->context, &def, &job->view, &found);
  if (status == PACKING_OK)
    measures_keep_fabric(&job->orientations, &found);
  return status;
}

static packing_status find_bonds(measure_job *job)
{
  packing_contacts_def def;
  if (isnan(job->asked->bond_gap))
    return PACKING_OK;
  packing_contacts_def_init(&def);
  def.gap = job->asked->bond_gap;
  def.walls = 0;
  def.dim = job->spec.dim;
  return packing_contacts_create(job->context, &def, job->domain, &job->view,
                                 &job->bonds);
}

int contacts_measure(measure_job *job)
{
  packing_status status = measure_classes(job);
  if (status != PACKING_OK)
    return measure_failed(job, status, "--up");
  status = measure_wall_fabric(job);
  if (status != PACKING_OK)
    return measure_failed(job, status, "fabric");
  status = measure_orientations(job);
  if (status != PACKING_OK)
    return measure_failed(job, status, "orientations");
  status = find_bonds(job);
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--bonds");
}

const char *coordination_say(char text[COORDINATION_TEXT], const report *r)
{
  if (isfinite(r->coordination_mean_no_rattlers))
    snprintf(text, COORDINATION_TEXT, "%.3f; %.3f without %zu rattler%s",
             r->coordination_mean, r->coordination_mean_no_rattlers, r->rattlers,
             r->rattlers == 1 ? "" : "s");
  else
    snprintf(text, COORDINATION_TEXT, "%.3f; all are rattlers", r->coordination_mean);
  return text;
}

static void add_degrees(cJSON *all, const packing_classes_report *found)
{
  cJSON *list = report_add_list(all, "degree");
  for (size_t k = 0; k < sizeof found->degree / sizeof found->degree[0]; k++)
    report_append_count(list, found->degree[k]);
}

static void report_classes(const measure_job *job, cJSON *all)
{
  const packing_classes_report *found = &job->classes;
  cJSON *made = report_add_object(all, "classes");
  add_degrees(made, found);
  report_add_count(made, "supported", found->supported);
  report_add_count(made, "non_stable", found->non_stable);
  report_add_count(made, "stable", found->stable);
  report_add_count(made, "firm", found->firm);
  const int some = job->contacts != NULL;
  report_add_real(made, "non_stable_share", some ? found->non_stable_share : (double)NAN);
  report_add_real(made, "stable_share", some ? found->stable_share : (double)NAN);
  report_add_real(made, "firm_share", some ? found->firm_share : (double)NAN);
}

static void report_bonds(const measure_job *job, cJSON *all)
{
  cJSON *made = report_add_object(all, "bonds");
  report_add_real(made, "gap", job->asked->bond_gap);
  report_add_count(made, "count",
                   job->bonds ? packing_contacts_count(job->bonds) : REPORT_NONE);
}

void contacts_report(const measure_job *job, cJSON *all)
{
  cJSON *made = report_add_object(all, "contacts");
  const packing_contacts *c = job->contacts;
  report_add_count(made, "pairs", c ? packing_contacts_count(c) : 0);
  report_add_count(made, "walls", c ? packing_contacts_wall_count(c) : 0);
  report_classes(job, all);
  report_add_fabric(all, "wall_fabric", &job->wall_fabric);
  report_add_fabric(all, "orientations", &job->orientations);
  report_bonds(job, all);
}
