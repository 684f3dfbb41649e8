/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_LAYERS_H
#define EXAMPLES_LAYERS_H

/* Packs made layer by layer: E. M. B. Campello, K. R. Cassares, Lat. Am. J. Solids Struct. 13,
 * 23 (2016), Algorithm 1. Functions return 0 or an exit code, after one line on standard error.
 * "Up" is the last axis: z, in two dimensions y. */

#include "../common/forces.h"
#include "../common/measures.h"
#include "../common/options.h"
#include "../common/progress.h"
#include "../common/spec.h"

extern const char layers_program[]; /* "packing-layers" */

/* When a layer has settled. */
typedef enum layer_end { LAYER_END_REST, LAYER_END_TIME } layer_end;

/* When the bed is full: no column ends below the height, or the highest particle reaches it. */
typedef enum full_rule { FULL_BED, FULL_HIGHEST } full_rule;

/* Where the space for a layer begins: above the highest particle, or where the lowest column of
 * the bed ends, the higher parts standing in the way. */
typedef enum layer_start { LAYER_START_HIGHEST, LAYER_START_BED } layer_start;

enum { LAYERS_MOST = 4096, PACKS_MOST = 1000 };

/* What can be asked; reals are NaN where not given. */
typedef struct layers_options {
  options common;
  const char *example; /* "5.1" ...; NULL: none */
  const char *sheet;
  uint64_t dim; /* 0: not given */
  double height, layer_height, layer_density;
  double layer_time, layer_time_max, rest_tolerance;
  forces_options forces;
  layer_end end;
  layer_start start;
  full_rule full;
  uint64_t packs, sets, max_layers;
} layers_options;

void layers_options_init(layers_options *o);

/* For argp: the options of this program, the common ones and the forces being its children. */
extern const struct argp_option layers_options_table[];
error_t layers_options_parse(int key, char *argument, struct argp_state *state);

/* The names of choices, in the order of their values. */
extern const char *const layers_end_names[], *const layers_start_names[],
                                                 *const layers_full_names[];

/* Vertical columns of two mean diameters' width over the cross-section. */
typedef struct columns {
  size_t across, deep;
  double x, y;           /* lowest corner */
  double dx, dy;         /* width of a column */
  double *top;           /* highest point of the particles whose centre is inside */
  unsigned char *counts; /* 1: the walls leave room for particles at the full height */
  size_t counted;        /* columns that count; 0: the highest particle decides */
} columns;

/* Everything that is the same for all packs of a run. */
typedef struct layers_job {
  layers_options *asked; /* with every default filled in */
  domain_spec spec;      /* the container; open above unless closed */
  char *domain_text, *psd_text;
  int closed; /* 1: a container without a top to be opened, as a sphere */
  input_files input;
  packing_context *context;
  packing_domain *domain;
  packing_psd *psd;
  forces forces;
  double floor, top; /* of the container */
  double mean_r;
  columns columns;
  progress bar;
  char label[96];
  size_t made;    /* packs that are finished */
  double work;    /* particle-steps so far */
  int told_short; /* remarks are made once */
  int told_capped;
} layers_job;

/* Fills in the defaults, makes the handles, checks the places of files. */
int layers_set_up(layers_job *job);
void layers_clean_up(layers_job *job);

/* What became of a layer. */
typedef struct layer {
  size_t placed, unplaced;
  double density; /* of the region it was laid into */
  double time;    /* simulated */
  int rested;     /* 1: its end was rest */
  int saturated;  /* 1: less was placed than asked */
} layer;

/* Why no further layer was laid. */
typedef enum layers_stop { STOP_FULL, STOP_NO_ROOM, STOP_MOST } layers_stop;

typedef struct layered_pack {
  uint64_t stream;
  packing_particles *particles;
  packing_dem *dem;
  packing_dem_report moved;
  layer *layers;
  size_t count;
  layers_stop stop;
  double bed;     /* where the lowest column ends, above the floor */
  double highest; /* the highest particle's top, above the floor */
  report report;
} layered_pack;

/* Makes and measures one pack; `job->made` says the how manieth it is. */
int layers_make(layers_job *job, layered_pack *made);
void layered_pack_free(layered_pack *made);

/* The space for a layer above `base`: the container between two heights. NULL with code 0
 * where there is none. */
int layers_region(const layers_job *job, double base, packing_domain **region);

/* Columns over the job's container. */
int columns_create(columns *c, const packing_domain *domain, double top, double mean_r);
void columns_free(columns *c);

/* Finds how high a pack stands: returns where its lowest column that counts ends; `highest`
 * gets its highest point. `floor_height` stands for nothing. */
double columns_measure(columns *c, const packing_view *view, int dim, double floor_height,
                       double *highest);

/* Writes files and report of all packs; tells what is less than was asked. */
int layers_write(layers_job *job, layered_pack *packs, size_t count, const char *command);
int layers_judge(const layers_job *job, const layered_pack *packs, size_t count);

/* The stream of pack number `number` (from 0): each has one of its own, so that --stream makes
 * any of them alone. */
uint64_t layers_stream(const layers_options *o, size_t number);

#endif
