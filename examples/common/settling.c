/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "settling.h"
#include <math.h>
#include "program.h"

/* How much work a call does: short enough for a lively bar and a prompt interrupt. */
static const double STEPS_AT_ONCE = 3e5; /* particle-steps */
static const double STEPS_MOST = 1e9;
enum { LOOKS = 100 };

int settling_check(const char *option, double time_max, double dt)
{
  if (time_max < dt)
    return program_fail(PROGRAM_BAD_INPUT, "--dt: %.9g is more than %s %.9g", dt, option,
                        time_max);
  if (dt > 0 && time_max / dt > STEPS_MOST)
    return program_fail(PROGRAM_BAD_INPUT,
                        "--dt: %.9g makes more than %.0e steps in %s "
                        "%.9g",
                        dt, STEPS_MOST, option, time_max);
  return 0;
}

/* Steps that a time stands for, at least one. */
static uint64_t steps_of(double time, double dt)
{
  return (uint64_t)fmax(1, fmin(floor(time / dt + 0.5), 1e15));
}

/* The pace, in steps. */
typedef struct pace {
  uint64_t last;     /* it ends after this at the latest */
  uint64_t earliest; /* no look before */
  uint64_t look;     /* and then one every so many */
  uint64_t at_once;
} pace;

static double step_length(const settling *s)
{
  packing_dem_advice advice;
  packing_dem_advice_init(&advice);
  if (s->forces->asked->dt == 0 && packing_dem_advise(s->dem, &advice) == PACKING_OK)
    return advice.advised;
  return s->forces->asked->dt;
}

static pace choose_pace(const settling *s)
{
  const double dt = step_length(s);
  return (pace){
      .last = steps_of(s->time_max, dt),
      .earliest = steps_of(sqrt(2 * s->fall / s->forces->down), dt),
      .look = steps_of(s->look / LOOKS, dt),
      .at_once = (uint64_t)fmax(1, STEPS_AT_ONCE / (double)s->particles),
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

static int at_rest(const settling *s, const pace *p, uint64_t done)
{
  return s->rest && done >= p->earliest && done % p->look == 0 &&
         s->moved->kinetic_per_mgr < s->tolerance;
}

static int failed(const settling *s, packing_status status)
{
  if (status != PACKING_ERR_UNSTABLE)
    return forces_status(s->forces, status);
  return program_fail(PROGRAM_BAD_INPUT,
                      "--dt: %s; a shorter step, or with much friction a larger "
                      "--slip-velocity than %.3g, may hold it",
                      packing_context_message(s->forces->context),
                      s->forces->asked->slip_velocity);
}

int settling_run(const settling *s, settled_state *end)
{
  uint64_t done = 0;
  const pace p = choose_pace(s);
  end->rested = 0;
  while (done < p.last && !end->rested && !interrupted()) {
    const uint64_t steps = next_steps(&p, done);
    const packing_status status = packing_dem_step(s->dem, steps, s->moved);
    if (status != PACKING_OK)
      return failed(s, status);
    done += steps;
    end->rested = at_rest(s, &p, done);
    s->show(s->user, (double)done / (double)p.last, (double)steps * (double)s->particles);
  }
  end->time = (double)done * s->moved->dt;
  return interrupted() ? program_interrupted() : 0;
}
