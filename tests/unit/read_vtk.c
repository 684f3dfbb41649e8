/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK: forms that stand in no sample, claims that the file does not keep, and XML that is none. */
#include "reading.h"
#if PACKING_I_HAVE_ZLIB
#include <zlib.h>
#endif

#define OPEN "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\">"
#define PIECE "<PolyData><Piece NumberOfPoints=\"2\"><PointData>"
#define RADII "<DataArray type=\"Float64\" Name=\"radius\">1 2</DataArray>"
#define POINTS                                                                           \
  "</PointData><Points><DataArray type=\"Float32\" NumberOfComponents='3' Name=\"x\">"   \
  "1 2 3\n4 5e0 -6\t</DataArray></Points>"
#define CLOSE "</Piece></PolyData></VTKFile>"

static packing_status read_text(reading *r, const char *text)
{
  packing_particles_truncate(r->particles, 0);
  return reading_text(r, "vtp", text);
}

static void plain_text(void **state)
{
  reading r = reading_begin(*state, 3);
  assert_ok(read_text(
      &r, "<?xml version='1.0'?>\n<!-- a > b -->" OPEN "<PolyData><FieldData>"
          "<DataArray type=\"Float64\" Name=\"radius\">7</DataArray></FieldData>"
          "<Piece NumberOfPoints=\"2\"><PointData>" RADII
          "<DataArray type=\"Int8\" Name=\"id\" format=\"ascii\">-3 2<x><y/></x>"
          "</DataArray><DataArray type=\"String\" Name=\"other\"/>" POINTS
          "<CellData><DataArray type=\"Float64\" Name=\"radius\">1</DataArray></CellData>"
          "</Piece><Piece NumberOfPoints=\"0\"><PointData/><Points/></Piece>"
          "</PolyData></VTKFile>"));
  assert_int_equal(r.info.particles, 2);
  reading_is(&r, 0, 1, 2, 3, 1);
  reading_is(&r, 1, 4, 5, -6, 2);
  assert_true(reading_id(&r, 0) == -3 && reading_id(&r, 1) == 2);
  reading_end(&r);
}

static void arrays_by_name(void **state)
{
  static const char text[] = OPEN PIECE RADII
      "<DataArray type=\"Float64\" Name=\"radii\">3 4</DataArray>"
      "<DataArray type=\"Float64\" Name=\"diameter\">10 12</DataArray>" POINTS CLOSE;
  static const char diameters[] = OPEN PIECE
      "<DataArray type=\"UInt16\" Name=\"diameter\">10 12</DataArray>" POINTS CLOSE;
  packing_context *c = *state;
  reading r = reading_begin(c, 3);
  assert_fails(c, read_text(&r, text), PACKING_ERR_FORMAT, "a second array for the same");
  r.def.radius_name = "radii";
  assert_ok(read_text(&r, text));
  reading_is(&r, 1, 4, 5, -6, 4);
  r.def.radius_name = NULL;
  r.def.diameter_name = "diameter";
  assert_ok(read_text(&r, text));
  reading_is(&r, 1, 4, 5, -6, 6);
  r.def.diameter_name = "radii";
  assert_ok(read_text(&r, text));
  reading_is(&r, 1, 4, 5, -6, 2);
  r.def.diameter_name = "absent";
  assert_fails(c, read_text(&r, text), PACKING_ERR_FORMAT, "no point data of radii");
  r.def.diameter_name = NULL;
  assert_ok(read_text(&r, diameters));
  reading_is(&r, 0, 1, 2, 3, 5);
  reading_end(&r);
}

static void pieces_follow_each_other(void **state)
{
#define ONE(x, radius)                                                                   \
  "<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"Float64\" "                     \
  "NumberOfComponents=\"3\">" x " 0 0</DataArray></Points><PointData><DataArray "        \
  "type=\"Float64\" Name=\"radius\">" radius "</DataArray>"
  packing_context *c = *state;
  reading r = reading_begin(c, 2);
  assert_ok(read_text(&r, OPEN "<PolyData>" ONE("1", "3") "</PointData></Piece>" ONE(
                              "2", "4") "</PointData></Piece></PolyData></VTKFile>"));
  assert_int_equal(r.info.particles, 2);
  reading_is(&r, 1, 2, 0, 0, 4);
  assert_int_equal(r.info.dim, 2);
  assert_fails(c,
               read_text(&r, OPEN "<PolyData>" ONE("1", "3") "</PointData></Piece>" ONE(
                                 "2", "4") "<DataArray type=\"Int8\" Name=\"id\">1"
                                           "</DataArray></PointData></Piece>"
                                           "</PolyData></VTKFile>"),
               PACKING_ERR_FORMAT, "other point data than the first");
  reading_end(&r);
}

static const struct {
  const char *text, *says;
} malformed[] = {
    {"", "no VTKFile"},
    {"text", "no VTKFile"},
    {"<x/>", "no VTKFile"},
    {"<VTKFile/>", "no type"},
    {"<VTKFile type=\"PolyData\"/>" OPEN, "something else follows"},
    {"<VTKFile type=\"PPolyData\"/>", "type: \"PPolyData\" is not read"},
    {"<VTKFile type=\"PolyData\" byte_order=\"Middle\"/>", "byte_order: \"Middle\""},
    {"<VTKFile type=\"PolyData\" header_type=\"UInt16\"/>", "header_type: \"UInt16\""},
    {"<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"/>",
     "compressor: \"vtkLZ4DataCompressor\" is not read"},
    {"<VTKFile type=\"PolyData\"", "a malformed tag"},
    {"<VTKFile type=\"PolyData\">", "the file ends too early"},
    {"<VTKFile type=\"PolyData\"x=\"\">", "a malformed tag"},
    {"<VTKFile type=PolyData>", "a malformed tag"},
    {"<VTKFile type=\"PolyData>", "a malformed tag"},
    {"<VTKFile type>", "a malformed tag"},
    {"< >", "a malformed tag"},
    {"</VTKFile>", "a malformed tag"},
    {OPEN "</VTK>", "an end tag of another element"},
    {"<!DOCTYPE x>", "neither element nor comment"},
    {"<!-- ", "a comment without an end"},
    {"<?xml", "a comment without an end"},
    {OPEN "<a><a><a><a><a><a><a><a><a><a><a><a><a><a><a><a>", "too many elements"},
    {OPEN "<PolyData><Piece NumberOfPoints=\"-1\">",
     "NumberOfPoints: \"-1\" is no count"},
    {OPEN "<PolyData><Piece NumberOfPoints=\"1.5\">", "\"1.5\" is no count"},
    {OPEN PIECE "<DataArray Name=\"radius\">", "no type"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Bit\">", "type: \"Bit\" is not read"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\" format=\"xml\">",
     "format: \"xml\" is not read"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\" NumberOfComponents=\"2\"><",
     "radius: 2 components, not 1"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\" NumberOfComponents=\"0\"><",
     "radius: 0 components, not 1"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\">1 2", "without an end"},
    {OPEN PIECE POINTS CLOSE, "no point data of radii or diameters"},
    {OPEN PIECE RADII "</PointData>" CLOSE, "a piece without Points"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Float64\">1</DataArray>" POINTS CLOSE,
     "the array ends too early"},
    {OPEN PIECE
     "<DataArray Name=\"radius\" type=\"Float64\">1    </DataArray>" POINTS CLOSE,
     "the array ends too early"},
    {OPEN PIECE
     "<DataArray Name=\"radius\" type=\"Float64\">1 2 3</DataArray>" POINTS CLOSE,
     "the array is longer than its piece asks for"},
    {OPEN PIECE
     "<DataArray Name=\"radius\" type=\"Float64\">1 nan</DataArray>" POINTS CLOSE,
     "no number that fits"},
    {OPEN PIECE
     "<DataArray Name=\"radius\" type=\"Int32\">1 2.5</DataArray>" POINTS CLOSE,
     "no number that fits"},
    {OPEN PIECE
     "<DataArray Name=\"radius\" type=\"Float64\">1 0</DataArray>" POINTS CLOSE,
     "the radius 0 must be above 0"},
    {OPEN PIECE RADII
     "<DataArray Name=\"id\" type=\"Float64\">1 1.5</DataArray>" POINTS CLOSE,
     "id: entry 1 is no whole number in range"},
    {OPEN PIECE RADII
     "<DataArray Name=\"type\" type=\"Int64\">1 2147483648</DataArray>" POINTS CLOSE,
     "type: entry 1 is no whole number in range"},
    {OPEN "<PolyData><Piece NumberOfPoints=\"4294967296\"><PointData>" RADII POINTS CLOSE,
     "the array ends too early"},
    {OPEN
     "<PolyData><Piece NumberOfPoints=\"9223372036854775807\"><PointData>" RADII POINTS
         CLOSE,
     "the array ends too early"},
    {OPEN PIECE
     "<DataArray Name=\"radius\" type=\"Float64\" format=\"appended\"/>" POINTS CLOSE,
     "no appended data at the offset"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Float64\" format=\"appended\" "
                "offset=\"7\"/>" POINTS "</Piece></PolyData><AppendedData "
                "encoding=\"raw\">_123",
     "no appended data at the offset"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Float64\" format=\"appended\"/>" POINTS
                "</Piece></PolyData><AppendedData encoding=\"raw\">_123",
     "the array ends too early"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Float64\" format=\"appended\"/>" POINTS
                "</Piece></PolyData><AppendedData encoding=\"raw\">_1234567890",
     "another length than its piece asks for"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Float64\" format=\"appended\"/>" POINTS
                "</Piece></PolyData><AppendedData encoding=\"raw\">_\x10",
     "the array ends too early"},
    {OPEN "<AppendedData encoding=\"raw\">x", "do not begin with _"},
    {OPEN "<AppendedData>_", "no encoding"},
    {OPEN "<AppendedData encoding=\"hex\">_", "encoding: \"hex\""},
    {OPEN "<AppendedData encoding=\"base64\">_AAAA", "appended data without an end"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\" format=\"binary\">AgAA*AEC"
                "</DataArray>" POINTS CLOSE,
     "no base64"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\" format=\"binary\">AgAAAAE"
                "</DataArray>" POINTS CLOSE,
     "the array ends too early"},
    {OPEN PIECE "<DataArray Name=\"radius\" type=\"Int8\" format=\"binary\">====AgAAAAEC"
                "</DataArray>" POINTS CLOSE,
     "no base64"},
    {OPEN PIECE RADII "<DataArray Name=\"velocity\" type=\"Float32\" format=\"binary\" "
                      "NumberOfComponents=\"3\">GAAAAAAAwH8AAAAAAAAAAAAAAAAAAAAAAAAAAA=="
                      "</DataArray>" POINTS CLOSE,
     "a velocity, spin or orientation is not finite"},
    {OPEN PIECE RADII "<DataArray Name=\"spin\" type=\"Float32\" format=\"binary\" "
                      "NumberOfComponents=\"3\">GAAAAAAAAAAAAAAAAACAfwAAAAAAAAAAAAAAAA=="
                      "</DataArray>" POINTS CLOSE,
     "a velocity, spin or orientation is not finite"},
};

static void malformed_files_are_refused(void **state)
{
  packing_context *c = *state;
  reading r = reading_begin(c, 3);
  for (size_t i = 0; i < sizeof malformed / sizeof malformed[0]; i++) {
    const packing_status status = read_text(&r, malformed[i].text);
    const char *message = packing_context_message(c);
    if (status != PACKING_ERR_FORMAT || strncmp(message, "byte ", 5) != 0 ||
        strstr(message, malformed[i].says) == NULL)
      fail_msg("case %zu: %s, \"%s\", not \"%s\"", i, packing_status_string(status),
               message, malformed[i].says);
    assert_int_equal(packing_particles_count(r.particles), 0);
  }
  reading_end(&r);
}

/* Header and data in one run of base64, and in a run each. */
static void runs_of_base64(void **state)
{
  static const char *const runs[] = {"AgAAAAEC",
                                     "AgAAAA==AQI=", "  AgAA\n AA=  =AQ I=\n"};
  for (size_t i = 0; i < 3; i++) {
    char text[1000];
    reading r = reading_begin(*state, 3);
    snprintf(
        text, sizeof text,
        "%s<DataArray Name=\"radius\" type=\"UInt8\" format=\"binary\">%s</DataArray>%s",
        OPEN PIECE, runs[i], POINTS CLOSE);
    assert_ok(read_text(&r, text));
    reading_is(&r, 0, 1, 2, 3, 1);
    reading_is(&r, 1, 4, 5, -6, 2);
    reading_end(&r);
  }
}

/* However many pieces tell of one array, the file gives no more particles than it holds. */
static void pieces_do_not_share_bytes(void **state)
{
#define TOLD                                                                             \
  "<Piece NumberOfPoints=\"1\"><Points><DataArray type=\"UInt8\" format=\"appended\" "   \
  "NumberOfComponents=\"3\" offset=\"0\"/></Points><PointData><DataArray "               \
  "type=\"UInt8\" "                                                                      \
  "Name=\"radius\" format=\"appended\" offset=\"12\"/></PointData></Piece>"
#define BYTES                                                                            \
  "</PolyData><AppendedData encoding=\"base64\">_AwAAAAECAw==AQAAAAE=</AppendedData>"    \
  "</VTKFile>"
  packing_context *c = *state;
  reading r = reading_begin(c, 3);
  assert_ok(read_text(&r, OPEN "<PolyData>" TOLD BYTES));
  reading_is(&r, 0, 1, 2, 3, 1);
  assert_fails(c, read_text(&r, OPEN "<PolyData>" TOLD TOLD BYTES), PACKING_ERR_FORMAT,
               "pieces share their appended data");
  assert_int_equal(packing_particles_count(r.particles), 0);
  reading_end(&r);
#undef TOLD
#undef BYTES
}

#if PACKING_I_HAVE_ZLIB
/* A file whose radii are `count` bytes of 1, deflated as blocks of `block`, as told by `head`. */
static packing_status read_blocks(reading *r, const uint64_t *head, size_t heads,
                                  const unsigned char *data, size_t size, uint64_t points)
{
  static unsigned char file[20000];
  int length = snprintf(
      (char *)file, sizeof file,
      "<VTKFile type=\"PolyData\" header_type=\"UInt64\" byte_order=\"LittleEndian\" "
      "compressor=\"vtkZLibDataCompressor\"><PolyData><Piece NumberOfPoints=\"%llu\">"
      "<PointData><DataArray Name=\"radius\" type=\"UInt8\" format=\"appended\"/>"
      "</PointData><Points><DataArray NumberOfComponents=\"3\" type=\"UInt8\">",
      (unsigned long long)points);
  for (uint64_t i = 0; i < 3 * points && i < 3000; i++)
    length += snprintf((char *)file + length, sizeof file - (size_t)length, "1 ");
  length += snprintf((char *)file + length, sizeof file - (size_t)length,
                     "</DataArray></Points></Piece></PolyData><AppendedData "
                     "encoding=\"raw\">_");
  size_t at = (size_t)length;
  for (size_t h = 0; h < heads; h++)
    for (unsigned k = 0; k < 8; k++)
      file[at++] = (unsigned char)(head[h] >> (8 * k));
  memcpy(file + at, data, size);
  at += size;
  packing_particles_truncate(r->particles, 0);
  return reading_bytes(r, "vtp", file, at, 0);
}

static size_t deflated(size_t count, unsigned char *out, size_t capacity)
{
  unsigned char ones[1000];
  uLongf size = capacity;
  memset(ones, 1, sizeof ones);
  assert_true(count <= sizeof ones);
  assert_int_equal(compress2(out, &size, ones, count, 9), Z_OK);
  return size;
}

static void compressed_blocks(void **state)
{
  packing_context *c = *state;
  test_allocator memory = {0};
  packing_context *counted = test_allocator_context(&memory);
  reading r = reading_begin(c, 3), bounded = reading_begin(counted, 3);
  unsigned char data[200];
  const size_t first = deflated(300, data, 100),
               second = deflated(100, data + first, 100);
  const size_t both = first + second;
  const uint64_t good[] = {2, 300, 100, first, second}, whole[] = {1, 300, 0, first};
  assert_ok(read_blocks(&r, good, 5, data, both, 400));
  assert_int_equal(r.info.particles, 400);
  reading_is(&r, 399, 1, 1, 1, 1);
  assert_ok(read_blocks(&r, whole, 4, data, both, 300));
  const struct {
    uint64_t head[5];
    uint64_t points;
    const char *says;
  } cases[] = {
      {{0, 0, 0, 0, 0}, 400, "another length"},
      {{2, 0, 0, 0, 0}, 400, "another length"},
      {{2, 300, 301, first, second}, 601, "another length"},
      {{3, 300, 100, first, second}, 400, "another length"},
      {{1, 400, 0, first, second}, 300, "another length"},
      {{UINT64_MAX, UINT64_MAX, UINT64_MAX, 0, 0}, 400, "another length"},
      {{400, 1, 0, 1, 1}, 400, "ends too early"},
      {{2, 300, 100, first, second + 1}, 400, "ends too early"},
      {{2, 300, 100, UINT64_MAX, second}, 400, "ends too early"},
      {{2, 300, 100, first, 0}, 400, "more is claimed than compressed data hold"},
      {{2, 300, 100, first - 1, second}, 400, "damaged block"},
      {{2, 300, 100, both - 20, 20}, 400, "damaged block"},
      {{2, 200, 200, first, second}, 400, "damaged block"},
      {{2, 310, 90, first, second}, 400, "damaged block"},
      {{1, UINT64_C(1) << 40, 0, both, 0}, UINT64_C(1) << 40, "ends too early"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    memory.peak = memory.bytes;
    const packing_status status =
        read_blocks(&bounded, cases[i].head, 5, data, both, cases[i].points);
    if (status != PACKING_ERR_FORMAT ||
        strstr(packing_context_message(counted), cases[i].says) == NULL)
      fail_msg("case %zu: %s, \"%s\", not \"%s\"", i, packing_status_string(status),
               packing_context_message(counted), cases[i].says);
    assert_true(memory.peak < 1 << 20);
  }
  reading_end(&r);
  reading_end(&bounded);
  packing_context_destroy(counted);
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
    cmocka_unit_test(plain_text),
    cmocka_unit_test(arrays_by_name),
    cmocka_unit_test(pieces_follow_each_other),
    cmocka_unit_test(malformed_files_are_refused),
    cmocka_unit_test(runs_of_base64),
    cmocka_unit_test(pieces_do_not_share_bytes),
#if PACKING_I_HAVE_ZLIB
    cmocka_unit_test(compressed_blocks),
#endif
  };
  return cmocka_run_group_tests(tests, setup, teardown);
}
