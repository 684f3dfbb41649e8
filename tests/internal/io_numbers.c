/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers to text and back: every byte against printf, every bit against strtod. */
#include "../../lib/io/decimal_internal.h"
#include "test.h"

/* xorshift64*: a stream of the test's own. */
static uint64_t next_bits(uint64_t *state)
{
  *state ^= *state >> 12;
  *state ^= *state << 25;
  *state ^= *state >> 27;
  return *state * UINT64_C(2685821657736338717);
}

static double from_bits(uint64_t bits)
{
  double v;
  memcpy(&v, &bits, sizeof v);
  return v;
}

static uint64_t to_bits(double v)
{
  uint64_t bits;
  memcpy(&bits, &v, sizeof bits);
  return bits;
}

/* 10^q = T 2^(L - 127) with T - the entry in [0, 1): against whole numbers. For q < 0, T is
 * the floor of 2^(127 - L) / 10^-q, so T 10^-q <= 2^(127 - L) < (T + 1) 10^-q. */
static void every_power_of_ten_is_the_floor(void **state)
{
  (void)state;
  for (int q = PACKING_I_POW10_MIN; q <= PACKING_I_POW10_MAX; q++) {
    const uint64_t *t = packing_i_pow10[q - PACKING_I_POW10_MIN];
    const int floor_log2 = q * 217706 >> 16;
    assert_true(t[0] >> 63 == 1);
    for (int step = 0; step < 2; step++) {
      packing_i_big entry, one;
      entry.count = 5;
      const uint64_t low = t[1] + (uint64_t)step;
      const uint64_t high = t[0] + (low < t[1]);
      entry.limb[0] = (uint32_t)low;
      entry.limb[1] = (uint32_t)(low >> 32);
      entry.limb[2] = (uint32_t)high;
      entry.limb[3] = (uint32_t)(high >> 32);
      entry.limb[4] = high < t[0];
      packing_i_big_set(&one, 1);
      /* the sign of 10^q 2^(127 - L) - entry */
      const int sign = packing_i_big_compare(&one, 127 - floor_log2, q, &entry);
      if (step == 0)
        assert_true(q >= 0 && q <= 55 ? sign == 0 : sign > 0);
      else
        assert_true(sign < 0);
    }
  }
}

static void assert_formats(double v)
{
  char want[64], got[PACKING_I_DOUBLE_SIZE];
  snprintf(want, sizeof want, "%.17g", v);
  const unsigned size = packing_i_format_double(v, got);
  assert_true(size <= 24);
  if (size != strlen(want) || memcmp(got, want, size) != 0)
    fail_msg("%s comes out as %.*s", want, (int)size, got);
}

static void assert_parses(const char *text)
{
  char *stop;
  const char *at = text;
  double got = 0;
  const double want = strtod(text, &stop);
  const packing_i_number found = packing_i_parse_double(&at, &got);
  if (isinf(want)) {
    if (found != PACKING_I_NUMBER_LARGE)
      fail_msg("%s is not found too large", text);
    return;
  }
  if (found != PACKING_I_NUMBER_OK || at != stop || to_bits(got) != to_bits(want))
    fail_msg("%s reads as %.17g, not %.17g (%d)", text, got, want, (int)found);
}

static void assert_round_trip(double v)
{
  char text[PACKING_I_DOUBLE_SIZE + 1];
  const char *at = text;
  double back;
  const unsigned size = packing_i_format_double(v, text);
  text[size] = '\0';
  assert_int_equal(packing_i_parse_double(&at, &back), PACKING_I_NUMBER_OK);
  assert_true(at == text + size);
  assert_true(to_bits(back) == to_bits(v));
}

static void edges_are_exact(void **state)
{
  (void)state;
  static const double edges[] = {0.0,
                                 1.0,
                                 0.1,
                                 9.0,
                                 10.0,
                                 99.0,
                                 1e16,
                                 1e17,
                                 1e22,
                                 1e23,
                                 1e-4,
                                 1e-5,
                                 9.9999e-5,
                                 0.5,
                                 1.5,
                                 123456.0,
                                 5e-324,
                                 1e-323,
                                 2.5e-320,
                                 2.2250738585072014e-308,
                                 2.2250738585072009e-308,
                                 1.7976931348623157e308,
                                 1.7976931348623155e308,
                                 9007199254740991.0,
                                 9007199254740992.0,
                                 9007199254740993.0,
                                 9007199254740994.0,
                                 99999999999999984.0,
                                 99999999999999999.0,
                                 123456789012345678.0,
                                 2.385,
                                 1.0 / 3.0};
  for (size_t i = 0; i < sizeof edges / sizeof edges[0]; i++)
    for (int sign = -1; sign <= 1; sign += 2) {
      assert_formats(sign * edges[i]);
      assert_round_trip(sign * edges[i]);
    }
}

static void powers_and_their_neighbours_are_exact(void **state)
{
  (void)state;
  for (int k = -1074; k <= 1023; k++) {
    const double p = ldexp(1.0, k);
    assert_formats(p);
    assert_formats(nextafter(p, 0.0));
    assert_formats(nextafter(p, 1e308));
    assert_round_trip(p);
  }
  for (int k = -323; k <= 308; k++) {
    char text[16];
    snprintf(text, sizeof text, "1e%d", k);
    assert_parses(text);
    const double p = strtod(text, NULL);
    assert_formats(p);
    assert_formats(nextafter(p, 0.0));
    assert_formats(nextafter(p, 1e308));
  }
}

/* Halves, quarters, eighths with as many digits as fit: exact ties in the 17th digit. */
static void ties_go_to_even(void **state)
{
  (void)state;
  uint64_t stream = 2385;
  for (int i = 0; i < 60000; i++) {
    const uint64_t bits = next_bits(&stream);
    assert_formats((double)(bits >> (bits & 7)));
    assert_formats(ldexp((double)(bits >> 11 | 1), -(int)(bits & 63)));
  }
}

/* The short product against whole numbers of full length, over all powers of ten and every
 * shift that 17 digits need; with exact ties where the power is 1. */
static void short_and_long_products_round_alike(void **state)
{
  (void)state;
  uint64_t stream = 8128;
  size_t ties = 0;
  for (int i = 0; i < 100000; i++) {
    const int q = -292 + i % 633, shift = 69 + i / 633 % 6;
    uint64_t m = next_bits(&stream) | UINT64_C(1) << 63, kept;
    if (q == 0)
      m = (m >> (shift - 63) | 1) << (shift - 63) | UINT64_C(1) << (shift - 64);
    const packing_i_scaled s = packing_i_scale10(m, q);
    const int e = -(shift + s.exp2);
    const packing_i_rounding quick = packing_i_round_scaled(&s, shift, &kept);
    const packing_i_rounding slow = packing_i_round_exactly(m, e, q, kept);
    assert_true(quick == slow || quick == PACKING_I_ROUND_UNSURE);
    ties += slow == PACKING_I_ROUND_TIE;
  }
  assert_true(ties >= 100);
}

static void random_bits_are_exact(void **state)
{
  (void)state;
  uint64_t stream = 20090604;
  for (int i = 0; i < 1200000; i++) {
    const double v = from_bits(next_bits(&stream));
    if (!isfinite(v))
      continue;
    assert_formats(v);
    assert_round_trip(v);
  }
}

/* What packs hold: 0 to 1, and some digits. */
static void usual_numbers_are_exact(void **state)
{
  (void)state;
  uint64_t stream = 17;
  for (int i = 0; i < 100000; i++) {
    const double v = ldexp((double)(next_bits(&stream) >> 11), -53);
    assert_formats(v);
    assert_round_trip(v);
    assert_formats(rint(v * 1000) / 1000);
  }
}

static void random_texts_parse_as_strtod_does(void **state)
{
  (void)state;
  uint64_t stream = 5;
  for (int i = 0; i < 200000; i++) {
    char text[128];
    const uint64_t a = next_bits(&stream), b = next_bits(&stream), c = next_bits(&stream);
    const int exponent = (int)(c % 720) - 370;
    switch (i % 4) {
    case 0:
      snprintf(text, sizeof text, "%llue%d", (unsigned long long)a, exponent);
      break;
    case 1: /* 30 to 40 digits */
      snprintf(text, sizeof text, "%llu%llu.%llue%d", (unsigned long long)a,
               (unsigned long long)b, (unsigned long long)(a ^ b), exponent);
      break;
    case 2:
      snprintf(text, sizeof text, "-0.000%llu", (unsigned long long)(a >> (c & 63)));
      break;
    default:
      snprintf(text, sizeof text, "+%llu.%lluE%+d", (unsigned long long)(a & 1023),
               (unsigned long long)(b >> (c & 63)), exponent);
    }
    assert_parses(text);
  }
}

/* The exact decimal digits of the middle between two doubles, of the middle with one unit
 * added far behind and of the middle cut: up to 770 digits. */
static void middles_between_doubles_are_decided(void **state)
{
  (void)state;
  uint64_t stream = 99;
  for (int i = 0; i < 4000; i++) {
    char text[1100];
    double v = fabs(from_bits(next_bits(&stream)));
    if (i % 4 == 0)
      v = ldexp((double)(next_bits(&stream) >> 40), -1074); /* denormals */
    if (!isfinite(v) || v > 1e300 || (v != 0 && v < 1e-306 && i % 4 != 0))
      continue;
    /* long double has eleven bits more: the middle is exact in it */
    const long double middle = ((long double)v + (long double)nextafter(v, HUGE_VAL)) / 2;
    const int size = snprintf(text, sizeof text - 1, "%.780Lg", middle);
    assert_true(size > 0 && size < 900);
    assert_parses(text);
    if (strpbrk(text, "e") == NULL && strpbrk(text, ".") != NULL) {
      strcat(text, "0000000001");
      assert_parses(text);
      text[size - 1]--;
      assert_parses(text);
    }
    char *e = strpbrk(text, "e");
    if (e != NULL) { /* one more digit before the exponent */
      memmove(e + 1, e, strlen(e) + 1);
      *e = '1';
      assert_parses(text);
    }
  }
}

static void known_hard_cases_are_exact(void **state)
{
  (void)state;
  static const char *const texts[] = {
      "9007199254740993",
      "9007199254740993.0000000000000000000000000000000001",
      "9007199254740992.9999999999999999999999999999999999",
      "2.2250738585072011e-308",
      "2.2250738585072012e-308",
      "1.7976931348623157e308",
      "1.7976931348623158e308",
      "1.7976931348623159e308",
      "179769313486231580793728971405303415079934132710037826936173778980444968292764750"
      "94664901797758720709633028641669288791094655554785194040263065748867150582068190"
      "89028407081287586763294671346836275152205220010345124211178434816240"
      "77570000.0",
      "4.9406564584124654e-324",
      "2.4703282292062327e-324",
      "2.4703282292062328e-324",
      "2.47032822920623272088284396434110686182529901307162382212792841250337753635104e-"
      "324",
      "7."
      "4109846876186981626485318930233205854758970392148714663837852375101326090531312779"
      "7949754542453988569694847043168576596389985065533909694598162194016172817189451069"
      "78"
      "5460710679176872575177347315553307795408549809608457500958111373034747658096871009"
      "590"
      "9754422710047573078097111189357848386756539987835030152280559340465937397917907387"
      "238"
      "2986502656757862600526e-324",
      "6.631236871469758276785396630275967e-316",
      "3."
      "2378839133029012895883524125015321748630376694231080599012970495523019706706765657"
      "86"
      "8353425930e-319",
      "8.54e-317",
      "1e-9999999999",
      "1e9999999999",
      "0e9999999999",
      "00000000000000000000000000000000000001.5",
      "0.00000000000000000000000000000000000015",
      "100000000000000000000000000000000000000000",
      "1e22",
      "1e23",
      "8.988465674311579e307",
      ".5",
      "5.",
      "+1.",
      "-.0",
      "-0",
      "-0e-5",
      "123456789012345678901234567890e-25"};
  for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
    assert_parses(texts[i]);
}

static void what_is_no_number_is_refused(void **state)
{
  (void)state;
  static const char *const texts[] = {"",   "-",   "+",   ".",   "-.",  "e5",
                                      "1e", "1e+", "1e-", "x1",  "nan", "inf",
                                      ",",  "--1", "+-1", "INF", " 1",  "\n"};
  for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
    const char *at = texts[i];
    double v = 7;
    assert_int_equal(packing_i_parse_double(&at, &v), PACKING_I_NUMBER_NONE);
    assert_true(at == texts[i] && v == 7);
  }
  const char *hex = "0x10";
  double v;
  assert_int_equal(packing_i_parse_double(&hex, &v), PACKING_I_NUMBER_OK);
  assert_true(v == 0 && *hex == 'x'); /* what follows is for the caller to refuse */
}

static void long_numbers_have_a_limit(void **state)
{
  (void)state;
  char text[PACKING_I_NUMBER_LENGTH + 32];
  for (int point = 0; point < 2; point++)
    for (int extra = 0; extra < 2; extra++) {
      const int size = PACKING_I_NUMBER_LENGTH + extra;
      memset(text, '7', (size_t)size);
      if (point)
        text[1] = '.';
      text[size] = '\0';
      const char *at = text;
      double v;
      const packing_i_number want = extra   ? PACKING_I_NUMBER_LONG
                                    : point ? PACKING_I_NUMBER_OK
                                            : PACKING_I_NUMBER_LARGE;
      assert_int_equal(packing_i_parse_double(&at, &v), want);
    }
  /* the longest number with a denormal's middle in it fits the whole numbers used */
  memset(text, '0', PACKING_I_NUMBER_LENGTH);
  memcpy(text, "2.4703282292062327208828439643411068618252990130716238221279284125033",
         69);
  memcpy(text + PACKING_I_NUMBER_LENGTH - 6, "1e-324", 7);
  assert_parses(text);
  memset(text, '9', PACKING_I_NUMBER_LENGTH);
  memcpy(text + PACKING_I_NUMBER_LENGTH - 5, "e-720", 6);
  assert_parses(text);
}

static void integers_read_and_write(void **state)
{
  (void)state;
  static const int64_t numbers[] = {0,  1,  -1,        9,         10,        -10,
                                    99, 42, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN};
  for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
    char want[32], got[32];
    int64_t back = 7;
    snprintf(want, sizeof want, "%lld", (long long)numbers[i]);
    got[packing_i_format_int(numbers[i], got)] = '\0';
    assert_string_equal(got, want);
    const char *at = got;
    assert_int_equal(packing_i_parse_int(&at, &back), PACKING_I_NUMBER_OK);
    assert_true(*at == '\0' && back == numbers[i]);
  }
  static const char *const large[] = {"9223372036854775808", "-9223372036854775809",
                                      "18446744073709551616", "99999999999999999999999"};
  for (size_t i = 0; i < sizeof large / sizeof large[0]; i++) {
    const char *at = large[i];
    int64_t back;
    assert_int_equal(packing_i_parse_int(&at, &back), PACKING_I_NUMBER_LARGE);
  }
  const char *none = "-x";
  int64_t back;
  assert_int_equal(packing_i_parse_int(&none, &back), PACKING_I_NUMBER_NONE);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_power_of_ten_is_the_floor),
      cmocka_unit_test(edges_are_exact),
      cmocka_unit_test(powers_and_their_neighbours_are_exact),
      cmocka_unit_test(ties_go_to_even),
      cmocka_unit_test(short_and_long_products_round_alike),
      cmocka_unit_test(random_bits_are_exact),
      cmocka_unit_test(usual_numbers_are_exact),
      cmocka_unit_test(random_texts_parse_as_strtod_does),
      cmocka_unit_test(middles_between_doubles_are_decided),
      cmocka_unit_test(known_hard_cases_are_exact),
      cmocka_unit_test(what_is_no_number_is_refused),
      cmocka_unit_test(long_numbers_have_a_limit),
      cmocka_unit_test(integers_read_and_write),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
