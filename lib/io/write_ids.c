/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ids and types as other programs take them: 31 bits, no id twice. Linear; memory only where ids
 * are not rising (two arrays of 4 bytes, sorted to find one used twice). */
#include "io_internal.h"

int64_t packing_i_id_from(const packing_view *view, size_t i, int64_t lowest)
{
  return view->id.data == NULL ? (int64_t)i + lowest : packing_i_view_id(view, i);
}

/* Sorts by eight bits at a time, four passes, so that the result ends in `keys`. */
static void sort_ids(uint32_t *keys, uint32_t *spare, size_t count)
{
  enum { BITS = 8, BUCKETS = 1 << BITS };
  for (unsigned shift = 0; shift < 32; shift += BITS) {
    size_t start[BUCKETS + 1] = {0};
    for (size_t i = 0; i < count; i++)
      start[(keys[i] >> shift) % BUCKETS + 1]++;
    for (size_t b = 1; b < BUCKETS; b++)
      start[b] += start[b - 1];
    for (size_t i = 0; i < count; i++)
      spare[start[(keys[i] >> shift) % BUCKETS]++] = keys[i];
    uint32_t *swapped = keys;
    keys = spare;
    spare = swapped;
  }
}

static packing_status check_unique(packing_context *context, const packing_view *v,
                                   int64_t lowest)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_status status = PACKING_OK;
  uint32_t *ids = packing_i_alloc(allocator, v->count, 2 * sizeof *ids);
  if (ids == NULL)
    return packing_i_nomem(context);
  for (size_t i = 0; i < v->count; i++)
    ids[i] = (uint32_t)packing_i_id_from(v, i, lowest);
  sort_ids(ids, ids + v->count, v->count);
  for (size_t i = 1; i < v->count && status == PACKING_OK; i++)
    if (ids[i] == ids[i - 1])
      status = packing_i_fail(context, PACKING_ERR_INVALID, "id", PACKING_NO_INDEX,
                              "%lu stands twice", (unsigned long)ids[i]);
  packing_i_free(allocator, ids);
  return status;
}

packing_status packing_i_check_ids(packing_context *context, const packing_view *v,
                                   int64_t lowest)
{
  int rising = 1;
  if (v->count > INT32_MAX)
    return packing_i_fail(context, PACKING_ERR_RANGE, "count", PACKING_NO_INDEX,
                          "%zu particles, ids are below 2^31", v->count);
  for (size_t i = 0; i < v->count; i++) {
    const int64_t id = packing_i_id_from(v, i, lowest);
    if (id < lowest || id > INT32_MAX)
      return packing_i_fail(context, PACKING_ERR_RANGE, "id", i,
                            "particle %zu: %lld is not in %lld .. 2^31 - 1", i,
                            (long long)id, (long long)lowest);
    rising &= i == 0 || id > packing_i_id_from(v, i - 1, lowest);
  }
  return rising ? PACKING_OK : check_unique(context, v, lowest);
}

packing_status packing_i_check_types(packing_context *context, const packing_view *v,
                                     int32_t *largest)
{
  *largest = 1;
  for (size_t i = 0; i < v->count; i++) {
    const int32_t type = packing_i_view_int(&v->type, i, 1);
    if (type < 1)
      return packing_i_fail(context, PACKING_ERR_RANGE, "type", i,
                            "particle %zu: %ld is below 1", i, (long)type);
    *largest = type > *largest ? type : *largest;
  }
  return PACKING_OK;
}
