/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The formula of a combination: what lies outside it, in terms of its parts.
 *
 * A formula is never empty and its steps come in postfix order, so that "and" and "or" find two
 * values and one is left at the end. That is made elsewhere (combination_create.c); the assertions
 * tell it to those, the analyzer among them, who see this file alone. */
#include "combination_internal.h"
#include <assert.h>
#include <math.h>

/* A value and the part that it is of. */
typedef struct value {
  double v;
  int part;
} value;

double packing_i_formula(const packing_i_combination_data *data, const double distance[],
                         int *part)
{
  value stack[PACKING_I_FORMULA_DEPTH];
  int used = 0;
  for (int i = 0; i < data->steps; i++) {
    const packing_i_step s = data->step[i];
    if (s.kind == PACKING_I_STEP_AND || s.kind == PACKING_I_STEP_OR) {
      assert(used > 1);
      const value b = stack[--used], a = stack[used - 1];
      if (s.kind == PACKING_I_STEP_AND ? b.v < a.v : b.v > a.v)
        stack[used - 1] = b;
    } else {
      const double d = distance[s.part];
      if (isnan(d)) {
        *part = s.part;
        return d;
      }
      stack[used++] = (value){s.kind == PACKING_I_STEP_INSIDE ? d : -d, s.part};
    }
  }
  assert(used == 1);
  *part = stack[0].part;
  return -stack[0].v;
}

void packing_i_part_distances(const packing_i_combination_data *data,
                              const packing_vec3 *point, double distance[])
{
  for (int i = 0; i < data->parts; i++)
    distance[i] = data->part[i]->ops->signed_distance(data->part[i], point, NULL);
}

void packing_i_part_sides(const packing_i_combination_data *data,
                          const packing_vec3 *point, double distance[])
{
  for (int i = 0; i < data->parts; i++) {
    const packing_i_domain_ops *ops = data->part[i]->ops;
    distance[i] = (ops->side != NULL ? ops->side : ops->signed_distance)(data->part[i],
                                                                         point, NULL);
  }
}

/* Whether the formula says "outside" when `part` does or does not, and the others clearly. */
static int says_outside(const packing_i_combination_data *data, const double distance[],
                        int part, int crossed)
{
  int stack[PACKING_I_FORMULA_DEPTH], used = 0;
  for (int i = 0; i < data->steps; i++) {
    const packing_i_step s = data->step[i];
    if (s.kind == PACKING_I_STEP_AND || s.kind == PACKING_I_STEP_OR) {
      assert(used > 1);
      const int b = stack[--used];
      stack[used - 1] =
          s.kind == PACKING_I_STEP_AND ? stack[used - 1] && b : stack[used - 1] || b;
    } else {
      const double d = distance[s.part];
      const int is_true = (s.kind == PACKING_I_STEP_INSIDE ? d : -d) > data->blur;
      stack[used++] = s.part == part ? crossed : is_true;
    }
  }
  assert(used == 1);
  return stack[0];
}

int packing_i_is_wall_at(const packing_i_combination_data *data, int part,
                         const packing_vec3 *point)
{
  double distance[PACKING_I_PARTS];
  packing_i_part_distances(data, point, distance);
  return says_outside(data, distance, part, 1) && !says_outside(data, distance, part, 0);
}
