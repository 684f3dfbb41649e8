/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One pack: lay, settle, look how high the bed stands, again. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "layers.h"

/* How much work a call does: short enough for a lively bar and a prompt interrupt. */
static const double STEPS_AT_ONCE = 3e5; /* particle-steps */
enum { PLACER_STEP = 8, LOOKS = 100 };

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

static int stepper_status(const layers_job *job, packing_status status)
{
  return program_status(job->context, status,
                        status == PACKING_ERR_UNSTABLE   ? "--dt"
                        : status == PACKING_ERR_GEOMETRY ? "--domain"
                                                         : "stepper");
}

static packing_status create_stepper(layers_job *job, layered_pack *made)
{
  const layers_options *o = job->asked;
  packing_dem_def def;
  packing_dem_def_init(&def);
  def.dt = o->dt;
  def.gravity = job->gravity;
  def.drag = o->drag;
  def.rotations = o->rotations;
  def.arm = o->arm;
  def.disc_mass = o->disc_mass;
  if (o->material_walls)
    def.wall_material = 0;
  /* What the stepper itself left in the bed may be mid-collision when the next layer comes; new
   * particles overlap nothing. The audit judges the end. */
  def.max_start_overlap = 1;
  def.impact_velocity = sqrt(2 * job->down * o->layer_height);
  return packing_dem_create(job->context, &def, job->domain, job->materials, job->laws,
                            job->law_count, made->particles, &made->dem);
}

static int wake(layers_job *job, layered_pack *made)
{
  const packing_status status =
      made->dem ? packing_dem_reload(made->dem) : create_stepper(job, made);
  return status == PACKING_OK ? 0 : stepper_status(job, status);
}

/* Steps that a time stands for, at least one. */
static uint64_t steps_of(double time, double dt)
{
  return (uint64_t)fmax(1, fmin(floor(time / dt + 0.5), 1e15));
}

/* The pace of a layer, in steps. */
typedef struct pace {
  uint64_t last;     /* it ends after this at the latest */
  uint64_t earliest; /* no look before */
  uint64_t look;     /* and then one every so many */
  uint64_t at_once;
} pace;

static pace choose_pace(const layers_job *job, const layered_pack *made, double dt)
{
  const layers_options *o = job->asked;
  const double particles = (double)packing_particles_count(made->particles);
  const int rest = o->end == LAYER_END_REST;
  return (pace){
      .last = steps_of(rest ? o->layer_time_max : o->layer_time, dt),
      .earliest = steps_of(sqrt(2 * o->layer_height / job->down), dt),
      .look = steps_of(o->layer_time / LOOKS, dt),
      .at_once = (uint64_t)fmax(1, STEPS_AT_ONCE / particles),
  };
}

static uint64_t least(uint64_t a, uint64_t b)
{
  return a < b ? a : b;
}

/* Steps to the next look, and not too many. */
static uint64_t next_steps(const pace *p, uint64_t done)
{
  const uint64_t to_look = p->look - done % p->look;
  return least(least(to_look, p->at_once), p->last - done);
}

static int at_rest(const layers_job *job, const layered_pack *made, const pace *p,
                   uint64_t done)
{
  return job->asked->end == LAYER_END_REST && done >= p->earliest &&
         done % p->look == 0 && made->moved.kinetic_per_mgr < job->asked->rest_tolerance;
}

static int step(layers_job *job, layered_pack *made, const pace *p)
{
  layer *here = &made->layers[made->count - 1];
  uint64_t done = 0;
  while (done < p->last && !here->rested && !interrupted()) {
    const uint64_t steps = next_steps(p, done);
    const packing_status status = packing_dem_step(made->dem, steps, &made->moved);
    if (status == PACKING_ERR_UNSTABLE)
      return program_fail(PROGRAM_BAD_INPUT,
                          "--dt: %s; a shorter step, or with much friction a larger "
                          "--slip-velocity than %.3g, may hold it",
                          packing_context_message(job->context),
                          job->asked->slip_velocity);
    if (status != PACKING_OK)
      return stepper_status(job, status);
    done += steps;
    job->work += (double)steps * (double)made->moved.particles;
    here->rested = at_rest(job, made, p, done);
    show(job, made, "settling", (double)done / (double)p->last);
  }
  here->time = (double)done * made->moved.dt;
  return interrupted() ? program_interrupted() : 0;
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
  packing_dem_advice advice;
  packing_dem_advice_init(&advice);
  int code = wake(job, made);
  if (code)
    return code;
  double dt = job->asked->dt;
  if (dt == 0 && packing_dem_advise(made->dem, &advice) == PACKING_OK)
    dt = advice.advised;
  const pace p = choose_pace(job, made, dt);
  code = step(job, made, &p);
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
