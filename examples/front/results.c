/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures, report, files and judgement. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "front.h"

static const char *const loosen_names[] = {"shrink", "remove"};

static packing_view view_of(const front_job *job)
{
  packing_view view;
  packing_particles_view(job->particles, &view);
  return view;
}

static const char *state_name(const front_job *job)
{
  return job->stopped ? "interrupted" : packing_placer_state_name(job->placed.state);
}

/* The sizes are measured apart: before radii shrink, and without those that stood there. */
int front_measure(front_job *job)
{
  const packing_view view = view_of(job);
  const measured m = {.context = job->context,
                      .domain = job->domain,
                      .view = &view,
                      .dim = job->spec.dim,
                      .limit = job->asked->common.max_overlap};
  return measures_fill(&job->report, &m, NULL);
}

/* ---- the report ---- */

static void report_amount(cJSON *all, const front_job *job)
{
  const options *o = &job->asked->common;
  report_add_count(all, "count", o->count ? o->count : REPORT_NONE);
  report_add_real(all, "mass", o->mass);
  report_add_real(all, "target_porosity", o->porosity);
  report_add_text(all, "loosen",
                  job->asked->loosen_given ? loosen_names[job->asked->loosen] : NULL);
}

static void report_select(cJSON *all, const front_options *o)
{
  cJSON *select = report_add_list(all, "select");
  for (int i = 0; i < 2; i++)
    report_append_text(select, packing_front_select_name(o->select[i]));
}

static void report_method(cJSON *all, const front_options *o)
{
  const int paper = o->mode == PACKING_FRONT_PAPER;
  const packing_contact_method *contact =
      o->contact ? o->contact : packing_contact_wrappers();
  report_add_text(all, "mode", packing_front_mode_name(o->mode));
  report_add_text(all, "direction", packing_front_direction_name(o->direction));
  report_add_text(all, "contact", paper ? contact->name : NULL);
  if (paper)
    report_select(all, o);
  else
    report_add_text(all, "select", NULL);
  report_add_count(all, "stock", o->stock_count ? o->stock_count : REPORT_NONE);
}

static cJSON *report_options(const front_job *job)
{
  const front_options *o = job->asked;
  cJSON *all = report_new();
  report_add_text(all, "domain", job->domain_text);
  report_add_text(all, "psd", o->common.psd);
  report_add_text(all, "list", o->list);
  cJSON *grades = report_add_list(all, "grade");
  for (size_t i = 0; i < o->grade_count; i++)
    report_append_text(grades, o->grades[i]);
  if (o->in.text)
    input_report(all, &o->in);
  else
    report_add_text(all, "in", NULL);
  report_amount(all, job);
  report_method(all, o);
  if (o->settle) {
    cJSON *settle = report_add_object(all, "settle");
    forces_report(settle, &job->forces);
  } else
    report_add_text(all, "settle", NULL);
  report_add_text(all, "frames", o->frames);
  report_add_text(all, "trace", o->trace);
  options_report(all, &o->common, job->context);
  return all;
}

static void report_list(cJSON *all, const front_job *job)
{
  cJSON *rows = report_add_list(all, "list");
  for (size_t i = 0; i < job->list.count; i++) {
    cJSON *row = report_new();
    report_add_real(row, "radius", job->list.classes[i].r);
    report_add_count(row, "asked", job->list.classes[i].count);
    report_add_count(row, "unplaced", job->list.left[i]);
    report_append_item(rows, row);
  }
}

static void report_grades(cJSON *all, const front_job *job)
{
  cJSON *rows = report_add_list(all, "grades");
  for (size_t i = 0; i < job->asked->grade_count; i++) {
    const front_grade *g = &job->grades[i];
    cJSON *row = report_new();
    report_add_text(row, "domain", g->where);
    report_add_text(row, "psd", g->sizes);
    report_add_count(row, "particles", g->count);
    report_add_real(row, "ks", g->ks);
    report_add_real(row, "ks_limit", g->ks_limit);
    report_append_item(rows, row);
  }
}

static void report_components(cJSON *all, const front_job *job)
{
  const size_t count = job->components ? packing_psd_components(job->psd) : 0;
  cJSON *rows = report_add_list(all, "components");
  for (size_t i = 0; i < count; i++) {
    const packing_size_component *c = &job->components[i];
    cJSON *row = report_new();
    report_add_count(row, "particles", c->count);
    report_add_real(row, "number_asked", c->number_asked);
    report_add_real(row, "number_placed", c->number_placed);
    report_add_real(row, "number_sd", c->number_sd);
    report_add_real(row, "mass_asked", c->mass_asked);
    report_add_real(row, "mass_placed", c->mass_placed);
    report_add_real(row, "ks", c->ks);
    report_add_real(row, "ks_p", c->ks_p);
    report_append_item(rows, row);
  }
}

static cJSON *report_settling(const front_job *job)
{
  if (!job->moved.steps)
    return NULL;
  cJSON *all = report_new();
  report_add_real(all, "time", job->settle_time);
  report_add_flag(all, "rest", job->rested);
  report_add_real(all, "dt", job->moved.dt);
  report_add_u64(all, "steps", job->moved.steps);
  report_add_real(all, "kinetic_per_mgr", job->moved.kinetic_per_mgr);
  return all;
}

static cJSON *report_front(const front_job *job)
{
  cJSON *all = report_new();
  report_add_text(all, "state", state_name(job));
  report_add_count(all, "standing", job->standing);
  report_add_count(all, "placed", job->placed.placed);
  report_add_u64(all, "attempts", job->placed.attempts);
  report_add_count(all, "on_front", job->on_front);
  report_add_real(all, "placed_volume_fraction", job->placed.volume_fraction);
  report_add_real(all, "loosened_volume_fraction", job->loosened);
  report_components(all, job);
  report_grades(all, job);
  report_list(all, job);
  report_add_item(all, "settle", report_settling(job));
  return all;
}

static void fill_report(front_job *job, const char *command, double start)
{
  report *r = &job->report;
  r->program = front_program;
  r->command = command;
  r->options = report_options(job);
  r->input = &job->input;
  r->seed = job->asked->common.seed;
  r->threads = packing_context_threads(job->context);
  r->unplaced = job->placed.unplaced;
  r->own_key = "front";
  r->own = report_front(job);
  r->time_total = program_seconds() - start;
}

/* ---- files ---- */

static void fill_notes(const front_job *job, notes *all)
{
  const front_options *o = job->asked;
  notes_add(all, "program", "%s %s", front_program, packing_version());
  notes_add(all, "domain", "%s", job->domain_text);
  notes_add(all, "psd", "%s", job->psd_text);
  notes_add(all, "method", "front, %s, %s", packing_front_mode_name(o->mode),
            packing_front_direction_name(o->direction));
  notes_add(all, "seed", "%llu", (unsigned long long)o->common.seed);
  notes_add(all, "stream", "%llu", (unsigned long long)o->common.stream);
  notes_add(all, "placed", "%s", state_name(job));
  if (!isnan(job->loosened))
    notes_add(all, "loosened", "%s, from volume fraction %.9g", loosen_names[o->loosen],
              job->placed.volume_fraction);
  if (job->moved.steps)
    notes_add(all, "settled", "under gravity, %s",
              job->rested ? "at rest" : "not at rest");
  notes_add(all, "audit",
            job->report.audit_passed ? "passed, limit %g" : "FAILED, limit %g",
            o->common.max_overlap);
}

/* Sizes of one distribution, as asked: not where parts have their own or radii shrank. */
static packing_psd *psd_of_pack(const front_job *job)
{
  const front_options *o = job->asked;
  const int shrunk = !isnan(job->loosened) && o->loosen == PACKING_LOOSEN_SHRINK;
  return shrunk || o->grade_count ? NULL : job->psd;
}

int front_write(front_job *job, const char *command, double start)
{
  options *o = &job->asked->common;
  fill_report(job, command, start);
  char *text = report_text(report_object(&job->report));
  pack p = {.context = job->context,
            .spec = &job->spec,
            .domain = job->domain,
            .psd_text = job->psd_text,
            .psd = psd_of_pack(job),
            .view = view_of(job),
            .density = o->density,
            .volume_fraction = job->report.volume_fraction,
            .colour = o->colour,
            .report = text,
            .own = job};
  fill_notes(job, &p.notes);
  const int code = outputs_write(&o->outputs, &p, 1, o->report ? NULL : text);
  notes_free(&p.notes);
  free(text);
  return code;
}

/* ---- judgement ---- */

/* The pack is there, only less of it than was asked. */
static int tell_short(const front_job *job)
{
  const front_options *o = job->asked;
  const packing_placer_report *p = &job->placed;
  if (job->list.count)
    return program_fail(PROGRAM_SHORT, "%s: %zu of %zu particles of the list placed",
                        state_name(job), p->placed, p->placed + p->unplaced);
  if (o->common.count)
    return program_fail(PROGRAM_SHORT, "%s: %zu of %zu particles placed", state_name(job),
                        p->placed, o->common.count);
  return program_fail(PROGRAM_SHORT, "%s: volume fraction %.6g of %.6g reached%s",
                      state_name(job), job->standing_fraction + p->volume_fraction,
                      job->standing_fraction + job->target,
                      o->loosen_given ? ", nothing to loosen" : "");
}

static int is_short(const front_job *job)
{
  const int limited = job->list.count || job->asked->common.count || job->target > 0;
  if (job->asked->loosen_given)
    return isnan(job->loosened);
  return limited && job->placed.state != PACKING_PLACER_DONE;
}

int front_judge(const front_job *job)
{
  const int code = measures_judge(&job->report);
  if (code)
    return code;
  if (job->stopped)
    return program_fail(PROGRAM_INTERRUPTED,
                        "interrupted: the pack so far has %zu particles",
                        packing_particles_count(job->particles));
  return is_short(job) ? tell_short(job) : PROGRAM_DONE;
}
