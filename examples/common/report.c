/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"
#include "statistics.h"

static void check(const void *made)
{
  if (!made)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
}

static void add_raw(cJSON *object, const char *key, const char *raw)
{
  check(cJSON_AddRawToObject(object, key, raw));
}

void report_add_real(cJSON *object, const char *key, double value)
{
  char text[40] = "null";
  if (isfinite(value))
    snprintf(text, sizeof text, "%.17g", value);
  add_raw(object, key, text);
}

void report_add_u64(cJSON *object, const char *key, uint64_t value)
{
  char text[32];
  snprintf(text, sizeof text, "%llu", (unsigned long long)value);
  add_raw(object, key, text);
}

void report_add_count(cJSON *object, const char *key, size_t value)
{
  if (value == REPORT_NONE)
    check(cJSON_AddNullToObject(object, key));
  else
    report_add_u64(object, key, value);
}

void report_add_text(cJSON *object, const char *key, const char *value)
{
  check(value ? cJSON_AddStringToObject(object, key, value)
              : cJSON_AddNullToObject(object, key));
}

void report_add_flag(cJSON *object, const char *key, int value)
{
  check(cJSON_AddBoolToObject(object, key, value));
}

cJSON *report_add_list(cJSON *object, const char *key)
{
  cJSON *list = cJSON_AddArrayToObject(object, key);
  check(list);
  return list;
}

void report_append_text(cJSON *list, const char *value)
{
  cJSON *entry = cJSON_CreateString(value);
  check(entry);
  cJSON_AddItemToArray(list, entry);
}

void report_append_real(cJSON *list, double value)
{
  char text[40] = "null";
  if (isfinite(value))
    snprintf(text, sizeof text, "%.17g", value);
  cJSON *entry = cJSON_CreateRaw(text);
  check(entry);
  cJSON_AddItemToArray(list, entry);
}

void report_append_count(cJSON *list, size_t value)
{
  cJSON *entry = cJSON_CreateNumber((double)value);
  check(entry);
  cJSON_AddItemToArray(list, entry);
}

cJSON *report_new(void)
{
  cJSON *made = cJSON_CreateObject();
  check(made);
  return made;
}

cJSON *report_add_object(cJSON *object, const char *key)
{
  cJSON *made = cJSON_AddObjectToObject(object, key);
  check(made);
  return made;
}

void report_add_item(cJSON *object, const char *key, cJSON *item)
{
  if (!item)
    report_add_text(object, key, NULL);
  else
    check(cJSON_AddItemToObject(object, key, item) ? item : NULL);
}

void report_append_item(cJSON *list, cJSON *item)
{
  check(cJSON_AddItemToArray(list, item) ? item : NULL);
}

static void fill_reals(cJSON *list, const double *values, size_t count)
{
  for (size_t i = 0; i < count; i++)
    report_append_real(list, values[i]);
}

void report_add_reals(cJSON *object, const char *key, const double *values, size_t count)
{
  fill_reals(report_add_list(object, key), values, count);
}

static void add_tensor(cJSON *object, const report_fabric *fabric)
{
  cJSON *rows = report_add_list(object, "tensor");
  for (int i = 0; i < fabric->dim; i++) {
    cJSON *row = cJSON_CreateArray();
    check(row);
    report_append_item(rows, row);
    fill_reals(row, fabric->tensor[i], (size_t)fabric->dim);
  }
}

void report_add_fabric(cJSON *object, const char *key, const report_fabric *fabric)
{
  cJSON *made = report_add_object(object, key);
  const int known = fabric->known && fabric->count > 0;
  if (known)
    report_add_reals(made, "eigenvalues", fabric->eigenvalues, (size_t)fabric->dim);
  else
    report_add_text(made, "eigenvalues", NULL);
  report_add_real(made, "sd", known ? fabric->sd : (double)NAN);
  if (known)
    add_tensor(made, fabric);
  else
    report_add_text(made, "tensor", NULL);
  report_add_count(made, "contacts", fabric->known ? fabric->count : REPORT_NONE);
  report_add_real(made, "noise_floor", known ? fabric->noise_floor : (double)NAN);
}

static void add_input(cJSON *root, const input_files *files)
{
  if (!files || files->count == 0) {
    report_add_text(root, "input", NULL);
    return;
  }
  cJSON *list = report_add_list(root, "input");
  for (size_t i = 0; i < files->count; i++) {
    cJSON *entry = report_new();
    report_add_text(entry, "file", files->items[i].path);
    report_add_text(entry, "sha256", files->items[i].sha256);
    cJSON_AddItemToArray(list, entry);
  }
}

static void add_volumes(cJSON *root, const report *r)
{
  const double porosity = 1 - r->volume_fraction;
  report_add_real(root, "domain_volume", r->domain_volume);
  report_add_real(root, "solid_volume", r->solid_volume);
  report_add_real(root, "volume_fraction", r->volume_fraction);
  report_add_real(root, "porosity", porosity);
  report_add_real(root, "void_ratio", porosity / r->volume_fraction);
  report_add_real(root, "volume_fraction_inner", r->volume_fraction_inner);
}

static void add_histogram(cJSON *object, const report *r)
{
  size_t used = PACKING_COORDINATION_BINS;
  if (!r->histogram_known) {
    report_add_text(object, "histogram", NULL);
    return;
  }
  while (used && r->histogram[used - 1] == 0)
    used--;
  cJSON *list = report_add_list(object, "histogram");
  for (size_t k = 0; k < used; k++)
    report_append_count(list, r->histogram[k]);
}

static void add_structure(cJSON *root, const report *r)
{
  cJSON *coordination = report_add_object(root, "coordination");
  report_add_real(coordination, "mean", r->coordination_mean);
  report_add_real(coordination, "mean_no_rattlers", r->coordination_mean_no_rattlers);
  report_add_count(coordination, "rattlers", r->rattlers);
  add_histogram(coordination, r);
  report_add_real(coordination, "tolerance", r->coordination_tolerance);
  report_add_fabric(root, "fabric", &r->fabric);
}

static void add_audit(cJSON *root, const report *r)
{
  cJSON *audit = report_add_object(root, "audit");
  report_add_real(audit, "max_overlap", r->max_overlap);
  report_add_real(audit, "max_protrusion", r->max_protrusion);
  report_add_real(audit, "limit", r->audit_limit);
  if (r->audit_passed < 0)
    report_add_text(audit, "passed", NULL);
  else
    report_add_flag(audit, "passed", r->audit_passed);
}

static void add_psd(cJSON *root, const report *r)
{
  cJSON *psd = report_add_object(root, "psd");
  report_add_real(psd, "ks", r->ks);
  report_add_real(psd, "ks_limit", r->ks_limit);
  report_add_real(psd, "ks_mass", r->ks_mass);
  report_add_count(psd, "unplaced", r->unplaced);
  report_add_real(psd, "mean_relative_error", r->mean_relative_error);
}

static void add_time(cJSON *root, const report *r)
{
  cJSON *time = report_add_object(root, "time");
  report_add_real(time, "place", r->time_place);
  report_add_real(time, "settle", r->time_settle);
  report_add_real(time, "measure", r->time_measure);
  report_add_real(time, "total", r->time_total);
  report_add_real(root, "rate", (double)r->particles / r->time_place);
}

void report_init(report *r)
{
  memset(r, 0, sizeof *r);
  r->domain_volume = r->solid_volume = (double)NAN;
  r->volume_fraction = r->volume_fraction_inner = (double)NAN;
  r->coordination_mean = r->coordination_mean_no_rattlers = (double)NAN;
  r->coordination_tolerance = (double)NAN;
  r->rattlers = r->unplaced = REPORT_NONE;
  r->max_overlap = r->max_protrusion = r->audit_limit = (double)NAN;
  r->audit_passed = -1;
  r->ks = r->ks_limit = r->ks_mass = r->mean_relative_error = (double)NAN;
  r->time_place = r->time_settle = r->time_measure = r->time_total = (double)NAN;
}

/* What the packs of one run have in common. */
static cJSON *shared_object(const report *r, cJSON *options)
{
  cJSON *root = report_new();
  report_add_text(root, "program", r->program);
  report_add_text(root, "version", packing_version());
  report_add_text(root, "command", r->command);
  check(cJSON_AddItemToObject(root, "options", options) ? root : NULL);
  add_input(root, r->input);
  if (r->seedless)
    report_add_text(root, "seed", NULL);
  else
    report_add_u64(root, "seed", r->seed);
  report_add_count(root, "threads", (size_t)r->threads);
  report_add_count(root, "dim", (size_t)r->dim);
  return root;
}

cJSON *report_object(report *r)
{
  cJSON *root = shared_object(r, r->options);
  report_add_count(root, "particles", r->particles);
  add_volumes(root, r);
  add_structure(root, r);
  add_audit(root, r);
  add_psd(root, r);
  if (r->own_key)
    check(cJSON_AddItemToObject(root, r->own_key, r->own) ? root : NULL);
  add_time(root, r);
  r->options = r->own = NULL;
  return root;
}

cJSON *report_packs(const report *shared, cJSON *options, cJSON **packs, size_t count,
                    size_t sets)
{
  cJSON *root = shared_object(shared, options);
  statistics_add_packs(root, packs, count, sets);
  return root;
}

char *report_text(cJSON *object)
{
  char *text = NULL;
  char *json = cJSON_Print(object);
  check(json);
  if (asprintf(&text, "%s\n", json) < 0)
    check(NULL);
  cJSON_free(json);
  cJSON_Delete(object);
  return text;
}
