/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Particles by id: eight bits of all ids are sorted at a time, bits that are the same in all
 * ids not at all, so that time is linear and rising ids cost a pass. */
#include "read_internal.h"
#include <string.h>

/* Unsigned, in the order of the signed. */
static uint64_t key(const packing_i_id_pair *pair)
{
  return (uint64_t)pair->id ^ UINT64_C(1) << 63;
}

static void sort_byte(const packing_i_id_pair *from, packing_i_id_pair *to, size_t count,
                      unsigned shift)
{
  size_t start[257] = {0};
  for (size_t i = 0; i < count; i++)
    start[(key(&from[i]) >> shift & 255) + 1]++;
  for (size_t b = 1; b < 257; b++)
    start[b] += start[b - 1];
  for (size_t i = 0; i < count; i++)
    to[start[key(&from[i]) >> shift & 255]++] = from[i];
}

/* Sorts, with as much room again; the result is in either. */
static packing_i_id_pair *sort(packing_i_id_pair *pairs, packing_i_id_pair *spare,
                               size_t count)
{
  uint64_t differ = 0;
  for (size_t i = 1; i < count; i++)
    differ |= key(&pairs[i]) ^ key(&pairs[0]);
  for (unsigned shift = 0; shift < 64; shift += 8)
    if ((differ >> shift & 255) != 0) {
      sort_byte(pairs, spare, count, shift);
      packing_i_id_pair *swapped = pairs;
      pairs = spare;
      spare = swapped;
    }
  return pairs;
}

static packing_status sort_pairs(packing_i_read *read, packing_i_ids *ids)
{
  const packing_allocator *allocator = packing_i_allocator(read->context);
  packing_i_id_pair *spare = packing_i_alloc(allocator, ids->count, sizeof *ids->pairs);
  if (spare == NULL)
    return packing_i_nomem(read->context);
  packing_i_id_pair *sorted = sort(ids->pairs, spare, ids->count);
  packing_i_free(allocator, sorted == spare ? ids->pairs : spare);
  ids->pairs = sorted;
  return PACKING_OK;
}

static packing_status check_unique(packing_i_read *read, const packing_i_ids *ids)
{
  for (size_t i = 1; i < ids->count; i++)
    if (ids->pairs[i].id == ids->pairs[i - 1].id)
      return packing_i_fail(read->context, PACKING_ERR_FORMAT, "id", ids->pairs[i].index,
                            "%lld stands twice, in rows %zu and %zu of the particles",
                            (long long)ids->pairs[i].id, ids->pairs[i - 1].index + 1,
                            ids->pairs[i].index + 1);
  return PACKING_OK;
}

packing_status packing_i_ids_begin(packing_i_read *read, packing_i_ids *ids)
{
  const packing_particles *p = read->particles;
  const int64_t *id = p->column[PACKING_FIELD_ID];
  ids->pairs = NULL;
  ids->count = p->count;
  if (!(packing_particles_columns(p) & PACKING_COLUMN_ID))
    return packing_i_fail(read->context, PACKING_ERR_FORMAT, "sort", PACKING_NO_INDEX,
                          "the file has no ids");
  ids->pairs =
      packing_i_alloc(packing_i_allocator(read->context), ids->count, sizeof *ids->pairs);
  if (ids->pairs == NULL)
    return packing_i_nomem(read->context);
  int rising = 1;
  for (size_t i = 0; i < ids->count; i++) {
    ids->pairs[i].id = id[i];
    ids->pairs[i].index = i;
    rising &= i == 0 || id[i] > id[i - 1];
  }
  packing_status status = rising ? PACKING_OK : sort_pairs(read, ids);
  if (status == PACKING_OK && !rising)
    status = check_unique(read, ids);
  if (status != PACKING_OK)
    packing_i_ids_end(read, ids);
  return status;
}

void packing_i_ids_end(packing_i_read *read, packing_i_ids *ids)
{
  packing_i_free(packing_i_allocator(read->context), ids->pairs);
  ids->pairs = NULL;
}

size_t packing_i_ids_find(const packing_i_ids *ids, int64_t id)
{
  size_t lo = 0, hi = ids->count;
  while (lo < hi) {
    const size_t middle = lo + (hi - lo) / 2;
    if (ids->pairs[middle].id < id)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo < ids->count && ids->pairs[lo].id == id ? ids->pairs[lo].index
                                                    : PACKING_NO_INDEX;
}

/* Entry i of each column becomes that of particle pairs[i].index. */
static void permute(packing_particles *p, const packing_i_ids *ids, unsigned char *spare)
{
  for (int field = 0; field < PACKING_FIELD_END; field++) {
    const size_t size = packing_i_fields[field].size;
    unsigned char *values = p->column[field];
    if (values == NULL)
      continue;
    for (size_t i = 0; i < ids->count; i++)
      memcpy(spare + i * size, values + ids->pairs[i].index * size, size);
    memcpy(values, spare, ids->count * size);
  }
}

/* New indices for the ends of bonds. */
static void renumber(packing_bonds *bonds, const packing_i_ids *ids, size_t *rank)
{
  for (size_t i = 0; i < ids->count; i++)
    rank[ids->pairs[i].index] = i;
  for (size_t b = 0; b < bonds->count; b++) {
    bonds->list[b].i = rank[bonds->list[b].i];
    bonds->list[b].j = rank[bonds->list[b].j];
  }
}

packing_status packing_i_read_sort(packing_i_read *read)
{
  const packing_allocator *allocator = packing_i_allocator(read->context);
  packing_i_ids ids;
  PACKING_I_TRY(packing_i_ids_begin(read, &ids));
  /* room for the widest column, or for a rank each */
  void *spare = packing_i_alloc(allocator, ids.count, sizeof(uint64_t));
  if (spare != NULL && ids.count > 0) {
    permute(read->particles, &ids, spare);
    if (read->def.bonds != NULL)
      renumber(read->def.bonds, &ids, spare);
  }
  packing_i_free(allocator, spare);
  packing_i_ids_end(read, &ids);
  return spare == NULL ? packing_i_nomem(read->context) : PACKING_OK;
}
