/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measures.h"
#include <math.h>
#include <string.h>
#include "program.h"

static packing_status audit_pack(report *r, const measured *m)
{
  packing_audit_def def;
  packing_audit_def_init(&def);
  packing_audit_report_init(&r->audit);
  def.limit = m->limit;
  const packing_status status =
      packing_audit(m->context, &def, m->domain, m->view, &r->audit);
  r->max_overlap = r->audit.max_overlap;
  r->max_protrusion = m->domain ? r->audit.max_protrusion : (double)NAN;
  r->audit_limit = def.limit;
  r->audit_passed = r->audit.passed;
  return status;
}

/* A container that is thin beside its particles may leave too little inside for its volume to be
 * found; then the rest is told all the same. */
static packing_status find_volume(const measured *m, packing_volume_report *volume)
{
  packing_volume_def def;
  packing_volume_def_init(&def);
  packing_status status =
      packing_measure_volume(m->context, &def, m->domain, m->view, volume);
  if (status != PACKING_ERR_RANGE)
    return status;
  program_remark("measures: %s: its volume fraction is not told",
                 packing_context_message(m->context));
  def.inner_margin = 0;
  status = packing_measure_volume(m->context, &def, m->domain, m->view, volume);
  volume->inner_fraction = (double)NAN;
  return status;
}

static packing_status measure_volume(report *r, const measured *m)
{
  packing_volume_report volume;
  if (!m->domain)
    return PACKING_OK;
  packing_volume_report_init(&volume);
  const packing_status status = find_volume(m, &volume);
  r->domain_volume = volume.domain_volume;
  r->solid_volume = volume.solid_volume;
  r->volume_fraction = volume.volume_fraction;
  r->volume_fraction_inner = volume.inner_fraction;
  return status;
}

static packing_status measure_coordination(report *r, const packing_contacts *contacts)
{
  packing_coordination_report found;
  packing_coordination_report_init(&found);
  const packing_status status = packing_contacts_coordination(contacts, &found);
  r->coordination_mean = found.mean;
  r->coordination_mean_no_rattlers = found.mean_no_rattlers;
  r->rattlers = found.rattlers;
  memcpy(r->histogram, found.histogram, sizeof r->histogram);
  r->histogram_known = 1;
  return status;
}

void measures_keep_fabric(report_fabric *to, const packing_fabric_report *found)
{
  to->known = 1;
  to->dim = found->dim;
  to->count = found->count;
  memcpy(to->eigenvalues, found->eigenvalues, sizeof to->eigenvalues);
  memcpy(to->tensor, found->tensor, sizeof to->tensor);
  to->sd = found->sd;
  to->noise_floor = found->noise_floor;
}

static packing_status measure_fabric(report *r, const packing_contacts *contacts)
{
  packing_fabric_report found;
  packing_fabric_report_init(&found);
  const packing_status status = packing_contacts_fabric(contacts, NULL, &found);
  if (status == PACKING_OK)
    measures_keep_fabric(&r->fabric, &found);
  return status;
}

static packing_status measure_contacts(report *r, const measured *m,
                                       packing_contacts **contacts)
{
  packing_contacts_def def;
  packing_contacts_def_init(&def);
  def.dim = m->dim;
  def.walls = contacts != NULL;
  if (m->tolerance > 0)
    def.tolerance = m->tolerance;
  r->coordination_tolerance = def.tolerance;
  packing_contacts *found = NULL;
  packing_status status =
      packing_contacts_create(m->context, &def, m->domain, m->view, &found);
  if (status == PACKING_OK)
    status = measure_coordination(r, found);
  if (status == PACKING_OK)
    status = measure_fabric(r, found);
  if (contacts)
    *contacts = found;
  else
    packing_contacts_destroy(found);
  return status;
}

static packing_status measure_sizes(report *r, const measured *m)
{
  packing_sizes_report sizes;
  if (!m->psd)
    return PACKING_OK;
  packing_sizes_report_init(&sizes);
  const packing_status status =
      packing_measure_sizes(m->context, m->psd, m->view, &sizes);
  r->ks = sizes.ks;
  r->ks_limit = sizes.ks_limit;
  r->ks_mass = sizes.ks_mass;
  r->mean_relative_error = sizes.mean_relative_error;
  return status;
}

int measures_fill(report *r, const measured *m, packing_contacts **contacts)
{
  const double start = program_seconds();
  packing_status status = audit_pack(r, m);
  if (status == PACKING_OK)
    status = measure_volume(r, m);
  if (status == PACKING_OK && m->view->count > 0)
    status = measure_contacts(r, m, contacts);
  if (status == PACKING_OK && m->view->count > 0)
    status = measure_sizes(r, m);
  r->dim = m->dim;
  r->particles = m->view->count;
  r->time_measure = program_seconds() - start;
  return status == PACKING_OK ? 0 : program_status(m->context, status, "measures");
}

int measures_judge(const report *r)
{
  if (r->audit_passed)
    return PROGRAM_DONE;
  return program_fail(PROGRAM_SHORT,
                      "the audit failed: overlap %.3g, protrusion %.3g, limit %.3g",
                      r->max_overlap, r->max_protrusion, r->audit_limit);
}
