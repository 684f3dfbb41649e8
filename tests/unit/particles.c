/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The store: growth, columns, views in and out, removal, every error. */
#include "test.h"

static const packing_vec3 origin = {0, 0, 0};

static packing_context *context_of(void **state)
{
  return *state;
}

static packing_particles *make(packing_context *context, int dim, unsigned columns)
{
  packing_particles_def def;
  packing_particles *p = NULL;
  packing_particles_def_init(&def);
  def.dim = dim;
  def.columns = columns;
  assert_ok(packing_particles_create(context, &def, &p));
  return p;
}

/* n particles with numbers that tell their index. */
static void fill(packing_particles *p, size_t n)
{
  for (size_t i = 0; i < n; i++) {
    const double t = (double)i;
    const packing_vec3 c = {t + 0.25, -t, packing_particles_dim(p) == 2 ? 0 : 2 * t};
    size_t index = 99;
    const size_t before = packing_particles_count(p);
    assert_ok(packing_particles_add(p, c, 1 + t / 8, &index));
    assert_int_equal(index, before);
  }
}

static double at(packing_column c, size_t i)
{
  double v;
  memcpy(&v, (const char *)c.data + i * c.stride, sizeof v);
  return v;
}

static void numbers_survive_growth(void **state)
{
  packing_particles *p = make(context_of(state), 3, 0);
  packing_view v;
  fill(p, 1000);
  assert_int_equal(packing_particles_count(p), 1000);
  packing_particles_view(p, &v);
  assert_int_equal(v.count, 1000);
  assert_null(v.id.data);
  assert_null(v.vx.data);
  for (size_t i = 0; i < 1000; i++) {
    assert_true(at(v.x, i) == (double)i + 0.25);
    assert_true(at(v.y, i) == -(double)i);
    assert_true(at(v.z, i) == 2 * (double)i);
    assert_true(at(v.r, i) == 1 + (double)i / 8);
  }
  packing_particles_destroy(p);
}

static void reserve_makes_room_once(void **state)
{
  (void)state;
  test_allocator a = {0};
  packing_context *context = test_allocator_context(&a);
  packing_particles *p = make(context, 3, PACKING_COLUMN_ID | PACKING_COLUMN_SPIN);
  assert_ok(packing_particles_reserve(p, 500));
  const size_t requests = a.requests;
  assert_true(packing_particles_bytes(p) >= 500 * (4 + 1 + 3) * 8);
  assert_true(packing_particles_bytes(p) <= a.bytes);
  fill(p, 500);
  assert_int_equal(a.requests, requests);
  fill(p, 1);
  assert_true(a.requests > requests);
  assert_status(packing_particles_reserve(p, SIZE_MAX / 4), PACKING_ERR_NOMEM);
  assert_int_equal(packing_particles_count(p), 501);
  packing_particles_destroy(p);
  packing_context_destroy(context);
  assert_int_equal(a.live, 0);
}

static void optional_columns_start_with_defaults(void **state)
{
  packing_particles *p = make(context_of(state), 3, PACKING_COLUMN_TYPE);
  fill(p, 3);
  assert_ok(packing_particles_add_columns(p, 63));
  assert_int_equal(packing_particles_columns(p), 63);
  fill(p, 30);
  packing_view v;
  packing_particles_view(p, &v);
  for (size_t i = 0; i < v.count; i++) {
    assert_int_equal(((const int64_t *)v.id.data)[i], i);
    assert_int_equal(((const int32_t *)v.type.data)[i], 1);
    assert_int_equal(((const int32_t *)v.component.data)[i], 0);
    assert_true(at(v.vx, i) == 0 && at(v.vy, i) == 0 && at(v.vz, i) == 0);
    assert_true(at(v.wx, i) == 0 && at(v.wy, i) == 0 && at(v.wz, i) == 0);
    assert_true(at(v.qw, i) == 1 && at(v.qx, i) == 0 && at(v.qy, i) == 0 &&
                at(v.qz, i) == 0);
  }
  packing_particles_destroy(p);
}

static void columns_asked_of_an_empty_store_appear(void **state)
{
  packing_particles *p = make(context_of(state), 2, 0);
  packing_view v;
  assert_ok(packing_particles_add_columns(p, PACKING_COLUMN_COMPONENT));
  assert_ok(packing_particles_add_user_column(p, "void ratio"));
  fill(p, 40);
  packing_particles_view(p, &v);
  assert_non_null(v.component.data);
  double *values = NULL;
  assert_ok(packing_particles_user_column(p, "void ratio", &values));
  for (size_t i = 0; i < 40; i++)
    assert_true(values[i] == 0);
  packing_particles_destroy(p);
}

static void set_and_extract_go_through_any_stride(void **state)
{
  packing_particles *p = make(context_of(state), 3, PACKING_COLUMN_ID);
  struct record {
    int64_t id;
    double r;
    char padding[24];
  } in[7], out[7];
  memset(out, 0, sizeof out);
  fill(p, 7);
  for (int i = 0; i < 7; i++) {
    in[i].id = 1000 - i;
    in[i].r = 2.385 + i;
  }
  assert_ok(packing_particles_set(p, PACKING_FIELD_ID, &in[0].id, sizeof in[0]));
  assert_ok(packing_particles_set(p, PACKING_FIELD_R, &in[0].r, sizeof in[0]));
  assert_ok(packing_particles_extract(p, PACKING_FIELD_ID, &out[0].id, sizeof out[0]));
  assert_ok(packing_particles_extract(p, PACKING_FIELD_R, &out[0].r, sizeof out[0]));
  for (int i = 0; i < 7; i++)
    assert_true(out[i].id == in[i].id && out[i].r == in[i].r);
  packing_particles_destroy(p);
}

static void append_and_assign_copy_what_both_have(void **state)
{
  packing_particles *from = make(context_of(state), 3, PACKING_COLUMN_VELOCITY);
  packing_particles *to = make(context_of(state), 3, 63);
  const double vy[5] = {5, 4, 3, 2, 1};
  packing_view v, w;
  double *mine = NULL;
  fill(from, 5);
  fill(to, 2);
  assert_ok(packing_particles_set(from, PACKING_FIELD_VY, vy, sizeof vy[0]));
  assert_ok(packing_particles_add_user_column(to, "mine"));
  assert_ok(packing_particles_user_column(to, "mine", &mine));
  mine[0] = mine[1] = 7;
  packing_particles_view(from, &v);
  assert_ok(packing_particles_append(to, &v));
  packing_particles_view(to, &w);
  assert_int_equal(w.count, 7);
  for (size_t i = 0; i < 5; i++) {
    assert_true(at(w.x, i + 2) == at(v.x, i) && at(w.r, i + 2) == at(v.r, i));
    assert_true(at(w.vy, i + 2) == vy[i] && at(w.qw, i + 2) == 1);
    assert_int_equal(((const int64_t *)w.id.data)[i + 2], i + 2);
  }
  assert_ok(packing_particles_user_column(to, "mine", &mine));
  assert_true(mine[1] == 7 && mine[2] == 0);
  assert_ok(packing_particles_assign(to, &v));
  packing_particles_view(to, &w);
  assert_int_equal(w.count, 5);
  assert_true(at(w.x, 0) == at(v.x, 0) && at(w.vy, 4) == 1);
  assert_ok(packing_particles_user_column(to, "mine", &mine));
  assert_true(mine[0] == 0);
  packing_particles_destroy(from);
  packing_particles_destroy(to);
}

static void a_view_without_z_lies_in_the_plane(void **state)
{
  packing_particles *p = make(context_of(state), 2, 0);
  const double x[2] = {1, 2}, y[2] = {3, 4}, r[2] = {5, 6};
  packing_view v;
  packing_view_init_arrays(&v, 2, x, y, NULL, r);
  assert_ok(packing_particles_append(p, &v));
  packing_particles_view(p, &v);
  assert_true(at(v.z, 0) == 0 && at(v.z, 1) == 0 && at(v.y, 1) == 4);
  packing_particles_destroy(p);
}

static void failing_views_change_nothing(void **state)
{
  packing_context *context = context_of(state);
  const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 0, -1};
  for (int b = 0; b < 5; b++)
    for (int where = 0; where < 4; where++) {
      packing_particles *p = make(context, 3, 0);
      double n[4][3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
      const char *names[] = {"x", "y", "z", "r"};
      packing_view v;
      fill(p, 6);
      const uint64_t before = test_hash_particles(p);
      n[where][1] = bad[b];
      packing_view_init_arrays(&v, 3, n[0], n[1], n[2], n[3]);
      if (b < 3) {
        assert_fails(context, packing_particles_append(p, &v), PACKING_ERR_INVALID,
                     names[where]);
        assert_non_null(strstr(packing_context_message(context), "particle 1"));
        assert_fails(context, packing_particles_assign(p, &v), PACKING_ERR_INVALID,
                     names[where]);
      } else if (where == 3) {
        assert_fails(context, packing_particles_append(p, &v), PACKING_ERR_RANGE, "r");
        assert_fails(context, packing_particles_assign(p, &v), PACKING_ERR_RANGE, "r");
      }
      if (b < 3 || where == 3)
        assert_true(test_hash_particles(p) == before);
      packing_particles_destroy(p);
    }
}

static void views_that_are_none_are_refused(void **state)
{
  packing_context *context = context_of(state);
  packing_particles *p = make(context, 3, 0);
  packing_view v;
  fill(p, 2);
  assert_fails(context, packing_particles_append(p, NULL), PACKING_ERR_INVALID, "view");
  memset(&v, 0, sizeof v);
  assert_fails(context, packing_particles_append(p, &v), PACKING_ERR_INVALID, "view");
  packing_view_init(&v);
  v.count = 3;
  assert_fails(context, packing_particles_assign(p, &v), PACKING_ERR_INVALID, "view");
  packing_particles_view(p, &v);
  assert_fails(context, packing_particles_append(p, &v), PACKING_ERR_INVALID, "view");
  assert_int_equal(packing_particles_count(p), 2);
  packing_view_init(&v);
  assert_ok(packing_particles_append(p, &v));
  assert_ok(packing_particles_assign(p, &v));
  assert_int_equal(packing_particles_count(p), 0);
  packing_particles_destroy(p);
}

/* Also one that begins in the middle: growing would free what is still to be copied. */
static void views_of_the_store_itself_are_refused(void **state)
{
  packing_context *context = context_of(state);
  packing_particles *p = make(context, 3, PACKING_COLUMN_ID);
  fill(p, 16);
  packing_view v;
  packing_particles_view(p, &v);
  assert_fails(context, packing_particles_append(p, &v), PACKING_ERR_INVALID, "view");
  v.count = 8;
  v.x.data = (const double *)v.x.data + 8;
  v.y.data = (const double *)v.y.data + 8;
  v.z.data = (const double *)v.z.data + 8;
  v.r.data = (const double *)v.r.data + 8;
  assert_fails(context, packing_particles_append(p, &v), PACKING_ERR_INVALID, "view");
  assert_fails(context, packing_particles_assign(p, &v), PACKING_ERR_INVALID, "view");
  assert_int_equal(packing_particles_count(p), 16);
  packing_particles_destroy(p);
}

static void removal_keeps_the_order_of_the_rest(void **state)
{
  packing_particles *p = make(context_of(state), 3, PACKING_COLUMN_ID);
  const size_t gone[] = {0, 3, 4, 9};
  const int64_t kept[] = {1, 2, 5, 6, 7, 8};
  double *mine = NULL;
  packing_view v;
  fill(p, 10);
  assert_ok(packing_particles_add_user_column(p, "mine"));
  assert_ok(packing_particles_user_column(p, "mine", &mine));
  for (int i = 0; i < 10; i++)
    mine[i] = i;
  assert_ok(packing_particles_remove(p, gone, 4));
  packing_particles_view(p, &v);
  assert_int_equal(v.count, 6);
  for (size_t i = 0; i < 6; i++) {
    assert_int_equal(((const int64_t *)v.id.data)[i], kept[i]);
    assert_true(at(v.x, i) == (double)kept[i] + 0.25 && mine[i] == (double)kept[i]);
  }
  assert_ok(packing_particles_remove(p, NULL, 0));
  packing_particles_truncate(p, 100);
  assert_int_equal(packing_particles_count(p), 6);
  packing_particles_truncate(p, 2);
  assert_int_equal(packing_particles_count(p), 2);
  packing_particles_destroy(p);
}

static void removal_refuses_wrong_indices(void **state)
{
  packing_context *context = context_of(state);
  packing_particles *p = make(context, 3, 0);
  const size_t falling[] = {2, 1}, twice[] = {2, 2}, beyond[] = {1, 5};
  fill(p, 5);
  const uint64_t before = test_hash_particles(p);
  assert_fails(context, packing_particles_remove(p, falling, 2), PACKING_ERR_RANGE,
               "indices");
  assert_fails(context, packing_particles_remove(p, twice, 2), PACKING_ERR_RANGE,
               "indices");
  assert_fails(context, packing_particles_remove(p, beyond, 2), PACKING_ERR_RANGE,
               "indices");
  assert_fails(context, packing_particles_remove(p, NULL, 2), PACKING_ERR_INVALID,
               "indices");
  assert_true(test_hash_particles(p) == before);
  packing_particles_destroy(p);
}

static void add_refuses_bad_numbers(void **state)
{
  packing_context *context = context_of(state);
  packing_particles *p = make(context, 3, 0);
  packing_particles *flat = make(context, 2, 0);
  packing_vec3 c = origin;
  assert_fails(context, packing_particles_add(p, c, 0, NULL), PACKING_ERR_RANGE, "r");
  assert_fails(context, packing_particles_add(p, c, -1, NULL), PACKING_ERR_RANGE, "r");
  assert_fails(context, packing_particles_add(p, c, (double)NAN, NULL),
               PACKING_ERR_INVALID, "r");
  c.y = (double)INFINITY;
  assert_fails(context, packing_particles_add(p, c, 1, NULL), PACKING_ERR_INVALID,
               "centre.y");
  c = origin;
  c.x = (double)NAN;
  assert_fails(context, packing_particles_add(p, c, 1, NULL), PACKING_ERR_INVALID,
               "centre.x");
  c = origin;
  c.z = 1e-300;
  assert_fails(context, packing_particles_add(flat, c, 1, NULL), PACKING_ERR_INVALID,
               "centre.z");
  assert_int_equal(packing_particles_count(p), 0);
  packing_particles_destroy(p);
  packing_particles_destroy(flat);
}

static void options_are_checked(void **state)
{
  packing_context *context = context_of(state);
  packing_particles_def def;
  packing_particles *p = NULL;
  packing_particles_def_init(&def);
  def.dim = 4;
  assert_fails(context, packing_particles_create(context, &def, &p), PACKING_ERR_RANGE,
               "dim");
  packing_particles_def_init(&def);
  def.columns = 64;
  assert_fails(context, packing_particles_create(context, &def, &p), PACKING_ERR_RANGE,
               "columns");
  packing_particles_def_init(&def);
  def.capacity = SIZE_MAX / 16;
  assert_fails(context, packing_particles_create(context, &def, &p), PACKING_ERR_RANGE,
               "capacity");
  def.struct_size = 1;
  assert_fails(context, packing_particles_create(context, &def, &p), PACKING_ERR_ABI,
               "struct_size");
  assert_fails(context, packing_particles_create(context, NULL, NULL),
               PACKING_ERR_INVALID, "particles");
  assert_null(p);
  assert_ok(packing_particles_create(NULL, NULL, &p));
  assert_int_equal(packing_particles_dim(p), 3);
  packing_particles_destroy(p);
}

static void columns_are_checked(void **state)
{
  packing_context *context = context_of(state);
  packing_particles *p = make(context, 3, PACKING_COLUMN_VELOCITY);
  double numbers[2] = {1, 2};
  fill(p, 2);
  assert_fails(context,
               packing_particles_set(p, PACKING_FIELD_END, numbers, sizeof(double)),
               PACKING_ERR_RANGE, "field");
  assert_fails(context,
               packing_particles_set(p, PACKING_FIELD_WX, numbers, sizeof(double)),
               PACKING_ERR_INVALID, "wx");
  assert_fails(context, packing_particles_set(p, PACKING_FIELD_X, numbers, 4),
               PACKING_ERR_RANGE, "stride");
  assert_fails(context, packing_particles_extract(p, PACKING_FIELD_X, NULL, 8),
               PACKING_ERR_INVALID, "x");
  numbers[1] = (double)NAN;
  assert_fails(context, packing_particles_set(p, PACKING_FIELD_VZ, numbers, 8),
               PACKING_ERR_INVALID, "vz");
  numbers[1] = 0;
  assert_fails(context, packing_particles_set(p, PACKING_FIELD_R, numbers, 8),
               PACKING_ERR_RANGE, "r");
  assert_fails(context, packing_particles_add_columns(p, 64), PACKING_ERR_RANGE,
               "columns");
  packing_particles_destroy(p);
}

static void user_columns_are_checked(void **state)
{
  packing_context *context = context_of(state);
  packing_particles *p = make(context, 3, 0);
  double *values = NULL;
  assert_fails(context, packing_particles_add_user_column(p, NULL), PACKING_ERR_INVALID,
               "name");
  assert_fails(context, packing_particles_add_user_column(p, ""), PACKING_ERR_INVALID,
               "name");
  assert_fails(context,
               packing_particles_add_user_column(p, "12345678901234567890123456789012"),
               PACKING_ERR_INVALID, "name");
  assert_ok(packing_particles_add_user_column(p, "1234567890123456789012345678901"));
  assert_fails(context,
               packing_particles_add_user_column(p, "1234567890123456789012345678901"),
               PACKING_ERR_INVALID, "name");
  assert_fails(context, packing_particles_user_column(p, "other", &values),
               PACKING_ERR_INVALID, "name");
  packing_particles_destroy(p);
}

static int setup(void **state)
{
  *state = test_context(1, PACKING_ISA_AUTO);
  return 0;
}

static int teardown(void **state)
{
  packing_context_destroy(*state);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_survive_growth),
      cmocka_unit_test(reserve_makes_room_once),
      cmocka_unit_test(optional_columns_start_with_defaults),
      cmocka_unit_test(columns_asked_of_an_empty_store_appear),
      cmocka_unit_test(set_and_extract_go_through_any_stride),
      cmocka_unit_test(append_and_assign_copy_what_both_have),
      cmocka_unit_test(a_view_without_z_lies_in_the_plane),
      cmocka_unit_test(failing_views_change_nothing),
      cmocka_unit_test(views_that_are_none_are_refused),
      cmocka_unit_test(views_of_the_store_itself_are_refused),
      cmocka_unit_test(removal_keeps_the_order_of_the_rest),
      cmocka_unit_test(removal_refuses_wrong_indices),
      cmocka_unit_test(add_refuses_bad_numbers),
      cmocka_unit_test(options_are_checked),
      cmocka_unit_test(columns_are_checked),
      cmocka_unit_test(user_columns_are_checked),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
