/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equation 2 as the paper has it: the sum of the gaps' sizes, minimised by Nelder and
 * Mead's simplex (GSL), which does not mind kinks. Slow and only good to some 1e-8, it is
 * the oracle of the potential method, which solves for the gaps instead. */
#include "touching.h"
#include <gsl/gsl_multimin.h>

enum { STEPS = 600, STARTS = 6 };

static packing_vec3 centre_of(const gsl_vector *x, int dim)
{
  const packing_vec3 centre = {gsl_vector_get(x, 0), gsl_vector_get(x, 1),
                               dim == 3 ? gsl_vector_get(x, 2) : 0};
  return centre;
}

static double sum_of_gaps(const gsl_vector *x, void *arg)
{
  const packing_contact_task *task = arg;
  double sum = 0;
  for (int i = 0; i < task->dim; i++)
    sum += fabs(touching_gap(task, centre_of(x, task->dim), i));
  return sum;
}

/* The least sum found from a start, and where. */
static double minimise(packing_contact_task *task, packing_vec3 *x)
{
  const size_t dim = (size_t)task->dim;
  gsl_multimin_fminimizer *m =
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, dim);
  gsl_vector *start = gsl_vector_alloc(dim), *step = gsl_vector_alloc(dim);
  gsl_multimin_function f = {sum_of_gaps, dim, task};
  gsl_vector_set(start, 0, x->x);
  gsl_vector_set(start, 1, x->y);
  if (dim == 3)
    gsl_vector_set(start, 2, x->z);
  gsl_vector_set_all(step, 0.3 * task->mobile.r);
  assert_int_equal(gsl_multimin_fminimizer_set(m, &f, start, step), 0);
  for (int i = 0; i < STEPS && gsl_multimin_fminimizer_size(m) > 1e-10; i++)
    if (gsl_multimin_fminimizer_iterate(m) != 0)
      break;
  *x = centre_of(m->x, task->dim);
  const double sum = m->fval;
  gsl_multimin_fminimizer_free(m);
  gsl_vector_free(start);
  gsl_vector_free(step);
  return sum;
}

/* From the places of the potential the simplex wins nothing, and from beside them it
 * comes back to one of them. */
static void spheres(void **state)
{
  (void)state;
  uint64_t random = 31;
  int back = 0, tried = 0;
  for (int i = 0; i < 60; i++) {
    packing_contact_task task = touching_random(&random, 2 + i % 2, 2, 0.4);
    packing_vec3 found[2];
    const int count = packing_contact_place(packing_contact_potential(), &task, found);
    if (count == 2 && touching_apart(found[0], found[1]) < 0.3 * task.mobile.r)
      continue;
    for (int k = 0; k < count; k++) {
      packing_vec3 x = found[k];
      x.x += 0.05 * task.mobile.r;
      x.y -= 0.05 * task.mobile.r;
      tried++;
      if (minimise(&task, &x) < 1e-7)
        back += fmin(touching_apart(x, found[0]), touching_apart(x, found[1])) < 1e-6;
    }
  }
  assert_true(tried > 60);
  /* A simplex may get stuck on a kink. */
  assert_true(back >= 0.9 * tried);
}

/* Where several starts of the simplex find contact with all of three bodies, clusters
 * among them, so does the potential. */
static void clusters(void **state)
{
  (void)state;
  uint64_t random = 32;
  packing_shape *shape = test_cluster(0.65, 1);
  int by_simplex = 0, both = 0, by_potential = 0;
  for (int i = 0; i < 60; i++) {
    packing_contact_task task = touching_random(&random, 2 + i % 2, 2, 0.2);
    const double half = 3 * scene_random(&random);
    packing_vec3 found[2];
    task.mobile.shape = shape;
    task.mobile.orientation[0] = cos(half);
    task.mobile.orientation[3] = sin(half);
    const int count = packing_contact_place(packing_contact_potential(), &task, found);
    double least = HUGE_VAL;
    for (int k = 0; k < STARTS; k++) {
      const packing_vec3 v = touching_direction(&random, task.dim);
      packing_vec3 x = {task.mobile.r * v.x, task.mobile.r * v.y, task.mobile.r * v.z};
      least = fmin(least, minimise(&task, &x));
    }
    by_simplex += least < 1e-8;
    by_potential += count > 0;
    both += least < 1e-8 && count > 0;
  }
  assert_true(by_simplex > 25);
  assert_int_equal(both, by_simplex);
  assert_true(by_potential >= both);
  packing_shape_destroy(shape);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spheres),
      cmocka_unit_test(clusters),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
