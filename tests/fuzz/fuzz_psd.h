/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_FUZZ_PSD_H
#define PACKING_FUZZ_PSD_H

/* The readers of size distributions: what they take must be a law, what they refuse must
 * leave the result alone and say why. */

#include "fuzz.h"
#include <math.h>

static inline void fuzz_check_law(packing_psd *psd)
{
  const double lo = packing_psd_min_r(psd), hi = packing_psd_max_r(psd);
  fuzz_require(lo > 0 && hi >= lo && isfinite(hi));
  for (int by = 0; by < 2; by++) {
    double before = lo;
    for (int i = 0; i <= 8; i++) {
      const double r = packing_psd_quantile(psd, (packing_by)by, i / 8.0);
      fuzz_require(r >= before && r <= hi);
      before = r;
    }
    fuzz_require(packing_psd_cdf(psd, (packing_by)by, hi) == 1);
  }
}

static inline void fuzz_check_result(packing_context *context, packing_status status,
                                     packing_psd *psd)
{
  if (status == PACKING_OK) {
    fuzz_check_law(psd);
    packing_psd_destroy(psd);
    return;
  }
  fuzz_require(status == PACKING_ERR_FORMAT || status == PACKING_ERR_RANGE);
  fuzz_require(psd == NULL);
  fuzz_require(packing_context_message(context)[0] != '\0');
  fuzz_require(strchr(packing_context_message(context), '\n') == NULL);
}

#endif
