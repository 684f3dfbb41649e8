/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of formats: what a program chooses from must be told apart. */
#include "../../lib/io/io_internal.h"
#include "test.h"

static size_t count(void)
{
  size_t n = 0;
  while (packing_i_formats[n] != NULL)
    n++;
  return n;
}

static void formats_are_described(void **state)
{
  (void)state;
  assert_true(count() >= 7);
  for (size_t i = 0; i < count(); i++) {
    const packing_i_format *f = packing_i_formats[i];
    assert_true(strlen(f->name) > 0 && strlen(f->reference) > 0 && strlen(f->holds) > 0);
    for (size_t j = 0; j < i; j++)
      assert_string_not_equal(f->name, packing_i_formats[j]->name);
  }
}

/* Each extension has its dot and belongs to one format. */
static void extensions_are_distinct(void **state)
{
  (void)state;
  char seen[256] = " ";
  for (size_t i = 0; i < count(); i++) {
    const char *at = packing_i_formats[i]->extensions;
    while (*at != '\0') {
      const size_t length = strcspn(at, " ");
      char key[32];
      assert_true(*at == '.' && length > 1 && length < 16);
      snprintf(key, sizeof key, " %.*s ", (int)length, at);
      assert_null(strstr(seen, key));
      assert_true(strlen(seen) + length + 2 < sizeof seen);
      strcat(seen, key + 1);
      at += length;
      at += *at == ' ';
    }
  }
  assert_non_null(strstr(seen, " .csv "));
  assert_non_null(strstr(seen, " .vtp "));
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(formats_are_described),
      cmocka_unit_test(extensions_are_distinct),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
