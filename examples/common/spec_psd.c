/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --psd: KIND:FIELDS[,by=mass|number], or a mixture SHARE*SPEC+SHARE*SPEC+... */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "spec.h"
#include "tap.h"

/* What a part is made from. */
typedef struct part {
  const char *kind;
  char *fields; /* the text after the colon, `,by=` cut off */
  packing_by by;
  int by_given;
  int dim;
  input_files *files;
} part;

typedef int (*part_create)(packing_context *context, const part *p, packing_psd **psd);

#define BAD(...) program_fail(PROGRAM_BAD_INPUT, "--psd: " __VA_ARGS__)

static int done(packing_context *context, packing_status status)
{
  return status == PACKING_OK ? 0 : program_status(context, status, "--psd");
}

/* Reads exactly the `count` fields of `names` into `value`. */
static int read_fields(const part *p, const char *const *names, size_t count,
                       double *value)
{
  size_t given = 0;
  int code = 0;
  char **words = spec_split(p->fields, ',', &given);
  if (given < count || !*words[0])
    code = BAD("%s: %s is missing", p->kind, names[*words[0] ? given : 0]);
  else if (given > count)
    code = BAD("%s: '%s' is one field too many", p->kind, words[count]);
  for (size_t i = 0; i < count && !code; i++) {
    char where[64];
    snprintf(where, sizeof where, "--psd: %s: %s", p->kind, names[i]);
    code = number_real(where, words[i], &value[i]);
  }
  free(words);
  return code;
}

/* The laws that are a handful of numbers: their def's fields in the order of the SPEC. */
#define LAW(law, count, names, assignments)                                              \
  static int create_##law(packing_context *context, const part *p, packing_psd **psd)    \
  {                                                                                      \
    static const char *const fields[] = names;                                           \
    packing_psd_##law##_def def;                                                         \
    double v[count];                                                                     \
    const int code = read_fields(p, fields, count, v);                                   \
    if (code)                                                                            \
      return code;                                                                       \
    packing_psd_##law##_def_init(&def);                                                  \
    assignments;                                                                         \
    def.dim = p->dim;                                                                    \
    if (p->by_given)                                                                     \
      def.by = p->by;                                                                    \
    return done(context, packing_psd_create_##law(context, &def, psd));                  \
  }
#define LIST(...)                                                                        \
  {                                                                                      \
    __VA_ARGS__                                                                          \
  }

LAW(mono, 1, LIST("R"), def.r = v[0])
LAW(uniform, 2, LIST("MIN", "MAX"), (def.min_r = v[0], def.max_r = v[1]))
LAW(normal, 4, LIST("MEAN", "SD", "MIN", "MAX"),
    (def.mean_r = v[0], def.sd_r = v[1], def.min_r = v[2], def.max_r = v[3]))
LAW(lognormal, 4, LIST("MEDIAN", "SIGMA", "MIN", "MAX"),
    (def.median_r = v[0], def.sigma = v[1], def.min_r = v[2], def.max_r = v[3]))
LAW(weibull, 4, LIST("SCALE", "SHAPE", "MIN", "MAX"),
    (def.scale_r = v[0], def.shape = v[1], def.min_r = v[2], def.max_r = v[3]))
LAW(gamma, 4, LIST("SCALE", "SHAPE", "MIN", "MAX"),
    (def.scale_r = v[0], def.shape = v[1], def.min_r = v[2], def.max_r = v[3]))
LAW(exponential, 3, LIST("MEAN", "MIN", "MAX"),
    (def.scale_r = v[0], def.min_r = v[1], def.max_r = v[2]))

/* R1=W1,R2=W2 */
static int read_shares(char **words, size_t count, double *r, double *share)
{
  for (size_t i = 0; i < count; i++) {
    char *weight = strchr(words[i], '=');
    if (!weight)
      return BAD("discrete: '%s' is not RADIUS=SHARE", words[i]);
    *weight++ = '\0';
    int code = number_real("--psd: discrete: radius", words[i], &r[i]);
    if (!code)
      code = number_real("--psd: discrete: share", weight, &share[i]);
    if (code)
      return code;
  }
  return 0;
}

static int create_discrete(packing_context *context, const part *p, packing_psd **psd)
{
  size_t count = 0;
  char **words = spec_split(p->fields, ',', &count);
  double *r = program_take(count, sizeof *r), *share = program_take(count, sizeof *share);
  int code = read_shares(words, count, r, share);
  if (!code) {
    packing_psd_discrete_def def;
    packing_psd_discrete_def_init(&def);
    def.count = count;
    def.r = r;
    def.share = share;
    def.dim = p->dim;
    if (p->by_given)
      def.by = p->by;
    code = done(context, packing_psd_create_discrete(context, &def, psd));
  }
  free(share);
  free(r);
  free(words);
  return code;
}

typedef packing_status (*psd_reader)(packing_context *context, const part *p,
                                     const packing_stream *stream, packing_psd **psd);

static packing_status read_curve(packing_context *context, const part *p,
                                 const packing_stream *stream, packing_psd **psd)
{
  packing_read_curve_def def;
  packing_read_curve_def_init(&def);
  def.dim = p->dim;
  if (p->by_given)
    def.by = p->by;
  return packing_read_curve(context, &def, stream, psd);
}

static packing_status read_sample(packing_context *context, const part *p,
                                  const packing_stream *stream, packing_psd **psd)
{
  packing_read_sample_def def;
  packing_read_sample_def_init(&def);
  def.dim = p->dim;
  if (p->by_given)
    def.by = p->by;
  return packing_read_sample(context, &def, stream, psd);
}

static int create_from_file(packing_context *context, const part *p, psd_reader reader,
                            packing_psd **psd)
{
  packing_file *file = NULL;
  char where[512];
  if (!*p->fields)
    return BAD("%s: FILE is missing", p->kind);
  snprintf(where, sizeof where, "--psd: %s", p->fields);
  packing_status status = packing_file_open(context, p->fields, &file);
  if (status != PACKING_OK)
    return program_status(context, status, "--psd");
  tap t;
  tap_open(&t, packing_file_stream(file));
  status = reader(context, p, &t.stream, psd);
  if (status == PACKING_OK)
    tap_note(&t, p->files, p->fields);
  packing_file_close(file);
  return status == PACKING_OK ? 0 : program_status(context, status, where);
}

static int create_curve(packing_context *context, const part *p, packing_psd **psd)
{
  return create_from_file(context, p, read_curve, psd);
}

static int create_sample(packing_context *context, const part *p, packing_psd **psd)
{
  return create_from_file(context, p, read_sample, psd);
}

static const struct {
  const char *name;
  part_create create;
} laws[] = {
    {"mono", create_mono},
    {"uniform", create_uniform},
    {"normal", create_normal},
    {"lognormal", create_lognormal},
    {"weibull", create_weibull},
    {"gamma", create_gamma},
    {"exponential", create_exponential},
    {"discrete", create_discrete},
    {"curve", create_curve},
    {"sample", create_sample},
};
enum { LAWS = sizeof laws / sizeof laws[0] };

static int unknown_law(const char *name)
{
  char list[256] = "";
  for (size_t i = 0; i < LAWS; i++)
    spec_list(list, sizeof list, laws[i].name);
  return BAD("unknown size distribution '%s'; known are %s", name, list);
}

/* Takes `,by=mass` or `,by=number` off the end of the fields. */
static int cut_by(part *p)
{
  char *last = strrchr(p->fields, ',');
  if (!last || strncmp(last, ",by=", 4) != 0)
    return 0;
  p->by_given = 1;
  p->by = strcmp(last + 4, "mass") == 0 ? PACKING_BY_MASS : PACKING_BY_NUMBER;
  if (p->by == PACKING_BY_NUMBER && strcmp(last + 4, "number") != 0)
    return BAD("by: '%s' is not mass or number", last + 4);
  *last = '\0';
  return 0;
}

static int create_part(packing_context *context, char *text, int dim, packing_psd **psd,
                       input_files *files)
{
  part p = {.kind = text, .dim = dim, .files = files};
  p.fields = strchr(text, ':');
  if (p.fields)
    *p.fields++ = '\0';
  else
    p.fields = text + strlen(text);
  for (size_t i = 0; i < LAWS; i++)
    if (strcmp(laws[i].name, text) == 0) {
      const int code = cut_by(&p);
      return code ? code : laws[i].create(context, &p, psd);
    }
  return unknown_law(text);
}

/* The length of `SHARE*` at the start of a text, 0 if there is none. */
static size_t share_length(const char *text)
{
  const size_t number = strspn(text, "0123456789.eE+-");
  return (isdigit((unsigned char)*text) || *text == '.') && text[number] == '*'
             ? number + 1
             : 0;
}

/* Ends the part at `at` before a '+' that stands before SHARE*; returns what follows it, or
 * NULL. */
static char *cut_part(char *at)
{
  for (; *at; at++)
    if (*at == '+' && share_length(at + 1)) {
      *at = '\0';
      return at + 1;
    }
  return NULL;
}

typedef struct mixture {
  packing_psd **parts;
  double *share;
  size_t count;
} mixture;

static int add_part(packing_context *context, char *text, int dim, mixture *m,
                    input_files *files)
{
  const size_t length = share_length(text);
  if (!length)
    return BAD("'%s' lacks its share, as in 0.84*SPEC+0.16*SPEC", text);
  m->parts = program_take_more(m->parts, m->count + 1, sizeof(packing_psd *));
  m->share = program_take_more(m->share, m->count + 1, sizeof *m->share);
  text[length - 1] = '\0';
  int code = number_positive("--psd: share", text, &m->share[m->count]);
  if (!code)
    code = create_part(context, text + length, dim, &m->parts[m->count], files);
  if (!code)
    m->count++;
  return code;
}

static int create_mixture(packing_context *context, char *text, int dim,
                          packing_psd **psd, input_files *files)
{
  mixture m = {0};
  int code = 0;
  while (text && !code) {
    char *next = cut_part(text);
    code = add_part(context, text, dim, &m, files);
    text = next;
  }
  if (!code) {
    packing_psd_mixture_def def;
    packing_psd_mixture_def_init(&def);
    def.count = m.count;
    def.parts = m.parts;
    def.share = m.share;
    def.dim = dim;
    code = done(context, packing_psd_create_mixture(context, &def, psd));
  }
  for (size_t i = 0; i < m.count; i++)
    packing_psd_destroy(m.parts[i]);
  free(m.share);
  free(m.parts);
  return code;
}

int psd_spec_create(packing_context *context, const char *text, int dim,
                    packing_psd **psd, input_files *files)
{
  for (const char *at = text; *at; at++)
    if (iscntrl((unsigned char)*at))
      return BAD("a control character in it");
  char *copy = program_copy(text, strlen(text));
  const int code = share_length(copy) ? create_mixture(context, copy, dim, psd, files)
                                      : create_part(context, copy, dim, psd, files);
  free(copy);
  return code;
}
