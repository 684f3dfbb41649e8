/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the readers of text take beyond the samples: forms that the formats allow, frames, order,
 * boxes, line ends, gzip. */
#include "reading.h"
#if PACKING_I_HAVE_ZLIB
#include <zlib.h>
#endif

static void formats_by_name_and_extension(void **state)
{
  (void)state;
  static const char *const paths[][2] = {
      {"pack.csv", "csv"},
      {"a.b/pack.vtp", "vtp"},
      {"pack.vtu", "vtu"},
      {"pack.data", "lammps"},
      {"pack.data.gz", "lammps"},
      {"x.dump", "dump"},
      {"x.lammpstrj.gz", "dump"},
      {"x.txt", "yade"},
      {"x.geo", "geo"},
      {"x.y.extxyz", "xyz"},
      {"x.xyz", "xyz"},
      {"x.xyzd", "xyzd"},
      {"x.xyzd.gz", NULL},
      {"x.vtp.gz", NULL},
      {"pack", NULL},
      {"pack.", NULL},
      {".csv", NULL},
      {"pack.gz", NULL},
      {".data.gz", NULL},
      {"a.csv/pack", NULL},
      {"pack.CSV", NULL},
      {"pack.cs", NULL},
      {"", NULL},
  };
  for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
    const char *found = packing_read_format_of(paths[i][0]);
    if (found == NULL || paths[i][1] == NULL)
      assert_true(found == paths[i][1]);
    else
      assert_string_equal(found, paths[i][1]);
  }
  assert_null(packing_read_format_of(NULL));
  size_t count = 0;
  for (; packing_read_format(count) != NULL; count++) {
    assert_non_null(packing_read_format_about(packing_read_format(count)));
    for (size_t k = 0; k < count; k++)
      assert_string_not_equal(packing_read_format(k), packing_read_format(count));
  }
  assert_int_equal(count, 11);
  assert_null(packing_read_format_about("pov"));
  assert_null(packing_read_format_about(NULL));
}

static const char frames[] = "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n2\n"
                             "ITEM: BOX BOUNDS pp pp ff\n0 1\n0 2\n0 4\n"
                             "ITEM: ATOMS xs diameter ys name zs id\n"
                             "0.25 0.5 0.5 a 0.75 7\n0.5 0.25 0.125 b 1 -3\n"
                             "ITEM: TIME\n0.5\n"
                             "ITEM: TIMESTEP\n20\nITEM: NUMBER OF ATOMS\n1\n"
                             "ITEM: BOX BOUNDS ff ff ff\n0 2\n0 2\n0 2\n"
                             "ITEM: ATOMS xs diameter ys name zs id\n"
                             "0.25 0.5 0.5 a 0.75 7\n"
                             "ITEM: TIMESTEP\n30\nITEM: NUMBER OF ATOMS\n0\n"
                             "ITEM: BOX BOUNDS\n0 3\n0 3\n0 3\n"
                             "ITEM: ATOMS xs diameter ys name zs id\n";

static void a_frame_of_a_dump(void **state)
{
  packing_context *c = *state;
  reading r = reading_begin(c, 3);
  r.def.frame = 0;
  r.def.sort = 1;
  assert_ok(reading_text(&r, "dump", frames));
  assert_true(r.info.frames == 3 && r.info.frame == 0 && r.info.particles == 2);
  assert_true(r.info.has_time && r.info.time == 10);
  assert_true(r.info.has_periodic && r.info.periodic == 3 && r.info.box.hi.z == 4);
  reading_is(&r, 0, 0.5, 0.25, 4, 0.125);
  reading_is(&r, 1, 0.25, 1, 3, 0.25);
  assert_true(reading_id(&r, 0) == -3 && reading_id(&r, 1) == 7);
  packing_particles_truncate(r.particles, 0);
  r.def.frame = 1;
  assert_ok(reading_text(&r, "dump", frames));
  assert_true(r.info.frame == 1 && r.info.particles == 1 && r.info.time == 0.5);
  assert_true(r.info.has_periodic && r.info.periodic == 0 && r.info.box.hi.z == 2);
  reading_is(&r, 0, 0.5, 1, 1.5, 0.25);
  packing_particles_truncate(r.particles, 0);
  r.def.frame = PACKING_FRAME_LAST;
  assert_ok(reading_text(&r, "dump", frames));
  assert_true(r.info.frame == 2 && r.info.particles == 0 && r.info.time == 30);
  assert_true(r.info.has_periodic == 0 && r.info.box.hi.z == 3);
  r.def.frame = 3;
  assert_fails(c, reading_text(&r, "dump", frames), PACKING_ERR_RANGE,
               "frame: 3, the file has 3");
  reading_end(&r);
}

/* x before xu before xs before xsu; a radius before a diameter; discs without z. */
static void columns_of_a_dump(void **state)
{
  static const char head[] = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n"
                             "ITEM: BOX BOUNDS ff ff ff\n2 4\n2 4\n-1 1\n";
  static const struct {
    const char *rows;
    double x, y, z, r;
  } cases[] = {
      {"ITEM: ATOMS xs ys zs x y z radius diameter\n.5 .5 .5 1 2 3 7 8\n", 1, 2, 3, 7},
      {"ITEM: ATOMS xs ys zs xu yu zu diameter\n.5 .5 .5 1 2 3 8\n", 1, 2, 3, 4},
      {"ITEM: ATOMS xsu ysu zsu xs ys zs diameter\n9 9 9 .5 .25 .5 8\n", 3, 2.5, 0, 4},
      {"ITEM: ATOMS xsu ysu zsu diameter\n-0.5 1.5 2 8\n", 1, 5, 3, 4},
      {"ITEM: ATOMS x y xs ys zs diameter\n9 9 .5 .25 .5 8\n", 3, 2.5, 0, 4},
      {"ITEM: ATOMS xs ys radius\n.5 .25 1\n", 3, 2.5, 0, 1},
      {"ITEM: ATOMS x y radius \n.5 .25 1 \n", .5, .25, 0, 1},
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    char text[400];
    reading r = reading_begin(*state, 3);
    snprintf(text, sizeof text, "%s%s", head, cases[k].rows);
    assert_ok(reading_text(&r, "dump", text));
    reading_is(&r, 0, cases[k].x, cases[k].y, cases[k].z, cases[k].r);
    assert_int_equal(r.info.dim, cases[k].z == 0 ? 2 : 3);
    reading_end(&r);
  }
}

/* Bounds of a tilted box are those of its corners: from Howto_triclinic, backwards. */
static void tilted_boxes(void **state)
{
  static const double tilts[][3] = {
      {0.25, 0.5, 0.125}, {-0.25, 0.5, -0.125}, {0.25, -0.5, 0.125}, {-0.25, -0.5, 0}};
  for (size_t k = 0; k < 4; k++) {
    const double xy = tilts[k][0], xz = tilts[k][1], yz = tilts[k][2];
    double lo = 2, hi = 3, low_y = 1, high_y = 2;
    for (int corner = 0; corner < 4; corner++) {
      const double dx = (corner & 1 ? xy : 0) + (corner & 2 ? xz : 0);
      lo = fmin(lo, 2 + dx);
      hi = fmax(hi, 3 + dx);
      low_y = fmin(low_y, 1 + (corner & 2 ? yz : 0));
      high_y = fmax(high_y, 2 + (corner & 2 ? yz : 0));
    }
    char text[500];
    snprintf(text, sizeof text,
             "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n"
             "ITEM: BOX BOUNDS xy xz yz pp pp pp\n%g %g %g\n%g %g %g\n0 1 %g\n"
             "ITEM: ATOMS xs ys zs radius\n0.5 0.25 0.75 1\n",
             lo, hi, xy, low_y, high_y, xz, yz);
    reading r = reading_begin(*state, 3);
    assert_ok(reading_text(&r, "dump", text));
    assert_true(r.info.box.lo.x == 2 && r.info.box.hi.x == 3);
    assert_true(r.info.box.lo.y == 1 && r.info.box.hi.y == 2);
    reading_is(&r, 0, 2.5 + 0.25 * xy + 0.75 * xz, 1.25 + 0.75 * yz, 0.75, 1);
    reading_end(&r);
  }
}

/* Ids with gaps and out of order, comments, image flags, sections that are passed over. */
static void data_of_lammps(void **state)
{
  static const char text[] =
      "# the first line is a comment, whatever it holds\r\n"
      "\r\n3 atoms # of three\r\n  2   atom types\r\n1 bonds\r\n2 bond types\r\n"
      "2 extra bond per atom\r\n"
      "0 1 xlo xhi\r\n0 2 ylo yhi\r\n-1 1 zlo zhi\r\n0.5 0 -0.5 xy xz yz\r\n\r\n"
      "Masses\r\n\r\n1 1.0\r\n2 1.0\r\n\r\nPair Coeffs # gran\r\n\r\n1\r\n\r\n"
      "Atoms#granular\r\n\r\n"
      "9 1 0.5 2650 .25 .5 .75 # the first\r\n"
      "3\t2  0.25 2650.0 1 1 1 0 -2 5\r\n"
      "5 1 1 2650 0 0 0\r\n\r\n"
      "Bonds\r\n\r\n1 2 5 9\r\n\r\n"
      "Velocities # in any order\r\n \r\n"
      "3 1 2 3 4 5 6\r\n9 0 0 0 0 0 0.5\r\n5 -1 0 0 0 0 0\r\n";
  for (int sort = 0; sort < 2; sort++) {
    reading r = reading_begin(*state, 3);
    packing_view v;
    r.def.sort = sort;
    assert_ok(reading_text(&r, "liggghts", text));
    packing_particles_view(r.particles, &v);
    const size_t first = sort ? 2 : 0, second = sort ? 0 : 1, third = sort ? 1 : 2;
    reading_is(&r, first, .25, .5, .75, .25);
    reading_is(&r, second, 1, 1, 1, .125);
    reading_is(&r, third, 0, 0, 0, .5);
    assert_true(reading_id(&r, first) == 9 && reading_type(&r, second) == 2);
    assert_true(reading_at(&v.wz, first) == 0.5 && reading_at(&v.wy, second) == 5);
    assert_true(reading_at(&v.vx, third) == -1);
    assert_int_equal(r.info.bonds, 1);
    const packing_bond *bond = packing_bonds_data(r.bonds);
    assert_true(bond->i == third && bond->j == first && bond->type == 2);
    assert_true(r.info.has_density && r.info.density == 2650);
    assert_true(r.info.tilt.x == 0.5 && r.info.tilt.z == -0.5 && !r.info.has_periodic);
    reading_end(&r);
  }
}

static void bonds_may_be_left_out(void **state)
{
  static const char text[] =
      "LSMGeometry 1.2\nBoundingBox -1 0 0 1 1 1\nPeriodicBoundaries 0 1 1\nDimension "
      "2D\n"
      "BeginParticles\nSimple\n2\n0.5 0 0 0.5 8 3\n-0.5 0 0 0.5 1 4\nEndParticles\n"
      "BeginConnect\n2\n8 1 0\n1 8 5\nEndConnect\n\n";
  reading r = reading_begin(*state, 2);
  r.def.bonds = NULL;
  assert_ok(reading_text(&r, "geo", text));
  assert_true(r.info.bonds == 2 && packing_bonds_count(r.bonds) == 0);
  assert_null(packing_bonds_data(r.bonds));
  assert_true(r.info.dim == 2 &&
              r.info.periodic == (PACKING_PERIODIC_Y | PACKING_PERIODIC_Z));
  assert_int_equal(reading_type(&r, 1), 4);
  packing_particles_truncate(r.particles, 0);
  r.def.bonds = r.bonds;
  assert_ok(reading_text(&r, "geo", text)); /* and again: the list starts anew */
  packing_particles_truncate(r.particles, 0);
  assert_ok(reading_text(&r, "geo", text));
  assert_int_equal(packing_bonds_count(r.bonds), 2);
  reading_end(&r);
}

static void extended_xyz(void **state)
{
  static const char text[] =
      "1\nno=\"a = b\" flag "
      "Properties=species:S:1:tags:I:2:pos:R:3:diameter:R:1:type:I:1 "
      "Lattice=\"2 0 0 .5 3 0 -.5 .25 4\" Origin=\"-1 0 1\" pbc=\"0 1 F\" Time=2.5 "
      "other=1\n"
      "Fe 1 2 0.25 0.5 0.75 0.5 3\n";
  reading r = reading_begin(*state, 3);
  assert_ok(reading_text(&r, "xyz", text));
  reading_is(&r, 0, .25, .5, .75, .25);
  assert_int_equal(reading_type(&r, 0), 3);
  assert_true(r.info.box.lo.x == -1 && r.info.box.hi.x == 1 && r.info.box.hi.z == 5);
  assert_true(r.info.tilt.x == 0.5 && r.info.tilt.y == -0.5 && r.info.tilt.z == 0.25);
  assert_true(r.info.periodic == PACKING_PERIODIC_Y && r.info.time == 2.5);
  reading_end(&r);
}

/* OVITO's names: spin, and a quaternion with its real part last. */
static void turning_grains_of_xyz(void **state)
{
  static const char text[] = "1\nProperties=pos:R:3:radius:R:1:angular_velocity:R:3:"
                             "orientation:R:4\n1 2 3 4 5 6 7 .5 -.5 .25 -.75\n";
  reading r = reading_begin(*state, 3);
  packing_view v;
  assert_ok(reading_text(&r, "xyz", text));
  packing_particles_view(r.particles, &v);
  const packing_column *const columns[] = {&v.wx, &v.wy, &v.wz, &v.qw,
                                           &v.qx, &v.qy, &v.qz};
  const double want[] = {5, 6, 7, -.75, .5, -.5, .25};
  for (int k = 0; k < 7; k++)
    assert_true(reading_at(columns[k], 0) == want[k]);
  reading_end(&r);
}

static void any_line_ends(void **state)
{
  static const char *const texts[] = {
      "1 2 3 4\n5 6 7 8\n", "1 2 3 4\n5 6 7 8", "1 2 3 4\r\n5 6 7 8\r\n",
      "\xEF\xBB\xBF#format x_y_z_r\n# \xC3\xA9t\xC3\xA9\n\t1  2\t3 4 \n 5 6 7 8\n"};
  for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    for (size_t chunk = 0; chunk < 4; chunk++) {
      reading r = reading_begin(*state, 3);
      assert_ok(reading_bytes(&r, "yade", texts[i], strlen(texts[i]), chunk));
      assert_int_equal(r.info.particles, 2);
      reading_is(&r, 1, 5, 6, 7, 8);
      reading_end(&r);
    }
}

/* A store without the columns of a #format that no row has. */
static void formats_without_rows(void **state)
{
  static const char text[] =
      "#format id_x_y_z_r_matId\n#format x_y_z_r\n1 2 3 4\n#format x_y_z_r\n5 6 7 8\n";
  reading r = reading_begin(*state, 3);
  assert_ok(reading_text(&r, "yade", text));
  assert_int_equal(r.info.particles, 2);
  assert_int_equal(packing_particles_columns(r.particles), 0);
  reading_end(&r);
}

static void nothing_is_a_pack(void **state)
{
  static const char *const empty[][2] = {
      {"yade", ""},
      {"yade-pack", ""},
      {"xyzd", ""},
      {"csv", "x,y,z,r\n"},
      {"lammps", "\n0 atoms\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n"},
      {"xyz", "0\nProperties=pos:R:3:radius:R:1:id:I:1\n"},
      {"geo", "LSMGeometry 1.2\nBoundingBox 0 0 0 1 1 1\nPeriodicBoundaries 0 0 0\n"
              "Dimension 3D\nBeginParticles\nSimple\n0\nEndParticles\nBeginConnect\n0\n"
              "EndConnect\n"},
  };
  for (size_t i = 0; i < sizeof empty / sizeof empty[0]; i++) {
    reading r = reading_begin(*state, 3);
    assert_ok(reading_text(&r, empty[i][0], empty[i][1]));
    assert_true(r.info.particles == 0 && r.info.frames == 1 && r.info.dim == 3);
    reading_end(&r);
  }
}

static void a_table_without_z(void **state)
{
  reading r = reading_begin(*state, 3), flat = reading_begin(*state, 2);
  static const char text[] = "x,y,r,id\n1,2,3,9\n4,5,6,2\n";
  r.def.sort = flat.def.sort = 1;
  assert_ok(reading_text(&r, "csv", text));
  assert_ok(reading_text(&flat, "csv", text));
  assert_true(r.info.dim == 2 && flat.info.dim == 2);
  reading_is(&r, 0, 4, 5, 0, 6);
  reading_is(&flat, 1, 1, 2, 0, 3);
  reading_end(&r);
  reading_end(&flat);
}

#if PACKING_I_HAVE_ZLIB
/* `text` as a member of a gzip file, behind `to`. */
static size_t gzip(const char *text, unsigned char *to, size_t capacity)
{
  z_stream z = {0};
  assert_int_equal(deflateInit2(&z, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  unsigned char in[200];
  const size_t size = strlen(text);
  assert_true(size < sizeof in);
  memcpy(in, text, size);
  z.next_in = in;
  z.avail_in = (unsigned)size;
  z.next_out = to;
  z.avail_out = (unsigned)capacity;
  assert_int_equal(deflate(&z, Z_FINISH), Z_STREAM_END);
  deflateEnd(&z);
  return capacity - z.avail_out;
}

static void compressed_text(void **state)
{
  packing_context *c = *state;
  unsigned char data[600];
  size_t size = gzip("1 2 3 4\n5 6", data, sizeof data);
  const size_t first = size;
  size += gzip(" 7 8\n1 1 1 1\n", data + size, sizeof data - size);
  for (size_t chunk = 0; chunk < 5; chunk++) {
    reading r = reading_begin(c, 3);
    assert_ok(reading_bytes(&r, "yade", data, size, chunk));
    assert_int_equal(r.info.particles, 3);
    reading_is(&r, 1, 5, 6, 7, 8);
    packing_particles_truncate(r.particles, 0);
    assert_fails(c, reading_bytes(&r, "yade", data, first, chunk), PACKING_ERR_FORMAT,
                 "line 2: z is missing");
    assert_fails(c, reading_bytes(&r, "yade", data, first - 1, chunk), PACKING_ERR_FORMAT,
                 "end too early");
    assert_fails(c, reading_bytes(&r, "yade", data, first + 2, chunk), PACKING_ERR_FORMAT,
                 "end too early");
    data[size] = 'x';
    assert_fails(c, reading_bytes(&r, "yade", data, size + 1, chunk), PACKING_ERR_FORMAT,
                 "something else follows");
    data[first - 5] ^= 1; /* the length, or the sum before it */
    assert_fails(c, reading_bytes(&r, "yade", data, size, chunk), PACKING_ERR_FORMAT,
                 "damaged");
    data[first - 5] ^= 1;
    reading_end(&r);
  }
}
#endif

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
    cmocka_unit_test(formats_by_name_and_extension),
    cmocka_unit_test(a_frame_of_a_dump),
    cmocka_unit_test(columns_of_a_dump),
    cmocka_unit_test(tilted_boxes),
    cmocka_unit_test(data_of_lammps),
    cmocka_unit_test(bonds_may_be_left_out),
    cmocka_unit_test(extended_xyz),
    cmocka_unit_test(turning_grains_of_xyz),
    cmocka_unit_test(any_line_ends),
    cmocka_unit_test(formats_without_rows),
    cmocka_unit_test(nothing_is_a_pack),
    cmocka_unit_test(a_table_without_z),
#if PACKING_I_HAVE_ZLIB
    cmocka_unit_test(compressed_text),
#endif
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
