/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fuzz_psd.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  packing_context *context = fuzz_context();
  packing_psd *psd = NULL;
  fuzz_input in;
  const packing_stream stream = fuzz_stream(&in, data, size);
  const packing_status status = packing_read_curve(context, NULL, &stream, &psd);
  fuzz_check_result(context, status, psd);
  packing_context_destroy(context);
  return 0;
}
