/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTP: parsed back by the small reader below, which follows offsets and inflates blocks. */
#include "test.h"
#if PACKING_I_HAVE_ZLIB
#include <zlib.h>
#endif

/* A pack of `count` particles with every optional column. */
typedef struct record {
  double x, y, z, r, v[3], w[3], q[4];
  int64_t id;
  int32_t type, component;
} record;

static packing_column column(const record *records, size_t offset)
{
  const packing_column c = {(const char *)records + offset, sizeof(record)};
  return c;
}

static record *full_pack(size_t count, packing_view *view)
{
  record *a = calloc(count + 1, sizeof *a);
  assert_non_null(a);
  for (size_t i = 0; i < count; i++) {
    const double t = (double)i;
    const record p = {t / 7,           -t,
                      5e-324 * t,      1 / (t + 1),
                      {t, 2 * t, -t},  {0.5, t, 1e300},
                      {1, 0, -0.0, t}, (int64_t)(i * i) - 5,
                      (int32_t)i % 3,  -(int32_t)i};
    a[i] = p;
  }
  packing_view_init(view);
  view->count = count;
  view->x = column(a, offsetof(record, x));
  view->y = column(a, offsetof(record, y));
  view->z = column(a, offsetof(record, z));
  view->r = column(a, offsetof(record, r));
  view->id = column(a, offsetof(record, id));
  view->type = column(a, offsetof(record, type));
  view->component = column(a, offsetof(record, component));
  view->vx = column(a, offsetof(record, v[0]));
  view->vy = column(a, offsetof(record, v[1]));
  view->vz = column(a, offsetof(record, v[2]));
  view->wx = column(a, offsetof(record, w[0]));
  view->wy = column(a, offsetof(record, w[1]));
  view->wz = column(a, offsetof(record, w[2]));
  view->qw = column(a, offsetof(record, q[0]));
  view->qx = column(a, offsetof(record, q[1]));
  view->qy = column(a, offsetof(record, q[2]));
  view->qz = column(a, offsetof(record, q[3]));
  return a;
}

static test_buffer written(packing_context *context, int compression,
                           const packing_view *view)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_vtp_def def;
  packing_vtp_def_init(&def);
  def.compression = compression;
  assert_ok(packing_write_vtp(context, &def, view, &stream));
  return buffer;
}

/* The number behind `key="` at or after `from`. */
static uint64_t attribute(const char *from, const char *key)
{
  char text[64];
  snprintf(text, sizeof text, "%s=\"", key);
  const char *at = strstr(from, text);
  assert_non_null(at);
  return strtoull(at + strlen(text), NULL, 10);
}

static uint64_t word(const char *at, size_t which)
{
  uint64_t w;
  memcpy(&w, at + which * sizeof w, sizeof w);
  return w;
}

/* The text of the DataArray of a name. */
static const char *find_array(const test_buffer *b, const char *name)
{
  char key[64];
  snprintf(key, sizeof key, "Name=\"%s\"", name);
  const char *at = strstr(b->data, key);
  assert_non_null(at);
  while (*at != '<')
    at--;
  return at;
}

static const char *appended(const test_buffer *b)
{
  const char *at = strstr(b->data, "<AppendedData encoding=\"raw\">");
  assert_non_null(at);
  at = strchr(at, '_');
  assert_non_null(at);
  return at + 1;
}

static void *inflate_blocks(const char *at, size_t *size)
{
#if PACKING_I_HAVE_ZLIB
  const uint64_t blocks = word(at, 0), whole = word(at, 1), last = word(at, 2);
  const char *from = at + (3 + blocks) * 8;
  *size = 0;
  unsigned char *out = malloc(blocks * whole + 1);
  assert_non_null(out);
  for (uint64_t b = 0; b < blocks; b++) {
    uLongf got = (uLongf)whole;
    assert_int_equal(
        uncompress(out + *size, &got, (const Bytef *)from, (uLong)word(at, 3 + b)), Z_OK);
    assert_int_equal(got, b + 1 == blocks && last != 0 ? last : whole);
    *size += got;
    from += word(at, 3 + b);
  }
  return out;
#else
  (void)at;
  *size = 0;
  return NULL;
#endif
}

/* The bytes of an array, to be freed. */
static void *array_bytes(const test_buffer *b, const char *name, const char *type,
                         size_t components, size_t *size)
{
  const char *xml = find_array(b, name);
  char want[64];
  snprintf(want, sizeof want, "<DataArray type=\"%s\" ", type);
  assert_true(strncmp(xml, want, strlen(want)) == 0);
  assert_int_equal(attribute(xml, "NumberOfComponents"), components);
  const char *at = appended(b) + attribute(xml, "offset");
  assert_true(at < b->data + b->size);
  if (strstr(b->data, "vtkZLibDataCompressor") != NULL)
    return inflate_blocks(at, size);
  *size = word(at, 0);
  assert_true(at + 8 + *size < b->data + b->size);
  void *copy = malloc(*size + 1);
  assert_non_null(copy);
  memcpy(copy, at + 8, *size);
  return copy;
}

/* Every tuple of an array against `count` records, from `offset` on. */
static void assert_array(const test_buffer *b, const char *name, const char *type,
                         size_t components, const record *records, size_t count,
                         size_t offset, size_t tuple)
{
  size_t size;
  char *bytes = array_bytes(b, name, type, components, &size);
  assert_int_equal(size, count * tuple);
  for (size_t i = 0; i < count; i++)
    assert_memory_equal(bytes + i * tuple, (const char *)&records[i] + offset, tuple);
  free(bytes);
}

static void assert_counts_up(const test_buffer *b, const char *name, int64_t first,
                             size_t count)
{
  size_t size;
  int64_t *numbers = array_bytes(b, name, "Int64", 1, &size);
  assert_int_equal(size, count * sizeof *numbers);
  for (size_t i = 0; i < count; i++)
    assert_int_equal(numbers[i], first + (int64_t)i);
  free(numbers);
}

static void assert_all(const test_buffer *b, const record *a, size_t n)
{
  assert_int_equal(attribute(b->data, "NumberOfPoints"), n);
  assert_int_equal(attribute(b->data, "NumberOfVerts"), n);
  assert_array(b, "Points", "Float64", 3, a, n, offsetof(record, x), 24);
  assert_array(b, "radius", "Float64", 1, a, n, offsetof(record, r), 8);
  assert_array(b, "id", "Int64", 1, a, n, offsetof(record, id), 8);
  assert_array(b, "type", "Int32", 1, a, n, offsetof(record, type), 4);
  assert_array(b, "component", "Int32", 1, a, n, offsetof(record, component), 4);
  assert_array(b, "velocity", "Float64", 3, a, n, offsetof(record, v), 24);
  assert_array(b, "spin", "Float64", 3, a, n, offsetof(record, w), 24);
  assert_array(b, "orientation", "Float64", 4, a, n, offsetof(record, q), 32);
  assert_counts_up(b, "connectivity", 0, n);
  assert_counts_up(b, "offsets", 1, n);
  static const char end[] = "\n</AppendedData>\n</VTKFile>\n";
  assert_string_equal(b->data + b->size - strlen(end), end);
}

static void raw_arrays_come_back(void **state)
{
  (void)state;
  static const size_t counts[] = {0, 1, 3, 2048, 2049, 5000};
  for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
    packing_view view;
    record *a = full_pack(counts[i], &view);
    test_buffer b = written(NULL, 0, &view);
    assert_all(&b, a, counts[i]);
    test_buffer_free(&b);
    free(a);
  }
}

static void a_plain_pack_is_exact(void **state)
{
  (void)state;
  static const double x[] = {1.5}, r[] = {0.25};
  packing_view view;
  packing_view_init_arrays(&view, 1, x, x, NULL, r);
  test_buffer b = written(NULL, 0, &view);
  static const char xml[] =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "<PolyData>\n"
      "<Piece NumberOfPoints=\"1\" NumberOfVerts=\"1\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
      "<PointData Scalars=\"radius\">\n"
      "<DataArray type=\"Float64\" Name=\"radius\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"0\"/>\n"
      "</PointData>\n"
      "<Points>\n"
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
      "format=\"appended\" offset=\"16\"/>\n"
      "</Points>\n"
      "<Verts>\n"
      "<DataArray type=\"Int64\" Name=\"connectivity\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"48\"/>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" NumberOfComponents=\"1\" "
      "format=\"appended\" offset=\"64\"/>\n"
      "</Verts>\n"
      "</Piece>\n"
      "</PolyData>\n"
      "<AppendedData encoding=\"raw\">\n_";
  const uint16_t one = 1;
  if (*(const unsigned char *)&one == 1)
    assert_memory_equal(b.data, xml, strlen(xml));
  size_t size;
  double *points = array_bytes(&b, "Points", "Float64", 3, &size);
  assert_true(points[0] == 1.5 && points[1] == 1.5 && points[2] == 0);
  free(points);
  test_buffer_free(&b);
}

/* Keeps of a full pack what a plain one has. */
static void make_plain(packing_view *view)
{
  const packing_view full = *view;
  packing_view_init(view);
  view->count = full.count;
  view->x = full.x;
  view->y = full.y;
  view->z = full.z;
  view->r = full.r;
}

static void skip_without_zlib(void)
{
  if (PACKING_I_HAVE_ZLIB)
    return;
  print_message("built without zlib\n");
  skip();
}

static void zlib_arrays_come_back(void **state)
{
  (void)state;
  static const size_t counts[] = {0, 1, 16384, 16385, 40000};
  skip_without_zlib();
  for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++) {
    packing_view view;
    record *a = full_pack(counts[i], &view);
    test_buffer b = written(NULL, counts[i] < 2 ? 9 : 1, &view);
    assert_all(&b, a, counts[i]);
    test_buffer_free(&b);
    free(a);
  }
}

/* 18 blocks and a piece: more than are compressed side by side at once. */
static void zlib_bytes_do_not_depend_on_threads(void **state)
{
  (void)state;
  enum { COUNT = 300000 };
  packing_view view;
  skip_without_zlib();
  record *a = full_pack(COUNT, &view);
  make_plain(&view);
  test_buffer first = written(NULL, 1, &view);
  assert_array(&first, "Points", "Float64", 3, a, COUNT, offsetof(record, x), 24);
  assert_counts_up(&first, "offsets", 1, COUNT);
  for (int threads = 2; threads <= 3; threads++) {
    packing_context *c = test_context(threads, PACKING_ISA_AUTO);
    test_buffer b = written(c, 1, &view);
    assert_int_equal(b.size, first.size);
    assert_memory_equal(b.data, first.data, b.size);
    test_buffer_free(&b);
    packing_context_destroy(c);
  }
  test_buffer_free(&first);
  free(a);
}

static void compression_is_checked(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_view view;
  packing_vtp_def def;
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  record *a = full_pack(2, &view);
  packing_vtp_def_init(&def);
  def.compression = 10;
  assert_fails(c, packing_write_vtp(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "compression");
  def.compression = -1;
  assert_fails(c, packing_write_vtp(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "compression");
  def.compression = 1;
  if (!PACKING_I_HAVE_ZLIB)
    assert_fails(c, packing_write_vtp(c, &def, &view, &stream), PACKING_ERR_UNSUPPORTED,
                 "compression");
  a[1].x = (double)NAN;
  assert_fails(c, packing_write_vtp(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "x: particle 1");
  assert_int_equal(buffer.size, 0);
  free(a);
  packing_context_destroy(c);
}

static void writing_fails_at_every_byte(void **state)
{
  (void)state;
  packing_view view;
  record *a = full_pack(2, &view);
  for (int compression = 0; compression <= PACKING_I_HAVE_ZLIB; compression++) {
    packing_vtp_def def;
    packing_vtp_def_init(&def);
    def.compression = compression;
    test_buffer whole = written(NULL, compression, &view);
    for (size_t k = 1; k < whole.size; k += compression ? 97 : 1) {
      test_buffer buffer = {0};
      const packing_stream stream = test_buffer_stream(&buffer);
      buffer.limit = k;
      assert_status(packing_write_vtp(NULL, &def, &view, &stream), PACKING_ERR_IO);
      test_buffer_free(&buffer);
    }
    test_buffer_free(&whole);
  }
  free(a);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(raw_arrays_come_back),
      cmocka_unit_test(a_plain_pack_is_exact),
      cmocka_unit_test(zlib_arrays_come_back),
      cmocka_unit_test(zlib_bytes_do_not_depend_on_threads),
      cmocka_unit_test(compression_is_checked),
      cmocka_unit_test(writing_fails_at_every_byte),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
