/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_SPEC_H
#define EXAMPLES_SPEC_H

/* The little language of --domain and --psd. Functions return 0, or an exit code after one
 * line on standard error that starts with the option and names the field. */

#include <packing/packing.h>

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
  DOMAIN_ANNULUS
} domain_kind;

/* A container as it was asked for, scaled and moved. */
typedef struct domain_spec {
  const char *text;  /* as typed, borrowed; NULL: none */
  domain_kind kind;  /* which */
  int dim;           /* 2 or 3 */
  double size[4];    /* lengths in the order of the SPEC */
  packing_vec3 at;   /* corner, centre of the base, or centre */
  packing_axis axis; /* of a body of revolution */
  unsigned periodic; /* sum of PACKING_PERIODIC_ */
  int open_top;
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

/* Makes the container; `*domain` stays NULL where there is none. */
int domain_spec_create(packing_context *context, const domain_spec *spec,
                       packing_domain **domain);

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
