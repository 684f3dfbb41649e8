/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files into sets: reports (JSON, known by the brace they begin with) and packs. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../common/program.h"
#include "../common/text_file.h"
#include "compare.h"

static int failed(const compare_job *job, packing_status status, const char *option,
                  const char *path)
{
  char where[4200];
  snprintf(where, sizeof where, "%s: %s", option, path);
  return program_status(job->context, status, where);
}

/* ---- reports ---- */

static int bad_key(const compare_job *job, const char *path, const char *why)
{
  return program_fail(PROGRAM_BAD_INPUT, "--key: %s %s in %s", job->asked->key, why,
                      path);
}

/* The item that a dotted key leads to, whole numbers counting entries of lists; or NULL. */
static const cJSON *find(const cJSON *at, const char *key)
{
  char *copy = program_copy(key, strlen(key));
  size_t count = 0;
  char **words = spec_split(copy, '.', &count);
  for (size_t i = 0; i < count && at; i++)
    if (cJSON_IsArray(at))
      at = *words[i] && strspn(words[i], "0123456789") == strlen(words[i]) &&
                   strlen(words[i]) < 9
               ? cJSON_GetArrayItem(at, atoi(words[i]))
               : NULL;
    else
      at = cJSON_GetObjectItemCaseSensitive(at, words[i]);
  free(words);
  free(copy);
  return at;
}

static int add_number(const compare_job *job, const char *path, const cJSON *from,
                      compare_set *set)
{
  const cJSON *item = find(from, job->asked->key);
  if (!item)
    return bad_key(job, path, "is not");
  if (cJSON_IsNull(item))
    return bad_key(job, path, "is null");
  if (!cJSON_IsNumber(item) || !isfinite(item->valuedouble))
    return bad_key(job, path, "is no number");
  compare_add_value(set, item->valuedouble);
  return 0;
}

/* One pack, "packs", or "sets" of them. */
static int add_report(const compare_job *job, const char *path, const cJSON *root,
                      compare_set *set)
{
  const cJSON *packs = cJSON_GetObjectItemCaseSensitive(root, "packs"), *item = NULL;
  const cJSON *sets = cJSON_GetObjectItemCaseSensitive(root, "sets");
  int code = 0;
  if (!cJSON_IsArray(packs) && !cJSON_IsArray(sets))
    return add_number(job, path, root, set);
  cJSON_ArrayForEach(item, sets) if (!code) code = add_report(job, path, item, set);
  cJSON_ArrayForEach(item, packs) if (!code) code = add_number(job, path, item, set);
  return code;
}

static int parse_report(const compare_job *job, const char *option, const char *path,
                        const char *text, size_t length, compare_set *set)
{
  if (!job->asked->key)
    return program_fail(PROGRAM_BAD_INPUT, "--key is missing: which number of %s?", path);
  cJSON *root =
      cJSON_ParseWithLengthOpts(text, length + 1, NULL, 1); /* and its zero byte */
  if (!root)
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s is not JSON", option, path);
  const int code = add_report(job, path, root, set);
  cJSON_Delete(root);
  return code;
}

/* ---- packs ---- */

typedef struct named_file {
  const char *path;
  char format[16];
} named_file;

typedef struct memory {
  const char *text;
  size_t length, at;
} memory;

static packing_status read_memory(void *user, void *buffer, size_t capacity,
                                  size_t *count)
{
  memory *m = user;
  *count = m->length - m->at < capacity ? m->length - m->at : capacity;
  memcpy(buffer, m->text + m->at, *count);
  m->at += *count;
  return PACKING_OK;
}

static packing_status read_pack(packing_context *context, const char *format,
                                const char *text, size_t length,
                                packing_particles *particles)
{
  memory m = {text, length, 0};
  const packing_stream stream = {read_memory, NULL, &m};
  return packing_read_pack(context, NULL, format, &stream, particles, NULL);
}

static void add_radii(const packing_particles *particles, compare_set *set)
{
  packing_view view;
  packing_particles_view(particles, &view);
  for (size_t i = 0; i < view.count; i++)
    compare_add_value(set, pack_number(&view.r, i));
}

static int unknown_format(const char *option, const char *path)
{
  char known[256] = "";
  const char *name;
  for (size_t i = 0; (name = packing_read_format(i)) != NULL; i++)
    spec_list(known, sizeof known, name);
  return program_fail(PROGRAM_BAD_INPUT,
                      "%s: %s is no JSON, and has neither a known extension nor FORMAT: "
                      "before it; known are %s",
                      option, path, known);
}

static int parse_pack(compare_job *job, const char *option, const named_file *file,
                      const char *text, size_t length, compare_set *set)
{
  packing_particles *particles = NULL;
  if (!*file->format)
    return unknown_format(option, file->path);
  packing_status status = packing_particles_create(job->context, NULL, &particles);
  if (status == PACKING_OK)
    status = read_pack(job->context, file->format, text, length, particles);
  if (status == PACKING_OK)
    add_radii(particles, set);
  packing_particles_destroy(particles);
  return status == PACKING_OK ? 0 : failed(job, status, option, file->path);
}

/* [FORMAT:]FILE; the format is "" where neither prefix nor extension tells. */
static named_file name_file(const char *text)
{
  named_file file = {text, ""};
  const size_t length = strcspn(text, ":/");
  if (text[length] == ':' && length < sizeof file.format) {
    memcpy(file.format, text, length);
    if (packing_read_format_about(file.format)) {
      file.path = text + length + 1;
      return file;
    }
  }
  const char *format = packing_read_format_of(text);
  snprintf(file.format, sizeof file.format, "%s", format ? format : "");
  return file;
}

int compare_add_file(compare_job *job, const char *option, const char *name,
                     compare_set *set)
{
  const named_file file = name_file(name);
  char *text = NULL;
  size_t length = 0;
  int code = text_file_read(job->context, &job->input, option, file.path, &text, &length);
  const int is_report = !code && text[strspn(text, " \t\r\n")] == '{';
  const char *what = is_report ? "report" : "r";
  if (!code && set->what && strcmp(set->what, what) != 0)
    code = program_fail(PROGRAM_BAD_INPUT, "%s: %s: a set is of reports or of packs",
                        option, file.path);
  set->what = what;
  if (!code)
    code = is_report ? parse_report(job, option, file.path, text, length, set)
                     : parse_pack(job, option, &file, text, length, set);
  free(text);
  return code;
}
