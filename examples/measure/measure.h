/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_MEASURE_H
#define EXAMPLES_MEASURE_H

/* packing-measure: what was asked, and what was found. Each measure is a file with a function
 * that makes it (0, or an exit code after one line on standard error), and one that reports it;
 * what is drawn stands in plot_*.c. */

#include "../common/input.h"
#include "../common/options.h"
#include "../common/report.h"

/* ---- what was asked ---- */

/* --profile */
typedef struct profile_ask {
  packing_profile_kind kind;
  packing_axis axis;
  size_t bins;
  char name[16]; /* "x", "radius", "sphere" */
} profile_ask;

/* --section */
typedef struct section_ask {
  packing_axis axis;
  int one;       /* 1: at `height`, 0: `count` of them */
  double height; /* [L] */
  size_t count;
} section_ask;

typedef struct measure_options {
  options common;
  input in;
  double tolerance; /* of contacts */
  packing_vec3 up;  /* against gravity; 0: as the library takes it */
  int rdf;          /* 1: asked for */
  double rdf_max;   /* in mean diameters; 0: as large as has centres */
  size_t rdf_bins;
  int no_order;
  packing_neighbours_def neighbours; /* of the measures of order */
  const char *order_text;            /* as typed; NULL: default */
  const char *order_file;            /* NULL: none */
  profile_ask *profiles;
  size_t profile_count;
  section_ask *sections;
  size_t section_count;
  uint64_t map[3]; /* cells; 0: none */
  const char *map_text;
  int pores;
  const char *pores_prefix; /* files of the network; NULL: none */
  double pores_overlap;     /* NaN: pores are not merged */
  double bond_gap;          /* NaN: no bonds */
  const char *bond_text;
  const char *contact_file; /* NULL: none */
  int normals;              /* bands of their histogram; 0: none */
  const char *sieves_text;  /* NULL: none */
  const char *plot;         /* prefix; NULL: none */
  int svg;                  /* format of plots */
} measure_options;

/* ---- what was found; arrays are NULL where a measure was not made ---- */

/* The histogram of normals, in bins of equal area. */
typedef struct normals_found {
  packing_normals_bin *bins;
  size_t *counts; /* each contact in two opposite bins */
  size_t count;   /* bins */
  size_t sum;     /* of the counts */
} normals_found;

typedef struct order_found {
  int made;
  packing_bond_order_report q4, q6;
  packing_hexatic_report hexatic;             /* two dimensions */
  packing_common_neighbours_report structure; /* three dimensions */
  int has_structure;
  packing_bond_order
      *local[2]; /* of l = 4 and 6, of each sphere; with a file of them only */
  packing_structure *structures; /* likewise */
  packing_hexatic *discs;        /* likewise, of each disc */
} order_found;

typedef struct rdf_found {
  packing_rdf_bin *bins;
  packing_rdf_report report;
  double r_max;
} rdf_found;

typedef struct profile_found {
  packing_profile_bin *bins;
  size_t count;
  packing_profile_report report;
} profile_found;

/* One plane. */
typedef struct plane_found {
  packing_section_report report;
  packing_section_image_report image;
  unsigned char *pixels;
  double height;
} plane_found;

typedef struct section_found {
  plane_found *planes;
  size_t count;
} section_found;

typedef struct map_found {
  packing_porosity_cell *cells;
  size_t count;
  packing_porosity_map_report report;
} map_found;

/* Points of a distribution of pores: shares 0, 1 / 40 ... 1. */
enum { PORE_POINTS = 41 };

typedef struct pores_found {
  packing_pores *network;
  packing_pores_report report;
  double pore_r[PORE_POINTS], constriction_r[PORE_POINTS]; /* NaN of none */
} pores_found;

/* Points of the curves of sizes. */
enum { CURVE_POINTS = 41 };

typedef struct sizes_found {
  int made;
  double lo, hi, mean; /* radii */
  double r[CURVE_POINTS];
  double asked[2][CURVE_POINTS], placed[2][CURVE_POINTS]; /* by number, by mass */
  double *openings;                                       /* diameters, falling */
  size_t opening_count;
  packing_sieve *sieves; /* one more: the pan */
  packing_curve_errors_report errors;
  packing_size_tests_report tests;
  packing_size_component *components;
  size_t component_count;
} sizes_found;

typedef struct measure_job {
  measure_options *asked;
  packing_context *context;
  input_files files;
  domain_spec spec;
  char *domain_text;
  packing_domain *domain;
  packing_psd *psd; /* NULL: not asked */
  packing_view view;
  packing_contacts *contacts; /* NULL without particles */
  packing_contacts *bonds;    /* NULL: not asked */
  packing_classes_report classes;
  report_fabric wall_fabric, orientations;
  normals_found normals;
  order_found order;
  rdf_found rdf;
  profile_found *profiles;
  section_found *sections;
  map_found map;
  pores_found pores;
  sizes_found sizes;
  report report;
} measure_job;

extern const char measure_program[];

/* options.c */
extern const struct argp measure_argp;
void measure_options_init(measure_options *o);
void measure_options_free(measure_options *o);
int measure_options_check(const measure_options *o);

/* Adds what a plot needs to what was asked, once the container is known. */
void measure_options_complete(measure_options *o, const domain_spec *spec);

/* The measures. */
int contacts_measure(measure_job *job);
void contacts_report(const measure_job *job, cJSON *all);
int normals_measure(measure_job *job);
cJSON *normals_report(const measure_job *job);
int order_measure(measure_job *job);
void order_free(order_found *found);
cJSON *order_report(const measure_job *job);
int rdf_measure(measure_job *job);
cJSON *rdf_report(const measure_job *job);
int profiles_measure(measure_job *job);
void profiles_report(const measure_job *job, cJSON *list);
int sections_measure(measure_job *job);
void sections_report(const measure_job *job, cJSON *list);

/* "6.031; 6.120 without 9 rattlers", for people; returns `text`. */
enum { COORDINATION_TEXT = 120 };
const char *coordination_say(char text[COORDINATION_TEXT], const report *r);

/* "z = 7: void 0.4780", for people; returns `text`. */
enum { SECTION_TEXT = 120 };
const char *section_say(char text[SECTION_TEXT], packing_axis axis,
                        const plane_found *plane);
int map_measure(measure_job *job);
cJSON *map_report(const measure_job *job);
int pores_measure(measure_job *job);
cJSON *pores_report(const measure_job *job);
int sizes_measure(measure_job *job);
cJSON *sizes_report(const measure_job *job);
int sizes_read_sieves(measure_job *job);

/* run.c: all of them, one after the other; then all that was found is freed. */
int measure_run(measure_job *job);
void measure_free(measure_job *job);

/* results.c */
int measure_add_outputs(measure_job *job);
int measure_write(measure_job *job, const char *command, double start);

/* summary.c: for people, on standard error. */
void measure_summary(const measure_job *job);

/* files.c, plot_*.c: the writers of tables and pictures; `own` of the pack is the job. */
packing_status write_contacts(const pack *p, const packing_stream *stream);
packing_status write_bonds(const pack *p, const packing_stream *stream);
packing_status write_order(const pack *p, const packing_stream *stream);
packing_status write_map(const pack *p, const packing_stream *stream);
packing_status write_pores(const pack *p, const packing_stream *stream);
packing_status write_constrictions(const pack *p, const packing_stream *stream);
packing_status write_network(const pack *p, const packing_stream *stream);
packing_status write_node1(const pack *p, const packing_stream *stream);
packing_status write_node2(const pack *p, const packing_stream *stream);
packing_status write_link1(const pack *p, const packing_stream *stream);
packing_status write_link2(const pack *p, const packing_stream *stream);
packing_status plot_sizes(const pack *p, const packing_stream *stream);
packing_status plot_rdf(const pack *p, const packing_stream *stream);
packing_status plot_coordination(const pack *p, const packing_stream *stream);
packing_status plot_normals(const pack *p, const packing_stream *stream);
packing_status plot_profile(const pack *p, const packing_stream *stream);
packing_status plot_section(const pack *p, const packing_stream *stream);

/* The failure of a measure, "radial distribution: ...". */
int measure_failed(const measure_job *job, packing_status status, const char *what);

/* "x", "y" or "z". */
const char *axis_name(packing_axis axis);

#endif
