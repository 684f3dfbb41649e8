/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A list of bonds that readers fill. 24 bytes a bond. */
#include "read_internal.h"

packing_status packing_bonds_create(packing_context *context, packing_bonds **bonds)
{
  PACKING_I_TRY(packing_i_check_given(context, "bonds", bonds));
  packing_bonds *b = packing_i_calloc(packing_i_allocator(context), 1, sizeof *b);
  if (b == NULL)
    return packing_i_nomem(context);
  b->context = packing_i_context_hold(context);
  *bonds = b;
  return PACKING_OK;
}

void packing_bonds_destroy(packing_bonds *bonds)
{
  if (bonds == NULL)
    return;
  packing_context *context = bonds->context;
  packing_i_free(packing_i_allocator(context), bonds->list);
  packing_i_free(packing_i_allocator(context), bonds);
  packing_context_destroy(context);
}

size_t packing_bonds_count(const packing_bonds *bonds)
{
  return bonds == NULL ? 0 : bonds->count;
}

const packing_bond *packing_bonds_data(const packing_bonds *bonds)
{
  return packing_bonds_count(bonds) == 0 ? NULL : bonds->list;
}

packing_status packing_i_bonds_add(packing_bonds *bonds, const packing_bond *bond)
{
  if (bonds->count == bonds->capacity) {
    const size_t capacity = bonds->capacity + bonds->capacity / 2 + 64;
    packing_bond *grown =
        packing_i_regrow(packing_i_allocator(bonds->context), bonds->list, bonds->count,
                         capacity, sizeof *grown);
    if (grown == NULL)
      return packing_i_nomem(bonds->context);
    bonds->list = grown;
    bonds->capacity = capacity;
  }
  bonds->list[bonds->count++] = *bond;
  return PACKING_OK;
}

packing_status packing_i_read_bond(packing_i_read *read, const packing_i_ids *ids,
                                   const int64_t ends[2], int32_t type)
{
  const packing_bond bond = {packing_i_ids_find(ids, ends[0]),
                             packing_i_ids_find(ids, ends[1]), type};
  if (bond.i == PACKING_NO_INDEX || bond.j == PACKING_NO_INDEX)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "a bond to particle %lld, which is not there",
                               (long long)ends[bond.i != PACKING_NO_INDEX]);
  if (bond.i == bond.j)
    return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                               "a bond of particle %lld to itself", (long long)ends[0]);
  read->info.bonds++;
  return read->def.bonds == NULL ? PACKING_OK
                                 : packing_i_bonds_add(read->def.bonds, &bond);
}
