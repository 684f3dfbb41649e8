/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Report and files. */
#include <stdlib.h>
#include <string.h>
#include "../common/measures.h"
#include "../common/program.h"
#include "convert.h"

static void report_changes(cJSON *all, const convert_options *o)
{
  cJSON *list = report_add_list(all, "changes");
  for (size_t i = 0; i < o->change_count; i++) {
    cJSON *entry = report_new();
    report_add_text(entry, change_names[o->changes[i].kind], o->changes[i].text);
    cJSON_AddItemToArray(list, entry);
  }
}

static cJSON *report_options(const convert_job *job, double density)
{
  const convert_options *o = job->asked;
  cJSON *all = report_new();
  input_report(all, &o->in);
  report_add_text(all, "domain", o->common.domain);
  report_changes(all, o);
  report_add_text(all, "crop_by", o->by_centres ? "centres" : "whole");
  report_add_real(all, "density", density);
  options_report_machine(all, &o->common, job->context);
  options_report_out(all, &o->common);
  report_add_text(all, "report", o->common.report);
  report_add_flag(all, "quiet", o->common.quiet);
  return all;
}

static cJSON *report_own(const convert_job *job)
{
  cJSON *all = report_new();
  report_add_count(all, "read", job->read);
  report_add_count(all, "written", packing_particles_count(job->asked->in.particles));
  report_add_count(all, "bonds_read", packing_bonds_count(job->asked->in.bonds));
  report_add_count(all, "bonds_written", job->bond_count);
  report_add_text(all, "domain", job->domain_text);
  return all;
}

static void fill_notes(const convert_job *job, notes *all)
{
  const convert_options *o = job->asked;
  notes_add(all, "program", "%s %s", convert_program, packing_version());
  if (job->domain_text)
    notes_add(all, "domain", "%s", job->domain_text);
  notes_add(all, "source", "%s", o->in.text);
  for (size_t i = 0; i < o->change_count; i++)
    notes_add(all, change_names[o->changes[i].kind], "%s", o->changes[i].text);
  notes_add(all, "audit",
            job->report.audit_passed ? "passed, limit %g" : "FAILED, limit %g",
            o->common.max_overlap);
}

/* As typed, or else as the file says. */
static double density_of(const convert_job *job)
{
  const convert_options *o = job->asked;
  return !o->common.density_given && o->in.info.has_density ? o->in.info.density
                                                            : o->common.density;
}

static pack pack_of(const convert_job *job, const packing_view *view)
{
  return (pack){.context = job->context,
                .spec = &job->spec,
                .domain = job->domain,
                .view = *view,
                .bonds = job->bonds,
                .bond_count = job->bond_count,
                .density = density_of(job),
                .volume_fraction = job->report.volume_fraction,
                .colour = job->asked->common.colour};
}

static char *make_report(convert_job *job, const char *command)
{
  report *r = &job->report;
  r->program = convert_program;
  r->command = command;
  r->seedless = 1;
  r->options = report_options(job, density_of(job));
  r->input = &job->files;
  r->threads = packing_context_threads(job->context);
  r->own_key = "convert";
  r->own = report_own(job);
  return report_text(report_object(r));
}

static int wants_ids_above_0(const char *format)
{
  return format && (strcmp(format, "lammps") == 0 || strcmp(format, "liggghts") == 0);
}

/* What LAMMPS would refuse is told with the way out. */
static int check_ids(const convert_job *job, const packing_view *view)
{
  const outputs *all = &job->asked->common.outputs;
  int64_t least = 1;
  for (size_t i = 0; view->id.data && i < view->count; i++) {
    const int64_t id = *(const int64_t *)(const void *)((const char *)view->id.data +
                                                        i * view->id.stride);
    least = id < least ? id : least;
  }
  for (size_t i = 0; i < all->count && least < 1; i++)
    if (wants_ids_above_0(all->items[i].format))
      return program_fail(
          PROGRAM_BAD_INPUT,
          "%s: %s: there is an id of %lld, and %s wants them above 0: see "
          "--renumber",
          all->items[i].option, all->items[i].path, (long long)least,
          all->items[i].format);
  return 0;
}

int convert_write(convert_job *job, const char *command)
{
  options *o = &job->asked->common;
  packing_view view;
  packing_particles_view(job->asked->in.particles, &view);
  if (job->spec.dim == 2)
    view.z.data = NULL;
  const measured m = {.context = job->context,
                      .domain = job->domain,
                      .view = &view,
                      .dim = job->spec.dim,
                      .limit = o->max_overlap};
  int code = check_ids(job, &view);
  if (!code)
    code = measures_fill(&job->report, &m, NULL);
  if (code)
    return code;
  pack p = pack_of(job, &view);
  char *text = make_report(job, command);
  p.report = text;
  fill_notes(job, &p.notes);
  code = outputs_write(&o->outputs, &p, 1, o->report ? NULL : text);
  notes_free(&p.notes);
  free(text);
  return code;
}
