/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Report, files and judgement. */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "layers.h"

static const char *const stop_names[] = {"full", "no room", "most layers"};

/* ---- the report ---- */

static void report_bed(cJSON *all, const layers_options *o)
{
  report_add_text(all, "example", o->example);
  report_add_real(all, "height", o->height);
  report_add_real(all, "layer_height", o->layer_height);
  report_add_real(all, "layer_density", o->layer_density);
  report_add_text(all, "layer_start", layers_start_names[o->start]);
  report_add_text(all, "full", layers_full_names[o->full]);
  report_add_u64(all, "max_layers", o->max_layers);
  report_add_text(all, "layer_end", layers_end_names[o->end]);
  report_add_real(all, "layer_time", o->layer_time);
  report_add_real(all, "layer_time_max", o->layer_time_max);
  report_add_real(all, "rest_tolerance", o->rest_tolerance);
  report_add_u64(all, "packs", o->packs);
  report_add_u64(all, "sets", o->sets);
}

/* Of the run, or of one pack as if it were asked for alone. */
static cJSON *report_options(const layers_job *job, const layered_pack *made)
{
  options common = job->asked->common;
  cJSON *all = report_new();
  if (made)
    common.stream = made->stream;
  report_add_text(all, "domain", job->domain_text);
  report_add_text(all, "psd", job->psd_text);
  report_bed(all, job->asked);
  forces_report(all, &job->forces);
  options_report(all, &common, job->context);
  report_add_text(all, "sheet", job->asked->sheet);
  return all;
}

static void report_each_layer(cJSON *all, const layered_pack *made)
{
  cJSON *placed = report_add_list(all, "particles");
  cJSON *density = report_add_list(all, "density");
  cJSON *time = report_add_list(all, "time");
  cJSON *rested = report_add_list(all, "end");
  for (size_t i = 0; i < made->count; i++) {
    report_append_count(placed, made->layers[i].placed);
    report_append_real(density, made->layers[i].density);
    report_append_real(time, made->layers[i].time);
    report_append_text(
        rested,
        layers_end_names[made->layers[i].rested ? LAYER_END_REST : LAYER_END_TIME]);
  }
}

static cJSON *report_layers(const layered_pack *made)
{
  size_t timed = 0, saturated = 0;
  double particle_steps = 0, particles = 0;
  cJSON *all = report_new();
  for (size_t i = 0; i < made->count; i++) {
    const layer *here = &made->layers[i];
    timed += !here->rested;
    saturated += here->saturated != 0;
    particles += (double)here->placed;
    particle_steps += particles * here->time / made->moved.dt;
  }
  report_add_count(all, "count", made->count);
  report_each_layer(all, made);
  report_add_count(all, "ended_by_time", timed);
  report_add_count(all, "saturated", saturated);
  report_add_text(all, "stopped", stop_names[made->stop]);
  report_add_real(all, "bed_height", made->bed);
  report_add_real(all, "highest", made->highest);
  report_add_real(all, "dt", made->moved.dt);
  report_add_u64(all, "steps", made->moved.steps);
  report_add_real(all, "simulated", made->moved.time);
  report_add_real(all, "kinetic_per_mgr", made->moved.kinetic_per_mgr);
  report_add_real(all, "particle_steps_per_second",
                  particle_steps / made->report.time_settle);
  return all;
}

/* What is the same in every pack's report. */
static void fill_shared(const layers_job *job, report *r, const char *command)
{
  r->program = layers_program;
  r->command = command;
  r->input = &job->input;
  r->seed = job->asked->common.seed;
  r->threads = packing_context_threads(job->context);
  r->dim = job->spec.dim;
}

static cJSON *report_one(const layers_job *job, layered_pack *made, const char *command)
{
  report *r = &made->report;
  fill_shared(job, r, command);
  r->options = report_options(job, made);
  r->unplaced = 0;
  for (size_t i = 0; i < made->count; i++)
    r->unplaced += made->layers[i].unplaced;
  r->own_key = "layers";
  r->own = report_layers(made);
  return report_object(r);
}

static char *report_all(const layers_job *job, layered_pack *packs, size_t count,
                        const char *command)
{
  report shared;
  if (count == 1)
    return report_text(report_one(job, packs, command));
  cJSON **each = program_take(count, sizeof(cJSON *));
  for (size_t i = 0; i < count; i++)
    each[i] = report_one(job, &packs[i], command);
  report_init(&shared);
  fill_shared(job, &shared, command);
  cJSON *all =
      report_packs(&shared, report_options(job, NULL), each, count, job->asked->sets);
  free(each);
  return report_text(all);
}

/* ---- files ---- */

static void fill_notes(const layers_job *job, const layered_pack *made, notes *all)
{
  const layers_options *o = job->asked;
  notes_add(all, "program", "%s %s", layers_program, packing_version());
  char *domain = domain_spec_text(&job->spec);
  notes_add(all, "domain", "%s", domain);
  free(domain);
  notes_add(all, "psd", "%s", job->psd_text);
  notes_add(all, "layers", "%zu of height %.9g at volume fraction %.9g, until %s",
            made->count, o->layer_height, o->layer_density, layers_end_names[o->end]);
  notes_add(all, "rotations", "%s", o->forces.rotations ? "on" : "off");
  notes_add(all, "friction", "%.9g", o->forces.friction);
  notes_add(all, "seed", "%llu", (unsigned long long)o->common.seed);
  notes_add(all, "stream", "%llu", (unsigned long long)made->stream);
  notes_add(all, "volume_fraction", "%.9g below %s %.9g", made->report.volume_fraction,
            job->spec.dim == 2 ? "y" : "z", job->top);
  notes_add(all, "stopped", "%s", stop_names[made->stop]);
  notes_add(all, "audit",
            made->report.audit_passed ? "passed, limit %g" : "FAILED, limit %g",
            o->common.max_overlap);
}

static pack pack_of(const layers_job *job, const layered_pack *made, const char *text)
{
  pack p = {.context = job->context,
            .spec = &job->spec,
            .domain = job->domain,
            .psd_text = job->psd_text,
            .psd = job->psd,
            .density = job->asked->common.density,
            .volume_fraction = made->report.volume_fraction,
            .colour = job->asked->common.colour,
            .report = text};
  packing_particles_view(made->particles, &p.view);
  fill_notes(job, made, &p.notes);
  return p;
}

int layers_write(layers_job *job, layered_pack *packs, size_t count, const char *command)
{
  options *o = &job->asked->common;
  char *text = report_all(job, packs, count, command);
  pack *all = program_take(count, sizeof *all);
  for (size_t i = 0; i < count; i++)
    all[i] = pack_of(job, &packs[i], text);
  const int code = outputs_write(&o->outputs, all, count, o->report ? NULL : text);
  for (size_t i = 0; i < count; i++)
    notes_free(&all[i].notes);
  free(all);
  free(text);
  return code;
}

/* ---- judgement ---- */

static int judge(const layers_job *job, const layered_pack *made)
{
  const layers_options *o = job->asked;
  const int code = measures_judge(&made->report);
  if (code || made->stop == STOP_FULL || (job->closed && made->stop == STOP_NO_ROOM))
    return code;
  return program_fail(
      PROGRAM_SHORT, "%s: the bed is full up to %.6g of %.6g after %zu layers",
      made->stop == STOP_MOST ? "--max-layers" : "no room for more",
      o->full == FULL_BED ? made->bed : made->highest, o->height, made->count);
}

int layers_judge(const layers_job *job, const layered_pack *packs, size_t count)
{
  int code = PROGRAM_DONE;
  for (size_t i = 0; i < count && !code; i++)
    code = judge(job, &packs[i]);
  return code;
}
