/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Structs that grow: an older caller's is shorter, a newer caller's is longer. */
#include "base_internal.h"
#include <string.h>

/* No struct will ever be larger: what stands there is no size. */
enum { LARGEST_STRUCT = 65536 };

void packing_i_def_fill(void *def, size_t size, void *defaults, size_t known)
{
  const size_t common = size < known ? size : known;
  if (def == NULL || size < sizeof(size_t))
    return;
  memset(def, 0, size);
  memcpy(defaults, &size, sizeof size);
  memcpy(def, defaults, common);
}

packing_status packing_i_def_read(packing_context *context, const void *def, void *copy,
                                  size_t known, size_t first)
{
  if (def == NULL)
    return PACKING_OK;
  size_t size;
  memcpy(&size, def, sizeof size);
  if (size < first || size > LARGEST_STRUCT)
    return packing_i_fail(
        context, PACKING_ERR_ABI, "struct_size", PACKING_NO_INDEX,
        "%zu is not a size this struct ever had: call its _def_init first", size);
  const unsigned char *bytes = def;
  for (size_t i = known; i < size; i++)
    if (bytes[i] != 0)
      return packing_i_fail(
          context, PACKING_ERR_ABI, "struct_size", PACKING_NO_INDEX,
          "the caller is newer than this library and sets options that it "
          "does not know");
  memcpy(copy, def, size < known ? size : known);
  return PACKING_OK;
}

packing_status packing_i_report_check(packing_context *context, const void *out)
{
  size_t size;
  if (out == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "report", PACKING_NO_INDEX,
                          "NULL");
  memcpy(&size, out, sizeof size);
  if (size < sizeof size || size > LARGEST_STRUCT)
    return packing_i_fail(context, PACKING_ERR_ABI, "struct_size", PACKING_NO_INDEX,
                          "the report is not initialised: call its _init first");
  return PACKING_OK;
}

packing_status packing_i_report_write(packing_context *context, void *out,
                                      const void *report, size_t known)
{
  size_t size;
  PACKING_I_TRY(packing_i_report_check(context, out));
  memcpy(&size, out, sizeof size);
  memcpy((unsigned char *)out + sizeof size, (const unsigned char *)report + sizeof size,
         (size < known ? size : known) - sizeof size);
  return PACKING_OK;
}
