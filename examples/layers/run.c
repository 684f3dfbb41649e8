/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One pack: lay, settle, look how high the bed stands, again. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "../common/settling.h"
#include "layers.h"

/* How much work a call does: short enough for a lively bar and a prompt interrupt. */
enum { PLACER_STEP = 8 };

static packing_view view_of(const layered_pack *made)
{
  packing_view view;
  packing_particles_view(made->particles, &view);
  return view;
}

/* ---- the bar ---- */

/* What a layer adds to the height, to tell how far the run is. */
static double expected_rise(const layers_job *job)
{
  const double settled = job->spec.dim == 2 ? 0.84 : 0.58;
  return job->asked->layer_height * job->asked->layer_density / settled;
}

static void show(layers_job *job, const layered_pack *made, const char *doing,
                 double share_of_layer)
{
  const layers_options *o = job->asked;
  const double all = (double)(o->packs * o->sets);
  const double height = made->bed + share_of_layer * expected_rise(job);
  const double share = fmin(1, height / o->height);
  if (all > 1)
    snprintf(job->label, sizeof job->label, "pack %zu/%.0f layer %zu: %s", job->made + 1,
             all, made->count, doing);
  else
    snprintf(job->label, sizeof job->label, "layer %zu: %s", made->count, doing);
  job->bar.label = job->label;
  job->bar.unit = "particle-steps";
  progress_show_work(&job->bar, ((double)job->made + share) / all,
                     packing_particles_count(made->particles), job->work);
}

/* ---- laying ---- */

static packing_status create_placer(const layers_job *job, const layered_pack *made,
                                    packing_domain *region, packing_placer **placer)
{
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.seed = job->asked->common.seed;
  /* Each layer of each pack has a stream of its own. */
  def.stream = made->stream * LAYERS_MOST + made->count - 1;
  def.volume_fraction = job->asked->layer_density;
  return packing_rsa_create(job->context, &def, region, job->psd, made->particles,
                            placer);
}

static int place(layers_job *job, layered_pack *made, packing_placer *placer)
{
  layer *here = &made->layers[made->count - 1];
  packing_placer_report placed;
  packing_placer_report_init(&placed);
  do {
    const packing_status status = packing_placer_step(placer, PLACER_STEP, &placed);
    if (status != PACKING_OK)
      return program_status(job->context, status, "rsa");
    show(job, made, "placing", 0);
  } while (placed.state == PACKING_PLACER_RUNNING && !interrupted());
  here->placed = placed.placed;
  here->unplaced = placed.unplaced;
  here->density = placed.volume_fraction;
  here->saturated = placed.state != PACKING_PLACER_DONE;
  return interrupted() ? program_interrupted() : 0;
}

/* A density out of reach is refused with the first layer; room for no particle further up is
 * the end. */
static int lay_into(layers_job *job, layered_pack *made, packing_domain *region)
{
  packing_placer *placer = NULL;
  const packing_status status = create_placer(job, made, region, &placer);
  if (status == PACKING_ERR_GEOMETRY && made->count > 1)
    return 0;
  if (status != PACKING_OK)
    return program_status(job->context, status,
                          status == PACKING_ERR_GEOMETRY ? "--psd" : "--layer-density");
  const int code = place(job, made, placer);
  packing_placer_destroy(placer);
  return code;
}

static void remark_short(layers_job *job, const layered_pack *made)
{
  const layer *here = &made->layers[made->count - 1];
  if (!here->saturated || here->placed == 0 || job->told_short)
    return;
  job->told_short = 1;
  program_remark(
      "layer %zu: no further particle fits at volume fraction %.4g of the %.4g "
      "asked; it goes on with what there is (and so may others)",
      made->count, here->density, job->asked->layer_density);
}

static int lay(layers_job *job, layered_pack *made)
{
  const double start = program_seconds();
  packing_domain *region = NULL;
  made->layers = program_take_more(made->layers, made->count + 1, sizeof *made->layers);
  memset(&made->layers[made->count++], 0, sizeof *made->layers);
  const double base = job->asked->start == LAYER_START_BED ? made->bed : made->highest;
  int code = layers_region(job, job->floor + base, &region);
  if (!code && region)
    code = lay_into(job, made, region);
  packing_domain_destroy(region);
  made->report.time_place += program_seconds() - start;
  if (!code)
    remark_short(job, made);
  return code;
}

/* ---- settling ---- */

static packing_status create_stepper(layers_job *job, layered_pack *made)
{
  packing_dem_def def;
  packing_dem_def_init(&def);
  forces_tell(&job->forces, &def);
  /* What the stepper itself left in the bed may be mid-collision when the next layer comes; new
   * particles overlap nothing. The audit judges the end. */
  def.max_start_overlap = 1;
  def.impact_velocity = sqrt(2 * job->forces.down * job->asked->layer_height);
  return packing_dem_create(job->context, &def, job->domain, job->forces.materials,
                            job->forces.laws, job->forces.law_count, made->particles,
                            &made->dem);
}

static int wake(layers_job *job, layered_pack *made)
{
  const packing_status status =
      made->dem ? packing_dem_reload(made->dem) : create_stepper(job, made);
  return status == PACKING_OK ? 0 : forces_status(&job->forces, status);
}

typedef struct settling_layer {
  layers_job *job;
  const layered_pack *made;
} settling_layer;

static void show_settling(void *user, double share, double work)
{
  const settling_layer *here = user;
  here->job->work += work;
  show(here->job, here->made, "settling", share);
}

static void remark_capped(layers_job *job, const layered_pack *made)
{
  const layer *here = &made->layers[made->count - 1];
  if (job->asked->end == LAYER_END_TIME || here->rested || job->told_capped)
    return;
  job->told_capped = 1;
  program_remark(
      "layer %zu: not at rest after --layer-time-max %.6g (kinetic energy %.3g "
      "of m g r, --rest-tolerance %.3g); the next one follows all the same",
      made->count, job->asked->layer_time_max, made->moved.kinetic_per_mgr,
      job->asked->rest_tolerance);
}

static int settle(layers_job *job, layered_pack *made)
{
  const double start = program_seconds();
  const layers_options *o = job->asked;
  const int rest = o->end == LAYER_END_REST;
  layer *here = &made->layers[made->count - 1];
  settling_layer user = {job, made};
  settled_state end = {0, 0};
  int code = wake(job, made);
  if (code)
    return code;
  const settling s = {.forces = &job->forces,
                      .dem = made->dem,
                      .particles = packing_particles_count(made->particles),
                      .moved = &made->moved,
                      .fall = o->layer_height,
                      .look = o->layer_time,
                      .time_max = rest ? o->layer_time_max : o->layer_time,
                      .rest = rest,
                      .tolerance = o->rest_tolerance,
                      .show = show_settling,
                      .user = &user};
  code = settling_run(&s, &end);
  here->time = end.time;
  here->rested = end.rested;
  made->report.time_settle += program_seconds() - start;
  if (!code)
    remark_capped(job, made);
  return code;
}

/* ---- all layers ---- */

static int is_full(const layers_job *job, const layered_pack *made)
{
  if (job->closed)
    return 0;
  return (job->asked->full == FULL_BED ? made->bed : made->highest) >= job->asked->height;
}

/* The height is where the sums of lengths say, not a rounding error above. */
static void look_at_bed(layers_job *job, layered_pack *made)
{
  const packing_view view = view_of(made);
  double highest = 0;
  const double bed =
      columns_measure(&job->columns, &view, job->spec.dim, job->floor, &highest);
  made->bed = bed - job->floor;
  made->highest = highest - job->floor;
}

static int pile_up(layers_job *job, layered_pack *made)
{
  do {
    int code = lay(job, made);
    if (code)
      return code;
    if (made->layers[made->count - 1].placed == 0) {
      made->count--;
      made->stop = STOP_NO_ROOM;
      return 0;
    }
    code = settle(job, made);
    if (code)
      return code;
    look_at_bed(job, made);
    made->stop = is_full(job, made) ? STOP_FULL : STOP_MOST;
  } while (made->stop != STOP_FULL && made->count < job->asked->max_layers);
  return 0;
}

static int create_store(layers_job *job, layered_pack *made)
{
  packing_particles_def def;
  packing_particles_def_init(&def);
  def.dim = job->spec.dim;
  def.columns = PACKING_COLUMN_VELOCITY | PACKING_COLUMN_SPIN;
  if (packing_psd_components(job->psd) > 1)
    def.columns |= PACKING_COLUMN_COMPONENT;
  const packing_status status =
      packing_particles_create(job->context, &def, &made->particles);
  return status == PACKING_OK ? 0 : program_status(job->context, status, "particles");
}

int layers_make(layers_job *job, layered_pack *made)
{
  const double start = program_seconds();
  report_init(&made->report);
  made->report.time_place = made->report.time_settle = 0;
  made->stream = layers_stream(job->asked, job->made);
  packing_dem_report_init(&made->moved);
  int code = create_store(job, made);
  if (!code)
    code = pile_up(job, made);
  packing_dem_destroy(made->dem);
  made->dem = NULL;
  if (code)
    return code;
  const packing_view view = view_of(made);
  const measured m = {.context = job->context,
                      .domain = job->domain,
                      .psd = job->psd,
                      .view = &view,
                      .dim = job->spec.dim,
                      .limit = job->asked->common.max_overlap};
  code = measures_fill(&made->report, &m, NULL);
  made->report.time_total = program_seconds() - start;
  return code;
}

void layered_pack_free(layered_pack *made)
{
  packing_particles_destroy(made->particles);
  free(made->layers);
}
