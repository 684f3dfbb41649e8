/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that other programs have written (tests/data/README.md), with the numbers that were
 * given to those programs. TEST_DATA is the directory; what zlib made is left out where the
 * library has none. */
#include "reading.h"

/* Reads a file whole and in small pieces, which must come to the same. */
static reading read_sample(packing_context *c, const char *format, const char *name,
                           int64_t frame, int sort)
{
  size_t size;
  unsigned char *data = reading_file(TEST_DATA, name, &size);
  reading r = {0}, pieces = {0};
  for (int round = 0; round < 2; round++) {
    reading *now = round == 0 ? &r : &pieces;
    *now = reading_begin(c, 3);
    now->def.frame = frame;
    now->def.sort = sort;
    const packing_status status =
        reading_bytes(now, format, data, size, round == 0 ? 0 : 7);
    if (status != PACKING_OK)
      fail_msg("%s: %s", name, packing_context_message(c));
  }
  assert_int_equal(test_hash_particles(r.particles),
                   test_hash_particles(pieces.particles));
  assert_memory_equal(&r.info, &pieces.info, sizeof r.info);
  reading_end(&pieces);
  free(data);
  return r;
}

static void assert_box(const reading *r, double x0, double y0, double z0, double x1,
                       double y1, double z1)
{
  assert_int_equal(r->info.has_box, 1);
  assert_true(r->info.box.lo.x == x0 && r->info.box.lo.y == y0 && r->info.box.lo.z == z0);
  assert_true(r->info.box.hi.x == x1 && r->info.box.hi.y == y1 && r->info.box.hi.z == z1);
}

static void assert_motion(const reading *r, size_t i, double vx, double vy, double vz,
                          double wx, double wy, double wz)
{
  packing_view v;
  packing_particles_view(r->particles, &v);
  assert_true(reading_at(&v.vx, i) == vx && reading_at(&v.vy, i) == vy &&
              reading_at(&v.vz, i) == vz);
  assert_true(reading_at(&v.wx, i) == wx && reading_at(&v.wy, i) == wy &&
              reading_at(&v.wz, i) == wz);
}

static void lammps_data(void **state)
{
  packing_context *c = *state;
  static const char *const names[] = {"lammps_sphere.data", "lammps_sphere.data.gz"};
  for (int k = 0; k < 1 + PACKING_I_HAVE_ZLIB; k++) {
    reading r = read_sample(c, "lammps", names[k], PACKING_FRAME_LAST, 0);
    assert_int_equal(r.info.particles, 3);
    assert_box(&r, -0.05, -0.05, 0.029993000000000016, 0.05, 0.05, 0.09001299999999994);
    assert_int_equal(r.info.has_periodic, 0);
    assert_true(r.info.has_density == 1 && r.info.density == 2650);
    reading_is(&r, 1, -0.029999000000000005, 0.009997999999999995, 0.05000300000000002,
               0.006);
    assert_int_equal(reading_id(&r, 1), 2);
    assert_int_equal(reading_type(&r, 1), 2);
    assert_motion(&r, 0, 0.1, -0.2, 0.3, 0, 0, 0);
    assert_motion(&r, 1, 0.1, -0.2, 0.3, 1, 2, 3);
    reading_end(&r);
  }
}

static void lammps_bonds_in_a_tilted_box(void **state)
{
  reading r = read_sample(*state, "lammps", "lammps_hybrid.data", PACKING_FRAME_LAST, 0);
  assert_int_equal(r.info.particles, 3);
  assert_box(&r, 0, 0, 0, 1, 1, 1);
  assert_true(r.info.tilt.x == 0.1 && r.info.tilt.y == -0.2 && r.info.tilt.z == 0.3);
  assert_int_equal(r.info.has_density, 0);
  reading_is(&r, 2, 0.7, 0.6, 0.9, 0.05);
  assert_int_equal(r.info.bonds, 2);
  assert_int_equal(packing_bonds_count(r.bonds), 2);
  const packing_bond *b = packing_bonds_data(r.bonds);
  assert_true(b[0].i == 0 && b[0].j == 1 && b[0].type == 1);
  assert_true(b[1].i == 1 && b[1].j == 2 && b[1].type == 1);
  reading_end(&r);
}

static void lammps_frames(void **state)
{
  packing_context *c = *state;
  for (int frame = 0; frame < 3; frame++) {
    reading r = read_sample(c, "dump", "lammps.dump", frame, 1);
    assert_int_equal(r.info.frames, 3);
    assert_int_equal(r.info.frame, frame);
    assert_true(r.info.has_time && r.info.time == 5 * frame);
    assert_true(r.info.has_periodic && r.info.periodic == PACKING_PERIODIC_X);
    reading_end(&r);
  }
  reading r = read_sample(c, "dump", "lammps.dump", 1, 1);
  reading_is(&r, 0, 0.0100005, 0.019999, 0.0300015, 0.01);
  assert_box(&r, -0.05, -0.05, 0.02999, 0.05, 0.05, 0.090009999999999993);
  assert_motion(&r, 1, 0.1, -0.2, 0.3, 1, 2, 3);
  assert_int_equal(reading_id(&r, 2), 3);
  reading_end(&r);
}

/* Four digits of scaled coordinates are what LAMMPS wrote. */
static void lammps_scaled_and_unwrapped(void **state)
{
  packing_context *c = *state;
  packing_view a, b;
  reading scaled = read_sample(c, "dump", "lammps_scaled.dump", 0, 0);
  reading plain = read_sample(c, "dump", "lammps.dump", 0, 1);
  reading unwrapped = read_sample(c, "dump", "lammps_unwrapped.dump", 0, 1);
  packing_particles_view(scaled.particles, &a);
  packing_particles_view(plain.particles, &b);
  for (size_t i = 0; i < 3; i++) {
    assert_near(reading_at(&a.x, i), reading_at(&b.x, i), 1e-7);
    assert_near(reading_at(&a.y, i), reading_at(&b.y, i), 1e-7);
    assert_near(reading_at(&a.z, i), reading_at(&b.z, i), 1e-7);
    assert_true(reading_at(&a.r, i) == reading_at(&b.r, i));
  }
  assert_int_equal(test_hash_particles(plain.particles),
                   test_hash_particles(unwrapped.particles));
  reading_end(&scaled);
  reading_end(&plain);
  reading_end(&unwrapped);
}

/* Both ways to tell a place in a tilted box agree. */
static void lammps_tilted_dump(void **state)
{
  packing_context *c = *state;
  size_t size;
  unsigned char *data = reading_file(TEST_DATA, "lammps_triclinic.dump", &size);
  data[size] = '\0';
  reading plain = read_sample(c, "dump", "lammps_triclinic.dump", 0, 0);
  assert_box(&plain, 0, 0, 0, 1, 1, 1);
  assert_true(plain.info.periodic == 7 && plain.info.tilt.x == 0.1 &&
              plain.info.tilt.y == -0.2 && plain.info.tilt.z == 0.3);
  char *names = strstr((char *)data, " x y z");
  assert_non_null(names);
  memcpy(names, " a b c", 6); /* so that the scaled ones are taken */
  reading scaled = reading_begin(c, 3);
  assert_ok(reading_bytes(&scaled, "dump", data, size, 0));
  packing_view a, b;
  packing_particles_view(plain.particles, &a);
  packing_particles_view(scaled.particles, &b);
  for (size_t i = 0; i < 3; i++) {
    assert_near(reading_at(&a.x, i), reading_at(&b.x, i), 1e-14);
    assert_near(reading_at(&a.y, i), reading_at(&b.y, i), 1e-14);
    assert_near(reading_at(&a.z, i), reading_at(&b.z, i), 1e-14);
  }
  reading_end(&plain);
  reading_end(&scaled);
  free(data);
}

static void liggghts(void **state)
{
  packing_context *c = *state;
  reading data = read_sample(c, "liggghts", "liggghts.data", PACKING_FRAME_LAST, 0);
  reading dump = read_sample(c, "dump", "liggghts.dump", PACKING_FRAME_LAST, 0);
  assert_box(&data, -0.05, -0.05, 0, 0.05, 0.05, 0.1);
  assert_box(&dump, -0.05, -0.05, 0, 0.05, 0.05, 0.1);
  assert_int_equal(dump.info.frames, 2);
  assert_true(dump.info.has_periodic && dump.info.periodic == 0 && dump.info.time == 5);
  reading_is(&data, 2, 0.04000100000000003, -0.04000199999999999, 0.09000299999999994,
             0.0045);
  reading_is(&dump, 2, 0.040001, -0.040002, 0.090003, 0.0045);
  assert_int_equal(packing_particles_columns(dump.particles),
                   PACKING_COLUMN_ID | PACKING_COLUMN_TYPE | PACKING_COLUMN_VELOCITY |
                       PACKING_COLUMN_SPIN);
  reading_end(&data);
  reading_end(&dump);
}

static void assert_three_of_yade(const reading *r, int materials)
{
  assert_int_equal(r->info.particles, 3);
  reading_is(r, 0, 0.1, 0.2, 0.3, 0.05);
  reading_is(r, 1, 0.4, -0.25, 0.001, 0.0625);
  reading_is(r, 2, 0.333333, 0.666667, 0.5, 0.03);
  for (size_t i = 0; materials && i < 3; i++)
    assert_int_equal(reading_type(r, i), i > 0);
}

static void yade(void **state)
{
  static const struct {
    const char *format, *name;
    int materials, ids;
  } samples[] = {
      {"yade", "yade_text.txt", 0, 0},      {"yade", "yade_matid.txt", 1, 0},
      {"yade", "yade_id.txt", 1, 1},        {"yade", "yade_attrs.txt", 0, 0},
      {"yade-pack", "yade_pack.txt", 0, 0}, {"yade-pack", "yade_periodic.txt", 0, 0}};
  for (size_t k = 0; k < sizeof samples / sizeof samples[0]; k++) {
    reading r =
        read_sample(*state, samples[k].format, samples[k].name, PACKING_FRAME_LAST, 0);
    assert_three_of_yade(&r, samples[k].materials);
    assert_int_equal(reading_id(&r, 2), samples[k].ids ? 2 : -1);
    assert_int_equal(r.info.has_box, k == 5);
    if (k == 5) {
      assert_box(&r, 0, 0, 0, 1, 2, 3);
      assert_true(r.info.has_periodic && r.info.periodic == 7);
    }
    reading_end(&r);
  }
}

static void yade_vtk(void **state)
{
  static const char *const names[] = {"yade_ascii.vtu", "yade_zlib.vtu"};
  for (int k = 0; k < 1 + PACKING_I_HAVE_ZLIB; k++) {
    reading r = read_sample(*state, "vtu", names[k], PACKING_FRAME_LAST, 0);
    assert_int_equal(r.info.particles, 3);
    reading_is(&r, 1, (double)0.4F, -0.25, (double)0.001F, 0.0625);
    assert_int_equal(reading_id(&r, 2), 2);
    assert_motion(&r, 1, 1, 2, 3, 0.5, 0, -1);
    reading_end(&r);
  }
}

/* What tests/data/README.md tells of: doubles, or floats where the file holds those. */
static void assert_four_of_vtk(const reading *r, int floats)
{
  static const double rows[4][4] = {{0.1, 0.2, 0.3, 0.05},
                                    {0.4, -0.25, 1e-3, 0.0625},
                                    {1.0 / 3, 2.0 / 3, 0.5, 0.03},
                                    {-7, 1e10, 5e-7, 2}};
  assert_int_equal(r->info.particles, 4);
  for (size_t i = 0; i < 4; i++) {
    double v[4];
    for (int k = 0; k < 4; k++)
      v[k] = floats ? (double)(float)rows[i][k] : rows[i][k];
    reading_is(r, i, v[0], v[1], v[2], v[3]);
    assert_int_equal(reading_id(r, i), 10 - (int)i);
    assert_int_equal(reading_type(r, i), 1 + (int)i % 2);
    const double t = (double)i;
    assert_motion(r, i, t, -t, t / 2, 0, 0, 0);
  }
}

static void vtk(void **state)
{
  static const struct {
    const char *name;
    int floats, zlib;
  } samples[] = {{"ascii", 0, 0},   {"base64", 1, 0},      {"base64_zlib_big", 0, 1},
                 {"binary", 0, 0},  {"binary_zlib", 1, 1}, {"raw_big", 1, 0},
                 {"raw_zlib", 0, 1}};
  for (size_t k = 0; k < sizeof samples / sizeof samples[0]; k++)
    for (int grid = 0; grid < 2 && PACKING_I_HAVE_ZLIB >= samples[k].zlib; grid++) {
      char name[64];
      snprintf(name, sizeof name, "vtk_%s.%s", samples[k].name, grid ? "vtu" : "vtp");
      reading r = read_sample(*state, grid ? "vtu" : "vtp", name, PACKING_FRAME_LAST, 0);
      assert_four_of_vtk(&r, samples[k].floats);
      reading_end(&r);
    }
}

static void gengeo(void **state)
{
  packing_context *c = *state;
  reading r = read_sample(c, "geo", "gengeo.geo", PACKING_FRAME_LAST, 0);
  reading sorted = read_sample(c, "geo", "gengeo.geo", PACKING_FRAME_LAST, 1);
  reading grid = read_sample(c, "vtu", "gengeo.vtu", PACKING_FRAME_LAST, 0);
  assert_box(&r, 0, 0, 0, 3, 3, 3);
  assert_true(r.info.has_periodic && r.info.periodic == 0);
  assert_int_equal(r.info.particles, 12);
  assert_int_equal(r.info.bonds, 14);
  assert_int_equal(test_hash_particles(r.particles), test_hash_particles(grid.particles));
  /* a bond says the same of the sorted pack: the ids of its ends, and that they touch */
  packing_view v;
  packing_particles_view(sorted.particles, &v);
  for (size_t b = 0; b < 14; b++) {
    const packing_bond p = packing_bonds_data(r.bonds)[b],
                       q = packing_bonds_data(sorted.bonds)[b];
    assert_int_equal(reading_id(&r, p.i), reading_id(&sorted, q.i));
    assert_int_equal(reading_id(&r, p.j), reading_id(&sorted, q.j));
    assert_int_equal(q.type, 7);
    const double dx = reading_at(&v.x, q.i) - reading_at(&v.x, q.j),
                 dy = reading_at(&v.y, q.i) - reading_at(&v.y, q.j),
                 dz = reading_at(&v.z, q.i) - reading_at(&v.z, q.j);
    assert_near(sqrt(dx * dx + dy * dy + dz * dz),
                reading_at(&v.r, q.i) + reading_at(&v.r, q.j), 3e-5);
  }
  for (size_t i = 1; i < 12; i++)
    assert_true(reading_id(&sorted, i) > reading_id(&sorted, i - 1));
  reading_end(&r);
  reading_end(&sorted);
  reading_end(&grid);
}

static void ase(void **state)
{
  for (int frame = 0; frame < 2; frame++) {
    reading r = read_sample(*state, "xyz", "ase.xyz", frame, 1);
    assert_int_equal(r.info.frames, 2);
    assert_box(&r, 0, 0, 0, 2, 3, 4);
    assert_true(r.info.has_periodic &&
                r.info.periodic == (PACKING_PERIODIC_X | PACKING_PERIODIC_Z));
    assert_true(r.info.has_time && r.info.time == 0.5 + frame);
    reading_is(&r, 2, frame + 0.1, frame + 0.2, frame + 0.3, 0.05); /* id 3 */
    assert_motion(&r, 0, 3, 4, 5, 0, 0, 0);
    reading_end(&r);
  }
}

static void packing_generation(void **state)
{
  reading r = read_sample(*state, "xyzd", "packing.xyzd", PACKING_FRAME_LAST, 0);
  assert_int_equal(r.info.particles, 4);
  reading_is(&r, 2, 1.0 / 3, 2.0 / 3, 0.5, 0.03);
  reading_is(&r, 3, -7, 1e10, 5e-7, 2);
  assert_int_equal(r.info.has_box, 0);
  reading_end(&r);
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
      cmocka_unit_test(lammps_data),
      cmocka_unit_test(lammps_bonds_in_a_tilted_box),
      cmocka_unit_test(lammps_frames),
      cmocka_unit_test(lammps_scaled_and_unwrapped),
      cmocka_unit_test(lammps_tilted_dump),
      cmocka_unit_test(liggghts),
      cmocka_unit_test(yade),
      cmocka_unit_test(yade_vtk),
      cmocka_unit_test(vtk),
      cmocka_unit_test(gengeo),
      cmocka_unit_test(ase),
      cmocka_unit_test(packing_generation),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
