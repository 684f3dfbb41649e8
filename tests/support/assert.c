/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"

void test_near(double a, double b, double tolerance, const char *what, const char *file,
               int line)
{
  if (a == b || fabs(a - b) <= tolerance)
    return;
  print_error("%s = %.17g, expected %.17g within %.3g (off by %.3g)\n", what, a, b,
              tolerance, a - b);
  _fail(file, line);
}

void test_status(packing_status got, packing_status want, packing_context *context,
                 const char *what, const char *file, int line)
{
  if (got == want)
    return;
  print_error("%s: \"%s\", expected \"%s\" %s\n", what, packing_status_string(got),
              packing_status_string(want), packing_context_message(context));
  _fail(file, line);
}

void test_names(packing_context *context, const char *field, const char *what,
                const char *file, int line)
{
  const char *message = packing_context_message(context);
  if (strstr(message, field) != NULL && strchr(message, '\n') == NULL)
    return;
  print_error("%s: message \"%s\" does not name \"%s\" in one line\n", what, message,
              field);
  _fail(file, line);
}
