/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Placing, and what the paper does afterwards: loosening (step 4), settling (step 3). */
#include <math.h>
#include <stdlib.h>
#include "../common/program.h"
#include "../common/settling.h"
#include "front.h"

/* How much work a call does: short enough for a lively bar and a prompt interrupt; pictures of
 * the growth want every moment. */
enum { STEP = 8, STEP_FRAMES = 1 };

/* How much of the amount is there; the placer's own estimate knows a list. */
static int note_end(front_job *job)
{
  packing_status status = packing_front_members(job->placer, 0, NULL, &job->on_front);
  if (status == PACKING_OK && job->list.count)
    status = packing_front_unplaced(job->placer, job->list.left);
  return status == PACKING_OK ? 0 : front_status(job, status);
}

int front_grow(front_job *job)
{
  const size_t budget = job->asked->frames ? STEP_FRAMES : STEP;
  const double start = program_seconds();
  progress bar;
  int code = 0;
  packing_placer_report_init(&job->placed);
  progress_start(&bar, "placing", !job->asked->common.quiet);
  do {
    const packing_status status = packing_placer_step(job->placer, budget, &job->placed);
    if (status != PACKING_OK)
      code = front_status(job, status);
    else
      code = front_frames_look(job);
    front_trace_look(job, program_seconds() - start);
    progress_show(&bar, job->placed.progress, job->placed.placed);
  } while (!code && job->placed.state == PACKING_PLACER_RUNNING && !interrupted());
  progress_clear();
  job->report.time_place = program_seconds() - start;
  if (!code && interrupted()) {
    job->stopped = 1;
    interrupt_take();
  }
  return code ? code : note_end(job);
}

/* ---- step 4 ---- */

/* Too little was placed: the judge says so. */
static int has_to_be_loosened(const front_job *job)
{
  return job->asked->loosen_given && !job->stopped &&
         job->placed.volume_fraction >= job->target;
}

static int loosen(front_job *job)
{
  packing_loosen_def def;
  if (!has_to_be_loosened(job))
    return 0;
  packing_loosen_def_init(&def);
  def.how = job->asked->loosen;
  def.volume_fraction = job->target;
  def.seed = job->asked->common.seed;
  def.stream = job->asked->common.stream;
  const packing_status status =
      packing_loosen(job->context, &def, job->domain, job->particles, &job->loosened);
  return status == PACKING_OK ? 0 : program_status(job->context, status, "--loosen");
}

/* Sizes are those of the pack that stays, before its radii shrink. */
int front_loosen(front_job *job)
{
  const int shrink = job->asked->loosen == PACKING_LOOSEN_SHRINK;
  int code = shrink ? front_measure_sizes(job) : 0;
  if (!code)
    code = loosen(job);
  return code || shrink ? code : front_measure_sizes(job);
}

/* ---- step 3 ---- */

typedef struct settling_pack {
  front_job *job;
  progress bar;
  double work;
} settling_pack;

static void show_settling(void *user, double share, double work)
{
  settling_pack *here = user;
  here->work += work;
  progress_show_work(&here->bar, share, packing_particles_count(here->job->particles),
                     here->work);
}

static double given(double value, double otherwise)
{
  return isnan(value) ? otherwise : value;
}

static double largest_r(const front_job *job)
{
  packing_view view;
  double largest = 0;
  packing_particles_view(job->particles, &view);
  const pack p = {.view = view};
  for (size_t i = 0; i < view.count; i++)
    largest = fmax(largest, pack_radius(&p, i));
  return largest;
}

static int create_stepper(front_job *job, packing_dem **dem)
{
  packing_dem_def def;
  packing_dem_def_init(&def);
  forces_tell(&job->forces, &def);
  packing_status status = packing_particles_add_columns(
      job->particles, PACKING_COLUMN_VELOCITY | PACKING_COLUMN_SPIN);
  if (status == PACKING_OK)
    status =
        packing_dem_create(job->context, &def, job->domain, job->forces.materials,
                           job->forces.laws, job->forces.law_count, job->particles, dem);
  return status == PACKING_OK ? 0 : forces_status(&job->forces, status);
}

static int step(front_job *job, packing_dem *dem, settling_pack *here)
{
  const front_options *o = job->asked;
  packing_bounds b;
  settled_state end = {0, 0};
  packing_domain_bounds(job->domain, &b);
  const double height = job->spec.dim == 2 ? b.hi.y - b.lo.y : b.hi.z - b.lo.z;
  const double fall = 4 * largest_r(job);
  const settling s = {
      .forces = &job->forces,
      .dem = dem,
      .particles = packing_particles_count(job->particles),
      .moved = &job->moved,
      .fall = fall,
      .look = sqrt(20 * fall / job->forces.down),
      .time_max = given(o->settle_time, 10 * sqrt(20 * height / job->forces.down)),
      .rest = 1,
      .tolerance = given(o->rest_tolerance, 1e-4),
      .show = show_settling,
      .user = here};
  int code = settling_check("--settle-time", s.time_max, o->forces.dt);
  if (!code)
    code = settling_run(&s, &end);
  job->settle_time = end.time;
  job->rested = end.rested;
  if (!code && !end.rested)
    program_remark("--settle: not at rest after %.6g (kinetic energy %.3g of m g r, "
                   "--rest-tolerance %.3g)",
                   end.time, job->moved.kinetic_per_mgr, s.tolerance);
  return code;
}

int front_settle(front_job *job)
{
  const double start = program_seconds();
  settling_pack here = {.job = job};
  packing_dem *dem = NULL;
  if (!job->asked->settle || job->stopped || packing_particles_count(job->particles) == 0)
    return 0;
  packing_dem_report_init(&job->moved);
  int code = create_stepper(job, &dem);
  progress_start(&here.bar, "settling", !job->asked->common.quiet);
  here.bar.unit = "particle-steps";
  if (!code)
    code = step(job, dem, &here);
  progress_clear();
  packing_dem_destroy(dem);
  job->report.time_settle = program_seconds() - start;
  return code;
}
