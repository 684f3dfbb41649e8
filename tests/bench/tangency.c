/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The four ways to place a particle in contact: nanoseconds a task (both places), spheres
 * of radii in [0.7, 1.3] around a gap, alone and with a flat and a curved wall; and tasks
 * without a place.
 *
 *   meson test -C build --benchmark tangency -v */
#define _POSIX_C_SOURCE 199309L
#include "bench.h"
#include <math.h>

enum { TASKS = 256, ROUNDS = 200 };

static double uniform(packing_rng *rng, double lo, double hi)
{
  return lo + (hi - lo) * packing_rng_uniform(rng);
}

/* Three spheres around the origin, which a particle there nearly touches. */
static void make_tasks(packing_contact_task *task, double loose,
                       const packing_domain *wall)
{
  packing_rng *rng = NULL;
  must(packing_rng_create(NULL, 1, 1, 0, &rng));
  for (int t = 0; t < TASKS; t++) {
    packing_contact_task_init(&task[t]);
    task[t].mobile = packing_body_sphere((packing_vec3){0, 0, 0}, uniform(rng, 0.7, 1.3));
    for (int i = 0; i < 3; i++) {
      const double r = uniform(rng, 0.7, 1.3), turn = 2.1 * i + uniform(rng, -0.2, 0.2);
      const double away = (r + task[t].mobile.r) * loose, up = uniform(rng, 0.4, 0.6);
      const double flat = away * sqrt(1 - up * up);
      task[t].fixed[i] = packing_body_sphere(
          (packing_vec3){flat * cos(turn), flat * sin(turn), -up * away}, r);
    }
    if (wall != NULL) {
      task[t].fixed[2].domain = wall;
      task[t].fixed[2].wall = 0;
    }
  }
  packing_rng_destroy(rng);
}

static void run(const char *what, const packing_contact_task *task)
{
  static const char *const names[] = {"wrappers", "potential", "binary", "direct"};
  printf("%-22s", what);
  for (int m = 0; m < 4; m++) {
    const packing_contact_method *method = packing_contact_method_named(names[m]);
    packing_vec3 centre[2];
    long places = 0;
    const double start = now();
    for (int round = 0; round < ROUNDS; round++)
      for (int t = 0; t < TASKS; t++)
        places += packing_contact_place(method, &task[t], centre);
    printf("  %s %.0f ns (%.2f places)", names[m],
           (now() - start) * 1e9 / (ROUNDS * TASKS), (double)places / (ROUNDS * TASKS));
  }
  printf("\n");
}

int main(void)
{
  static packing_contact_task task[TASKS];
  packing_domain_box_def box;
  packing_domain_sphere_def ball;
  packing_domain *flat = NULL, *round = NULL;
  packing_domain_box_def_init(&box);
  box.size = (packing_vec3){20, 20, 20};
  box.corner = (packing_vec3){-1, -10, -10};
  packing_domain_sphere_def_init(&ball);
  ball.radius = 10;
  ball.centre.x = 9;
  must(packing_domain_create_box(NULL, &box, &flat));
  must(packing_domain_create_sphere(NULL, &ball, &round));
  make_tasks(task, 1, NULL);
  run("three spheres", task);
  make_tasks(task, 1, flat);
  run("two and a flat wall", task);
  make_tasks(task, 1, round);
  run("two and a curved wall", task);
  make_tasks(task, 1.6, NULL);
  run("too far apart", task);
  packing_domain_destroy(flat);
  packing_domain_destroy(round);
  return 0;
}
