/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ways to place a particle in contact, by name, and the call that all of them go
 * through. */
#include "touch_internal.h"
#include <string.h>

static const packing_contact_method *(*const methods[])(void) = {
    packing_contact_wrappers, packing_contact_potential, packing_contact_binary,
    packing_contact_direct};

const packing_contact_method *packing_contact_method_named(const char *name)
{
  if (name == NULL)
    return NULL;
  for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
    if (strcmp(methods[i]()->name, name) == 0)
      return methods[i]();
  return NULL;
}

static int is_particle(const packing_body *body)
{
  return packing_i_vec_finite(body->centre) && body->r > 0 && isfinite(body->r);
}

static int is_valid(const packing_contact_task *task)
{
  if (task->struct_size < sizeof *task || (task->dim != 2 && task->dim != 3))
    return 0;
  if (task->mobile.domain != NULL || !(task->mobile.r > 0 && isfinite(task->mobile.r)))
    return 0;
  int particles = 0;
  for (int i = 0; i < task->dim; i++) {
    if (task->fixed[i].domain != NULL)
      continue;
    if (!is_particle(&task->fixed[i]))
      return 0;
    particles++;
  }
  return particles > 0;
}

int packing_contact_place(const packing_contact_method *method,
                          const packing_contact_task *task, packing_vec3 centre[2])
{
  if (method == NULL || method->place == NULL || task == NULL || centre == NULL ||
      !is_valid(task))
    return 0;
  return method->place(method->user, task, centre);
}
