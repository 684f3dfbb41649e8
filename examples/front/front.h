/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_FRONT_H
#define EXAMPLES_FRONT_H

/* Packs grown by the advancing front. Functions return 0, or an exit code after one line on
 * standard error. */

#include "../common/forces.h"
#include "../common/input.h"
#include "../common/measures.h"
#include "../common/options.h"
#include "../common/progress.h"

extern const char front_program[]; /* "packing-front" */

enum { FRONT_GRADES_MOST = 64, FRONT_FRAMES_MOST = 64 };

/* What can be asked; reals are NaN where not given. */
typedef struct front_options {
  options common;
  forces_options forces;
  input in;
  packing_front_mode mode;
  packing_front_direction direction;
  packing_front_select select[2];            /* of the front, of the neighbours */
  const packing_contact_method *contact;     /* NULL: not given */
  const char *stock, *list, *frames, *trace; /* as typed; NULL: not given */
  const char *grades[FRONT_GRADES_MOST];
  size_t stock_count, grade_count, frame_count; /* 0: not given */
  int select_given, loosen_given, settle;
  packing_loosen_how loosen;
  double settle_time, rest_tolerance;
} front_options;

void front_options_init(front_options *o);

/* For argp: the options of this program; children: the common ones, the amount, the forces, the
 * input. */
extern const struct argp_option front_options_table[];
error_t front_options_parse(int key, char *argument, struct argp_state *state);

/* Whether the options go together; sets the limit of the audit. */
int front_options_check(front_options *o);

/* A part of the container with sizes of its own. */
typedef struct front_grade {
  const char *text;    /* as typed */
  char *sizes, *where; /* its two SPECs */
  domain_spec spec;
  packing_domain *domain;
  packing_psd *psd;
  size_t count;        /* particles there */
  double ks, ks_limit; /* NaN without particles */
} front_grade;

/* What was asked of a class of an exact list, and what has become of it. */
typedef struct front_list {
  packing_front_class *classes;
  size_t *left; /* not placed */
  size_t count;
} front_list;

/* The growing pack at a moment: its first particles, and which of them were the front. */
typedef struct front_frame {
  size_t count;
  double volume_fraction;
  size_t *member;
  size_t members;
} front_frame;

/* How far it was when. */
typedef struct front_mark {
  double seconds;
  size_t placed;
  double volume_fraction;
} front_mark;

typedef struct front_job {
  front_options *asked;
  domain_spec spec;
  char *domain_text, *psd_text;
  input_files input;
  packing_context *context;
  packing_domain *domain;
  packing_psd *psd; /* NULL: an exact list */
  front_grade *grades;
  front_list list;
  packing_particles *particles;
  size_t standing;          /* of them, from --in */
  double standing_fraction; /* of the container that these fill */
  double target;            /* volume fraction asked, 0: none */
  packing_placer *placer;
  packing_placer_report placed;
  int stopped; /* 1: told to stop before the end */
  size_t on_front;
  front_frame *frames;
  size_t frame_count;
  front_mark *marks;
  size_t mark_count;
  packing_particles *grown; /* as it was before it was changed; NULL: as it is */
  double loosened;          /* volume fraction, NaN: not loosened */
  forces forces;
  packing_dem_report moved;
  double settle_time; /* simulated */
  int rested;
  packing_size_component *components; /* of a mixture; NULL: none measured */
  report report;
} front_job;

/* Makes the handles and the placer, checks the places of files. */
int front_set_up(front_job *job);
void front_clean_up(front_job *job);

/* Tells a failed call of the library, by the option where its message begins with a field. */
int front_status(const front_job *job, packing_status status);

/* Reads --list; sizes of --grade; the particles that stand there already. */
int front_list_read(front_job *job);
int front_grades_create(front_job *job);
int front_standing_read(front_job *job);

/* Lets the pack grow. */
int front_grow(front_job *job);

/* Remembers the growing pack every so often, and the picture of all that. */
int front_frames_look(front_job *job);
int front_frames_keep(front_job *job);
packing_status front_frames_write(const pack *p, const packing_stream *stream, int svg);
void front_frames_free(front_job *job);

/* Notes how far the growth is, for --trace, and writes it. */
void front_trace_look(front_job *job, double seconds);
packing_status front_trace_write(const pack *p, const packing_stream *stream);

/* Steps 3 and 4 of the paper's method. */
int front_loosen(front_job *job);
int front_settle(front_job *job);

/* Measures what was placed against what was asked; all else. */
int front_measure_sizes(front_job *job);
int front_measure(front_job *job);

/* Writes files and report; tells what is less than was asked. */
int front_write(front_job *job, const char *command, double start);
int front_judge(const front_job *job);

#endif
