/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "measures.h"
#include <string.h>
#include "program.h"

static packing_status audit_pack(report *r, packing_context *context,
                                 packing_domain *domain, const packing_view *view,
                                 double limit)
{
  packing_audit_def def;
  packing_audit_report audit;
  packing_audit_def_init(&def);
  packing_audit_report_init(&audit);
  def.limit = limit;
  const packing_status status = packing_audit(context, &def, domain, view, &audit);
  r->max_overlap = audit.max_overlap;
  r->max_protrusion = audit.max_protrusion;
  r->audit_limit = def.limit;
  r->audit_passed = audit.passed;
  return status;
}

static packing_status measure_volume(report *r, packing_context *context,
                                     packing_domain *domain, const packing_view *view)
{
  packing_volume_report volume;
  packing_volume_report_init(&volume);
  const packing_status status =
      packing_measure_volume(context, NULL, domain, view, &volume);
  r->domain_volume = volume.domain_volume;
  r->solid_volume = volume.solid_volume;
  r->volume_fraction = volume.volume_fraction;
  r->volume_fraction_inner = volume.inner_fraction;
  return status;
}

static packing_status measure_coordination(report *r, packing_context *context,
                                           packing_domain *domain,
                                           const packing_view *view)
{
  packing_coordination_def def;
  packing_coordination_report found;
  packing_coordination_def_init(&def);
  packing_coordination_report_init(&found);
  def.dim = packing_domain_dim(domain);
  const packing_status status =
      packing_measure_coordination(context, &def, domain, view, &found);
  r->coordination_mean = found.mean;
  r->coordination_mean_no_rattlers = found.mean_no_rattlers;
  r->coordination_tolerance = def.tolerance;
  r->rattlers = found.rattlers;
  memcpy(r->histogram, found.histogram, sizeof r->histogram);
  r->histogram_known = 1;
  return status;
}

static packing_status measure_sizes(report *r, packing_context *context, packing_psd *psd,
                                    const packing_view *view)
{
  packing_sizes_report sizes;
  packing_sizes_report_init(&sizes);
  const packing_status status = packing_measure_sizes(context, psd, view, &sizes);
  r->ks = sizes.ks;
  r->ks_limit = sizes.ks_limit;
  r->ks_mass = sizes.ks_mass;
  r->mean_relative_error = sizes.mean_relative_error;
  return status;
}

int measures_fill(report *r, packing_context *context, packing_domain *domain,
                  packing_psd *psd, const packing_view *view, double limit)
{
  const double start = program_seconds();
  packing_status status = audit_pack(r, context, domain, view, limit);
  if (status == PACKING_OK)
    status = measure_volume(r, context, domain, view);
  if (status == PACKING_OK && view->count > 0)
    status = measure_coordination(r, context, domain, view);
  if (status == PACKING_OK && view->count > 0)
    status = measure_sizes(r, context, psd, view);
  r->dim = packing_domain_dim(domain);
  r->particles = view->count;
  r->time_measure = program_seconds() - start;
  return status == PACKING_OK ? 0 : program_status(context, status, "measures");
}

int measures_judge(const report *r)
{
  if (r->audit_passed)
    return PROGRAM_DONE;
  return program_fail(PROGRAM_SHORT,
                      "the audit failed: overlap %.3g, protrusion %.3g, limit %.3g",
                      r->max_overlap, r->max_protrusion, r->audit_limit);
}
