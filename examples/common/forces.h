/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_FORCES_H
#define EXAMPLES_FORCES_H

/* What moves particles in the stepper: the options of a group of their own, and the handles made
 * from them. Functions return 0, or an exit code after one line on standard error. */

#include <argp.h>
#include <cjson/cJSON.h>
#include <packing/packing.h>

typedef struct forces_options {
  const char *gravity;    /* as typed; NULL: not given */
  const char *near_field; /* the same */
  /* Reals are NaN where not given. */
  double young, poisson, damping, friction, drag, slip_velocity, dt;
  packing_arm arm;
  int rotations, pull, disc_mass, material_walls;
  const char *given; /* the first of these options on the command line; NULL: none */
} forces_options;

void forces_options_init(forces_options *o);

/* --gravity, --friction and so on; its input is a forces_options. */
extern const struct argp forces_argp;

typedef struct forces {
  forces_options *asked; /* with every default filled in after forces_fill_in() */
  packing_context *context;
  int dim;
  double density;
  packing_vec3 gravity;
  double near_field[5];
  double down; /* gravity's part downwards, > 0 */
  packing_materials *materials;
  packing_law *laws[3];
  size_t law_count;
} forces;

/* Reads --gravity (default 2, downwards) and --near-field. `periodic` says along what gravity
 * cannot pull, `settled` what does not settle else, as in "layer". */
int forces_read(forces *f, forces_options *asked, int dim, unsigned periodic,
                const char *settled);

/* The defaults, the slip velocity being that of particles of `mean_r`; then drag and dt of
 * these where not given. */
int forces_fill_in(forces *f, double mean_r, double drag, double dt);

/* Makes materials and laws. */
int forces_create(forces *f, packing_context *context, double density);
void forces_free(forces *f);

/* What the stepper is told of them. */
void forces_tell(const forces *f, packing_dem_def *def);

/* Adds them to the options of a report. */
void forces_report(cJSON *all, const forces *f);

/* Tells a failed call of the stepper. */
int forces_status(const forces *f, packing_status status);

#endif
