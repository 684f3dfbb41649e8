/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every format that packs are written in, with every allocation failing in turn. */
#include "test.h"

static const double x[] = {0.25, 0.5}, r[] = {0.125, 0.0625};
static const int64_t id[] = {2, 1}; /* falling: sorted to find one used twice */
static const packing_bond bond[] = {{0, 1, 1}};

static packing_domain *domain;
static const char *format;
static int compression;

static packing_status scenario(packing_context *context, uint64_t *hash)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_write_def def;
  packing_view view;
  packing_view_init_arrays(&view, 2, x, x, x, r);
  view.id.data = id;
  view.id.stride = sizeof id[0];
  packing_write_def_init(&def);
  def.domain = domain;
  def.bonds = bond;
  def.bond_count = 1;
  def.compression = compression;
  packing_status status = packing_write_pack(context, &def, format, &view, &stream);
  if (status == PACKING_ERR_UNSUPPORTED) /* no zlib */
    status = PACKING_OK;
  if (status == PACKING_ERR_NOMEM)
    assert_int_equal(buffer.size, 0);
  *hash = test_hash(TEST_HASH_START, buffer.data, buffer.size);
  test_buffer_free(&buffer);
  return status;
}

static void formats(void **state)
{
  (void)state;
  domain = test_box(1, 1, 1, 0);
  for (size_t f = 0; packing_write_format_at(f) != NULL; f++) {
    format = packing_write_format_at(f)->name;
    const int sorts = strcmp(format, "lammps") == 0 || strcmp(format, "geo") == 0;
    assert_true(test_every_allocation(scenario) >= (sorts ? 2 : 1));
  }
  format = "vtu";
  compression = 1;
  test_every_allocation(scenario);
  packing_domain_destroy(domain);
}

static packing_status collection(packing_context *context, uint64_t *hash)
{
  static const packing_pvd_entry entries[] = {{"a.vtu", 0, 0}};
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_write_pvd(context, entries, 1, &stream);
  *hash = test_hash(TEST_HASH_START, buffer.data, buffer.size);
  test_buffer_free(&buffer);
  return status;
}

static void collections(void **state)
{
  (void)state;
  assert_int_equal(test_every_allocation(collection), 1);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(formats),
      cmocka_unit_test(collections),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
