/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_MEASURES_H
#define EXAMPLES_MEASURES_H

/* What every program measures of its pack at the end. */

#include "report.h"

/* The pack and what is known of it. */
typedef struct measured {
  packing_context *context;
  packing_domain *domain; /* NULL: no container, then no volume fraction either */
  packing_psd *psd;       /* NULL: no sizes asked for */
  const packing_view *view;
  int dim;
  double limit;     /* of the audit */
  double tolerance; /* of contacts, relative to r_i + r_j; 0: the library's */
} measured;

/* Makes the audit and all measures of the report. `contacts` (may be NULL) takes the contact
 * network, NULL of no particles. Returns 0 or an exit code. */
int measures_fill(report *r, const measured *m, packing_contacts **contacts);

/* Keeps what a report tells of a fabric. */
void measures_keep_fabric(report_fabric *to, const packing_fabric_report *found);

/* Whether the audit passed; says so if not. Returns PROGRAM_DONE or PROGRAM_SHORT. */
int measures_judge(const report *r);

#endif
