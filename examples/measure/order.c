/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bond orders: Q4 and Q6 with the structures told by common neighbours, in two dimensions
 * psi_6. */
#include <math.h>
#include "measure.h"

static packing_status measure_degree(const measure_job *job,
                                     const packing_neighbours *neighbours, int l,
                                     packing_bond_order_report *found)
{
  packing_bond_order_def def;
  packing_bond_order_def_init(&def);
  packing_bond_order_report_init(found);
  def.l = l;
  return packing_measure_bond_order(job->context, &def, neighbours, NULL, 0, found);
}

static packing_status measure_spheres(measure_job *job,
                                      const packing_neighbours *neighbours)
{
  order_found *o = &job->order;
  packing_status status = measure_degree(job, neighbours, 4, &o->q4);
  if (status == PACKING_OK)
    status = measure_degree(job, neighbours, 6, &o->q6);
  o->has_structure = job->asked->neighbours.kind == PACKING_NEIGHBOURS_WITHIN;
  packing_common_neighbours_report_init(&o->structure);
  if (status == PACKING_OK && o->has_structure)
    status = packing_measure_common_neighbours(job->context, neighbours, NULL, 0,
                                               &o->structure);
  return status;
}

static packing_status measure_discs(measure_job *job,
                                    const packing_neighbours *neighbours)
{
  packing_hexatic_report_init(&job->order.hexatic);
  return packing_measure_hexatic(job->context, NULL, neighbours, NULL, 0,
                                 &job->order.hexatic);
}

int order_measure(measure_job *job)
{
  packing_neighbours *neighbours = NULL;
  packing_neighbours_def def = job->asked->neighbours;
  def.dim = job->spec.dim;
  packing_status status =
      packing_neighbours_create(job->context, &def, job->domain, &job->view, &neighbours);
  if (status == PACKING_OK)
    status = job->spec.dim == 2 ? measure_discs(job, neighbours)
                                : measure_spheres(job, neighbours);
  packing_neighbours_destroy(neighbours);
  job->order.made = status == PACKING_OK;
  return status == PACKING_OK ? 0 : measure_failed(job, status, "--order");
}

static void report_degree(cJSON *all, const char *key,
                          const packing_bond_order_report *found)
{
  cJSON *made = report_add_object(all, key);
  report_add_real(made, "global", found->whole);
  report_add_real(made, "mean", found->mean);
  report_add_real(made, "mean_averaged", found->mean_averaged);
  report_add_real(made, "w_global", found->whole_w);
  report_add_real(made, "w_mean", found->mean_w);
}

static cJSON *report_structure(const order_found *o)
{
  cJSON *made = report_new();
  for (int k = 0; k < PACKING_STRUCTURE_END; k++)
    report_add_count(made, packing_structure_name((packing_structure)k),
                     o->structure.number[k]);
  return made;
}

static cJSON *report_hexatic(const packing_hexatic_report *found)
{
  cJSON *made = report_new();
  report_add_real(made, "global", found->whole);
  report_add_real(made, "mean", found->mean);
  report_add_real(made, "six_neighbours_share", found->share);
  return made;
}

cJSON *order_report(const measure_job *job)
{
  const order_found *o = &job->order;
  const int flat = job->spec.dim == 2;
  if (!o->made)
    return NULL;
  cJSON *made = report_new();
  report_add_text(made, "neighbours",
                  job->asked->order_text ? job->asked->order_text : "1.2");
  report_add_count(made, "isolated", flat ? o->hexatic.isolated : o->q6.isolated);
  if (flat) {
    report_add_text(made, "q4", NULL);
    report_add_text(made, "q6", NULL);
  } else {
    report_degree(made, "q4", &o->q4);
    report_degree(made, "q6", &o->q6);
  }
  report_add_item(made, "structures",
                  !flat && o->has_structure ? report_structure(o) : NULL);
  report_add_item(made, "psi6", flat ? report_hexatic(&o->hexatic) : NULL);
  return made;
}
