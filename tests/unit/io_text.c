/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LAMMPS, YADE, extended XYZ: the exact text of a small pack, and what is refused. */
#include "test.h"

static const double x[] = {0.25, 0.5}, y[] = {0.5, 0.125}, z[] = {0.75, 0.5},
                    r[] = {0.125, 0.0625};

typedef packing_status (*write_function)(packing_context *context,
                                         const packing_view *view,
                                         const packing_stream *stream);

static char *written(write_function write, const packing_view *view)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  assert_ok(write(NULL, view, &stream));
  return buffer.data;
}

static void assert_writes(write_function write, const packing_view *view,
                          const char *want)
{
  char *text = written(write, view);
  assert_string_equal(text, want);
  free(text);
}

static packing_status attempt(packing_context *context, write_function write,
                              const packing_view *view)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = write(context, view, &stream);
  if (status != PACKING_OK)
    assert_int_equal(buffer.size, 0); /* refused before the first byte */
  test_buffer_free(&buffer);
  return status;
}

/* The options stand here, so that one signature does for all formats. */
static packing_lammps_def lammps_def;
static packing_xyz_def xyz_def;
static packing_yade_def yade_def;

static packing_status lammps(packing_context *context, const packing_view *view,
                             const packing_stream *stream)
{
  return packing_write_lammps(context, &lammps_def, view, stream);
}

static packing_status xyz(packing_context *context, const packing_view *view,
                          const packing_stream *stream)
{
  return packing_write_xyz(context, &xyz_def, view, stream);
}

static packing_status yade(packing_context *context, const packing_view *view,
                           const packing_stream *stream)
{
  return packing_write_yade(context, &yade_def, view, stream);
}

static packing_view small_pack(void)
{
  packing_view view;
  packing_lammps_def_init(&lammps_def);
  packing_xyz_def_init(&xyz_def);
  packing_yade_def_init(&yade_def);
  packing_view_init_arrays(&view, 2, x, y, z, r);
  return view;
}

static void lammps_text_is_exact(void **state)
{
  (void)state;
  const packing_view view = small_pack();
  assert_writes(lammps, &view,
                "pack written by libpacking\n"
                "\n"
                "2 atoms\n"
                "1 atom types\n"
                "\n"
                "0.125 0.5625 xlo xhi\n"
                "0.0625 0.625 ylo yhi\n"
                "0.4375 0.875 zlo zhi\n"
                "\n"
                "Atoms # sphere\n"
                "\n"
                "1 1 0.25 1000 0.25 0.5 0.75\n"
                "2 1 0.125 1000 0.5 0.125 0.5\n");
}

static void lammps_writes_ids_types_and_velocities(void **state)
{
  (void)state;
  static const int64_t id[] = {INT32_MAX, 3};
  static const int32_t type[] = {1, 4};
  packing_view view = small_pack();
  lammps_def.title = "a title";
  lammps_def.density = 2650;
  lammps_def.box.hi.x = lammps_def.box.hi.y = lammps_def.box.hi.z = 1;
  view.id.data = id;
  view.id.stride = sizeof id[0];
  view.type.data = type;
  view.type.stride = sizeof type[0];
  view.vx = view.x;
  view.wz = view.r;
  assert_writes(lammps, &view,
                "a title\n"
                "\n"
                "2 atoms\n"
                "4 atom types\n"
                "\n"
                "0 1 xlo xhi\n"
                "0 1 ylo yhi\n"
                "0 1 zlo zhi\n"
                "\n"
                "Atoms # sphere\n"
                "\n"
                "2147483647 1 0.25 2650 0.25 0.5 0.75\n"
                "3 4 0.125 2650 0.5 0.125 0.5\n"
                "\n"
                "Velocities\n"
                "\n"
                "2147483647 0.25 0 0 0 0 0.125\n"
                "3 0.5 0 0 0 0 0.0625\n");
}

static void a_flat_box_is_one_diameter_thick(void **state)
{
  (void)state;
  packing_view view = small_pack();
  view.z.data = NULL;
  view.count = 1;
  lammps_def.dim = 2;
  assert_writes(lammps, &view,
                "pack written by libpacking\n\n1 atoms\n1 atom types\n\n"
                "0.125 0.375 xlo xhi\n0.375 0.625 ylo yhi\n-0.125 0.125 zlo zhi\n\n"
                "Atoms # sphere\n\n1 1 0.25 1000 0.25 0.5 0\n");
  xyz_def.box.hi.x = xyz_def.box.hi.y = 1;
  assert_writes(xyz, &view,
                "1\n"
                "Lattice=\"1 0 0 0 1 0 0 0 0.25\" Origin=\"0 0 -0.125\" "
                "Properties=species:S:1:pos:R:3:radius:R:1:id:I:1 pbc=\"F F F\" Time=0\n"
                "X 0.25 0.5 0 0.125 1\n");
}

static void an_empty_pack_needs_a_box(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_view view = small_pack();
  view.count = 0;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "box");
  assert_fails(c, attempt(c, xyz, &view), PACKING_ERR_INVALID, "box");
  lammps_def.box.hi.x = lammps_def.box.hi.y = lammps_def.box.hi.z = 1;
  assert_writes(lammps, &view,
                "pack written by libpacking\n\n0 atoms\n1 atom types\n\n"
                "0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms # sphere\n\n");
  packing_context_destroy(c);
}

static void lammps_refuses_what_lammps_would(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_view view = small_pack();
  int64_t id[] = {1, 0};
  int32_t type[] = {1, 0};
  const packing_bounds unit = {{0, 0, 0}, {1, 1, 1}};

  lammps_def.density = 0;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "density");
  lammps_def.density = (double)NAN;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "density");
  view = small_pack();
  lammps_def.dim = 1;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "dim");
  lammps_def.dim = 2;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "z");
  view = small_pack();
  lammps_def.title = "two\nlines";
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "title");

  view = small_pack();
  lammps_def.box = unit;
  lammps_def.box.hi.y = 0.5; /* the face itself is outside */
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE,
               "box: the centre of particle 0");
  lammps_def.box.hi.y = 0;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "box");
  lammps_def.box.hi.y = (double)INFINITY;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "box");

  view = small_pack();
  view.id.data = id;
  view.id.stride = sizeof id[0];
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "id: particle 1");
  id[1] = INT64_C(2147483648);
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "id: particle 1");
  id[1] = 1;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, "id: 1 stands twice");
  id[0] = 2;
  assert_ok(attempt(c, lammps, &view));
  view = small_pack();
  view.type.data = type;
  view.type.stride = sizeof type[0];
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "type: particle 1");
  view = small_pack();
  static const double huge[] = {1e308, 1e308};
  lammps_def.box = unit;
  view.r.data = huge;
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "r: particle 0");
  view = small_pack();
  view.count = (size_t)INT32_MAX + 1; /* refused before any is looked at */
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_RANGE, "count");
  packing_context_destroy(c);
}

/* Ids in no order: sorted by bytes to find one used twice. */
static void lammps_finds_an_id_used_twice(void **state)
{
  (void)state;
  enum { COUNT = 3000 };
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_view view = small_pack();
  static int64_t id[COUNT];
  for (int i = 0; i < COUNT; i++)
    id[i] = 1 + (i * INT64_C(1103515245) + 12345) % INT32_MAX;
  view.count = COUNT;
  view.x.stride = view.y.stride = view.z.stride = view.r.stride = 0;
  view.id.data = id;
  view.id.stride = sizeof id[0];
  assert_ok(attempt(c, lammps, &view));
  id[2900] = id[17];
  char says[64];
  snprintf(says, sizeof says, "id: %lld stands twice", (long long)id[17]);
  assert_fails(c, attempt(c, lammps, &view), PACKING_ERR_INVALID, says);
  packing_context_destroy(c);
}

static void yade_text_is_exact(void **state)
{
  (void)state;
  packing_view view = small_pack();
  assert_writes(yade, &view, "0.25\t0.5\t0.75\t0.125\n0.5\t0.125\t0.5\t0.0625\n");
  yade_def.header = 1;
  view.z.data = NULL;
  assert_writes(yade, &view,
                "#format x_y_z_r\n0.25\t0.5\t0\t0.125\n0.5\t0.125\t0\t0.0625\n");
}

static void xyz_text_is_exact(void **state)
{
  (void)state;
  static const int64_t id[] = {-4, 12};
  packing_view view = small_pack();
  view.id.data = id;
  view.id.stride = sizeof id[0];
  xyz_def.periodic = PACKING_PERIODIC_X | PACKING_PERIODIC_Z;
  assert_writes(xyz, &view,
                "2\n"
                "Lattice=\"0.4375 0 0 0 0.5625 0 0 0 0.4375\" "
                "Origin=\"0.125 0.0625 0.4375\" "
                "Properties=species:S:1:pos:R:3:radius:R:1:id:I:1 pbc=\"T F T\" Time=0\n"
                "X 0.25 0.5 0.75 0.125 -4\n"
                "X 0.5 0.125 0.5 0.0625 12\n");
}

static void xyz_refuses_bad_options(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_view view = small_pack();
  xyz_def.periodic = 8;
  assert_fails(c, attempt(c, xyz, &view), PACKING_ERR_INVALID, "periodic");
  view = small_pack();
  xyz_def.box.lo.x = 1;
  assert_fails(c, attempt(c, xyz, &view), PACKING_ERR_INVALID, "z"); /* flat, with z */
  xyz_def.box.hi.z = 1;
  assert_fails(c, attempt(c, xyz, &view), PACKING_ERR_RANGE, "box: empty along x");
  packing_context_destroy(c);
}

static void writing_fails_at_every_byte(void **state)
{
  (void)state;
  static const write_function writes[] = {lammps, yade, xyz};
  packing_view view = small_pack();
  view.vx = view.x;
  for (size_t f = 0; f < 3; f++) {
    char *whole = written(writes[f], &view);
    for (size_t k = 1; k < strlen(whole); k++) {
      test_buffer buffer = {0};
      const packing_stream stream = test_buffer_stream(&buffer);
      buffer.limit = k;
      assert_status(writes[f](NULL, &view, &stream), PACKING_ERR_IO);
      test_buffer_free(&buffer);
    }
    free(whole);
  }
}

/* However small a radius is beside its centre, the box around holds the centre. */
static void a_tiny_particle_stays_in_its_box(void **state)
{
  (void)state;
  static const double far[] = {1e6}, tiny[] = {1e-12};
  packing_view view = small_pack();
  packing_view_init_arrays(&view, 1, far, far, far, tiny);
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  assert_ok(attempt(c, lammps, &view));
  assert_ok(attempt(c, xyz, &view));
  packing_context_destroy(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lammps_text_is_exact),
      cmocka_unit_test(lammps_writes_ids_types_and_velocities),
      cmocka_unit_test(a_flat_box_is_one_diameter_thick),
      cmocka_unit_test(an_empty_pack_needs_a_box),
      cmocka_unit_test(lammps_refuses_what_lammps_would),
      cmocka_unit_test(lammps_finds_an_id_used_twice),
      cmocka_unit_test(yade_text_is_exact),
      cmocka_unit_test(xyz_text_is_exact),
      cmocka_unit_test(xyz_refuses_bad_options),
      cmocka_unit_test(writing_fails_at_every_byte),
      cmocka_unit_test(a_tiny_particle_stays_in_its_box),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
