/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "statistics.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "moments.h"
#include "program.h"
#include "report.h"

/* Where the three go. */
typedef struct three {
  cJSON *mean, *sd, *cv;
} three;

/* What is the same for all packs of a run. */
static int is_shared(const char *key)
{
  static const char *const keys[] = {"program", "version", "command", "options",
                                     "input",   "seed",    "threads", "dim"};
  for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
    if (strcmp(keys[i], key) == 0)
      return 1;
  return 0;
}

static int is_number_or_null(const cJSON *item)
{
  return cJSON_IsRaw(item) || cJSON_IsNumber(item) || cJSON_IsNull(item);
}

/* Numbers of full precision stand in reports as raw text, and so may "null". */
static double number_of(const cJSON *item)
{
  if (cJSON_IsNumber(item))
    return item->valuedouble;
  if (!cJSON_IsRaw(item) || strcmp(item->valuestring, "null") == 0)
    return (double)NAN;
  return strtod(item->valuestring, NULL);
}

static void add_number(const three *to, const char *key, cJSON *const *items,
                       size_t count)
{
  double *values = program_take(count, sizeof(double));
  for (size_t i = 0; i < count; i++)
    values[i] = number_of(cJSON_GetObjectItemCaseSensitive(items[i], key));
  const moments found = moments_of(values, count);
  free(values);
  report_add_real(to->mean, key, found.mean);
  report_add_real(to->sd, key, found.sd);
  report_add_real(to->cv, key, found.sd / found.mean);
}

static void add_numbers(const three *to, cJSON *const *items, size_t count);

static void add_group(const three *to, const char *key, cJSON *const *items, size_t count)
{
  cJSON **inner = program_take(count, sizeof(cJSON *));
  for (size_t i = 0; i < count; i++)
    inner[i] = cJSON_GetObjectItemCaseSensitive(items[i], key);
  const three below = {report_add_object(to->mean, key), report_add_object(to->sd, key),
                       report_add_object(to->cv, key)};
  add_numbers(&below, inner, count);
  free(inner);
}

/* All objects have the keys of the first, in its order. */
static void add_numbers(const three *to, cJSON *const *items, size_t count)
{
  for (const cJSON *item = items[0]->child; item; item = item->next)
    if (is_shared(item->string))
      continue;
    else if (cJSON_IsObject(item))
      add_group(to, item->string, items, count);
    else if (is_number_or_null(item))
      add_number(to, item->string, items, count);
}

static void add_three(cJSON *to, cJSON *const *items, size_t count)
{
  const three all = {report_add_object(to, "mean"), report_add_object(to, "sd"),
                     report_add_object(to, "cv")};
  add_numbers(&all, items, count);
}

static void add_set(cJSON *to, cJSON **packs, size_t count)
{
  cJSON *list = report_add_list(to, "packs");
  for (size_t i = 0; i < count; i++)
    cJSON_AddItemToArray(list, packs[i]);
  add_three(to, packs, count);
}

void statistics_add_packs(cJSON *root, cJSON **packs, size_t count, size_t sets)
{
  const size_t each = count / sets;
  if (sets == 1) {
    add_set(root, packs, count);
    return;
  }
  cJSON **means = program_take(sets, sizeof(cJSON *));
  cJSON *list = report_add_list(root, "sets");
  for (size_t s = 0; s < sets; s++) {
    cJSON *set = report_new();
    cJSON_AddItemToArray(list, set);
    add_set(set, packs + s * each, each);
    means[s] = cJSON_GetObjectItemCaseSensitive(set, "mean");
  }
  add_three(root, packs, count);
  add_three(report_add_object(root, "set_means"), means, sets);
  free(means);
}
