/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every allocation of polygons, combinations and the search for the innermost point fails once. */
#include "solids.h"

static packing_status finish(packing_status status, packing_domain *domain,
                             uint64_t *hash)
{
  if (status == PACKING_OK) {
    const double v = packing_domain_volume(domain);
    *hash = test_hash(TEST_HASH_START, &v, sizeof v);
  }
  packing_domain_destroy(domain);
  return status;
}

static packing_status polygon(packing_context *context, uint64_t *hash)
{
  uint64_t seed = 1;
  const test_rings r = rings_many(&seed);
  packing_domain *domain = NULL;
  const packing_status status = rings_create(context, &r, &domain);
  return finish(status, domain, hash);
}

static packing_status polygon_inset(packing_context *context, uint64_t *hash)
{
  const test_rings r = rings_l();
  packing_domain *domain = NULL, *in = NULL;
  packing_status status = rings_create(context, &r, &domain);
  if (status == PACKING_OK)
    status = packing_domain_create_inset(context, domain, 0.25, &in);
  packing_domain_destroy(domain);
  return finish(status, in, hash);
}

static packing_status reader(packing_context *context, uint64_t *hash)
{
  packing_domain *domain = NULL;
  test_buffer buffer = {0};
  test_buffer_text(&buffer,
                   "x,y,ring\n0,0,1\n4,0,1\n4,4,1\n0,4,1\n1,1,2\n2,1,2\n2,2,2\n");
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_read_polygon(context, NULL, &stream, &domain);
  test_buffer_free(&buffer);
  return finish(status, domain, hash);
}

static packing_status combination(packing_context *context, uint64_t *hash)
{
  packing_domain *a = solid_box(2, 1, 1, 0, 0, 0), *b = solid_box(1, 2, 1, 0, 0, 0);
  packing_domain *domain = NULL, *in = NULL;
  packing_status status = solid_try(context, PACKING_UNION, a, b, &domain);
  if (status == PACKING_OK)
    status = packing_domain_create_inset(context, domain, 0.375, &in);
  packing_domain_destroy(a);
  packing_domain_destroy(b);
  packing_domain_destroy(domain);
  return finish(status, in, hash);
}

static packing_status innermost(packing_context *context, uint64_t *hash)
{
  uint64_t seed = 1;
  const test_rings r = rings_many(&seed);
  packing_domain *domain = rings_domain(&r);
  packing_vec3 p;
  const packing_status status = packing_domain_innermost(context, domain, 1e-5, &p, NULL);
  if (status == PACKING_OK)
    *hash = test_hash(TEST_HASH_START, &p, sizeof p);
  packing_domain_destroy(domain);
  return status;
}

static void every_allocation_fails_once(void **state)
{
  (void)state;
  assert_true(test_every_allocation(polygon) >= 6);
  assert_true(test_every_allocation(polygon_inset) >= 7);
  assert_true(test_every_allocation(reader) >= 10);
  assert_true(test_every_allocation(combination) >= 3);
  assert_true(test_every_allocation(innermost) >= 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_allocation_fails_once)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
