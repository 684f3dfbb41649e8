/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bonds as writers need them: checked, their types, and the groups that they tie together
 * (union-find with path halving, the lower index on top; R. E. Tarjan, J. van Leeuwen, "Worst-case
 * analysis of set union algorithms", JACM 31, 1984). */
#include "io_internal.h"

static packing_status check_bond(packing_context *context, size_t count,
                                 const packing_bond *b, size_t k)
{
  if (b->i >= count || b->j >= count)
    return packing_i_fail(context, PACKING_ERR_INVALID, "bonds", k,
                          "bond %zu: particle %zu of %zu", k, b->i >= count ? b->i : b->j,
                          count);
  if (b->i == b->j)
    return packing_i_fail(context, PACKING_ERR_INVALID, "bonds", k,
                          "bond %zu: particle %zu with itself", k, b->i);
  return PACKING_OK;
}

packing_status packing_i_check_bonds(packing_context *context, size_t count,
                                     const packing_bond *bonds, size_t bond_count)
{
  if (bond_count > 0)
    PACKING_I_TRY(packing_i_check_given(context, "bonds", bonds));
  if (bond_count > INT32_MAX)
    return packing_i_fail(context, PACKING_ERR_RANGE, "bond_count", PACKING_NO_INDEX,
                          "%zu, at most 2^31 - 1", bond_count);
  for (size_t k = 0; k < bond_count; k++)
    PACKING_I_TRY(check_bond(context, count, &bonds[k], k));
  return PACKING_OK;
}

packing_status packing_i_bond_types(packing_context *context, const packing_bond *bonds,
                                    size_t bond_count, int32_t *largest)
{
  *largest = 1;
  for (size_t k = 0; k < bond_count; k++) {
    if (bonds[k].type < 1)
      return packing_i_fail(context, PACKING_ERR_RANGE, "bonds", k,
                            "bond %zu: type %ld is below 1", k, (long)bonds[k].type);
    *largest = bonds[k].type > *largest ? bonds[k].type : *largest;
  }
  return PACKING_OK;
}

static uint32_t top_of(uint32_t *parent, size_t i)
{
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return (uint32_t)i;
}

/* Parents become numbers; a parent has a lower index than its children, so it is numbered when
 * they are met, and those not met yet still hold an index. */
static void number_groups(uint32_t *parent, const unsigned char *tied, size_t count)
{
  uint32_t groups = 0;
  for (size_t i = 0; i < count; i++)
    if (parent[i] == i)
      parent[i] = tied[i] ? ++groups : 0;
    else
      parent[i] = parent[parent[i]];
}

packing_status packing_i_bond_groups(packing_context *context, size_t count,
                                     const packing_bond *bonds, size_t bond_count,
                                     uint32_t **groups)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  uint32_t *parent = packing_i_alloc(allocator, count, sizeof *parent);
  unsigned char *tied = packing_i_calloc(allocator, count, 1);
  packing_status status = PACKING_OK;
  if (parent == NULL || tied == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  for (size_t i = 0; i < count; i++)
    parent[i] = (uint32_t)i;
  for (size_t k = 0; k < bond_count; k++) {
    const uint32_t a = top_of(parent, bonds[k].i), b = top_of(parent, bonds[k].j);
    tied[bonds[k].i] = tied[bonds[k].j] = 1;
    parent[a > b ? a : b] = a < b ? a : b;
  }
  number_groups(parent, tied, count);
  *groups = parent;
  parent = NULL;
out:
  packing_i_free(allocator, tied);
  packing_i_free(allocator, parent);
  return status;
}
