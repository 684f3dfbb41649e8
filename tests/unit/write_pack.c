/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing_write_pack(): the exact bytes of a small pack in each format, and the same pack read
 * back. */
#include "test.h"

static const double x[] = {0.25, 0.5}, y[] = {0.5, 0.125}, z[] = {0.75, 0.5},
                    r[] = {0.125, 0.0625}, v[] = {3, -1};
static const packing_bond bond[] = {{0, 1, 2}};

static packing_write_def def;
static packing_view view;

/* Two spheres in the unit box. */
static void begin(void)
{
  packing_write_def_init(&def);
  def.box.hi.x = def.box.hi.y = def.box.hi.z = 1;
  packing_view_init_arrays(&view, 2, x, y, z, r);
}

static void begin_flat(void)
{
  begin();
  def.dim = 2;
  view.z.data = NULL;
}

static test_buffer written(const char *format)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  assert_ok(packing_write_pack(NULL, &def, format, &view, &stream));
  return buffer;
}

static void assert_writes(const char *format, const char *want)
{
  test_buffer buffer = written(format);
  assert_string_equal(buffer.data, want);
  test_buffer_free(&buffer);
}

static void plain_formats_are_those_of_io(void **state)
{
  (void)state;
  static const char *const keys[] = {"seed"}, *const values[] = {"7"};
  begin();
  def.note_count = 1;
  def.keys = keys;
  def.values = values;
  assert_writes("csv", "# seed: 7\nx,y,z,r\n0.25,0.5,0.75,0.125\n0.5,0.125,0.5,0.0625\n");
  assert_writes("yade", "0.25\t0.5\t0.75\t0.125\n0.5\t0.125\t0.5\t0.0625\n");
  assert_writes("yade-pack", "0.25\t0.5\t0.75\t0.125\n0.5\t0.125\t0.5\t0.0625\n");
  def.periodic = 7;
  assert_writes("yade-pack",
                "##PERIODIC:: 1 1 1\n0.25\t0.5\t0.75\t0.125\n0.5\t0.125\t0.5\t0.0625\n");
}

static void lammps_data_takes_bonds_liggghts_data_does_not(void **state)
{
  (void)state;
  begin();
  def.title = "two";
  def.density = 2650;
  def.bonds = bond;
  def.bond_count = 1;
  assert_writes("lammps", "two\n\n2 atoms\n1 atom types\n1 bonds\n2 bond types\n\n"
                          "0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
                          "Atoms # hybrid\n\n"
                          "1 1 0.25 0.5 0.75 0.25 2650 1\n"
                          "2 1 0.5 0.125 0.5 0.125 2650 1\n\n"
                          "Bonds\n\n1 2 1 2\n");
  assert_writes("liggghts", "two\n\n2 atoms\n1 atom types\n\n"
                            "0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
                            "Atoms # sphere\n\n"
                            "1 1 0.25 2650 0.25 0.5 0.75\n"
                            "2 1 0.125 2650 0.5 0.125 0.5\n");
}

static void a_dump_is_exact(void **state)
{
  (void)state;
  begin();
  def.periodic = PACKING_PERIODIC_Y;
  assert_writes("dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\n"
                        "ITEM: BOX BOUNDS ff pp ff\n0 1\n0 1\n0 1\n"
                        "ITEM: ATOMS id type radius x y z\n"
                        "1 1 0.125 0.25 0.5 0.75\n2 1 0.0625 0.5 0.125 0.5\n");
  view.vy.data = view.wx.data = v;
  view.vy.stride = view.wx.stride = sizeof v[0];
  view.count = 1;
  assert_writes("dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n"
                        "ITEM: BOX BOUNDS ff pp ff\n0 1\n0 1\n0 1\n"
                        "ITEM: ATOMS id type radius x y z vx vy vz omegax omegay omegaz\n"
                        "1 1 0.125 0.25 0.5 0.75 0 3 0 3 0 0\n");
}

static void geo_is_exact(void **state)
{
  (void)state;
  begin();
  def.bonds = bond;
  def.bond_count = 1;
  def.periodic = PACKING_PERIODIC_X;
  assert_writes("geo", "LSMGeometry 1.2\nBoundingBox 0 0 0 1 1 1\n"
                       "PeriodicBoundaries 1 0 0\nDimension 3D\n"
                       "BeginParticles\nSimple\n2\n"
                       "0.25 0.5 0.75 0.125 0 1\n0.5 0.125 0.5 0.0625 1 1\n"
                       "EndParticles\nBeginConnect\n1\n0 1 2\nEndConnect\n");
  static const int64_t id[] = {0, 70};
  static const int32_t type[] = {5, -6};
  begin_flat();
  view.id.data = id;
  view.id.stride = sizeof id[0];
  view.type.data = type;
  view.type.stride = sizeof type[0];
  assert_writes("geo", "LSMGeometry 1.2\nBoundingBox 0 0 -0.125 1 1 0.125\n"
                       "PeriodicBoundaries 0 0 0\nDimension 2D\n"
                       "BeginParticles\nSimple\n2\n"
                       "0.25 0.5 0 0.125 0 5\n0.5 0.125 0 0.0625 70 -6\n"
                       "EndParticles\nBeginConnect\n0\nEndConnect\n");
}

static void xyz_takes_the_columns_that_there_are(void **state)
{
  (void)state;
  static const int32_t type[] = {3};
  static const double q[] = {0.5, 0.25, -0.25, 0.75}; /* w, x, y, z */
  begin();
  view.count = 1;
  view.type.data = type;
  view.vx.data = v;
  view.wz.data = r;
  view.qw.data = q;
  view.qx.data = q + 1;
  view.qy.data = q + 2;
  view.qz.data = q + 3;
  def.time = 1.5;
  assert_writes("xyz",
                "1\nLattice=\"1 0 0 0 1 0 0 0 1\" Origin=\"0 0 0\" "
                "Properties=species:S:1:pos:R:3:radius:R:1:id:I:1:type:I:1:velo:R:3:"
                "angular_velocity:R:3:orientation:R:4 pbc=\"F F F\" Time=1.5\n"
                "X 0.25 0.5 0.75 0.125 1 3 3 0 0 0 0 0.125 0.25 -0.25 0.75 0.5\n");
}

static void pfc_and_neper_and_mercury_are_exact(void **state)
{
  (void)state;
  begin();
  def.title = "two balls";
  assert_writes("pfc",
                "; two balls\nmodel new\nmodel domain extent 0 1 0 1 0 1\n"
                "ball create id 1 position 0.25 0.5 0.75 radius 0.125 group 'type1'\n"
                "ball create id 2 position 0.5 0.125 0.5 radius 0.0625 group 'type1'\n");
  assert_writes("neper-coo", "0.25 0.5 0.75\n0.5 0.125 0.5\n");
  assert_writes("neper-weight", "0.125\n0.0625\n");
  def.time = 2;
  view.vz.data = v;
  view.vz.stride = sizeof v[0];
  assert_writes("mercury", "2 2 0 0 0 1 1 1\n"
                           "0.25 0.5 0.75 0 0 3 0.125 0 0 0 0 0 0 0\n"
                           "0.5 0.125 0.5 0 0 -1 0.0625 0 0 0 0 0 0 0\n");
  begin_flat();
  def.periodic = PACKING_PERIODIC_X;
  assert_writes("pfc",
                "; pack written by libpacking\nmodel new\n"
                "model domain extent 0 1 0 1 condition periodic destroy\n"
                "ball create id 1 position 0.25 0.5 radius 0.125 group 'type1'\n"
                "ball create id 2 position 0.5 0.125 radius 0.0625 group 'type1'\n");
  assert_writes("neper-coo", "0.25 0.5\n0.5 0.125\n");
}

static void assert_holds(const test_buffer *b, const char *text)
{
  if (strstr(b->data, text) == NULL)
    fail_msg("no \"%s\" in\n%s", text, b->data);
}

static void the_deck_of_a_box(void **state)
{
  (void)state;
  packing_deck_def deck;
  packing_deck_def_init(&deck);
  deck.data_name = "a/b-1.data";
  deck.timestep = 0.5;
  deck.poisson_ratio = 0.25;
  deck.youngs_modulus = 1e6;
  deck.down.x = 3;
  deck.down.z = -4;
  deck.gravity = 2;
  deck.steps = 77;
  begin();
  def.periodic = PACKING_PERIODIC_X;
  def.deck = &deck;
  test_buffer b = written("lammps-deck");
  assert_holds(&b, "variable        steps index 77\n");
  assert_holds(&b, "variable        gravity index 2\n");
  assert_holds(&b, "\ndimension       3\nboundary        p m m\n");
  assert_holds(&b, "\natom_style      sphere\n");
  assert_holds(&b, "\nread_data       a/b-1.data\n");
  assert_holds(&b, " hertz/material 1000000 0.5 0.25 tangential mindlin NULL 1.0 0.5 ");
  assert_holds(&b, "${gravity} vector 0.59999999999999998 0 -0.80000000000000004\n");
  assert_holds(&b, " yplane 0 NULL\n");
  assert_holds(&b, " yplane NULL 1\n");
  assert_holds(&b, " zplane NULL 1\n");
  assert_null(strstr(b.data, "xplane"));
  assert_holds(&b, "\ntimestep        0.5\n");
  assert_holds(&b, "\nrun             ${steps}\n");
  test_buffer_free(&b);
  b = written("liggghts-deck");
  assert_holds(&b, "\nsoft_particles  yes\n");
  assert_holds(&b, " primitive type 1 yplane 1\n");
  assert_null(strstr(b.data, "mesh"));
  test_buffer_free(&b);
}

/* Rayleigh's time of the smallest particle: pi .0625 sqrt(1000 (2 1.3) / 1e7) / .92553 / 5. */
static void the_time_step_is_a_fifth_of_rayleighs(void **state)
{
  (void)state;
  begin_flat();
  test_buffer b = written("lammps-deck");
  const char *at = strstr(b.data, "timestep        ");
  assert_non_null(at);
  assert_close(strtod(at + 16, NULL), 6.84157447986616e-4, 1e-12);
  assert_holds(&b, "\ndimension       2\nboundary        m m p\n");
  assert_holds(&b, " vector 0 -1 0\nfix             flat all enforce2d\n");
  assert_holds(&b, "nve/sphere disc\n");
  assert_holds(&b, " yplane 0 NULL\n");
  assert_null(strstr(b.data, "zplane"));
  test_buffer_free(&b);
}

static void bonds_stand_in_lammpss_deck(void **state)
{
  (void)state;
  begin();
  def.bonds = bond;
  def.bond_count = 1;
  test_buffer b = written("lammps-deck");
  assert_holds(&b, "\natom_style      hybrid sphere bond\n");
  assert_holds(&b, "\nbond_style      zero nocoeff\nbond_coeff      *\n");
  test_buffer_free(&b);
}

static packing_domain *cone(void)
{
  packing_domain_cone_def cone_def;
  packing_domain *domain = NULL;
  packing_domain_cone_def_init(&cone_def);
  cone_def.bottom_radius = 2;
  cone_def.top_radius = 1;
  cone_def.height = 2;
  cone_def.base.x = -1;
  cone_def.axis = PACKING_AXIS_X;
  assert_ok(packing_domain_create_cone(NULL, &cone_def, &domain));
  return domain;
}

static void a_cone_becomes_a_region_or_a_mesh(void **state)
{
  (void)state;
  packing_domain *domain = cone();
  begin();
  def.domain = domain;
  test_buffer b = written("lammps-deck");
  assert_holds(&b, " xplane -1 NULL\n");
  assert_holds(&b, " xplane NULL 1\n");
  /* goes on by twice the largest radius, .25, and so widens by .125 */
  assert_holds(&b, " cone x 0 0 2.125 0.875 -1.25 1.25 open 1 open 2\n");
  test_buffer_free(&b);
  b = written("liggghts-deck");
  assert_holds(&b, " all mesh/surface file container.stl type 1\n");
  assert_null(strstr(b.data, "primitive"));
  test_buffer_free(&b);
  packing_domain_destroy(domain);
}

/* Without a box a file takes the domain's, wider where particles stand out of an open top. */
static void the_box_is_that_of_the_domain(void **state)
{
  (void)state;
  packing_domain_box_def box_def;
  packing_domain *domain = NULL;
  packing_domain_box_def_init(&box_def);
  box_def.size.x = 4;
  box_def.size.y = 2;
  box_def.size.z = 0.875;
  box_def.periodic = PACKING_PERIODIC_X;
  box_def.open_top = 1;
  box_def.corner.x = -1;
  assert_ok(packing_domain_create_box(NULL, &box_def, &domain));
  begin();
  memset(&def.box, 0, sizeof def.box);
  def.domain = domain;
  view.z.data = y;
  view.y.data = z; /* the highest at z = .625 */
  test_buffer b = written("dump");
  assert_holds(&b, "ITEM: BOX BOUNDS pp ff ff\n-1 3\n0 2\n0 0.875\n");
  test_buffer_free(&b);
  view.z.data = z; /* up to .75 + .125 */
  static const double high[] = {1, 1.5};
  view.z.data = high;
  b = written("dump");
  assert_holds(&b, "ITEM: BOX BOUNDS pp ff ff\n-1 3\n0 2\n0 1.5625\n");
  test_buffer_free(&b);
  packing_domain_destroy(domain);
}

static void a_scene_shows_spheres_and_walls(void **state)
{
  (void)state;
  packing_domain *domain = cone();
  begin();
  test_buffer b = written("pov");
  assert_holds(&b, "\nsphere { <0.25,0.5,0.75>, 0.125 texture { S31 } }\n"
                   "sphere { <0.5,0.125,0.5>, 0.0625 texture { S0 } }\n");
  assert_holds(&b, "\n  look_at <0.5,0.5,0.5>\n");
  assert_null(strstr(b.data, "mesh"));
  test_buffer_free(&b);
  def.domain = domain;
  b = written("pov");
  assert_holds(&b, "\nmesh {\ntriangle { <");
  test_buffer_free(&b);
  packing_domain_destroy(domain);
  packing_domain *flat = test_rectangle(1, 1, 0);
  begin_flat();
  def.domain = flat;
  b = written("pov");
  assert_null(strstr(b.data, "mesh"));
  assert_holds(&b, "\n  sky y\n");
  test_buffer_free(&b);
  packing_domain_destroy(flat);
}

static void a_vtu_is_exact(void **state)
{
  (void)state;
  const uint16_t one = 1;
  if (*(const unsigned char *)&one != 1)
    skip();
  begin();
  def.bonds = bond;
  def.bond_count = 1;
  test_buffer b = written("vtu");
  static const char xml[] =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"2\" NumberOfCells=\"3\">\n"
      "<PointData Scalars=\"radius\">\n"
      "<DataArray type=\"Float64\" Name=\"radius\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"0\"/>\n"
      "</PointData>\n"
      "<Points>\n"
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
      "format=\"appended\" offset=\"24\"/>\n"
      "</Points>\n"
      "<Cells>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"80\"/>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"120\"/>\n"
      "<DataArray type=\"UInt8\" Name=\"types\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"152\"/>\n"
      "</Cells>\n"
      "<CellData>\n"
      "<DataArray type=\"Int32\" Name=\"bond\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"163\"/>\n"
      "</CellData>\n"
      "</Piece>\n"
      "</UnstructuredGrid>\n"
      "<AppendedData encoding=\"raw\">\n_";
  const double points[] = {x[0], y[0], z[0], x[1], y[1], z[1]};
  const int64_t connectivity[] = {0, 1, 0, 1}, offsets[] = {1, 2, 4};
  const unsigned char types[] = {1, 1, 3};
  const int32_t bonds[] = {0, 0, 2};
  const struct {
    const void *data;
    size_t size;
  } arrays[] = {{r, sizeof r},
                {points, sizeof points},
                {connectivity, sizeof connectivity},
                {offsets, sizeof offsets},
                {types, sizeof types},
                {bonds, sizeof bonds}};
  const char *at = b.data + strlen(xml);
  assert_memory_equal(b.data, xml, strlen(xml));
  for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
    uint64_t size;
    memcpy(&size, at, sizeof size);
    assert_int_equal(size, arrays[i].size);
    assert_memory_equal(at + sizeof size, arrays[i].data, arrays[i].size);
    at += sizeof size + arrays[i].size;
  }
  assert_string_equal(at, "\n</AppendedData>\n</VTKFile>\n");
  test_buffer_free(&b);
}

static void a_collection_is_exact(void **state)
{
  (void)state;
  static const packing_pvd_entry entries[] = {{"a.vtp", 0, 0}, {"b<\"&>.vtu", 0.25, 3}};
  test_buffer b = {0};
  const packing_stream stream = test_buffer_stream(&b);
  assert_ok(packing_write_pvd(NULL, entries, 2, &stream));
  assert_string_equal(
      b.data,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
      "<Collection>\n<DataSet timestep=\"0\" part=\"0\" file=\"a.vtp\"/>\n"
      "<DataSet timestep=\"0.25\" part=\"3\" file=\"b&lt;&quot;&amp;&gt;.vtu\"/>\n"
      "</Collection>\n</VTKFile>\n");
  test_buffer_free(&b);
}

/* What one end wrote the other end reads, bit for bit. */
static void formats_come_back(void **state)
{
  (void)state;
  static const char *const formats[] = {"csv",  "vtp",       "vtu", "lammps", "dump",
                                        "yade", "yade-pack", "geo", "xyz",    "liggghts"};
  for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
    packing_particles *store = test_store(3);
    packing_bonds *bonds = NULL;
    packing_read_def read_def;
    packing_view got;
    assert_ok(packing_bonds_create(NULL, &bonds));
    packing_read_def_init(&read_def);
    read_def.bonds = bonds;
    begin();
    def.bonds = bond;
    def.bond_count = 1;
    test_buffer b = written(formats[f]);
    const packing_stream stream = test_buffer_stream(&b);
    assert_ok(packing_read_pack(NULL, &read_def, formats[f], &stream, store, NULL));
    packing_particles_view(store, &got);
    assert_int_equal(got.count, 2);
    for (size_t i = 0; i < 2; i++) {
      const packing_column *const columns[] = {&got.x, &got.y, &got.z, &got.r};
      const double want[] = {x[i], y[i], z[i], r[i]};
      for (int k = 0; k < 4; k++)
        assert_memory_equal((const char *)columns[k]->data + i * columns[k]->stride,
                            &want[k], sizeof want[k]);
    }
    packing_bonds_destroy(bonds);
    packing_particles_destroy(store);
    test_buffer_free(&b);
  }
}

static void bonds_come_back(void **state)
{
  (void)state;
  static const char *const formats[] = {"lammps", "geo"};
  for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
    packing_particles *store = test_store(3);
    packing_bonds *bonds = NULL;
    packing_read_def read_def;
    assert_ok(packing_bonds_create(NULL, &bonds));
    packing_read_def_init(&read_def);
    read_def.bonds = bonds;
    begin();
    def.bonds = bond;
    def.bond_count = 1;
    test_buffer b = written(formats[f]);
    const packing_stream stream = test_buffer_stream(&b);
    assert_ok(packing_read_pack(NULL, &read_def, formats[f], &stream, store, NULL));
    assert_int_equal(packing_bonds_count(bonds), 1);
    const packing_bond *got = packing_bonds_data(bonds);
    assert_true(got->i == 0 && got->j == 1 && got->type == 2);
    packing_bonds_destroy(bonds);
    packing_particles_destroy(store);
    test_buffer_free(&b);
  }
}

static void formats_are_told_apart(void **state)
{
  (void)state;
  size_t count = 0;
  for (; packing_write_format_at(count) != NULL; count++) {
    const packing_write_format *f = packing_write_format_at(count);
    assert_int_equal(f->struct_size, sizeof *f);
    assert_true(strlen(f->holds) > 0 && strlen(f->program) > 0);
    assert_true(f->verified == (strstr(f->program, "not verified") == NULL));
    assert_ptr_equal(packing_write_format_find(f->name),
                     f); /* the only one of its name */
  }
  assert_int_equal(count, 19);
  assert_null(packing_write_format_at((size_t)-1));
  assert_null(packing_write_format_find("pack"));
  assert_null(packing_write_format_find(NULL));
}

static void extensions_stand_for_formats(void **state)
{
  (void)state;
  static const char *const known[][2] = {
      {"a.csv", "csv"},     {"x/b.vtp", "vtp"}, {"b.vtu", "vtu"}, {"a.b.data", "lammps"},
      {"./c.dump", "dump"}, {"c.geo", "geo"},   {"c.xyz", "xyz"}, {"c.extxyz", "xyz"},
      {"c.pov", "pov"},     {"c.stl", "stl"},   {"c.txt", "yade"}};
  static const char *const unknown[] = {"",   "csv",  ".csv",   "a/.csv", "a.csv/b",
                                        "a.", "a.xy", "a.xyz ", "in.pack"};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
    assert_non_null(packing_write_format_of(known[i][0]));
    assert_string_equal(packing_write_format_of(known[i][0])->name, known[i][1]);
  }
  for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; i++)
    assert_null(packing_write_format_of(unknown[i]));
  assert_null(packing_write_format_of(NULL));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plain_formats_are_those_of_io),
      cmocka_unit_test(lammps_data_takes_bonds_liggghts_data_does_not),
      cmocka_unit_test(a_dump_is_exact),
      cmocka_unit_test(geo_is_exact),
      cmocka_unit_test(xyz_takes_the_columns_that_there_are),
      cmocka_unit_test(pfc_and_neper_and_mercury_are_exact),
      cmocka_unit_test(the_deck_of_a_box),
      cmocka_unit_test(the_time_step_is_a_fifth_of_rayleighs),
      cmocka_unit_test(bonds_stand_in_lammpss_deck),
      cmocka_unit_test(a_cone_becomes_a_region_or_a_mesh),
      cmocka_unit_test(the_box_is_that_of_the_domain),
      cmocka_unit_test(a_scene_shows_spheres_and_walls),
      cmocka_unit_test(a_vtu_is_exact),
      cmocka_unit_test(a_collection_is_exact),
      cmocka_unit_test(formats_come_back),
      cmocka_unit_test(bonds_come_back),
      cmocka_unit_test(formats_are_told_apart),
      cmocka_unit_test(extensions_stand_for_formats),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
