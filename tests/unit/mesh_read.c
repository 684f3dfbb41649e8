/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes from files of each format, told by content or by name; what is broken is refused with its
 * line or byte. */
#include "mesh_scenes.h"

static packing_context *context;

static int set_up(void **state)
{
  (void)state;
  context = test_context(1, PACKING_ISA_AUTO);
  return 0;
}

static int tear_down(void **state)
{
  (void)state;
  packing_context_destroy(context);
  return 0;
}

typedef packing_mesh_format format_t;

static packing_status read_bytes(const void *data, size_t size, size_t chunk,
                                 format_t format, packing_mesh **mesh)
{
  test_buffer buffer = {0};
  packing_read_mesh_def def;
  packing_read_mesh_def_init(&def);
  def.format = format;
  buffer.data = malloc(size + 1);
  assert_non_null(buffer.data);
  memcpy(buffer.data, data, size);
  buffer.size = size;
  buffer.chunk = chunk;
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_read_mesh(context, &def, &stream, mesh);
  test_buffer_free(&buffer);
  return status;
}

/* A mesh that must come out as the corner of a cube: 4 vertices, 4 triangles, volume 1 / 6. */
static void check_corner(const packing_mesh *mesh)
{
  packing_mesh_view v;
  packing_mesh_report r;
  packing_mesh_view_init(&v);
  packing_mesh_report_init(&r);
  assert_ok(packing_mesh_arrays(context, mesh, &v));
  assert_int_equal(v.vertex_count, 4);
  assert_int_equal(v.triangle_count, 4);
  assert_close(packing_mesh_volume(mesh), 1.0 / 6, 1e-15);
  assert_ok(packing_mesh_check(context, mesh, &r));
  assert_int_equal(r.defect, PACKING_MESH_SOUND);
}

static void check_both(const void *data, size_t size, format_t format)
{
  const size_t chunks[] = {0, 1, 7};
  for (int i = 0; i < 6; i++) {
    packing_mesh *mesh = NULL;
    assert_ok(read_bytes(data, size, chunks[i / 2],
                         i % 2 ? format : PACKING_MESH_FORMAT_AUTO, &mesh));
    check_corner(mesh);
    packing_mesh_destroy(mesh);
  }
}

static void check_text(const char *text, format_t format)
{
  check_both(text, strlen(text), format);
}

static void refuse_bytes(const void *data, size_t size, format_t format,
                         packing_status status, const char *says)
{
  packing_mesh *mesh = NULL;
  assert_status(read_bytes(data, size, 3, format, &mesh), status);
  assert_null(mesh);
  const char *message = packing_context_message(context);
  assert_null(strchr(message, '\n'));
  if (strstr(message, says) == NULL)
    fail_msg("\"%s\" does not say \"%s\"", message, says);
}

static void refuse_text(const char *text, packing_status status, const char *says)
{
  refuse_bytes(text, strlen(text), PACKING_MESH_FORMAT_AUTO, status, says);
}

/* ---- STL ---- */

#define FACET(x, y, z)                                                                   \
  "facet normal 0 0 1\n  outer loop\n    vertex " x "\n    vertex " y "\n    vertex " z  \
  "\n  endloop\nendfacet\n"
#define O "0 0 0"
#define X "1 0 0"
#define Y "0 1 0"
#define Z "0 0 1"
#define CORNER FACET(O, Y, X) FACET(O, X, Z) FACET(O, Z, Y) FACET(X, Y, Z)

static void test_stl_text(void **state)
{
  (void)state;
  check_text("solid a corner\n" CORNER "endsolid a corner\n",
             PACKING_MESH_FORMAT_STL_TEXT);
  check_text("solid\r\n" FACET(O, Y, X) FACET(
                 O, X, "0 0 1.0e0") "endsolid\n\n"
                                    "  solid two\n" FACET(O, Z, Y) "\n# a remark\n" FACET(
                                        X, Y, Z) "endsolid",
             PACKING_MESH_FORMAT_STL_TEXT);
}

static void test_stl_text_refused(void **state)
{
  (void)state;
  refuse_text("solid\n" CORNER, PACKING_ERR_FORMAT, "before endsolid");
  refuse_text("solid\nendsolid\n", PACKING_ERR_FORMAT, "no triangle");
  refuse_text("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
              PACKING_ERR_FORMAT, "line 6");
  refuse_text("solid\nfacet\nouter loop\nvertex 0 0 nan\n", PACKING_ERR_FORMAT,
              "line 4: vertex");
  refuse_text("solid\nfacet\nouter loop\nvertex 0 0 1e999\n", PACKING_ERR_FORMAT,
              "line 4: vertex");
  refuse_text("solid\nfacet\nouter loop\nvertex 0 0\n", PACKING_ERR_FORMAT, "missing");
  refuse_text("solid\nfacet\nouter loop\nvertex 0 0 1 2\n", PACKING_ERR_FORMAT, "line 4");
  refuse_text("solid\nfacet\nvertex 0 0 1\n", PACKING_ERR_FORMAT, "outer loop");
  refuse_text("solid\n" CORNER "something\n", PACKING_ERR_FORMAT, "\"something\"");
  refuse_text("solid\n" CORNER "endsolid\nmore\n", PACKING_ERR_FORMAT, "\"more\"");
}

/* The corner as binary STL; returns the bytes. */
static size_t stl_binary(unsigned char *bytes, const char *header, uint32_t count)
{
  static const int corner[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  memset(bytes, 0, 84);
  memcpy(bytes, header, strlen(header));
  for (int k = 0; k < 4; k++)
    bytes[80 + k] = (unsigned char)(count >> 8 * k);
  size_t at = 84;
  for (int i = 0; i < 12; i++) {
    if (i % 3 == 0) {
      memset(bytes + at, 0x7f, 12); /* normals are not looked at */
      at += 12;
    }
    memset(bytes + at, 0, 12);
    if (corner[i] > 0) {
      bytes[at + 4 * (size_t)(corner[i] - 1) + 2] = 0x80; /* 1.0f */
      bytes[at + 4 * (size_t)(corner[i] - 1) + 3] = 0x3f;
    }
    at += 12;
    if (i % 3 == 2) {
      bytes[at++] = 0x12;
      bytes[at++] = 0;
    }
  }
  return at;
}

static void test_stl_binary(void **state)
{
  (void)state;
  unsigned char bytes[512];
  const size_t size = stl_binary(bytes, "a corner", 4);
  assert_int_equal(size, 284);
  check_both(bytes, size, PACKING_MESH_FORMAT_STL_BINARY);
  /* many call themselves "solid" */
  assert_int_equal(stl_binary(bytes, "solid corner by somebody", 4), size);
  check_both(bytes, size, PACKING_MESH_FORMAT_STL_BINARY);
}

static void test_stl_binary_refused(void **state)
{
  (void)state;
  const format_t binary = PACKING_MESH_FORMAT_STL_BINARY;
  unsigned char bytes[512];
  const size_t size = stl_binary(bytes, "a corner", 4);
  for (size_t cut = 0; cut < size; cut++)
    refuse_bytes(bytes, cut, binary, PACKING_ERR_FORMAT, "the file ends");
  bytes[size] = 0;
  refuse_bytes(bytes, size + 1, binary, PACKING_ERR_FORMAT, "behind");
  stl_binary(bytes, "a corner", 0xffffffffU);
  refuse_bytes(bytes, size, binary, PACKING_ERR_FORMAT, "4294967291 triangles");
  stl_binary(bytes, "a corner", 0);
  refuse_bytes(bytes, 84, binary, PACKING_ERR_FORMAT, "no triangle");
  stl_binary(bytes, "a corner", 4);
  bytes[84 + 50 + 12 + 3] = 0x7f; /* infinity */
  bytes[84 + 50 + 12 + 2] = 0x80;
  refuse_bytes(bytes, size, binary, PACKING_ERR_FORMAT, "byte 134");
}

/* What the library writes it reads: the same container. */
static void test_stl_round_trip(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++)
    for (int ascii = 0; ascii < 2; ascii++) {
      shape *s = shape_of(kind);
      packing_domain *domain = shape_domain(s, 1);
      packing_mesh *mesh = NULL;
      packing_mesh_report r;
      packing_stl_def def;
      test_buffer buffer = {0};
      const packing_stream stream = test_buffer_stream(&buffer);
      packing_stl_def_init(&def);
      def.ascii = ascii;
      assert_ok(packing_write_stl(context, &def, domain, &stream));
      assert_ok(packing_read_mesh(context, NULL, &stream, &mesh));
      packing_mesh_report_init(&r);
      assert_ok(packing_mesh_check(context, mesh, &r));
      assert_int_equal(r.defect, PACKING_MESH_SOUND);
      assert_close(packing_mesh_volume(mesh), packing_domain_volume(domain),
                   ascii ? 1e-14 : 1e-5);
      packing_mesh_destroy(mesh);
      packing_domain_destroy(domain);
      test_buffer_free(&buffer);
      free(s);
    }
}

/* Every container that can be written comes back closed. */
static void test_stl_of_containers(void **state)
{
  (void)state;
  packing_domain_silo_def def;
  packing_domain *domain = NULL;
  packing_mesh *mesh = NULL;
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_domain_silo_def_init(&def);
  def.radius = 1;
  def.height = 3;
  def.hopper_height = 1;
  def.outlet_radius = 0.2;
  assert_ok(packing_domain_create_silo(context, &def, &domain));
  assert_ok(packing_write_stl(context, NULL, domain, &stream));
  assert_ok(packing_read_mesh(context, NULL, &stream, &mesh));
  assert_true(packing_mesh_volume(mesh) > packing_domain_volume(domain));
  assert_close(packing_mesh_volume(mesh), packing_domain_volume(domain), 2e-3);
  packing_domain_destroy(domain);
  assert_ok(shape_domain_of(context, mesh, &domain));
  packing_domain_destroy(domain);
  packing_mesh_destroy(mesh);
  test_buffer_free(&buffer);
}

/* ---- OBJ ---- */

static void test_obj(void **state)
{
  (void)state;
  check_text(
      "# a corner\no corner\nmtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0 1.0\n"
      "v 0 0 1 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\ng a\nusemtl b\ns off\n"
      "f 1 3 2\nf 1/1 2/1 4/1\nf 1//1 4//1 3//1 # last but one\nf 2/1/1 3/1/1 4/1/1\n",
      PACKING_MESH_FORMAT_OBJ);
  check_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 -3 -1\n"
             "f -4 \\\n -1 -2\nf 2 3 4",
             PACKING_MESH_FORMAT_OBJ);
}

/* A cube of squares: each is cut in two. */
static void test_obj_polygons(void **state)
{
  (void)state;
  static const char cube[] =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  packing_mesh *mesh = NULL;
  packing_domain *domain = NULL;
  assert_ok(read_bytes(cube, sizeof cube - 1, 0, PACKING_MESH_FORMAT_AUTO, &mesh));
  assert_ok(shape_domain_of(context, mesh, &domain));
  assert_true(packing_domain_volume(domain) == 1);
  packing_domain_destroy(domain);
  packing_mesh_destroy(mesh);
}

static void test_obj_refused(void **state)
{
  (void)state;
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", PACKING_ERR_FORMAT, "line 4");
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", PACKING_ERR_FORMAT,
              "vertex 0 of 3");
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", PACKING_ERR_FORMAT, "vertex -4");
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9999999999999999999\n",
              PACKING_ERR_FORMAT, "is no vertex");
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", PACKING_ERR_FORMAT, "2 corners");
  refuse_text("v 0 0 0\nf 1 x 2\n", PACKING_ERR_FORMAT, "\"x\" is no vertex");
  refuse_text("v 0 0\n", PACKING_ERR_FORMAT, "missing");
  refuse_text("v 0 0 inf\n", PACKING_ERR_FORMAT, "finite");
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n", PACKING_ERR_FORMAT, "no triangle");
  refuse_text("cstype bezier\n", PACKING_ERR_UNSUPPORTED, "curves");
  refuse_text("hello\n", PACKING_ERR_FORMAT, "STL, OBJ or PLY");
  refuse_text("", PACKING_ERR_FORMAT, "no triangle");
  refuse_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n", PACKING_ERR_FORMAT, "rest");
}

/* ---- PLY ---- */

static void test_ply_ascii(void **state)
{
  (void)state;
  check_text("ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\n"
             "property float x\nproperty float y\nproperty float z\n"
             "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
             "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n",
             PACKING_MESH_FORMAT_PLY);
  /* other properties, elements and names */
  check_text("ply\r\nformat ascii 1.0\r\nobj_info x\r\nelement vertex 4\r\n"
             "property uchar red\r\nproperty double z\r\nproperty list int float junk\r\n"
             "property double x\r\nproperty double y\r\n"
             "element edge 1\r\nproperty int a\r\nproperty int b\r\n"
             "element face 4\r\nproperty float q\r\n"
             "property list uint8 uint32 vertex_index\r\nend_header\r\n"
             "9 0 0 0 0\r\n9 0 1 7.5 1 0\r\n9 0 2 7 7 0 1\r\n9 1 0 0 0\r\n1 2\r\n"
             "1.5 3 0 2 1\r\n0 3 0 1 3\r\n0 3 0 3 2\r\n0 3 1 2 3\r\n\r\n",
             PACKING_MESH_FORMAT_PLY);
}

typedef struct bytes {
  unsigned char data[2048];
  size_t size;
  int big;
} bytes;

static void put(bytes *b, const void *value, size_t size)
{
  const uint16_t one = 1;
  unsigned char low_first;
  memcpy(&low_first, &one, 1);
  for (size_t i = 0; i < size; i++)
    b->data[b->size + i] =
        ((const unsigned char *)
             value)[(b->big != 0) == (low_first != 0) ? size - 1 - i : i];
  b->size += size;
}

static void put_text(bytes *b, const char *text)
{
  memcpy(b->data + b->size, text, strlen(text));
  b->size += strlen(text);
}

/* Vertices of a float, a double and a short; faces of ushorts behind a list of floats. */
static void ply_binary(bytes *b, int big)
{
  static const uint16_t corner[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  b->size = 0;
  b->big = big;
  put_text(b, "ply\nformat ");
  put_text(b, big ? "binary_big_endian" : "binary_little_endian");
  put_text(b,
           " 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty char "
           "s\nproperty short z\nelement face 4\nproperty list ushort float w\n"
           "property list int ushort vertex_indices\nend_header\n");
  for (int v = 0; v < 4; v++) {
    const float x = v == 1;
    const double y = v == 2;
    const int16_t z = v == 3;
    const int8_t s = -1;
    put(b, &x, sizeof x);
    put(b, &y, sizeof y);
    put(b, &s, sizeof s);
    put(b, &z, sizeof z);
  }
  for (int t = 0; t < 4; t++) {
    const uint16_t count = (uint16_t)t;
    const int32_t three = 3;
    const float w = 0.5f;
    put(b, &count, sizeof count);
    for (int i = 0; i < t; i++)
      put(b, &w, sizeof w);
    put(b, &three, sizeof three);
    for (int i = 0; i < 3; i++)
      put(b, &corner[3 * t + i], sizeof corner[0]);
  }
}

static void test_ply_binary(void **state)
{
  (void)state;
  bytes b;
  for (int big = 0; big < 2; big++) {
    ply_binary(&b, big);
    check_both(b.data, b.size, PACKING_MESH_FORMAT_PLY);
    for (size_t cut = 1; cut < b.size; cut++) {
      packing_mesh *mesh = NULL;
      assert_status(read_bytes(b.data, cut, 0, PACKING_MESH_FORMAT_PLY, &mesh),
                    PACKING_ERR_FORMAT);
      assert_null(mesh);
    }
    b.data[b.size] = 0;
    refuse_bytes(b.data, b.size + 1, PACKING_MESH_FORMAT_PLY, PACKING_ERR_FORMAT,
                 "behind");
  }
}

#define PLY "ply\nformat ascii 1.0\n"
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define LIST "property list uchar int vertex_indices\n"

static void test_ply_refused(void **state)
{
  (void)state;
  static const struct {
    const char *text, *says;
  } cases[] = {
      {"ply\nformat ascii 2.0\n", "format"},
      {"ply\nelement vertex 1\nend_header\n", "no format"},
      {PLY "end_header\n", "0 elements named vertex"},
      {PLY "element vertex 3\n" XYZ "end_header\n", "0 named face"},
      {PLY "element face 1\n" LIST "element vertex 3\n" XYZ "end_header\n",
       "before vertices"},
      {PLY "element vertex 3\nproperty float x\nelement face 1\n" LIST "end_header\n",
       "x, y and z"},
      {PLY "element vertex 3\n" XYZ "element face 1\nproperty int a\nend_header\n",
       "vertex_indices"},
      {PLY "element vertex 3\n" XYZ "element face 1\nproperty list float int "
           "vertex_indices\nend_header\n",
       "whole number"},
      {PLY "element vertex 3\n" XYZ "element face 1\nproperty list uchar float "
           "vertex_indices\nend_header\n",
       "whole numbers"},
      {PLY "property float x\n", "no element"},
      {PLY "element vertex 3\nproperty quad x\n", "no type"},
      {PLY "element vertex -1\n", "element"},
      {PLY "element vertex many\n", "element"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST "element o 9\nend_header\n",
       "without properties"},
      {PLY "hello\n", "header"},
      {PLY "element vertex 3\n" XYZ, "end_header"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
       "vertex 3"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
       "vertex -1"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n",
       "vertex 1.5"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
       "2 corners"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n-1\n",
       "a list of -1"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n",
       "finite"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0 4\n0 1 0\n3 0 1 2\n",
       "line 11"},
      {PLY "element vertex 3\n" XYZ "element face 2\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
       "last element"},
      {PLY "element vertex 3\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n7\n",
       "behind"},
      {PLY "element vertex 9223372036854775807\n" XYZ "element face 1\n" LIST
           "end_header\n0 0 0\n",
       "last element"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    refuse_text(cases[i].text, PACKING_ERR_FORMAT, cases[i].says);
  refuse_bytes("plo\n", 4, PACKING_MESH_FORMAT_PLY, PACKING_ERR_FORMAT, "first line");
}

/* Too many elements or properties. */
static void test_ply_limits(void **state)
{
  (void)state;
  char text[16384] = PLY;
  for (int i = 0; i < 33; i++)
    strcat(text, "element other 0\n");
  refuse_text(text, PACKING_ERR_FORMAT, "32 elements");
  strcpy(text, PLY "element other 1\n");
  for (int i = 0; i < 257; i++)
    strcat(text, "property int i\n");
  refuse_text(text, PACKING_ERR_FORMAT, "256 properties");
}

/* ---- options ---- */

static void test_options(void **state)
{
  (void)state;
  static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"
                             "f 1 4 3\nf 2 3 4\n";
  packing_read_mesh_def def;
  packing_mesh *mesh = NULL;
  packing_bounds b;
  test_buffer buffer = {0};
  test_buffer_text(&buffer, text);
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_read_mesh_def_init(&def);
  def.scale = 0.5;
  def.shift.z = 2;
  assert_ok(packing_read_mesh(context, &def, &stream, &mesh));
  packing_mesh_bounds(mesh, &b);
  assert_true(b.lo.z == 2 && b.hi.z == 2.5);
  packing_mesh_destroy(mesh);
  mesh = NULL;
  assert_fails(context, packing_read_mesh(context, &def, &stream, NULL),
               PACKING_ERR_INVALID, "mesh");
  assert_fails(context, packing_read_mesh(context, &def, NULL, &mesh),
               PACKING_ERR_INVALID, "stream");
  def.format = (packing_mesh_format)9;
  assert_fails(context, packing_read_mesh(context, &def, &stream, &mesh),
               PACKING_ERR_INVALID, "format");
  packing_read_mesh_def_init(&def);
  def.merge = -1;
  buffer.read_at = 0;
  assert_fails(context, packing_read_mesh(context, &def, &stream, &mesh),
               PACKING_ERR_RANGE, "merge");
  def.struct_size = 1;
  assert_fails(context, packing_read_mesh(context, &def, &stream, &mesh), PACKING_ERR_ABI,
               "struct_size");
  assert_null(mesh);
  test_buffer_free(&buffer);
  assert_status(packing_read_mesh_file(context, NULL, "/nonexistent/mesh.stl", &mesh),
                PACKING_ERR_IO);
  assert_fails(context, packing_read_mesh_file(context, NULL, NULL, &mesh),
               PACKING_ERR_INVALID, "path");
}

static void test_files(void **state)
{
  (void)state;
  static const char path[] = "packing-mesh-read.stl";
  shape *s = shape_of(SHAPE_SPHERE);
  packing_domain *domain = shape_domain(s, 1);
  packing_mesh *mesh = NULL;
  packing_file *file = NULL;
  assert_ok(packing_file_create(context, path, &file));
  assert_ok(packing_write_stl(context, NULL, domain, packing_file_stream(file)));
  assert_ok(packing_file_commit(file));
  assert_ok(packing_read_mesh_file(NULL, NULL, path, &mesh));
  assert_close(packing_mesh_volume(mesh), packing_domain_volume(domain), 1e-6);
  assert_int_equal(remove(path), 0);
  packing_mesh_destroy(mesh);
  packing_domain_destroy(domain);
  free(s);
}

static packing_status broken(void *user, void *buffer, size_t capacity, size_t *count)
{
  (void)user;
  (void)buffer;
  *count = capacity + 1;
  return PACKING_OK;
}

static packing_status failing(void *user, void *buffer, size_t capacity, size_t *count)
{
  int *calls = user;
  if (++*calls > 1)
    return PACKING_ERR_IO;
  memcpy(buffer, "solid\n", 6);
  *count = capacity < 6 ? capacity : 6;
  return PACKING_OK;
}

static void test_streams_that_fail(void **state)
{
  (void)state;
  int calls = 0;
  packing_mesh *mesh = NULL;
  const packing_stream too_much = {broken, NULL, NULL}, fails = {failing, NULL, &calls};
  assert_status(packing_read_mesh(context, NULL, &too_much, &mesh), PACKING_ERR_INVALID);
  assert_status(packing_read_mesh(context, NULL, &fails, &mesh), PACKING_ERR_IO);
  assert_null(mesh);
}

int main(void)
{
#define TEST(f) cmocka_unit_test_setup_teardown(f, set_up, tear_down)
  const struct CMUnitTest tests[] = {
      TEST(test_stl_text),
      TEST(test_stl_text_refused),
      TEST(test_stl_binary),
      TEST(test_stl_binary_refused),
      TEST(test_stl_round_trip),
      TEST(test_stl_of_containers),
      TEST(test_obj),
      TEST(test_obj_polygons),
      TEST(test_obj_refused),
      TEST(test_ply_ascii),
      TEST(test_ply_binary),
      TEST(test_ply_refused),
      TEST(test_ply_limits),
      TEST(test_options),
      TEST(test_files),
      TEST(test_streams_that_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
