/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program that has set a locale with a decimal comma reads and writes the same files. The
 * locale is one that is installed, or is compiled into a directory of the test's own; where
 * neither can be, the test is skipped. */
#define _XOPEN_SOURCE 700
#include "test.h"
#include <locale.h>
#include <unistd.h>

static char directory[256];

static int has_comma(void)
{
  return strcmp(localeconv()->decimal_point, ",") == 0;
}

static int compile_locale(void)
{
  const char *base = getenv("TMPDIR");
  char command[600];
  snprintf(directory, sizeof directory, "%s/packing-locale-XXXXXX",
           base != NULL && strlen(base) < 200 ? base : "/tmp");
  if (mkdtemp(directory) == NULL)
    return 0;
  snprintf(command, sizeof command,
           "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >/dev/null 2>&1", directory);
  return system(command) == 0 && setenv("LOCPATH", directory, 1) == 0 &&
         setlocale(LC_ALL, "de_DE.UTF-8") != NULL;
}

static int set_comma(void **state)
{
  static const char *const names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "ru_RU.UTF-8"};
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    if (setlocale(LC_ALL, names[i]) != NULL && has_comma())
      return 0;
  if (!compile_locale())
    setlocale(LC_ALL, "C");
  return 0;
}

static int unset_comma(void **state)
{
  char command[300];
  (void)state;
  setlocale(LC_ALL, "C");
  snprintf(command, sizeof command, "rm -rf '%s'", directory);
  return directory[0] == '\0' ? 0 : system(command);
}

static void skip_without_comma(void)
{
  if (has_comma())
    return;
  print_message("no locale with a decimal comma is installed, nor can one be made\n");
  skip();
}

static void a_comma_locale_changes_no_byte(void **state)
{
  (void)state;
  skip_without_comma();
  char shown[8];
  snprintf(shown, sizeof shown, "%.1f", 0.5);
  assert_string_equal(shown, "0,5"); /* the host's own output has changed */
  static const double x[] = {0.1, 1e-5}, r[] = {0.5, 2.385};
  packing_view view;
  test_buffer buffer = {0};
  const packing_stream stream = test_buffer_stream(&buffer);
  packing_view_init_arrays(&view, 2, x, x, x, r);
  assert_ok(packing_write_csv(NULL, NULL, &view, &stream));
  assert_string_equal(buffer.data,
                      "x,y,z,r\n"
                      "0.10000000000000001,0.10000000000000001,0.10000000000000001,0.5\n"
                      "1.0000000000000001e-05,1.0000000000000001e-05,"
                      "1.0000000000000001e-05,2.3849999999999998\n");
  packing_particles *particles = test_store(3);
  assert_ok(packing_read_csv(NULL, &stream, particles));
  double back[2];
  assert_ok(packing_particles_extract(particles, PACKING_FIELD_R, back, sizeof back[0]));
  assert_true(back[0] == 0.5 && back[1] == 2.385);
  packing_particles_destroy(particles);
  test_buffer_free(&buffer);
}

static void a_comma_locale_changes_no_sizes(void **state)
{
  (void)state;
  skip_without_comma();
  packing_psd *psd = NULL;
  test_buffer buffer;
  test_buffer_text(&buffer, "0.5\n2.385\n");
  const packing_stream stream = test_buffer_stream(&buffer);
  assert_ok(packing_read_sample(NULL, NULL, &stream, &psd));
  assert_true(packing_psd_min_r(psd) == 0.5 && packing_psd_max_r(psd) == 2.385);
  packing_psd_destroy(psd);
  test_buffer_free(&buffer);
  assert_true(has_comma()); /* and the locale is still the host's */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_comma_locale_changes_no_byte),
      cmocka_unit_test(a_comma_locale_changes_no_sizes),
  };
  return cmocka_run_group_tests(tests, set_comma, unset_comma);
}
