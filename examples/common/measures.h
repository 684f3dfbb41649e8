/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef EXAMPLES_MEASURES_H
#define EXAMPLES_MEASURES_H

/* What every program measures of its pack at the end. */

#include "report.h"

/* Makes the audit and all measures of the report. `limit` is the
 * audit's. Returns 0 or an exit code. */
int measures_fill(report *r, packing_context *context, packing_domain *domain,
                  packing_psd *psd, const packing_view *view, double limit);

/* Whether the audit passed; says so if not. Returns PROGRAM_DONE or PROGRAM_SHORT. */
int measures_judge(const report *r);

#endif
