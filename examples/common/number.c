/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers in text. The programs never call setlocale(), so strtod() reads the C locale's
 * numbers; what it takes beyond plain decimal ones is refused first. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "program.h"

static int not_a_number(const char *where, const char *text)
{
  if (!*text)
    return program_fail(PROGRAM_BAD_INPUT, "%s: a number is missing", where);
  return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is not a number", where, text);
}

/* [sign] digits [. digits] [e [sign] digits], with a digit before or after the point. */
static int is_decimal(const char *text)
{
  size_t digits = 0;
  text += *text == '+' || *text == '-';
  for (; isdigit((unsigned char)*text); text++)
    digits++;
  if (*text == '.')
    for (text++; isdigit((unsigned char)*text); text++)
      digits++;
  if (!digits)
    return 0;
  if (*text == 'e' || *text == 'E') {
    text++;
    text += *text == '+' || *text == '-';
    if (!isdigit((unsigned char)*text))
      return 0;
    text += strspn(text, "0123456789");
  }
  return *text == '\0';
}

int number_real(const char *where, const char *text, double *value)
{
  if (!is_decimal(text))
    return not_a_number(where, text);
  const double read = strtod(text, NULL);
  if (!isfinite(read))
    return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is too large", where, text);
  *value = read;
  return 0;
}

int number_positive(const char *where, const char *text, double *value)
{
  double read = 0;
  const int code = number_real(where, text, &read);
  if (code)
    return code;
  if (!(read > 0))
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s is not above 0", where, text);
  *value = read;
  return 0;
}

int number_not_negative(const char *where, const char *text, double *value)
{
  const int code = number_real(where, text, value);
  return !code && !(*value >= 0)
             ? program_fail(PROGRAM_BAD_INPUT, "%s: %s is below 0", where, text)
             : code;
}

int number_share(const char *where, const char *text, double *value)
{
  const int code = number_real(where, text, value);
  return !code && !(*value > 0 && *value < 1)
             ? program_fail(PROGRAM_BAD_INPUT, "%s: %s is not between 0 and 1", where,
                            text)
             : code;
}

int number_whole(const char *where, const char *text, uint64_t least, uint64_t most,
                 uint64_t *value)
{
  if (!*text || strspn(text, "0123456789") != strlen(text))
    return program_fail(PROGRAM_BAD_INPUT, "%s: '%s' is not a whole number", where, text);
  errno = 0;
  const unsigned long long read = strtoull(text, NULL, 10);
  if (errno == ERANGE || read < least || read > most)
    return program_fail(PROGRAM_BAD_INPUT, "%s: %s is not within %llu to %llu", where,
                        text, (unsigned long long)least, (unsigned long long)most);
  *value = read;
  return 0;
}

void number_text(char text[NUMBER_TEXT], double value)
{
  for (int digits = 15; digits <= 17; digits++) {
    snprintf(text, NUMBER_TEXT, "%.*g", digits, value);
    if (strtod(text, NULL) == value)
      return;
  }
}
