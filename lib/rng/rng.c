/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public stream: a packing_i_stream with an owner. */
#include "rng_internal.h"
#include "base_internal.h"
#include <gsl/gsl_randist.h>
#include <packing/rng.h>

struct packing_rng {
  packing_i_stream stream;
  packing_context *context;
};

packing_status packing_rng_create(packing_context *context, uint64_t seed,
                                  uint32_t purpose, uint64_t index, packing_rng **rng)
{
  if (rng == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "rng", PACKING_NO_INDEX, "NULL");
  packing_rng *r = packing_i_alloc(packing_i_allocator(context), 1, sizeof *r);
  if (r == NULL)
    return packing_i_nomem(context);
  packing_i_stream_open(&r->stream, seed, 0, purpose, index);
  r->context = packing_i_context_hold(context);
  *rng = r;
  return PACKING_OK;
}

void packing_rng_destroy(packing_rng *rng)
{
  if (rng == NULL)
    return;
  packing_context *context = rng->context;
  packing_i_free(packing_i_allocator(context), rng);
  packing_context_destroy(context);
}

packing_i_stream *packing_i_rng_stream(packing_rng *rng)
{
  return &rng->stream;
}

uint64_t packing_rng_bits(packing_rng *rng)
{
  return packing_i_stream_bits(&rng->stream);
}

double packing_rng_uniform(packing_rng *rng)
{
  return packing_i_stream_uniform(&rng->stream);
}

double packing_rng_uniform_open(packing_rng *rng)
{
  return packing_i_stream_uniform_open(&rng->stream);
}

uint64_t packing_rng_below(packing_rng *rng, uint64_t bound)
{
  return bound == 0 ? 0 : packing_i_stream_below(&rng->stream, bound);
}

double packing_rng_normal(packing_rng *rng)
{
  const gsl_rng gsl = packing_i_stream_gsl(&rng->stream);
  return gsl_ran_gaussian_ziggurat(&gsl, 1);
}
