/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_CONVERT_H
#define EXAMPLES_CONVERT_H

/* packing-convert: what was asked, what is at hand, and the steps. Functions return 0, or an exit
 * code after one line on standard error. */

#include "../common/input.h"
#include "../common/options.h"
#include "../common/report.h"

/* What can be done to a pack on its way. */
typedef enum change_kind {
  CHANGE_CROP,
  CHANGE_SCALE,
  CHANGE_SHIFT,
  CHANGE_REPLICATE,
  CHANGE_BOND,
  CHANGE_RENUMBER
} change_kind;

typedef struct change {
  change_kind kind;
  const char *text;  /* as typed */
  double factor;     /* scale; bond: the gap */
  packing_vec3 by;   /* shift */
  size_t numbers;    /* shift: how many were given */
  uint64_t times[3]; /* replicate */
  domain_spec keep;  /* crop */
} change;

typedef struct convert_options {
  options common;
  input in;
  change *changes; /* in the order typed */
  size_t change_count;
  int by_centres; /* crop: 1: keep what has its centre inside, 0: whole particles only */
} convert_options;

typedef struct convert_job {
  convert_options *asked;
  packing_context *context;
  input_files files;
  domain_spec spec;   /* of kind DOMAIN_NONE: no container */
  char *domain_text;  /* of spec */
  char *first_domain; /* the same before any change */
  packing_domain *domain;
  packing_bond *bonds; /* of the particles as they are now */
  size_t bond_count;
  size_t read; /* particles */
  report report;
} convert_job;

extern const char convert_program[];
extern const char *const change_names[];

void convert_options_init(convert_options *o);
void convert_options_free(convert_options *o);
extern const struct argp convert_argp;
int convert_options_check(const convert_options *o);

/* Applies all changes to the particles, bonds and container. */
int convert_change(convert_job *job);

/* Their parts: the failure of a change; `count` numbers, or the end of the program; the container
 * is what `text` (taken) says from here on, `option` being at fault if it is none; the change those
 * that have files of their own. */
int convert_failed(const convert_job *job, const change *c, packing_status status);
double *convert_take_numbers(size_t count);
int convert_set_domain(convert_job *job, const char *option, char *text);
int convert_replicate(convert_job *job, const change *c);
int convert_bond(convert_job *job, const change *c);
packing_status convert_number_ids(packing_particles *particles);

/* Makes the report and the files. */
int convert_write(convert_job *job, const char *command);

#endif
