/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law of the user's: a function over batches, called as the built-in ones are. What it costs
 * and whether it gives the same bytes everywhere is the user's affair. */
#include "dem_internal.h"

static packing_law_function kernel(const packing_law *law, packing_isa isa)
{
  (void)isa;
  return law->as.custom.evaluate;
}

static void release(packing_law *law)
{
  if (law->as.custom.release != NULL)
    law->as.custom.release(law->user);
}

static const packing_i_law_ops custom_ops = {
    .name = "custom",
    .reference = "the user's function",
    .kernel = kernel,
    .release = release,
};

void packing_law_custom_def_fill(packing_law_custom_def *def, size_t size)
{
  packing_law_custom_def defaults = {.reach = 0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_history(packing_context *context,
                                    const packing_law_custom_def *d)
{
  if (d->history_size > PACKING_I_HISTORY)
    return packing_i_fail(context, PACKING_ERR_RANGE, "history_size", PACKING_NO_INDEX,
                          "%zu must be at most %d", d->history_size, PACKING_I_HISTORY);
  if (d->history_size > 0 && d->reach > 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "history_size", PACKING_NO_INDEX,
                          "only laws of contacts (reach 0) have a history");
  if (d->history_even >> d->history_size != 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "history_even", PACKING_NO_INDEX,
                          "%#x names more than the %zu doubles of history",
                          d->history_even, d->history_size);
  return PACKING_OK;
}

packing_status packing_law_create_custom(packing_context *context,
                                         const packing_law_custom_def *def,
                                         packing_law **law)
{
  packing_law_custom_def d;
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  PACKING_I_TRY(packing_i_check_given(context, "law", law));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_law_custom, release, def, &d));
  if (d.evaluate == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "evaluate", PACKING_NO_INDEX,
                          "NULL");
  PACKING_I_TRY(packing_i_check_not_negative(context, "reach", d.reach));
  PACKING_I_TRY(check_history(context, &d));
  packing_law *made;
  PACKING_I_TRY(packing_i_law_create(context, &custom_ops, &made));
  made->as.custom = d;
  made->user = d.user;
  made->reach = d.reach;
  made->history_size = d.history_size;
  made->history_even = d.history_even;
  *law = made;
  return PACKING_OK;
}
