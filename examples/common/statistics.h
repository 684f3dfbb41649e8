/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_STATISTICS_H
#define EXAMPLES_STATISTICS_H

/* Mean, standard deviation and coefficient of variation over the reports of several packs. */

#include <cjson/cJSON.h>
#include <stddef.h>

/* Adds "packs" or "sets" with their statistics, as report_packs() says; the `count` objects
 * become part of `root`. */
void statistics_add_packs(cJSON *root, cJSON **packs, size_t count, size_t sets);

#endif
