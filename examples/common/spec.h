/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_SPEC_H
#define EXAMPLES_SPEC_H

/* The little language of --domain and --psd. Functions return 0, or an exit code after one
 * line on standard error that starts with the option and names the field. */

#include <packing/packing.h>
#include <stdio.h>

/* Containers that a SPEC can name. */
typedef enum domain_kind {
  DOMAIN_NONE, /* no container at all */
  DOMAIN_BOX,
  DOMAIN_RECT,
  DOMAIN_CYLINDER,
  DOMAIN_TUBE,
  DOMAIN_CONE,
  DOMAIN_SILO,
  DOMAIN_SPHERE,
  DOMAIN_CIRCLE,
  DOMAIN_ANNULUS,
  DOMAIN_POLYGON,
  DOMAIN_MESH
} domain_kind;

/* A container as it was asked for, scaled and moved. Where it is combined with others,
 * "SPEC --and SPEC --or SPEC --minus SPEC", this is the first of them and `more` is the rest. */
typedef struct domain_spec {
  const char *text;  /* as typed, borrowed; NULL: none */
  domain_kind kind;  /* which */
  int dim;           /* 2 or 3 */
  double size[4];    /* lengths in the order of the SPEC */
  packing_vec3 at;   /* corner, centre of the base, or centre */
  packing_axis axis; /* of a body of revolution */
  unsigned periodic; /* sum of PACKING_PERIODIC_ */
  int open_top;
  const char *file; /* of kinds that are read from one: its name in `text`, not ended */
  int file_length;
  double scale;         /* of what the file holds, before it is moved to `at` */
  const char *more;     /* what follows in `text`, from the operator on; NULL: nothing */
  double more_scale;    /* of that */
  packing_vec3 more_at; /* what it was moved by then */
} domain_spec;

int domain_spec_parse(const char *text, domain_spec *spec);

/* The same of another option, say "--crop". */
int domain_spec_parse_as(const char *option, const char *text, domain_spec *spec);

/* A SPEC of the container as it is now; free it. */
char *domain_spec_text(const domain_spec *spec);

/* No container, in `dim` dimensions. */
void domain_spec_none(int dim, domain_spec *spec);

/* The length that is the container's height; NULL where it has none, as a sphere. */
double *domain_spec_height(domain_spec *spec);

/* Calls `visit` for the container and for each that is combined with it. */
void domain_spec_each(const domain_spec *spec,
                      void (*visit)(void *user, const domain_spec *part), void *user);

/* Scales it about the origin; moves it. */
void domain_spec_scale(domain_spec *spec, double factor);
void domain_spec_shift(domain_spec *spec, packing_vec3 by);

/* A file that a run read. */
typedef struct input_file {
  char *path;
  char sha256[65];
} input_file;

typedef struct input_files {
  input_file *items;
  size_t count;
} input_files;

void input_files_free(input_files *files);

/* Makes the container, and notes the files that it read (NULL: it does not); `*domain` stays NULL
 * where there is none. */
int domain_spec_create_noting(packing_context *context, const domain_spec *spec,
                              input_files *files, packing_domain **domain);
int domain_spec_create(packing_context *context, const domain_spec *spec,
                       packing_domain **domain);

/* One container without those it is combined with (spec_domain.c). `named` is the option that
 * messages name first; `text` has `length` characters. */
int domain_part_parse(const char *named, const char *text, size_t length,
                      domain_spec *spec);
void domain_part_print(FILE *to, const domain_spec *spec);
int domain_part_create(packing_context *context, const domain_spec *spec,
                       input_files *files, packing_domain **domain);

/* Makes the distribution of a SPEC for particles of dimension `dim`, and notes the files that
 * it read. */
int psd_spec_create(packing_context *context, const char *text, int dim,
                    packing_psd **psd, input_files *files);

/* What --help says about both, and about the exit status of programs that make packs and of
 * those that take them. */
extern const char spec_domain_help[], spec_psd_help[];
extern const char spec_maker_status_help[], spec_taker_status_help[];

/* That of makers whose interrupted packs are whole. */
extern const char spec_grower_status_help[];

/* Adds a name to a list "a, b, c" for a message. */
void spec_list(char *list, size_t size, const char *name);

/* Cuts `text` at each `separator`, in place; free the list, not the words. */
char **spec_split(char *text, char separator, size_t *count);

#endif
