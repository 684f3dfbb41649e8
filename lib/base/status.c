/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <packing/base.h>

#define PACKING_I_STRING(x) #x
#define PACKING_I_VERSION(a, b, c)                                                       \
  PACKING_I_STRING(a) "." PACKING_I_STRING(b) "." PACKING_I_STRING(c)

const char *packing_version(void)
{
  return PACKING_I_VERSION(PACKING_VERSION_MAJOR, PACKING_VERSION_MINOR,
                           PACKING_VERSION_PATCH);
}

const char *packing_status_string(packing_status status)
{
  switch (status) {
  case PACKING_OK:
    return "no error";
  case PACKING_ERR_NOMEM:
    return "out of memory";
  case PACKING_ERR_INVALID:
    return "invalid argument";
  case PACKING_ERR_RANGE:
    return "value out of range";
  case PACKING_ERR_FORMAT:
    return "malformed file";
  case PACKING_ERR_IO:
    return "input or output failed";
  case PACKING_ERR_GEOMETRY:
    return "impossible geometry";
  case PACKING_ERR_UNSTABLE:
    return "unstable time step";
  case PACKING_ERR_UNSUPPORTED:
    return "not supported";
  case PACKING_ERR_ABI:
    return "struct size unknown to this library";
  case PACKING_ERR_INTERNAL:
    return "internal error, please report it";
  case PACKING_STATUS_END:
    break;
  }
  return "unknown status";
}
