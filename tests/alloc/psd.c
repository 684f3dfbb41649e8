/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of every distribution, of its dense limit and of a stream fails once. */
#include "psds.h"

static int kind_now;

static packing_status make_and_ask(packing_context *context, uint64_t *hash)
{
  packing_psd *psd = NULL;
  packing_rng *rng = NULL;
  double limit = 0;
  packing_status status = test_psd_create(context, kind_now, 1, PACKING_BY_MASS, 3, &psd);
  if (status != PACKING_OK)
    goto out;
  status = packing_rng_create(context, 1, PACKING_PURPOSE_SIZE, 0, &rng);
  if (status != PACKING_OK)
    goto out;
  status = packing_psd_dense_limit(context, psd, &limit);
  if (status != PACKING_OK)
    goto out;
  *hash = test_hash(TEST_HASH_START, &limit, sizeof limit);
  for (int i = 0; i < 100; i++) {
    const double r = packing_psd_draw(psd, rng, NULL);
    *hash = test_hash(*hash, &r, sizeof r);
  }
out:
  packing_rng_destroy(rng);
  packing_psd_destroy(psd);
  return status;
}

static void every_allocation_may_fail(void **state)
{
  (void)state;
  for (kind_now = 0; kind_now < TEST_PSD_KINDS; kind_now++) {
    const size_t failures = test_every_allocation(make_and_ask);
    assert_true(failures >= 3); /* the distribution, the stream, the dense limit */
    if (kind_now == TEST_PSD_MIXTURE)
      assert_true(failures > 15);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
