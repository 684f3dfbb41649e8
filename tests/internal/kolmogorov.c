/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ways to a Kolmogorov-Smirnov p-value against each other where they overlap. */
#include "test.h"
#include "measure/sizes_internal.h"

static double exact(size_t n, double d)
{
  double chance = -1;
  assert_ok(packing_i_kolmogorov_matrix(NULL, n, d, &chance));
  return chance;
}

/* The first term left out is of order n^-2; its factor is below 0.06. */
static void the_expansion_nears_the_matrix(void **state)
{
  (void)state;
  const double counts[] = {200, 500, 1000, 5000};
  for (size_t c = 0; c < 4; c++)
    for (double z = 0.3; z < 2.5; z += c < 3 ? 0.1 : 0.4) {
      const double n = counts[c];
      assert_near(packing_i_kolmogorov_expansion(n, z), exact((size_t)n, z / sqrt(n)),
                  0.06 / (n * n) + 1e-13);
    }
  assert_true(packing_i_kolmogorov_expansion(1e4, 1e-3) == 0);
  assert_near(packing_i_kolmogorov_expansion(1e4, 9), 1, 1e-12);
}

static void twice_one_side_is_the_tail_of_the_matrix(void **state)
{
  (void)state;
  for (size_t n = 2; n < 1500; n = n * 3 / 2 + 1)
    for (double z = 1.9; z < 2.6; z += 0.2) {
      const double d = z / sqrt((double)n);
      if (d < 1)
        assert_near(2 * packing_i_kolmogorov_side(n, d), 1 - exact(n, d),
                    3 * exp(-8 * z * z) + 1e-13);
    }
}

/* P(D+ >= d) = (1 - d)^n for d >= 1 - 1/n. */
static void one_side_has_a_closed_form(void **state)
{
  (void)state;
  for (size_t n = 1; n < 50; n++) {
    const double d = 1 - 0.7 / (double)n;
    assert_close(packing_i_kolmogorov_side(n, d), pow(1 - d, (double)n), 1e-13);
    assert_near(packing_i_kolmogorov_side(n, 1), 0, 1e-300);
  }
}

/* To (n d^2)^2 / n of itself, as the header of the method says. */
static void one_side_nears_its_limit(void **state)
{
  (void)state;
  for (size_t n = 1000; n <= 100000; n *= 10)
    for (double z2 = 1; z2 <= 12; z2 += 1) {
      const double d = sqrt(z2 / (double)n);
      assert_close(packing_i_kolmogorov_side_limit((double)n, d),
                   packing_i_kolmogorov_side(n, d), (z2 * z2 + 1) / (double)n);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_expansion_nears_the_matrix),
      cmocka_unit_test(twice_one_side_is_the_tail_of_the_matrix),
      cmocka_unit_test(one_side_has_a_closed_form),
      cmocka_unit_test(one_side_nears_its_limit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
