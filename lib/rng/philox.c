/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Our generator as a gsl_rng_type, so that GSL's samplers draw from our streams. The state is
 * always embedded in something of ours: gsl_rng_alloc() would call malloc and may abort. */
#include "rng_internal.h"

static void set(void *state, unsigned long int seed)
{
  packing_i_stream_open(state, seed, 0, 0, 0);
}

static unsigned long int get(void *state)
{
  return (unsigned long int)(packing_i_stream_bits(state) >> 32);
}

static double get_double(void *state)
{
  return packing_i_stream_uniform(state);
}

const gsl_rng_type packing_i_gsl_philox = {
    "philox4x32-10", 0xffffffffUL, 0, sizeof(packing_i_stream), set, get, get_double};
