/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of a pack: exact text, bits that come back, and every way to be malformed. */
#include "test.h"

typedef struct log_state {
  packing_status status;
  size_t index;
} log_state;

static void keep(void *user, const packing_log_record *record)
{
  log_state *l = user;
  l->status = record->status;
  l->index = record->index;
}

static packing_context *logging_context(log_state *log)
{
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.log = keep;
  def.log_user = log;
  assert_ok(packing_context_create(&def, &context));
  return context;
}

static packing_status read_text(packing_context *context, const char *text, size_t size,
                                size_t chunk, packing_particles *particles)
{
  test_buffer buffer = {0};
  test_buffer_text(&buffer, "");
  buffer.data = realloc(buffer.data, size + 1);
  assert_non_null(buffer.data);
  memcpy(buffer.data, text, size);
  buffer.size = size;
  buffer.chunk = chunk;
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = packing_read_csv(context, &stream, particles);
  test_buffer_free(&buffer);
  return status;
}

static double at(const packing_column *c, size_t i)
{
  return *(const double *)(const void *)((const char *)c->data + i * c->stride);
}

/* Reads `text` into a store of dimension `dim`, which the caller destroys. */
static packing_particles *taken(const char *text, size_t chunk, int dim)
{
  packing_particles *p = test_store(dim);
  assert_ok(read_text(NULL, text, strlen(text), chunk, p));
  return p;
}

static char *written(const packing_csv_def *def, const packing_view *view)
{
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  assert_ok(packing_write_csv(NULL, def, view, &stream));
  return buffer.data;
}

static const double x[] = {0.1, -0.0}, y[] = {1e-300, 2}, z[] = {5e-324, 1e17},
                    r[] = {0.25, 3};

static void plain_text_is_exact(void **state)
{
  (void)state;
  packing_view view;
  packing_view_init_arrays(&view, 2, x, y, z, r);
  char *text = written(NULL, &view);
  assert_string_equal(text, "x,y,z,r\n"
                            "0.10000000000000001,1e-300,4.9406564584124654e-324,0.25\n"
                            "-0,2,1e+17,3\n");
  free(text);
}

static void notes_and_optional_columns_are_written(void **state)
{
  (void)state;
  static const char *const keys[] = {"domain", "seed"};
  static const char *const values[] = {"box:1,1,1", "18446744073709551615"};
  static const int64_t id[] = {INT64_MIN, 7};
  static const int32_t type[] = {2, INT32_MAX}, component[] = {0, -1};
  packing_csv_def def;
  packing_view view;
  packing_csv_def_init(&def);
  def.dim = 2;
  def.note_count = 2;
  def.keys = keys;
  def.values = values;
  packing_view_init_arrays(&view, 2, x, r, NULL, r);
  view.id.data = id;
  view.id.stride = sizeof id[0];
  view.type.data = type;
  view.type.stride = sizeof type[0];
  view.component.data = component;
  view.component.stride = sizeof component[0];
  view.wz.data = r;
  view.wz.stride = sizeof r[0];
  view.qw = view.qx = view.qy = view.qz = view.wz;
  char *text = written(&def, &view);
  assert_string_equal(text,
                      "# domain: box:1,1,1\n"
                      "# seed: 18446744073709551615\n"
                      "x,y,r,id,type,component,wx,wy,wz,qw,qx,qy,qz\n"
                      "0.10000000000000001,0.25,0.25,-9223372036854775808,2,0,0,0,0.25,"
                      "0.25,0.25,0.25,0.25\n"
                      "-0,3,3,7,2147483647,-1,0,0,3,3,3,3,3\n");
  free(text);
}

static void no_particles_make_a_header(void **state)
{
  (void)state;
  packing_view view;
  packing_view_init(&view);
  char *text = written(NULL, &view);
  assert_string_equal(text, "x,y,z,r\n");
  packing_particles *p = taken(text, 0, 3);
  assert_int_equal(packing_particles_count(p), 0);
  packing_particles_destroy(p);
  free(text);
}

static void writer_refuses_what_cannot_be_read_back(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  test_buffer buffer = {0};
  packing_stream stream = test_buffer_stream(&buffer);
  packing_csv_def def;
  packing_view view;
  double bad[] = {1, (double)NAN};
  packing_csv_def_init(&def);
  packing_view_init_arrays(&view, 2, x, y, z, r);
  view.y.data = bad;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "y");
  bad[1] = (double)INFINITY;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "particle 1");
  packing_view_init_arrays(&view, 2, x, y, z, bad);
  bad[1] = 0;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "r");
  bad[1] = -2;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "r");
  packing_view_init_arrays(&view, 2, x, y, NULL, r);
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "z");
  packing_view_init_arrays(&view, 2, x, y, z, r);
  def.dim = 2;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "z");
  def.dim = 4;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "dim");
  packing_csv_def_init(&def);
  view.qx = view.x;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "orientation");
  view.qx.data = NULL;
  view.vx.data = (const char *)x + 1;
  view.vx.stride = 8;
  view.count = 1;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID, "vx");
  view.struct_size = 0;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "view");
  assert_fails(c, packing_write_csv(c, &def, NULL, &stream), PACKING_ERR_INVALID, "view");
  packing_view_init_arrays(&view, 2, x, y, z, r);
  assert_fails(c, packing_write_csv(c, &def, &view, NULL), PACKING_ERR_INVALID, "stream");
  stream.write = NULL;
  assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID,
               "stream");
  def.struct_size = 4;
  assert_status(packing_write_csv(c, &def, &view, &stream), PACKING_ERR_ABI);
  assert_int_equal(buffer.size, 0); /* nothing was written on the way */
  packing_context_destroy(c);
}

static void writer_refuses_notes_that_break_lines(void **state)
{
  (void)state;
  static const char *const good[] = {"a"}, *const newline[] = {"a\nb"},
                           *const colon[] = {"a:b"}, *const none[] = {NULL};
  const struct {
    const char *const *keys, *const *values;
    const char *field;
  } cases[] = {{newline, good, "keys"},  {colon, good, "keys"},  {none, good, "keys"},
               {NULL, good, "keys"},     {good, NULL, "values"}, {good, none, "values"},
               {good, newline, "values"}};
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_csv_def def;
  packing_view view;
  packing_csv_def_init(&def);
  packing_view_init_arrays(&view, 2, x, y, z, r);
  def.note_count = 1;
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    def.keys = cases[i].keys;
    def.values = cases[i].values;
    assert_fails(c, packing_write_csv(c, &def, &view, &stream), PACKING_ERR_INVALID,
                 cases[i].field);
  }
  packing_context_destroy(c);
}

static void columns_come_in_any_order(void **state)
{
  (void)state;
  packing_particles *p =
      taken("# a note\nr, qz,id,y,type,z ,qw,x,qy,qx,component\n"
            "# another\n"
            "0.5,0,12,2,3,-0,1,1e3,0,0,4\n"
            " .25 ,1,-9223372036854775808,\t7,2147483647,1.5,0,+1,0,0,-2",
            0, 3);
  packing_view v;
  packing_particles_view(p, &v);
  assert_int_equal(v.count, 2);
  assert_int_equal(packing_particles_columns(p), PACKING_COLUMN_ID | PACKING_COLUMN_TYPE |
                                                     PACKING_COLUMN_COMPONENT |
                                                     PACKING_COLUMN_ORIENTATION);
  assert_true(at(&v.x, 0) == 1000 && at(&v.x, 1) == 1);
  assert_true(at(&v.y, 0) == 2 && at(&v.y, 1) == 7);
  assert_true(at(&v.z, 0) == 0 && signbit(at(&v.z, 0)) && at(&v.z, 1) == 1.5);
  assert_true(at(&v.r, 0) == 0.5 && at(&v.r, 1) == 0.25);
  assert_true(at(&v.qw, 0) == 1 && at(&v.qz, 1) == 1);
  int64_t id[2];
  int32_t type[2], component[2];
  assert_ok(packing_particles_extract(p, PACKING_FIELD_ID, id, sizeof id[0]));
  assert_ok(packing_particles_extract(p, PACKING_FIELD_TYPE, type, sizeof type[0]));
  assert_ok(
      packing_particles_extract(p, PACKING_FIELD_COMPONENT, component, sizeof type[0]));
  assert_true(id[0] == 12 && id[1] == INT64_MIN);
  assert_true(type[0] == 3 && type[1] == INT32_MAX);
  assert_true(component[0] == 4 && component[1] == -2);
  packing_particles_destroy(p);
}

static void lines_end_as_they_like(void **state)
{
  (void)state;
  static const char *const texts[] = {
      "x,y,z,r\n1,2,3,4\n5,6,7,8\n", "x,y,z,r\n1,2,3,4\n5,6,7,8",
      "x,y,z,r\r\n1,2,3,4\r\n5,6,7,8\r\n", "\xEF\xBB\xBFx,y,z,r\n1,2,3,4\n5,6,7,8\n",
      "\xEF\xBB\xBF# \xC3\xA9t\xC3\xA9\nx,y,z,r\n1,2,3,4\n5,6,7,8\n# end"};
  for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    for (size_t chunk = 0; chunk < 4; chunk++) {
      packing_particles *p = taken(texts[i], chunk, 3);
      packing_view v;
      packing_particles_view(p, &v);
      assert_int_equal(v.count, 2);
      assert_true(at(&v.x, 0) == 1 && at(&v.r, 0) == 4);
      assert_true(at(&v.x, 1) == 5 && at(&v.r, 1) == 8);
      packing_particles_destroy(p);
    }
}

static void two_dimensions_have_no_z(void **state)
{
  (void)state;
  packing_particles *p = taken("x,y,r,vx,vy,wz\n1,2,3,4,5,6\n", 0, 2);
  packing_view v;
  packing_particles_view(p, &v);
  assert_int_equal(v.count, 1);
  assert_true(at(&v.vx, 0) == 4 && at(&v.vy, 0) == 5 && at(&v.vz, 0) == 0);
  assert_true(at(&v.wx, 0) == 0 && at(&v.wy, 0) == 0 && at(&v.wz, 0) == 6);
  packing_particles_destroy(p);
}

typedef struct malformed {
  const char *text;
  size_t line;
  const char *says;
} malformed;

static const malformed cases[] = {
    {"", 1, "no header"},
    {"# only a note\n", 2, "no header"},
    {"\nx,y,z,r\n", 1, "unknown column \"\""},
    {"1,2,3,4\n", 1, "unknown column \"1\""},
    {"x,y,z,r,mass\n", 1, "unknown column \"mass\""},
    {"x,y,z,r,X\n", 1, "unknown column \"X\""},
    {"x,y,z,r,\n", 1, "unknown column \"\""},
    {"x;y;z;r\n", 1, "unknown column \"x;y;z;r\""},
    {"x,y,z,r\xC3\xA9\n", 1, "unknown column \"r??\""},
    {"\xFF\xFEx\n", 1, "unknown column \"??x\""},
    {"x,y,z,r,x\n", 1, "x stands twice"},
    {"y,z,r\n", 1, "x is missing"},
    {"x,y,z\n", 1, "r is missing"},
    {"x,z,r\n", 1, "y is missing"},
    {"x,y,z,r,vx,vz\n", 1, "vy is missing"},
    {"x,y,z,r,wz\n", 1, "wx is missing"},
    {"x,y,z,r,qw,qx,qz\n", 1, "qy is missing"},
    {"x,y,z,r\n1,2,3\n", 2, "3 columns, the header has 4"},
    {"x,y,z,r\n1,2,3,4,5\n", 2, "5 columns"},
    {"x,y,z,r\n1,2,3,4,\n", 2, "5 columns"},
    {"x,y,z,r\n1\n", 2, "1 column,"},
    {"x,y,z,r\n1,2,3,4\n\n", 3, "blank"},
    {"x,y,z,r\n \t\n", 2, "blank"},
    {"x,y,z,r\n1,2,3,4\n1,,3,4\n", 3, "y: \"\" is not a finite number"},
    {"x,y,z,r\n1,2,3,4 5\n", 2, "r: \"4 5\""},
    {"x,y,z,r\n1,2,3,4x\n", 2, "r: \"4x\""},
    {"x,y,z,r\n# fine\n0x10,2,3,4\n", 3, "x: \"0x10\""},
    {"x,y,z,r\nnan,2,3,4\n", 2, "x: \"nan\" is not a finite number"},
    {"x,y,z,r\n1,-inf,3,4\n", 2, "y: \"-inf\""},
    {"x,y,z,r\n1,2,INFINITY,4\n", 2, "z: \"INFINITY\""},
    {"x,y,z,r\n1,2,3,1e999\n", 2, "r: \"1e999\" is out of range"},
    {"x,y,z,r\n1,2,-1.8e308,1\n", 2, "z: \"-1.8e308\" is out of range"},
    {"x,y,z,r\n1,2,3,0\n", 2, "r: 0 must be above 0"},
    {"x,y,z,r\n1,2,3,-0.5\n", 2, "r: -0.5"},
    {"x,y,z,r\n1,2,3,1e-999\n", 2, "r: 0"},
    {"x,y,z,r\n1,2,3,\"4\"\n", 2, "r: \"\"4\"\""},
    {"x,y,z,r\n1.5.2,2,3,4\n", 2, "x: \"1.5.2\""},
    {"x,y,z,r\n1,2e,3,4\n", 2, "y: \"2e\""},
    {"x,y,z,r\n1,2\x01,3,4\n", 2, "y: \"2?\""},
    {"x,y,z,r\n1,2,\xE2\x88\x92"
     "3,4\n",
     2, "z: \"???3\""},
    {"x,y,z,r\n1,2,3\r,4\r\n", 2, "z: \"3?\""},
    {"x,y,z,r\n1 # no\n", 2, "1 column"},
    {"x,y,z,r,id\n1,2,3,4,5.0\n", 2, "id: \"5.0\" is not a whole number"},
    {"x,y,z,r,id\n1,2,3,4,\n", 2, "id: \"\" is not a whole number"},
    {"x,y,z,r,id\n1,2,3,4,9223372036854775808\n", 2, "id: "},
    {"x,y,z,r,type\n1,2,3,4,2147483648\n", 2, "type: \"2147483648\" is out of range"},
    {"x,y,z,r,component\n1,2,3,4,-2147483649\n", 2, "component: "},
};

static void malformed_files_are_refused_with_their_line(void **state)
{
  (void)state;
  log_state log = {PACKING_OK, 0};
  packing_context *c = logging_context(&log);
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    for (size_t chunk = 0; chunk < 2; chunk++) {
      packing_particles *p = test_store(3);
      char line[32];
      snprintf(line, sizeof line, "line %zu: ", cases[i].line);
      const char *text = cases[i].text;
      const packing_status status = read_text(c, text, strlen(text), chunk, p);
      if (status != PACKING_ERR_FORMAT ||
          strncmp(packing_context_message(c), line, strlen(line)) != 0 ||
          strstr(packing_context_message(c), cases[i].says) == NULL)
        fail_msg("case %zu: %s, \"%s\", not \"%s... %s\"", i,
                 packing_status_string(status), packing_context_message(c), line,
                 cases[i].says);
      assert_int_equal(log.status, PACKING_ERR_FORMAT);
      assert_int_equal(log.index, cases[i].line);
      assert_int_equal(packing_particles_count(p), 0);
      packing_particles_destroy(p);
    }
  packing_context_destroy(c);
}

static void a_zero_byte_is_no_end(void **state)
{
  (void)state;
  static const char text[] = "x,y,z,r\n1,2,3,4\0\n";
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_particles *p = test_store(3);
  assert_fails(c, read_text(c, text, sizeof text - 1, 0, p), PACKING_ERR_FORMAT,
               "line 2: r: \"4?\"");
  packing_particles_destroy(p);
  packing_context_destroy(c);
}

/* 8192 bytes a line, 1024 a number. */
static void overlong_lines_and_numbers_are_refused(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  static char text[200000];
  for (size_t length = 8190; length <= 100000;
       length = length < 8195 ? length + 1 : 100000) {
    packing_particles *p = test_store(3);
    strcpy(text, "x,y,z,r\n");
    memset(text + 8, ' ', length);
    memcpy(text + 8, "1,2,3,4", 7);
    strcpy(text + 8 + length, "\n");
    const packing_status status = read_text(c, text, strlen(text), 0, p);
    if (length <= 8192) {
      assert_ok(status);
      assert_int_equal(packing_particles_count(p), 1);
    } else {
      assert_int_equal(status, PACKING_ERR_FORMAT);
      assert_string_equal(packing_context_message(c), "line 2: longer than 8192 bytes");
    }
    packing_particles_destroy(p);
    if (length == 100000)
      break;
  }
  packing_particles *p = test_store(3);
  memset(text, 0, 200000);
  strcpy(text, "x,y,z,r\n1,2,0.");
  memset(text + strlen(text), '3', 1100);
  strcat(text, ",4\n");
  assert_fails(c, read_text(c, text, strlen(text), 0, p), PACKING_ERR_FORMAT,
               "line 2: z: a number longer than 1024 bytes");
  packing_particles_destroy(p);
  packing_context_destroy(c);
}

static void stores_that_do_not_fit_are_refused(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_particles *flat = test_store(2), *full = test_store(3);
  const packing_vec3 origin = {0, 0, 0};
  const char *text = "x,y,z,r\n1,2,3,4\n";
  assert_fails(c, read_text(c, text, strlen(text), 0, flat), PACKING_ERR_RANGE,
               "particles");
  assert_int_equal(packing_particles_count(flat), 0);
  assert_ok(packing_particles_add(full, origin, 1, NULL));
  assert_fails(c, read_text(c, text, strlen(text), 0, full), PACKING_ERR_RANGE,
               "particles");
  assert_int_equal(packing_particles_count(full), 1);
  assert_fails(c, read_text(c, text, strlen(text), 0, NULL), PACKING_ERR_INVALID,
               "particles");
  packing_particles_truncate(full, 0);
  assert_fails(c, packing_read_csv(c, NULL, full), PACKING_ERR_INVALID, "stream");
  const packing_stream unreadable = {NULL, NULL, NULL};
  assert_fails(c, packing_read_csv(c, &unreadable, full), PACKING_ERR_INVALID, "stream");
  packing_particles_destroy(flat);
  packing_particles_destroy(full);
  packing_context_destroy(c);
}

/* A stream that fails after some bytes, with a status of its own. */
static packing_status broken_read(void *user, void *buffer, size_t capacity,
                                  size_t *count)
{
  size_t *left = user;
  static const char text[] = "x,y,z,r\n1,2,3,4\n";
  assert_true(capacity > sizeof text);
  if (*left == 0)
    return PACKING_ERR_UNSUPPORTED;
  --*left;
  memcpy(buffer, text, sizeof text - 1);
  *count = sizeof text - 1;
  return PACKING_OK;
}

static packing_status greedy_read(void *user, void *buffer, size_t capacity,
                                  size_t *count)
{
  (void)user;
  (void)buffer;
  *count = capacity + 1;
  return PACKING_OK;
}

static void a_broken_stream_is_passed_on(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_particles *p = test_store(3);
  size_t left = 1;
  packing_stream stream = {broken_read, NULL, &left};
  assert_fails(c, packing_read_csv(c, &stream, p), PACKING_ERR_UNSUPPORTED, "stream");
  assert_int_equal(packing_particles_count(p), 0);
  stream.read = greedy_read;
  assert_fails(c, packing_read_csv(c, &stream, p), PACKING_ERR_INVALID, "stream");
  packing_particles_destroy(p);
  packing_context_destroy(c);
}

static void writing_fails_at_every_byte(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_view view;
  packing_view_init_arrays(&view, 2, x, y, z, r);
  char *whole = written(NULL, &view);
  for (size_t k = 1; k <= strlen(whole); k++) {
    test_buffer buffer = {0};
    const packing_stream stream = test_buffer_stream(&buffer);
    buffer.limit = k;
    const packing_status status = packing_write_csv(c, NULL, &view, &stream);
    if (k < strlen(whole)) {
      assert_int_equal(status, PACKING_ERR_IO);
      test_names(c, "stream", "write", __FILE__, __LINE__);
    } else {
      assert_ok(status);
    }
    test_buffer_free(&buffer);
  }
  free(whole);
  packing_context_destroy(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(plain_text_is_exact),
      cmocka_unit_test(notes_and_optional_columns_are_written),
      cmocka_unit_test(no_particles_make_a_header),
      cmocka_unit_test(writer_refuses_what_cannot_be_read_back),
      cmocka_unit_test(writer_refuses_notes_that_break_lines),
      cmocka_unit_test(columns_come_in_any_order),
      cmocka_unit_test(lines_end_as_they_like),
      cmocka_unit_test(two_dimensions_have_no_z),
      cmocka_unit_test(malformed_files_are_refused_with_their_line),
      cmocka_unit_test(a_zero_byte_is_no_end),
      cmocka_unit_test(overlong_lines_and_numbers_are_refused),
      cmocka_unit_test(stores_that_do_not_fit_are_refused),
      cmocka_unit_test(a_broken_stream_is_passed_on),
      cmocka_unit_test(writing_fails_at_every_byte),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
