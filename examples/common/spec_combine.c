/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --domain and what is combined with it: SPEC --and SPEC --or SPEC --minus SPEC, left to right. */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "spec.h"

static const struct {
  const char *option;
  packing_operation operation;
} operators[] = {
    {"--or", PACKING_UNION},
    {"--and", PACKING_INTERSECTION},
    {"--minus", PACKING_DIFFERENCE},
};
enum { OPERATORS = sizeof operators / sizeof operators[0] };

/* Which operator stands at `at`, with blanks on both sides; -1: none. */
static int operator_at(const char *at)
{
  for (int i = 0; i < OPERATORS; i++) {
    const size_t length = strlen(operators[i].option);
    if (at[0] == ' ' && strncmp(at + 1, operators[i].option, length) == 0 &&
        at[1 + length] == ' ')
      return i;
  }
  return -1;
}

/* The next operator, or the end of the text. */
static const char *find_operator(const char *text)
{
  while (*text && operator_at(text) < 0)
    text++;
  return text;
}

/* The next of those that are combined: its operator, its SPEC. NULL `at`: there is none. */
typedef struct part {
  const char *at, *text;
  size_t length;
  int which;
} part;

static part next_part(const char *more)
{
  part p = {more, NULL, 0, 0};
  if (!more || !*more) {
    p.at = NULL;
    return p;
  }
  p.which = operator_at(more);
  p.text = more + strlen(operators[p.which].option) + 2;
  p.length = (size_t)(find_operator(p.text) - p.text);
  return p;
}

static int parse_part(const part *p, const domain_spec *first, domain_spec *spec)
{
  const char *named = operators[p->which].option;
  const int code = domain_part_parse(named, p->text, p->length, spec);
  if (code)
    return code;
  if (spec->dim != first->dim)
    return program_fail(PROGRAM_BAD_INPUT,
                        "%s: '%.*s' has %d dimensions, what it is combined with %d",
                        named, (int)p->length, p->text, spec->dim, first->dim);
  domain_spec_scale(spec, first->more_scale);
  domain_spec_shift(spec, first->more_at);
  return 0;
}

int domain_spec_parse_as(const char *named, const char *text, domain_spec *spec)
{
  for (const char *at = text; *at; at++)
    if (iscntrl((unsigned char)*at))
      return program_fail(PROGRAM_BAD_INPUT, "%s: a control character in it", named);
  const char *more = find_operator(text);
  int code = domain_part_parse(named, text, (size_t)(more - text), spec);
  spec->more = *more ? more : NULL;
  spec->more_scale = 1; /* what was appended to the first is not meant for the others */
  spec->more_at = (packing_vec3){0, 0, 0};
  for (part p = next_part(spec->more); p.at && !code; p = next_part(p.text + p.length)) {
    domain_spec other;
    code = parse_part(&p, spec, &other);
  }
  return code;
}

int domain_spec_parse(const char *text, domain_spec *spec)
{
  return domain_spec_parse_as("--domain", text, spec);
}

void domain_spec_scale(domain_spec *spec, double factor)
{
  for (size_t i = 0; i < sizeof spec->size / sizeof spec->size[0]; i++)
    spec->size[i] *= factor;
  packing_vec3 *const at[] = {&spec->at, &spec->more_at};
  for (int i = 0; i < 2; i++)
    *at[i] = (packing_vec3){factor * at[i]->x, factor * at[i]->y, factor * at[i]->z};
  if (spec->file)
    spec->scale *= factor;
  spec->more_scale *= factor;
}

void domain_spec_shift(domain_spec *spec, packing_vec3 by)
{
  packing_vec3 *const at[] = {&spec->at, &spec->more_at};
  for (int i = 0; i < 2; i++)
    *at[i] = (packing_vec3){at[i]->x + by.x, at[i]->y + by.y, at[i]->z + by.z};
}

static int print_all(FILE *to, const domain_spec *spec)
{
  int code = 0;
  domain_part_print(to, spec);
  for (part p = next_part(spec->more); p.at && !code; p = next_part(p.text + p.length)) {
    domain_spec other;
    code = parse_part(&p, spec, &other);
    fprintf(to, " %s ", operators[p.which].option);
    if (!code)
      domain_part_print(to, &other);
  }
  return code;
}

char *domain_spec_text(const domain_spec *spec)
{
  char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  if (!to)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  print_all(to, spec);
  const int failed = ferror(to);
  if (fclose(to) != 0 || failed || !text)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  return text;
}

/* Makes *domain what it is with another container combined. */
static int combine(packing_context *context, const part *p, const domain_spec *first,
                   input_files *files, packing_domain **domain)
{
  domain_spec spec;
  packing_domain *other = NULL, *both = NULL;
  packing_domain_combination_def def;
  int code = parse_part(p, first, &spec);
  if (!code)
    code = domain_part_create(context, &spec, files, &other);
  if (code)
    return code;
  packing_domain_combination_def_init(&def);
  def.operation = operators[p->which].operation;
  def.a = *domain;
  def.b = other;
  const packing_status status = packing_domain_create_combination(context, &def, &both);
  packing_domain_destroy(other);
  if (status != PACKING_OK)
    return program_status(context, status, operators[p->which].option);
  packing_domain_destroy(*domain);
  *domain = both;
  return 0;
}

int domain_spec_create_noting(packing_context *context, const domain_spec *spec,
                              input_files *files, packing_domain **domain)
{
  packing_domain *made = NULL;
  if (spec->kind == DOMAIN_NONE)
    return 0;
  int code = domain_part_create(context, spec, files, &made);
  for (part p = next_part(spec->more); p.at && !code; p = next_part(p.text + p.length))
    code = combine(context, &p, spec, files, &made);
  if (code)
    packing_domain_destroy(made);
  else
    *domain = made;
  return code;
}

int domain_spec_create(packing_context *context, const domain_spec *spec,
                       packing_domain **domain)
{
  return domain_spec_create_noting(context, spec, NULL, domain);
}

void domain_spec_each(const domain_spec *spec,
                      void (*visit)(void *user, const domain_spec *part), void *user)
{
  domain_spec one = *spec;
  one.more = NULL;
  visit(user, &one);
  for (part p = next_part(spec->more); p.at; p = next_part(p.text + p.length))
    if (parse_part(&p, spec, &one) == 0)
      visit(user, &one);
}
