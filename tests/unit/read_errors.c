/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every way to be malformed, by format: the line is named, and the store stays empty. */
#include "reading.h"

typedef struct malformed {
  const char *text;
  size_t line;
  const char *says;
} malformed;

static void refuse_all(packing_context *c, const char *format, const malformed *cases,
                       size_t count)
{
  for (size_t i = 0; i < count; i++)
    for (size_t chunk = 0; chunk < 2; chunk++) {
      char line[32];
      reading r = reading_begin(c, 3);
      snprintf(line, sizeof line, "line %zu: ", cases[i].line);
      const char *text = cases[i].text;
      const packing_status status = reading_bytes(&r, format, text, strlen(text), chunk);
      const char *message = packing_context_message(c);
      if (status != PACKING_ERR_FORMAT ||
          (cases[i].line > 0 && strncmp(message, line, strlen(line)) != 0) ||
          strstr(message, cases[i].says) == NULL)
        fail_msg("%s, case %zu: %s, \"%s\", not \"%s... %s\"", format, i,
                 packing_status_string(status), message, line, cases[i].says);
      assert_int_equal(packing_particles_count(r.particles), 0);
      assert_int_equal(packing_bonds_count(r.bonds), 0);
      reading_end(&r);
    }
}

#define REFUSE(format, cases)                                                            \
  refuse_all(*state, (format), (cases), sizeof(cases) / sizeof(cases)[0])

#define HEAD "x\n\n2 atoms\n1 atom types\n1 bonds\n1 bond types\n"
#define BOX "0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n"
#define ATOMS "\nAtoms # sphere\n\n1 1 0.2 9 0 0 0\n5 1 0.2 9 0.5 0 0 1 0 -1\n"

static void lammps(void **state)
{
  static const malformed cases[] = {
      {"", 1, "ends before its first line"},
      {"x\n", 2, "no line xlo xhi"},
      {"x\n" BOX "-1 atoms\n", 5, "atoms: \"-1\" is out of range"},
      {"x\n2.5 atoms\n", 2, "atoms: \"2.5\" is not a whole number"},
      {"x\n1 ellipsoids\n", 2, "ellipsoids: \"1\" is out of range"},
      {"x\n4 atoms of gold\n", 2, "\"4 atoms of gold\" is no line of a header"},
      {"x\n0 xlo xhi\n", 2, "\"0 xlo xhi\" is no line"},
      {"x\n0 nan xlo xhi\n", 2, "xlo xhi: \"nan\" is not a finite number"},
      {"x\n0 1 xlo xhi\n2 1 ylo yhi\n0 1 zlo zhi\n", 5, "from 2 to 1 along y"},
      {"x\n0 1 xlo xhi\n0 1 zlo zhi\n", 4, "no line ylo yhi"},
      {"x\n1 2 q xy xz yz\n", 2, "yz: \"q\" is not a finite number"},
      {HEAD BOX, 10, "no section Atoms"},
      {HEAD BOX ATOMS, 15, "no section Bonds"},
      {HEAD BOX "\nAtoms # atomic\n\n", 11, "atoms of style \"atomic\""},
      {HEAD BOX "\nAtoms # hybrid bond sphere\n\n", 11,
       "atoms of style \"hybrid bond sphere\""},
      {HEAD BOX "\nAtoms # hybrid sphere\n\n", 11, "atoms of style \"hybrid sphere\""},
      {HEAD BOX "\nAtoms\n1 1 0.2 9 0 0 0\n", 12, "must be blank"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0 0\n", 14, "ends before its last row"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0 0\n\nBonds\n", 14,
       "a blank line, 1 rows of Atoms are missing"},
      {HEAD BOX "\nAtoms\n\n0 1 0.2 9 0 0 0\n", 13, "id: \"0\" is out of range"},
      {HEAD BOX "\nAtoms\n\n1 2 0.2 9 0 0 0\n", 13, "type: \"2\" is out of range"},
      {HEAD BOX "\nAtoms\n\n1 1 0 9 0 0 0\n", 13, "the radius 0 must be above 0"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 0 0 0 0\n", 13, "the density 0 is not above 0"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0\n", 13, "x, y, z is missing"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0 0 1\n", 13, "image is missing"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0 0 1 1 1 1\n", 13, "\"1\" is too much"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0 0 1.5 1 1\n", 13, "image: \"1.5\""},
      {HEAD BOX "\nAtoms # hybrid\n\n1 1 0 0 0 0.2 9\n", 13, "molecule is missing"},
      {HEAD BOX "\nAtoms\n\n1 1 0.2 9 0 0 0\n1 1 0.2 9 0 0 0\n", 0,
       "id: 1 stands twice, in rows 1 and 2"},
      {HEAD BOX ATOMS "\nAtoms\n\n", 16, "a second section Atoms"},
      {HEAD BOX ATOMS "\n3\n", 16, "\"3\" stands where a section should begin"},
      {HEAD BOX ATOMS "\nEllipsoids\n\n", 16, "section \"Ellipsoids\""},
      {HEAD BOX "\nVelocities\n\n", 11, "Velocities stands before Atoms"},
      {HEAD BOX "\nBonds\n\n", 11, "Bonds stands before Atoms"},
      {HEAD BOX ATOMS "\nVelocities\n\n1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n", 19,
       "particle 2 is not there"},
      {HEAD BOX ATOMS "\nVelocities\n\n1 0 0 0 0 0 0\n1 0 0 0 0 0 0\n", 19,
       "particle 1 stands twice"},
      {HEAD BOX ATOMS "\nVelocities\n\n1 0 0 0\n", 18, "wx is missing"},
      {HEAD BOX ATOMS "\nVelocities\n\n1 0 0 0 0 0 0 0\n", 18, "\"0\" is too much"},
      {HEAD BOX ATOMS "\nVelocities\n\n1 0 0 0 0 0 0\n", 19, "ends before its last row"},
      {HEAD BOX ATOMS "\nBonds\n\n1 1 1 4\n", 18, "a bond to particle 4, which is not"},
      {HEAD BOX ATOMS "\nBonds\n\n1 1 5 5\n", 18, "a bond of particle 5 to itself"},
      {HEAD BOX ATOMS "\nBonds\n\n1 2 1 5\n", 18, "type: \"2\" is out of range"},
      {HEAD BOX ATOMS "\nBonds\n\n1 1 1\n", 18, "id is missing"},
      {HEAD BOX ATOMS "\nBonds\n\n1 1 1 5\n\nBonds\n\n", 20, "a second section Bonds"},
      {"x\n4294967296 atoms\n1 atom types\n" BOX "\nAtoms\n\n1 1 0.2 9 0 0 0\n", 11,
       "ends before its last row"},
      {"x\n9223372036854775808 atoms\n", 2, "is out of range"},
  };
  REFUSE("lammps", cases);
  REFUSE("liggghts", cases);
}

#define STEP "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n2\n"
#define CELL "ITEM: BOX BOUNDS pp ff ss\n0 1\n0 1\n0 1\n"

static void dump(void **state)
{
  static const malformed cases[] = {
      {"", 1, "ends before its first item"},
      {"\n", 1, "\"\" is no item"},
      {"ITEM: BONDS\n", 1, "\"ITEM: BONDS\" is no item of a dump"},
      {STEP, 5, "the file ends before the atoms of frame 0"},
      {"ITEM: TIMESTEP\n", 2, "ends before time step"},
      {"ITEM: TIMESTEP\nx\n", 2, "time step: \"x\""},
      {"ITEM: NUMBER OF ATOMS\n-1\n", 2, "number of atoms: \"-1\" is out of range"},
      {"ITEM: ATOMS id\n", 1, "ATOMS before TIMESTEP, NUMBER OF ATOMS or BOX BOUNDS"},
      {STEP "ITEM: BOX BOUNDS pq ff ff\n", 5, "no edges along x"},
      {STEP "ITEM: BOX BOUNDS pp ff\n", 5, "no edges along z"},
      {STEP "ITEM: BOX BOUNDS pp ff ff ff\n", 5, "\"ff\" is too much"},
      {STEP "ITEM: BOX BOUNDS abc origin\n", 5, "no edges along x"},
      {STEP "ITEM: BOX BOUNDS pp ff ff\n0 1\n0 1\n", 8, "ends before the bounds"},
      {STEP "ITEM: BOX BOUNDS pp ff ff\n0\n", 6, "upper bound is missing"},
      {STEP "ITEM: BOX BOUNDS pp ff ff\n0 1 2\n", 6, "\"2\" is too much"},
      {STEP "ITEM: BOX BOUNDS xy xz yz pp ff ff\n0 1\n", 6, "tilt is missing"},
      {STEP "ITEM: BOX BOUNDS\n0 1\n1 0\n0 1\n", 8, "the box goes from 1 to 0 along y"},
      {STEP CELL "ITEM: ATOMS id x y z\n", 9, "no column radius or diameter"},
      {STEP CELL "ITEM: ATOMS id x ys z radius\n", 9, "no columns x y z"},
      {STEP CELL "ITEM: ATOMS id x y z radius vx vz\n", 9, "column vy is missing"},
      {STEP CELL "ITEM: ATOMS id x y z radius omegaz\n", 9, "column omegax is missing"},
      {STEP CELL "ITEM: ATOMS id x y z radius x\n", 9, "column x stands twice"},
      {STEP CELL "ITEM: ATOMS x y z radius\n1 2 3 4\n", 11, "ends before the last atom"},
      {STEP CELL "ITEM: ATOMS x y z radius\n1 2 3\n", 10, "radius is missing"},
      {STEP CELL "ITEM: ATOMS x y z radius\n1 2 3 -4\n", 10, "the radius -4 must be"},
      {STEP CELL "ITEM: ATOMS x y z radius\n1 2 3 4 5\n", 10,
       "\"5\" behind the 4 columns"},
      {STEP CELL "ITEM: ATOMS x y z radius q\n1 2 3 4\n", 10,
       "4 words, the columns are 5"},
      {STEP CELL "ITEM: ATOMS x y z radius id\n1 2 3 4 5.5\n", 10, "id: \"5.5\""},
      {STEP CELL "ITEM: ATOMS xs ys zs radius\n1e308 1e308 1e999 4\n", 10,
       "zs: \"1e999\""},
      {STEP CELL "ITEM: ATOMS x y z radius\n1 2 3 4\n1 2 3 4\n1 2 3 4\n", 12,
       "\"1 2 3 4\" is no item"},
      {STEP CELL "ITEM: ATOMS x y z radius\n1 2 3 4\n1 2 3 4\n" STEP CELL
                 "ITEM: ATOMS x y z radius vx vy vz\n",
       20, "other columns than in the first frame"},
      {"ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n4294967296\n" CELL
       "ITEM: ATOMS x y z radius\n1 2 3 4\n",
       11, "ends before the last atom"},
  };
  REFUSE("dump", cases);
}

static void yade(void **state)
{
  static const malformed cases[] = {
      {"1 2 3\n", 1, "r is missing"},
      {"1 2 3 4 5\n", 1, "\"5\" is too much"},
      {"1,2,3,4\n", 1, "x: \"1,2,3,4\""},
      {"1 2 3 0\n", 1, "the radius 0"},
      {"1 2 3 4\n\n", 2, "a blank line"},
      {"\n", 1, "a blank line"},
      {"#format x_y_z\n", 1, "#format: \"x_y_z\" is not known"},
      {"#format\n", 1, "#format: \"\" is not known"},
      {"#format x_y_z_r_matId\n1 2 3 4\n", 2, "matId is missing"},
      {"#format x_y_z_r_matId\n1 2 3 4 1.5\n", 2, "matId: \"1.5\""},
      {"#format id_x_y_z_r_matId\n1 2 3 4 1\n", 2, "matId is missing"},
      {"1 2 3 4\n#format x_y_z_r_matId\n1 2 3 4 1\n", 2,
       "behind rows with other columns"},
      {"1 2 3 1e-400\n", 1, "the radius 0"},
  };
  static const malformed packs[] = {
      {"# a note\n1 2 3 4\n", 1, "x: \"#\""},
      {"1 2 3 4\n##PERIODIC:: 1 2 3\n", 2, "x: \"##PERIODIC::\""},
      {"##PERIODIC:: 1 2\n", 1, "the cell is missing"},
      {"##PERIODIC:: 1 2 3 4\n", 1, "\"4\" is too much"},
      {"##PERIODIC:: 1 -2 3\n", 1, "from 0 to -2 along y"},
      {"1 2 3 4 x\n", 1, "clumpId: \"x\""},
      {"1 2 3 4 -1 0\n", 1, "\"0\" is too much"},
      {"1 2 3 4 -1\n\n", 2, "a blank line"},
  };
  REFUSE("yade", cases);
  REFUSE("yade-pack", packs);
  packing_context *c = *state;
  reading r = reading_begin(c, 3);
  assert_fails(c, reading_text(&r, "yade-pack", "1 2 3 4 -1\n1 2 3 4 7\n"),
               PACKING_ERR_UNSUPPORTED, "line 2: a sphere of clump 7");
  reading_end(&r);
}

#define GEO                                                                              \
  "LSMGeometry 1.2\nBoundingBox 0 0 0 1 1 1\nPeriodicBoundaries 0 0 0\nDimension 3D\n"

static void geo(void **state)
{
  static const malformed cases[] = {
      {"", 1, "ends before LSMGeometry"},
      {"LSM 1.2\n", 1, "\"LSM 1.2\" stands where LSMGeometry should"},
      {"LSMGeometry 1.3\n", 1, "not version 1.2"},
      {"LSMGeometry 1.2\nBoundingBox 0 0 0 1 1\n", 2, "BoundingBox is missing"},
      {"LSMGeometry 1.2\nBoundingBox 0 0 2 1 1 1\n", 2, "from 2 to 1 along z"},
      {"LSMGeometry 1.2\nBoundingBox 0 0 0 1 1 1\nPeriodicBoundaries 0 2 0\n", 3,
       "PeriodicBoundaries: \"2\" is out of range"},
      {"LSMGeometry 1.2\nBoundingBox 0 0 0 1 1 1\nPeriodicBoundaries 0 1 0\nDimension "
       "4D\n",
       4, "neither 2D nor 3D"},
      {GEO "BeginParticles\nClumps\n", 6, "\"Clumps\" stands where Simple should"},
      {GEO "BeginParticles\nSimple\n-1\n", 7, "count: \"-1\" is out of range"},
      {GEO "BeginParticles\nSimple\n1 1\n", 7, "\"1\" is too much"},
      {GEO "BeginParticles\nSimple\n4294967296\n1 2 3 4 0 0\n", 9,
       "ends before the last particle"},
      {GEO "BeginParticles\nSimple\n1\n1 2 3 4 0\n", 8, "tag is missing"},
      {GEO "BeginParticles\nSimple\n1\n1 2 3 4 0 0 0\n", 8, "\"0\" is too much"},
      {GEO "BeginParticles\nSimple\n1\n1 2 3 0 0 0\n", 8, "the radius 0"},
      {GEO "BeginParticles\nSimple\n1\n1 2 3 4 0 0\n1 2 3 4 1 0\nEndParticles\n", 9,
       "stands where EndParticles should"},
      {GEO "BeginParticles\nSimple\n0\nEndParticles\n", 9, "ends before BeginConnect"},
      {GEO "BeginParticles\nSimple\n1\n1 2 3 4 0 0\nEndParticles\nBeginConnect\n9\n", 12,
       "ends before the last connection"},
      {GEO
       "BeginParticles\nSimple\n1\n1 2 3 4 0 0\nEndParticles\nBeginConnect\n1\n0 1 2\n",
       12, "a bond to particle 1"},
      {GEO "BeginParticles\nSimple\n0\nEndParticles\nBeginConnect\n0\nEnd\n", 11,
       "\"End\" stands where EndConnect should"},
      {GEO "BeginParticles\nSimple\n0\nEndParticles\nBeginConnect\n0\nEndConnect\nmore\n",
       12, "\"more\" is too much"},
      {"LSMGeometry 1.2\nBoundingBox 0 0 0 1 1 1\nPeriodicBoundaries 0 0 0\nDimension "
       "2D\n"
       "BeginParticles\nSimple\n1\n1 2 3 4 0 0\n",
       8, "z is 3 in two dimensions"},
  };
  REFUSE("geo", cases);
}

#define PROPERTIES "Properties=pos:R:3:radius:R:1 "

static void xyz(void **state)
{
  static const malformed cases[] = {
      {"", 1, "ends before its first line"},
      {"x\n", 1, "count: \"x\""},
      {"1 2\n", 1, "\"2\" is too much"},
      {"1\n", 2, "ends before the line of properties"},
      {"1\na comment\nX 1 2 3\n", 2, "no pos"},
      {"1\nProperties=pos:R:3\n", 2, "no radius or diameter"},
      {"1\nProperties=pos:R:2:radius:R:1\n", 2, "\"pos\" has another type or number"},
      {"1\nProperties=pos:S:3:radius:R:1\n", 2, "\"pos\" has another type or number"},
      {"1\nProperties=pos:Q:3\n", 2, "\"pos\" has no type"},
      {"1\nProperties=pos:R:0\n", 2, "\"pos\" has no number of columns"},
      {"1\nProperties=pos:R:x\n", 2, "\"pos\" has no number of columns"},
      {"1\nProperties=pos:R\n", 2, "\"pos\" has no number of columns"},
      {"1\nProperties=pos:R:3:radius:R:1:pos:R:3\n", 2, "\"pos\" stands twice"},
      {"1\n" PROPERTIES "Lattice=\"1 0 0 0 1 0 0 0\"\n", 2, "Lattice is missing"},
      {"1\n" PROPERTIES "Lattice=\"1 0 0 0 1 0 0 0 1 1\"\n", 2, "\"1\" is too much"},
      {"1\n" PROPERTIES "Lattice=\"1 1 0 0 1 0 0 0 1\"\n", 2, "does not point along x"},
      {"1\n" PROPERTIES "Lattice=\"1 0 0 0 1 0 0 0 -1\"\n", 2, "from 0 to -1 along z"},
      {"1\n" PROPERTIES "Lattice=\"1 0 0 0 1 0 0 0 1\n", 2, "an open quote"},
      {"1\n" PROPERTIES "\"alone\"\n", 2, "a quote without a key"},
      {"1\n" PROPERTIES "pbc=\"T F\"\n", 2, "pbc is not three of T and F"},
      {"1\n" PROPERTIES "pbc=\"T F T T\"\n", 2, "\"T\" is too much"},
      {"1\n" PROPERTIES "Time=soon\n", 2, "Time: \"soon\""},
      {"1\n" PROPERTIES "Lattice=\"1 0 0 0 1 0 0 0 1\" Origin=\"0 0\"\n", 2,
       "Origin is missing"},
      {"2\n" PROPERTIES "\n1 2 3 4\n", 4, "ends before its last row"},
      {"1\n" PROPERTIES "\n1 2 3\n", 3, "radius is missing"},
      {"1\n" PROPERTIES "\n1 2 3 4 5\n", 3, "\"5\" is too much"},
      {"1\n" PROPERTIES "\n1 2 3 0\n", 3, "the radius 0"},
      {"1\n" PROPERTIES "\n1 2 3 4\n\n", 4, "count is missing"},
      {"1\nProperties=pos:R:3:radius:R:1:name:S:2\n1 2 3 4 five\n", 3,
       "fewer columns than Properties names"},
      {"1\nProperties=pos:R:3:radius:R:1:id:I:1\n1 2 3 4 5.5\n", 3, "id: \"5.5\""},
      {"4294967296\n" PROPERTIES "\n1 2 3 4\n", 4, "ends before its last row"},
      {"1\n" PROPERTIES "\n1 2 3 4\n1\nProperties=pos:R:3:radius:R:1:id:I:1\n1 2 3 4 5\n",
       5, "other columns than in the first frame"},
  };
  REFUSE("xyz", cases);
}

static void csv(void **state)
{
  static const malformed cases[] = {{"x,y,z,r\n1,2,3,0\n", 2, "r: 0 must be above 0"}};
  REFUSE("csv", cases);
}

static void xyzd(void **state)
{
  packing_context *c = *state;
  double rows[2][4] = {{1, 2, 3, 0.5}, {4, 5, 6, 0.5}};
  reading r = reading_begin(c, 3);
  assert_fails(c, reading_bytes(&r, "xyzd", rows, sizeof rows - 1, 0), PACKING_ERR_FORMAT,
               "byte 32: the file ends within a row");
  rows[1][3] = -1;
  assert_fails(c, reading_bytes(&r, "xyzd", rows, sizeof rows, 0), PACKING_ERR_FORMAT,
               "byte 32: the radius -0.5");
  rows[1][3] = 1;
  rows[1][0] = (double)NAN;
  assert_fails(c, reading_bytes(&r, "xyzd", rows, sizeof rows, 3), PACKING_ERR_FORMAT,
               "byte 32: the centre");
  rows[1][0] = (double)INFINITY;
  assert_fails(c, reading_bytes(&r, "xyzd", rows, sizeof rows, 3), PACKING_ERR_FORMAT,
               "not finite");
  assert_int_equal(packing_particles_count(r.particles), 0);
  reading_end(&r);
}

static packing_status unwilling(void *user, void *buffer, size_t capacity, size_t *count)
{
  (void)user;
  (void)buffer;
  *count = capacity + 1;
  return capacity == 0 ? PACKING_OK : PACKING_ERR_IO;
}

static packing_status boastful(void *user, void *buffer, size_t capacity, size_t *count)
{
  (void)user;
  (void)buffer;
  *count = capacity + 1;
  return PACKING_OK;
}

static void streams(void **state)
{
  packing_context *c = *state;
  packing_stream bad = {unwilling, NULL, NULL};
  for (size_t f = 0; packing_read_format(f) != NULL; f++) {
    reading r = reading_begin(c, 3);
    const char *format = packing_read_format(f);
    bad.read = unwilling;
    assert_fails(c, packing_read_pack(c, NULL, format, &bad, r.particles, NULL),
                 PACKING_ERR_IO, "stream");
    bad.read = boastful;
    assert_fails(c, packing_read_pack(c, NULL, format, &bad, r.particles, NULL),
                 PACKING_ERR_INVALID, "stream");
    reading_end(&r);
  }
}

static void arguments(void **state)
{
  packing_context *c = *state;
  reading r = reading_begin(c, 3);
  test_buffer buffer;
  test_buffer_text(&buffer, "1 2 3 4\n");
  packing_stream stream = test_buffer_stream(&buffer);
  packing_read_def def;
  packing_read_def_init(&def);
  assert_int_equal(def.frame, PACKING_FRAME_LAST);
  assert_fails(c, packing_read_pack(c, NULL, NULL, &stream, r.particles, NULL),
               PACKING_ERR_INVALID, "format");
  assert_fails(c, packing_read_pack(c, NULL, "pov\n", &stream, r.particles, NULL),
               PACKING_ERR_INVALID, "format: \"pov?\"");
  assert_fails(c, packing_read_pack(c, NULL, "yade", NULL, r.particles, NULL),
               PACKING_ERR_INVALID, "stream");
  assert_fails(c, packing_read_pack(c, NULL, "yade", &stream, NULL, NULL),
               PACKING_ERR_INVALID, "particles");
  stream.read = NULL;
  assert_fails(c, packing_read_pack(c, NULL, "yade", &stream, r.particles, NULL),
               PACKING_ERR_INVALID, "stream");
  stream = test_buffer_stream(&buffer);
  def.frame = -2;
  assert_fails(c, packing_read_pack(c, &def, "yade", &stream, r.particles, NULL),
               PACKING_ERR_RANGE, "frame");
  def.frame = 1;
  assert_fails(c, packing_read_pack(c, &def, "yade", &stream, r.particles, NULL),
               PACKING_ERR_RANGE, "frame: 1, the file has 1");
  def.frame = 0;
  def.sort = 2;
  assert_fails(c, packing_read_pack(c, &def, "yade", &stream, r.particles, NULL),
               PACKING_ERR_RANGE, "sort");
  def.sort = 1;
  buffer.read_at = 0;
  assert_fails(c, packing_read_pack(c, &def, "yade", &stream, r.particles, NULL),
               PACKING_ERR_FORMAT, "sort: the file has no ids");
  def.sort = 0;
  def.radius_name = def.diameter_name = "x";
  assert_fails(c, packing_read_pack(c, &def, "yade", &stream, r.particles, NULL),
               PACKING_ERR_INVALID, "diameter_name");
  def.struct_size = 4;
  assert_status(packing_read_pack(c, &def, "yade", &stream, r.particles, NULL),
                PACKING_ERR_ABI);
  buffer.read_at = 0;
  r.info.struct_size = 0;
  assert_status(packing_read_pack(c, NULL, "yade", &stream, r.particles, &r.info),
                PACKING_ERR_ABI);
  assert_int_equal(packing_particles_count(r.particles), 0);
  buffer.read_at = 0;
  assert_ok(packing_read_pack(NULL, NULL, "yade", &stream, r.particles, NULL));
  assert_fails(c, packing_read_pack(c, NULL, "yade", &stream, r.particles, NULL),
               PACKING_ERR_RANGE, "particles");
  assert_fails(c, packing_bonds_create(c, NULL), PACKING_ERR_INVALID, "bonds");
  packing_bonds_destroy(NULL);
  assert_int_equal(packing_bonds_count(NULL), 0);
  assert_null(packing_bonds_data(NULL));
  test_buffer_free(&buffer);
  reading_end(&r);
}

static void flat_stores(void **state)
{
  packing_context *c = *state;
  reading r = reading_begin(c, 2);
  assert_fails(c, reading_text(&r, "yade", "1 2 0 4\n1 2 3 4\n"), PACKING_ERR_FORMAT,
               "line 2: z is 3, the store has two dimensions");
  assert_fails(c, reading_text(&r, "csv", "x,y,z,r\n1,2,0,4\n"), PACKING_ERR_RANGE,
               "dimension");
  assert_ok(reading_text(&r, "yade", "1 2 0 4\n"));
  assert_int_equal(r.info.dim, 2);
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
      cmocka_unit_test(lammps),    cmocka_unit_test(dump),
      cmocka_unit_test(yade),      cmocka_unit_test(geo),
      cmocka_unit_test(xyz),       cmocka_unit_test(csv),
      cmocka_unit_test(xyzd),      cmocka_unit_test(streams),
      cmocka_unit_test(arguments), cmocka_unit_test(flat_stores),
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
