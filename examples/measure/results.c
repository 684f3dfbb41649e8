/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Report and files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "../common/picture.h"
#include "../common/program.h"
#include "measure.h"

/* ---- the report ---- */

static void report_asked_void(cJSON *all, const measure_options *o)
{
  cJSON *profiles = report_add_list(all, "profile");
  for (size_t i = 0; i < o->profile_count; i++) {
    char text[40];
    snprintf(text, sizeof text, "%s,%zu", o->profiles[i].name, o->profiles[i].bins);
    report_append_text(profiles, text);
  }
  cJSON *sections = report_add_list(all, "section");
  for (size_t i = 0; i < o->section_count; i++) {
    const section_ask *s = &o->sections[i];
    char text[64];
    if (s->one)
      snprintf(text, sizeof text, "%s=%.17g", axis_name(s->axis), s->height);
    else
      snprintf(text, sizeof text, "%s,%zu", axis_name(s->axis), s->count);
    report_append_text(sections, text);
  }
  report_add_text(all, "map", o->map_text);
  report_add_flag(all, "pores", o->pores);
  report_add_text(all, "pore_network", o->pores_prefix);
  report_add_real(all, "pore_merge", o->pores_overlap);
}

static cJSON *report_options(const measure_job *job)
{
  const measure_options *o = job->asked;
  const double up[] = {o->up.x, o->up.y, o->up.z};
  cJSON *all = report_new();
  input_report(all, &o->in);
  report_add_text(all, "domain", job->domain_text);
  report_add_text(all, "psd", o->common.psd);
  report_add_real(all, "tolerance", o->tolerance);
  if (up[0] != 0 || up[1] != 0 || up[2] != 0)
    report_add_reals(all, "up", up, 3);
  else
    report_add_text(all, "up", NULL);
  report_add_text(all, "contacts", o->contact_file);
  report_add_text(all, "bonds", o->bond_text);
  report_add_count(all, "normals", o->normals ? (size_t)o->normals : REPORT_NONE);
  report_add_text(all, "order", o->order_text ? o->order_text : "1.2");
  report_add_text(all, "order_list", o->order_file);
  report_add_real(all, "rdf", job->rdf.bins ? job->rdf.r_max : (double)NAN);
  report_add_count(all, "rdf_bins", job->rdf.bins ? o->rdf_bins : REPORT_NONE);
  report_asked_void(all, o);
  report_add_text(all, "sieves", o->sieves_text);
  options_report_machine(all, &o->common, job->context);
  report_add_text(all, "plot", o->plot);
  report_add_text(all, "plot_format", o->svg ? "svg" : "png");
  report_add_text(all, "report", o->common.report);
  report_add_flag(all, "quiet", o->common.quiet);
  return all;
}

/* What of the audit does not stand in every program's report: who, and how many. */
static void report_audit(cJSON *all, const packing_audit_report *found)
{
  cJSON *made = report_add_object(all, "audit");
  report_add_real(made, "min_gap", found->min_gap);
  report_add_count(made, "gap_i", found->gap_i);
  report_add_count(made, "gap_j", found->gap_j);
  report_add_count(made, "overlaps", found->overlaps);
  report_add_count(made, "overlap_i", found->overlap_i);
  report_add_count(made, "overlap_j", found->overlap_j);
  report_add_count(made, "protrusions", found->protrusions);
  report_add_count(made, "protrusion_i", found->protrusion_i);
  report_add_count(made, "duplicates", found->duplicates);
  report_add_count(made, "bad_numbers", found->bad_numbers);
}

static cJSON *report_own(const measure_job *job)
{
  cJSON *all = report_new();
  report_audit(all, &job->report.audit);
  contacts_report(job, all);
  report_add_item(all, "normals", normals_report(job));
  report_add_item(all, "order", order_report(job));
  report_add_item(all, "radial_distribution", rdf_report(job));
  profiles_report(job, report_add_list(all, "profiles"));
  sections_report(job, report_add_list(all, "sections"));
  report_add_item(all, "map", map_report(job));
  report_add_item(all, "pores", pores_report(job));
  report_add_item(all, "sizes", sizes_report(job));
  return all;
}

static char *make_report(measure_job *job, const char *command, double start)
{
  report *r = &job->report;
  r->program = measure_program;
  r->command = command;
  r->seedless = 1;
  r->options = report_options(job);
  r->input = &job->files;
  r->threads = packing_context_threads(job->context);
  r->own_key = "measures";
  r->own = report_own(job);
  r->time_total = program_seconds() - start;
  return report_text(report_object(r));
}

/* ---- files ---- */

static void add_file(outputs *all, const char *option, const char *prefix,
                     const char *tail, const char *extension, pack_writer write)
{
  char *path = NULL;
  if (asprintf(&path, "%s%s%s", prefix, tail, extension) < 0)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  outputs_add(all, option, prefix, path)->write = write;
  free(path);
}

static void add_plots(measure_job *job)
{
  static const struct {
    const char *tail;
    pack_writer write;
    int flat; /* 1: also of two dimensions */
  } plots[] = {{"-sizes", plot_sizes, 1},
               {"-rdf", plot_rdf, 1},
               {"-coordination", plot_coordination, 1},
               {"-normals", plot_normals, 1},
               {"-profile", plot_profile, 1},
               {"-section", plot_section, 0}};
  const measure_options *o = job->asked;
  for (size_t i = 0; i < sizeof plots / sizeof plots[0]; i++)
    if (plots[i].flat || job->spec.dim == 3)
      add_file(&job->asked->common.outputs, "--plot", o->plot, plots[i].tail,
               o->svg ? ".svg" : ".png", plots[i].write);
}

static void add_network(measure_job *job)
{
  static const struct {
    const char *tail, *extension;
    pack_writer write;
    int flat; /* 1: also of two dimensions */
  } parts[] = {{"", ".vtp", write_network, 1},
               {"-pores", ".csv", write_pores, 1},
               {"-constrictions", ".csv", write_constrictions, 1},
               {"_node1", ".dat", write_node1, 0},
               {"_node2", ".dat", write_node2, 0},
               {"_link1", ".dat", write_link1, 0},
               {"_link2", ".dat", write_link2, 0}};
  measure_options *o = job->asked;
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
    if (parts[i].flat || job->spec.dim == 3)
      add_file(&o->common.outputs, "--pore-network", o->pores_prefix, parts[i].tail,
               parts[i].extension, parts[i].write);
}

int measure_add_outputs(measure_job *job)
{
  measure_options *o = job->asked;
  if (o->plot)
    add_plots(job);
  if (o->pores_prefix)
    add_network(job);
  return outputs_check(&o->common.outputs, job->context, &job->files);
}

int measure_write(measure_job *job, const char *command, double start)
{
  options *o = &job->asked->common;
  char *text = make_report(job, command, start);
  const pack p = {.context = job->context,
                  .spec = &job->spec,
                  .domain = job->domain,
                  .psd_text = o->psd,
                  .psd = job->psd,
                  .view = job->view,
                  .volume_fraction = job->report.volume_fraction,
                  .report = text,
                  .own = job};
  const int code = outputs_write(&o->outputs, &p, 1, o->report ? NULL : text);
  free(text);
  return code;
}
