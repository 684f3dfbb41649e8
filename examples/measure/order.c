/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bond orders: Q4 and Q6 with the structures told by common neighbours, in two dimensions
 * psi_6. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "../common/table.h"
#include "measure.h"

/* Room for an entry a particle where there shall be a file of them, else NULL. */
static void *room_of_each(const measure_job *job, size_t size)
{
  return job->asked->order_file ? program_take(job->view.count, size) : NULL;
}

/* How many entries there is room for. */
static size_t capacity_of_each(const measure_job *job)
{
  return job->asked->order_file ? job->view.count : 0;
}

static packing_status measure_degree(measure_job *job,
                                     const packing_neighbours *neighbours, int l,
                                     packing_bond_order_report *found)
{
  packing_bond_order **local = &job->order.local[l == 6];
  packing_bond_order_def def;
  packing_bond_order_def_init(&def);
  packing_bond_order_report_init(found);
  def.l = l;
  *local = room_of_each(job, sizeof **local);
  return packing_measure_bond_order(job->context, &def, neighbours, *local,
                                    capacity_of_each(job), found);
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
  if (status != PACKING_OK || !o->has_structure)
    return status;
  o->structures = room_of_each(job, sizeof *o->structures);
  return packing_measure_common_neighbours(job->context, neighbours, o->structures,
                                           capacity_of_each(job), &o->structure);
}

static packing_status measure_discs(measure_job *job,
                                    const packing_neighbours *neighbours)
{
  order_found *o = &job->order;
  packing_hexatic_report_init(&o->hexatic);
  o->discs = room_of_each(job, sizeof *o->discs);
  return packing_measure_hexatic(job->context, NULL, neighbours, o->discs,
                                 capacity_of_each(job), &o->hexatic);
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

void order_free(order_found *found)
{
  free(found->local[0]);
  free(found->local[1]);
  free(found->structures);
  free(found->discs);
}

/* ---- the list ---- */

static void print_sphere(table *t, const order_found *o, size_t i)
{
  const packing_bond_order *q4 = &o->local[0][i], *q6 = &o->local[1][i];
  table_print(t, "%zu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g%s%s\n", i, q4->q, q4->averaged,
              q4->w, q6->q, q6->averaged, q6->w, o->has_structure ? "," : "",
              o->has_structure ? packing_structure_name(o->structures[i]) : "");
}

static void print_disc(table *t, const order_found *o, size_t i)
{
  const packing_hexatic *psi = &o->discs[i];
  table_print(t, "%zu,%.17g,%.17g,%.17g,%zu\n", i, psi->re, psi->im, psi->modulus,
              psi->neighbours);
}

packing_status write_order(const pack *p, const packing_stream *stream)
{
  const measure_job *job = p->own;
  const order_found *o = &job->order;
  const int flat = job->spec.dim == 2;
  table t;
  table_open(&t, stream);
  if (flat)
    table_print(&t, "i,psi6_re,psi6_im,psi6,neighbours\n");
  else
    table_print(&t, "i,q4,q4_averaged,w4,q6,q6_averaged,w6%s\n",
                job->asked->neighbours.kind == PACKING_NEIGHBOURS_WITHIN ? ",structure"
                                                                         : "");
  for (size_t i = 0; i < job->view.count; i++)
    (flat ? print_disc : print_sphere)(&t, o, i);
  return table_close(&t);
}

/* ---- the report ---- */

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
