/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pack.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include "program.h"

void notes_add(notes *all, const char *key, const char *format, ...)
{
  va_list arguments;
  char *value = NULL;
  va_start(arguments, format);
  const int length = vasprintf(&value, format, arguments);
  va_end(arguments);
  if (length < 0)
    exit(program_fail(PROGRAM_SYSTEM, "out of memory"));
  all->keys = program_take_more(all->keys, all->count + 1, sizeof *all->keys);
  all->values = program_take_more(all->values, all->count + 1, sizeof *all->values);
  all->keys[all->count] = key;
  all->values[all->count++] = value;
}

void notes_free(notes *all)
{
  for (size_t i = 0; i < all->count; i++)
    free(all->values[i]);
  free(all->values);
  free(all->keys);
}

size_t pack_components(const pack *p)
{
  size_t most = 0;
  if (p->psd)
    return packing_psd_components(p->psd);
  for (size_t i = 0; i < p->view.count; i++)
    if (pack_component(p, i) > most)
      most = pack_component(p, i);
  return most + 1;
}

void pack_radii(const pack *p, double *lo, double *hi)
{
  *lo = *hi = 0;
  if (p->psd) {
    *lo = packing_psd_min_r(p->psd);
    *hi = packing_psd_max_r(p->psd);
    return;
  }
  for (size_t i = 0; i < p->view.count; i++) {
    const double r = pack_radius(p, i);
    *lo = i ? fmin(*lo, r) : r;
    *hi = fmax(*hi, r);
  }
}

static void widen(packing_bounds *b, packing_vec3 c, double r)
{
  b->lo = (packing_vec3){fmin(b->lo.x, c.x - r), fmin(b->lo.y, c.y - r),
                         fmin(b->lo.z, c.z - r)};
  b->hi = (packing_vec3){fmax(b->hi.x, c.x + r), fmax(b->hi.y, c.y + r),
                         fmax(b->hi.z, c.z + r)};
}

void pack_bounds(const pack *p, packing_bounds *bounds)
{
  const double far = p->view.count ? (double)INFINITY : 0;
  if (p->domain) {
    packing_domain_bounds(p->domain, bounds);
    return;
  }
  *bounds = (packing_bounds){{far, far, far}, {-far, -far, -far}};
  for (size_t i = 0; i < p->view.count; i++)
    widen(bounds, pack_centre(p, i), pack_radius(p, i));
  if (p->spec->dim == 2)
    bounds->lo.z = bounds->hi.z = 0;
}
