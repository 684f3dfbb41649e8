/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every refusal of packing_front_create() and its companions, and the names of its values. */
#include "cluster.h"
#include "front_scenes.h"

typedef struct bench {
  packing_context *context;
  packing_domain *domain;
  packing_psd *psd;
  packing_particles *store;
  packing_front_def def;
} bench;

static bench bench_make(void)
{
  bench b = {test_context(1, PACKING_ISA_AUTO), test_box(9, 9, 9, 0),
             test_uniform(0.7, 1.3), test_store(3), front_paper()};
  return b;
}

static void bench_end(bench *b)
{
  packing_particles_destroy(b->store);
  packing_psd_destroy(b->psd);
  packing_domain_destroy(b->domain);
  packing_context_destroy(b->context);
}

/* The def is refused, and nothing is written. */
static void refused(bench *b, packing_psd *psd, packing_status status, const char *field)
{
  packing_placer *placer = (packing_placer *)(void *)b;
  assert_fails(
      b->context,
      packing_front_create(b->context, &b->def, b->domain, psd, b->store, &placer),
      status, field);
  assert_ptr_equal(placer, b);
  assert_int_equal(packing_particles_count(b->store), 0);
  assert_status(packing_front_create(NULL, &b->def, b->domain, psd, b->store, &placer),
                status);
  b->def = front_paper();
}

static void values_out_of_range(void **state)
{
  (void)state;
  bench b = bench_make();
#define REFUSE(field, value, status, name)                                               \
  (b.def.field = (value), refused(&b, b.psd, (status), (name)))
  REFUSE(mode, (packing_front_mode)3, PACKING_ERR_RANGE, "mode");
  REFUSE(direction, (packing_front_direction)2, PACKING_ERR_RANGE, "direction");
  REFUSE(select_particle, (packing_front_select)3, PACKING_ERR_RANGE, "select_particle");
  REFUSE(select_neighbours, (packing_front_select)-1, PACKING_ERR_RANGE,
         "select_neighbours");
  REFUSE(volume_fraction, NAN, PACKING_ERR_INVALID, "volume_fraction");
  REFUSE(volume_fraction, INFINITY, PACKING_ERR_INVALID, "volume_fraction");
  REFUSE(volume_fraction, -0.1, PACKING_ERR_RANGE, "volume_fraction");
  REFUSE(volume_fraction, 1.0, PACKING_ERR_RANGE, "volume_fraction");
  REFUSE(stock, 64, PACKING_ERR_RANGE, "stock");
  bench_end(&b);
}

static void options_of_another_mode(void **state)
{
  (void)state;
  bench b = bench_make();
  packing_shape *shape = test_cluster(0.6, 1);
  for (int mode = PACKING_FRONT_DENSE; mode <= PACKING_FRONT_FAST; mode++) {
#define REFUSE_MODE(field, value)                                                        \
  (b.def.mode = (packing_front_mode)mode,                                                \
   REFUSE(field, (value), PACKING_ERR_RANGE, #field))
    REFUSE_MODE(select_particle, PACKING_FRONT_FIFO);
    REFUSE_MODE(select_neighbours, PACKING_FRONT_LIFO);
    REFUSE_MODE(contact, packing_contact_direct());
    REFUSE_MODE(shape, shape);
    REFUSE_MODE(stock, 4097);
  }
  packing_shape_destroy(shape);
  bench_end(&b);
}

static void contacts_and_shapes(void **state)
{
  (void)state;
  bench b = bench_make();
  packing_shape *shape = test_cluster(0.6, 1);
  const packing_contact_method hollow = {.name = "hollow"};
  REFUSE(contact, &hollow, PACKING_ERR_INVALID, "contact");
  REFUSE(shape, shape, PACKING_ERR_UNSUPPORTED, "contact");
  b.def.contact = packing_contact_wrappers();
  REFUSE(shape, shape, PACKING_ERR_UNSUPPORTED, "contact");
  packing_shape_destroy(shape);
  bench_end(&b);
}

static void lists(void **state)
{
  (void)state;
  bench b = bench_make();
  const double bad[] = {0, -1, NAN, INFINITY};
  const packing_front_region region = {b.domain, b.psd};
  packing_front_class classes[2] = {{1, 4}, {0.5, 3}};
#define LIST (b.def.classes = classes, b.def.class_count = 2)
  b.def.class_count = 2;
  refused(&b, NULL, PACKING_ERR_INVALID, "classes");
  b.def.classes = classes;
  refused(&b, NULL, PACKING_ERR_RANGE, "classes");
  LIST;
  refused(&b, b.psd, PACKING_ERR_INVALID, "psd");
  LIST;
  b.def.regions = &region;
  b.def.region_count = 1;
  refused(&b, NULL, PACKING_ERR_INVALID, "regions");
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    classes[1].r = bad[k];
    LIST;
    refused(&b, NULL, k < 2 ? PACKING_ERR_RANGE : PACKING_ERR_INVALID, "classes");
  }
  classes[1].r = 0.5;
  classes[1].count = 0;
  LIST;
  refused(&b, NULL, PACKING_ERR_RANGE, "classes");
  classes[1].count = SIZE_MAX - 3;
  LIST;
  refused(&b, NULL, PACKING_ERR_RANGE, "classes");
  bench_end(&b);
}

static size_t first(void *user, const packing_vec3 *centre)
{
  (void)user;
  (void)centre;
  return 1;
}

static void regions(void **state)
{
  (void)state;
  bench b = bench_make();
  packing_domain *flat = test_rectangle(3, 3, 0);
  const packing_front_region bad[] = {{b.domain, NULL}, {NULL, b.psd}, {flat, b.psd}};
  const packing_status status[] = {PACKING_ERR_INVALID, PACKING_ERR_INVALID,
                                   PACKING_ERR_RANGE};
  b.def.region_count = 1;
  refused(&b, b.psd, PACKING_ERR_INVALID, "regions");
  b.def.regions = bad;
  refused(&b, b.psd, PACKING_ERR_RANGE, "regions");
  b.def.choose = first;
  refused(&b, b.psd, PACKING_ERR_INVALID, "choose");
  for (int k = 0; k < 3; k++) {
    b.def.regions = &bad[k];
    b.def.region_count = 1;
    refused(&b, b.psd, status[k], "regions");
  }
  packing_domain_destroy(flat);
  bench_end(&b);
}

static void what_is_missing(void **state)
{
  (void)state;
  bench b = bench_make();
  packing_placer *placer = NULL;
  packing_particles *flat = test_store(2);
  packing_context *c = b.context;
  refused(&b, NULL, PACKING_ERR_INVALID, "psd");
  assert_fails(c, packing_front_create(c, &b.def, NULL, b.psd, b.store, &placer),
               PACKING_ERR_INVALID, "domain");
  assert_fails(c, packing_front_create(c, &b.def, b.domain, b.psd, NULL, &placer),
               PACKING_ERR_INVALID, "particles");
  assert_fails(c, packing_front_create(c, &b.def, b.domain, b.psd, b.store, NULL),
               PACKING_ERR_INVALID, "placer");
  assert_fails(c, packing_front_create(c, &b.def, b.domain, b.psd, flat, &placer),
               PACKING_ERR_RANGE, "particles");
  b.def.struct_size = 4;
  assert_status(packing_front_create(c, &b.def, b.domain, b.psd, b.store, &placer),
                PACKING_ERR_ABI);
  assert_null(placer);
  packing_particles_destroy(flat);
  bench_end(&b);
}

static void containers_too_small(void **state)
{
  (void)state;
  bench b = bench_make();
  packing_domain *old = b.domain;
  packing_domain *small[] = {test_box(1.39, 9, 9, 0), test_box(9, 9, 1.3, 4),
                             test_box(9, 9, 9, 7)};
  for (int k = 0; k < 2; k++) {
    b.domain = small[k];
    refused(&b, b.psd, PACKING_ERR_GEOMETRY, "psd");
  }
  b.domain = small[2];
  REFUSE(direction, PACKING_FRONT_INWARD, PACKING_ERR_RANGE, "direction");
  for (int k = 0; k < 3; k++)
    packing_domain_destroy(small[k]);
  b.domain = old;
  bench_end(&b);
}

static void companions(void **state)
{
  (void)state;
  bench b = bench_make();
  packing_placer *front = NULL, *other = NULL;
  size_t index[4] = {7, 7, 7, 7}, count = 7;
  packing_context *c = b.context;
  b.def.count = 6;
  assert_ok(packing_front_create(c, &b.def, b.domain, b.psd, b.store, &front));
  assert_ok(packing_rsa_create(c, NULL, b.domain, b.psd, b.store, &other));
  assert_status(packing_front_members(NULL, 4, index, &count), PACKING_ERR_INVALID);
  assert_fails(c, packing_front_members(other, 4, index, &count), PACKING_ERR_INVALID,
               "placer");
  assert_fails(c, packing_front_members(front, 4, NULL, &count), PACKING_ERR_INVALID,
               "index");
  assert_fails(c, packing_front_members(front, 4, index, NULL), PACKING_ERR_INVALID,
               "count");
  assert_status(packing_front_unplaced(NULL, index), PACKING_ERR_INVALID);
  assert_fails(c, packing_front_unplaced(other, index), PACKING_ERR_INVALID, "placer");
  assert_fails(c, packing_front_unplaced(front, index), PACKING_ERR_INVALID, "placer");
  assert_int_equal(count, 7);
  assert_int_equal(index[0], 7);
  test_run(front);
  assert_ok(packing_front_members(front, 0, NULL, &count));
  assert_int_equal(count, 6);
  assert_ok(packing_front_members(front, 2, index, &count));
  assert_true(count == 6 && index[0] == 0 && index[1] == 1 && index[2] == 7);
  packing_placer_destroy(front);
  packing_placer_destroy(other);
  const packing_front_class class = {0.5, 3};
  b.def = front_paper();
  b.def.classes = &class;
  b.def.class_count = 1;
  assert_ok(packing_front_create(c, &b.def, b.domain, NULL, b.store, &front));
  assert_fails(c, packing_front_unplaced(front, NULL), PACKING_ERR_INVALID, "counts");
  packing_placer_destroy(front);
  bench_end(&b);
}

static void names(void **state)
{
  (void)state;
  assert_string_equal(packing_front_mode_name(PACKING_FRONT_DENSE), "dense");
  assert_string_equal(packing_front_mode_name(PACKING_FRONT_FAST), "fast");
  assert_string_equal(packing_front_mode_name(PACKING_FRONT_PAPER), "paper");
  assert_null(packing_front_mode_name((packing_front_mode)3));
  assert_string_equal(packing_front_direction_name(PACKING_FRONT_OUTWARD), "outward");
  assert_string_equal(packing_front_direction_name(PACKING_FRONT_INWARD), "inward");
  assert_null(packing_front_direction_name((packing_front_direction)2));
  assert_string_equal(packing_front_select_name(PACKING_FRONT_RANDOM), "random");
  assert_string_equal(packing_front_select_name(PACKING_FRONT_FIFO), "fifo");
  assert_string_equal(packing_front_select_name(PACKING_FRONT_LIFO), "lifo");
  assert_null(packing_front_select_name((packing_front_select)3));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(values_out_of_range),
      cmocka_unit_test(options_of_another_mode),
      cmocka_unit_test(contacts_and_shapes),
      cmocka_unit_test(lists),
      cmocka_unit_test(regions),
      cmocka_unit_test(what_is_missing),
      cmocka_unit_test(containers_too_small),
      cmocka_unit_test(companions),
      cmocka_unit_test(names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
