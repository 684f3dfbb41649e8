/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grading curves and samples: what they become, and every way to be malformed. */
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

static packing_read_curve_def curve_def;
static packing_read_sample_def sample_def;

typedef packing_status (*read_function)(packing_context *context,
                                        const packing_stream *stream, packing_psd **psd);

static packing_status curve(packing_context *context, const packing_stream *stream,
                            packing_psd **psd)
{
  return packing_read_curve(context, &curve_def, stream, psd);
}

static packing_status sample(packing_context *context, const packing_stream *stream,
                             packing_psd **psd)
{
  return packing_read_sample(context, &sample_def, stream, psd);
}

static packing_status read_text(packing_context *context, read_function read,
                                const char *text, size_t chunk, packing_psd **psd)
{
  test_buffer buffer;
  test_buffer_text(&buffer, text);
  buffer.chunk = chunk;
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status = read(context, &stream, psd);
  test_buffer_free(&buffer);
  return status;
}

static packing_psd *taken(read_function read, const char *text, size_t chunk)
{
  packing_psd *psd = NULL;
  assert_ok(read_text(NULL, read, text, chunk, &psd));
  return psd;
}

static int set_up(void **state)
{
  (void)state;
  packing_read_curve_def_init(&curve_def);
  packing_read_sample_def_init(&sample_def);
  return 0;
}

static const char sand[] = "# sand\n"
                           "diameter,percent_passing\n"
                           "0.125,0\n"
                           "0.25,12.5\n"
                           "# dust between\n"
                           "0.5,75\n"
                           "1,100\n";

static const char as_shares[] = "passing , diameter\r\n"
                                "0,0.125\r\n"
                                "0.125,0.25\r\n"
                                "0.75,0.5\r\n"
                                "1,1";

/* The law passes through the rows: by mass, at half the diameters. */
static void a_curve_passes_through_its_rows(void **state)
{
  (void)state;
  for (size_t chunk = 0; chunk < 3; chunk++) {
    packing_psd *psd = taken(curve, sand, chunk);
    assert_string_equal(packing_psd_kind(psd), "curve");
    assert_true(packing_psd_min_r(psd) == 0.0625 && packing_psd_max_r(psd) == 0.5);
    assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 0.125), 0.125, 1e-12);
    assert_close(packing_psd_cdf(psd, PACKING_BY_MASS, 0.25), 0.75, 1e-12);
    packing_psd_destroy(psd);
  }
}

static void percent_and_shares_are_the_same_law(void **state)
{
  (void)state;
  packing_psd *a = taken(curve, sand, 0), *b = taken(curve, as_shares, 0);
  for (int i = 0; i <= 100; i++)
    assert_true(packing_psd_quantile(a, PACKING_BY_NUMBER, i / 100.0) ==
                packing_psd_quantile(b, PACKING_BY_NUMBER, i / 100.0));
  packing_psd_destroy(a);
  packing_psd_destroy(b);
}

/* A scale of a power of two scales every radius bit for bit. */
static void the_scale_multiplies_lengths(void **state)
{
  (void)state;
  packing_psd *plain = taken(curve, sand, 0);
  curve_def.scale = 1.0 / 1024;
  packing_psd *small = taken(curve, sand, 0);
  for (int i = 0; i <= 100; i++)
    assert_true(packing_psd_quantile(plain, PACKING_BY_MASS, i / 100.0) ==
                1024 * packing_psd_quantile(small, PACKING_BY_MASS, i / 100.0));
  packing_psd_destroy(plain);
  packing_psd_destroy(small);
  plain = taken(sample, "1\n2\n", 0);
  sample_def.scale = 4;
  small = taken(sample, "1\n2\n", 0);
  assert_true(packing_psd_max_r(plain) == 2 && packing_psd_max_r(small) == 8);
  packing_psd_destroy(plain);
  packing_psd_destroy(small);
}

static void by_and_dim_are_passed_on(void **state)
{
  (void)state;
  curve_def.by = PACKING_BY_NUMBER;
  packing_psd *psd = taken(curve, sand, 0);
  assert_close(packing_psd_cdf(psd, PACKING_BY_NUMBER, 0.25), 0.75, 1e-12);
  packing_psd_destroy(psd);
  curve_def.dim = 4;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  psd = NULL;
  assert_fails(c, read_text(c, curve, sand, 0, &psd), PACKING_ERR_RANGE, "dim");
  sample_def.dim = 4;
  assert_fails(c, read_text(c, sample, "1\n", 0, &psd), PACKING_ERR_RANGE, "dim");
  sample_def.dim = 3;
  sample_def.bandwidth = -1;
  assert_fails(c, read_text(c, sample, "1\n", 0, &psd), PACKING_ERR_RANGE, "bandwidth");
  assert_null(psd);
  packing_context_destroy(c);
}

static void a_sample_is_its_radii(void **state)
{
  (void)state;
  for (size_t chunk = 0; chunk < 3; chunk++) {
    packing_psd *psd =
        taken(sample, "# radii\n3\n\n  \t\n 1 \r\n2e0\n3\n# the end", chunk);
    double mean;
    assert_string_equal(packing_psd_kind(psd), "sample");
    assert_true(packing_psd_min_r(psd) == 1 && packing_psd_max_r(psd) == 3);
    assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, 1, &mean));
    assert_close(mean, 2.25, 1e-15);
    packing_psd_destroy(psd);
  }
}

static void a_long_sample_grows(void **state)
{
  (void)state;
  enum { COUNT = 5000 };
  char *text = malloc(COUNT * 8);
  size_t used = 0;
  double mean;
  assert_non_null(text);
  for (int i = 1; i <= COUNT; i++)
    used += (size_t)snprintf(text + used, 8, "%d\n", i);
  packing_psd *psd = taken(sample, text, 0);
  assert_ok(packing_psd_moment(psd, PACKING_BY_NUMBER, 1, &mean));
  assert_close(mean, (COUNT + 1) / 2.0, 1e-12);
  packing_psd_destroy(psd);
  free(text);
}

/* `count` rows, then what follows. */
static char *rows(int count, const char *end)
{
  char *text = malloc((size_t)count * 16 + 100);
  size_t used = 0;
  assert_non_null(text);
  used += (size_t)sprintf(text, "diameter,passing\n");
  for (int i = 0; i < count; i++)
    used += (size_t)sprintf(text + used, "%d,0\n", i + 1);
  strcpy(text + used, end);
  return text;
}

static void a_long_curve_grows(void **state)
{
  (void)state;
  char *text = rows(1000, "1001,1\n");
  packing_psd *psd = taken(curve, text, 0);
  assert_true(packing_psd_max_r(psd) == 500.5);
  assert_near(packing_psd_cdf(psd, PACKING_BY_MASS, 500), 0, 1e-12);
  packing_psd_destroy(psd);
  free(text);
}

static void a_curve_has_a_limit(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_psd *psd = NULL;
  char *text = rows(100001, "");
  assert_fails(c, read_text(c, curve, text, 0, &psd), PACKING_ERR_FORMAT,
               "line 100002: more than 100000 rows");
  free(text);
  packing_context_destroy(c);
}

typedef struct malformed {
  read_function read;
  const char *text;
  size_t line;
  packing_status status;
  const char *says;
} malformed;

#define HEAD "diameter,percent_passing\n"

static const malformed cases[] = {
    {curve, "", 1, PACKING_ERR_FORMAT, "no header"},
    {curve, "1,0\n2,100\n", 1, PACKING_ERR_FORMAT, "unknown column \"1\""},
    {curve, "diameter\n1\n", 1, PACKING_ERR_FORMAT, "the header must be"},
    {curve, "passing,percent_passing\n", 1, PACKING_ERR_FORMAT, "the header must be"},
    {curve, "diameter,passing,percent_passing\n", 1, PACKING_ERR_FORMAT, "must be"},
    {curve, "diameter,diameter\n", 1, PACKING_ERR_FORMAT, "twice"},
    {curve, "Diameter,passing\n", 1, PACKING_ERR_FORMAT, "\"Diameter\""},
    {curve, "diameter;passing\n", 1, PACKING_ERR_FORMAT, "unknown column"},
    {curve, HEAD, 1, PACKING_ERR_FORMAT, "truncated: no row"},
    {curve, HEAD "1,0\n", 2, PACKING_ERR_FORMAT, "truncated: the last row passes 0"},
    {curve, HEAD "1,0\n2,94.5\n", 3, PACKING_ERR_FORMAT,
     "truncated: the last row passes 94.5"},
    {curve, "diameter,passing\n1,0\n2,0.999", 3, PACKING_ERR_FORMAT, "truncated"},
    {curve, HEAD "1,5\n2,100\n", 2, PACKING_ERR_FORMAT, "the first row passes 5, not 0"},
    {curve, HEAD "1,0\n2,60\n3,50\n4,100\n", 4, PACKING_ERR_FORMAT, "descending: 50"},
    {curve, HEAD "1,0\n3,60\n2,70\n4,100\n", 4, PACKING_ERR_FORMAT,
     "diameter 2 does not rise above 3"},
    {curve, HEAD "1,0\n1,100\n", 3, PACKING_ERR_FORMAT, "diameter 1 does not rise"},
    {curve, HEAD "0,0\n1,100\n", 2, PACKING_ERR_FORMAT, "diameter 0 must be above 0"},
    {curve, HEAD "-1,0\n1,100\n", 2, PACKING_ERR_FORMAT, "diameter -1"},
    {curve, HEAD "1,-1\n2,100\n", 2, PACKING_ERR_FORMAT,
     "-1 passing is not within 0 to 100"},
    {curve, HEAD "1,0\n2,100.5\n", 3, PACKING_ERR_FORMAT, "100.5 passing"},
    {curve, "diameter,passing\n1,0\n2,100\n", 3, PACKING_ERR_FORMAT,
     "100 passing is not within 0 to 1"},
    {curve, HEAD "1,0\n2,nan\n", 3, PACKING_ERR_FORMAT, "percent_passing: \"nan\""},
    {curve, HEAD "1,0\n2,100,\n", 3, PACKING_ERR_FORMAT, "3 columns"},
    {curve, HEAD "1,0\n\n2,100\n", 3, PACKING_ERR_FORMAT, "blank"},
    {curve, HEAD "1,0\n2;100\n", 3, PACKING_ERR_FORMAT, "1 column"},
    {curve, HEAD "1,0\n2,100%\n", 3, PACKING_ERR_FORMAT, "\"100%\""},
    {curve, HEAD "1,0\n1e999,100\n", 3, PACKING_ERR_FORMAT,
     "diameter: \"1e999\" is out of range"},
    {sample, "", 1, PACKING_ERR_FORMAT, "no radius"},
    {sample, "# only\n\n", 3, PACKING_ERR_FORMAT, "no radius"},
    {sample, "1\n0\n", 2, PACKING_ERR_FORMAT, "r: 0 must be above 0"},
    {sample, "1\n-2\n", 2, PACKING_ERR_FORMAT, "r: -2"},
    {sample, "1\n2 3\n", 2, PACKING_ERR_FORMAT, "r: \"2 3\""},
    {sample, "1\n2,3\n", 2, PACKING_ERR_FORMAT, "2 columns"},
    {sample, "r\n1\n", 1, PACKING_ERR_FORMAT, "r: \"r\" is not a finite number"},
    {sample, "1\ninf\n", 2, PACKING_ERR_FORMAT, "\"inf\""},
    {sample, "1\n\n\n1e400\n", 4, PACKING_ERR_FORMAT, "out of range"},
};

static void malformed_files_are_refused_with_their_line(void **state)
{
  (void)state;
  log_state log = {PACKING_OK, 0};
  packing_context *c = logging_context(&log);
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    packing_psd *psd = NULL;
    char line[32];
    snprintf(line, sizeof line, "line %zu: ", cases[i].line);
    const packing_status status = read_text(c, cases[i].read, cases[i].text, i % 3, &psd);
    const char *message = packing_context_message(c);
    if (status != cases[i].status || strncmp(message, line, strlen(line)) != 0 ||
        strstr(message, cases[i].says) == NULL)
      fail_msg("case %zu: %s, \"%s\", not \"%s... %s\"", i, packing_status_string(status),
               message, line, cases[i].says);
    assert_int_equal(log.status, cases[i].status);
    assert_int_equal(log.index, cases[i].line);
    assert_null(psd);
  }
  packing_context_destroy(c);
}

static void options_are_checked(void **state)
{
  (void)state;
  packing_context *c = test_context(1, PACKING_ISA_AUTO);
  packing_psd *psd = NULL;
  curve_def.scale = sample_def.scale = 0;
  assert_fails(c, read_text(c, curve, sand, 0, &psd), PACKING_ERR_RANGE, "scale");
  assert_fails(c, read_text(c, sample, "1\n", 0, &psd), PACKING_ERR_RANGE, "scale");
  curve_def.scale = sample_def.scale = (double)NAN;
  assert_fails(c, read_text(c, curve, sand, 0, &psd), PACKING_ERR_INVALID, "scale");
  assert_fails(c, read_text(c, sample, "1\n", 0, &psd), PACKING_ERR_INVALID, "scale");
  curve_def.scale = sample_def.scale = 1e300;
  assert_fails(c, read_text(c, curve, HEAD "1e9,0\n2e9,100\n", 0, &psd),
               PACKING_ERR_RANGE, "line 2: diameter 1e+09 times the scale");
  assert_fails(c, read_text(c, sample, "1\n1e9\n", 0, &psd), PACKING_ERR_RANGE,
               "line 2: r 1e+09 times the scale");
  set_up(NULL);
  assert_fails(c, read_text(c, curve, sand, 0, NULL), PACKING_ERR_INVALID, "psd");
  assert_fails(c, read_text(c, sample, "1\n", 0, NULL), PACKING_ERR_INVALID, "psd");
  assert_fails(c, packing_read_curve(c, NULL, NULL, &psd), PACKING_ERR_INVALID, "stream");
  assert_fails(c, packing_read_sample(c, NULL, NULL, &psd), PACKING_ERR_INVALID,
               "stream");
  curve_def.struct_size = sample_def.struct_size = 1;
  assert_status(read_text(c, curve, sand, 0, &psd), PACKING_ERR_ABI);
  assert_status(read_text(c, sample, "1\n", 0, &psd), PACKING_ERR_ABI);
  assert_null(psd);
  packing_context_destroy(c);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(a_curve_passes_through_its_rows, set_up),
      cmocka_unit_test_setup(percent_and_shares_are_the_same_law, set_up),
      cmocka_unit_test_setup(the_scale_multiplies_lengths, set_up),
      cmocka_unit_test_setup(by_and_dim_are_passed_on, set_up),
      cmocka_unit_test_setup(a_sample_is_its_radii, set_up),
      cmocka_unit_test_setup(a_long_sample_grows, set_up),
      cmocka_unit_test_setup(a_long_curve_grows, set_up),
      cmocka_unit_test_setup(a_curve_has_a_limit, set_up),
      cmocka_unit_test_setup(malformed_files_are_refused_with_their_line, set_up),
      cmocka_unit_test_setup(options_are_checked, set_up),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
