/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Non stable, stable and firm particles. */
#include "test.h"

enum { MOST = 8 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST];
  packing_view view;
} pack;

static const double radius[MOST] = {1, 1, 1, 1, 1, 1, 1, 1};

static void add(pack *p, double x, double y, double z)
{
  const size_t i = p->view.count++;
  p->x[i] = x;
  p->y[i] = y;
  p->z[i] = z;
}

static void begin(pack *p)
{
  packing_view_init_arrays(&p->view, 0, p->x, p->y, p->z, radius);
}

static packing_classes_report classify(const pack *p, packing_domain *domain, int dim,
                                       packing_vec3 up, int walls)
{
  packing_contacts_def def;
  packing_classes_def classes;
  packing_classes_report r;
  packing_contacts *c = NULL;
  packing_contacts_def_init(&def);
  def.dim = dim;
  packing_classes_def_init(&classes);
  classes.up = up;
  classes.walls = walls;
  packing_classes_report_init(&r);
  assert_ok(packing_contacts_create(NULL, &def, domain, &p->view, &c));
  assert_ok(packing_contacts_classes(c, &classes, &r));
  packing_contacts_destroy(c);
  size_t sum = 0;
  for (int k = 0; k < 5; k++)
    sum += r.degree[k];
  assert_int_equal(sum, p->view.count);
  assert_int_equal(r.non_stable + r.stable + r.firm, p->view.count);
  assert_int_equal(r.stable, r.supported);
  const double n = (double)p->view.count;
  assert_close(r.non_stable_share, (double)r.non_stable / n, 1e-15);
  assert_close(r.stable_share, (double)r.stable / n, 1e-15);
  assert_close(r.firm_share, (double)r.firm / n, 1e-15);
  return r;
}

static const packing_vec3 by_default = {0, 0, 0}, down = {0, 0, -3};

/* Three spheres that touch, 1 above z = 0, and a fourth on them. */
static void fill_pyramid(pack *p)
{
  begin(p);
  add(p, 1, 1, 1);
  add(p, 3, 1, 1);
  add(p, 2, 1 + sqrt(3), 1);
  add(p, 2, 1 + sqrt(3) / 3, 1 + 2 * sqrt(6) / 3);
}

static void a_sphere_on_three_is_stable(void **state)
{
  (void)state;
  pack p;
  fill_pyramid(&p);
  packing_classes_report r = classify(&p, NULL, 3, by_default, 1);
  assert_int_equal(r.degree[3], 4);
  assert_int_equal(r.stable, 1);
  assert_int_equal(r.non_stable, 3);
  r = classify(&p, NULL, 3, down, 1); /* it hangs */
  assert_int_equal(r.stable, 0);
  assert_int_equal(r.non_stable, 4);
}

static void walls_hold_where_they_count(void **state)
{
  (void)state;
  pack p;
  packing_domain *box = test_box(20, 20, 20, 0);
  fill_pyramid(&p);
  for (size_t i = 0; i < 4; i++)
    p.x[i] += 5;
  for (size_t i = 0; i < 4; i++)
    p.y[i] += 5;
  packing_classes_report r = classify(&p, box, 0, by_default, 1);
  assert_true(r.firm == 3 && r.stable == 1 && r.degree[4] == 3);
  r = classify(&p, box, 0, by_default, 0);
  assert_true(r.firm == 0 && r.stable == 1 && r.degree[3] == 4);
  packing_domain_destroy(box);
}

/* With up along one of its edges the pyramid stands on two spheres and a corner. */
static void up_turns_with_the_pack(void **state)
{
  (void)state;
  pack p, q;
  fill_pyramid(&p);
  q = p;
  packing_view_init_arrays(&q.view, p.view.count, q.x, q.y, q.z, radius);
  for (size_t i = 0; i < 4; i++) {
    q.x[i] = p.z[i];
    q.y[i] = p.x[i];
    q.z[i] = p.y[i];
  }
  const packing_vec3 up = {1e-200, 0, 0};
  assert_int_equal(classify(&q, NULL, 3, up, 1).stable, 1);
  assert_int_equal(classify(&q, NULL, 3, by_default, 1).stable,
                   classify(&p, NULL, 3, (packing_vec3){0, 7, 0}, 1).stable);
}

/* Two opposite contacts level with the centre and one below: on the edge of the triangle. */
static void on_the_border_it_rolls(void **state)
{
  (void)state;
  pack p;
  begin(&p);
  add(&p, 0, 0, 0);
  add(&p, 2, 0, 0);
  add(&p, -2, 0, 0);
  add(&p, 0, 1.2, -1.6);
  packing_classes_report r = classify(&p, NULL, 3, by_default, 1);
  assert_true(r.degree[3] == 1 && r.degree[1] == 3 && r.supported == 0);
  p.x[1] = p.x[2] = 0;
  p.y[1] = p.y[2] = -1;
  p.z[1] = p.z[2] = -sqrt(2);
  p.x[1] = 1;
  p.x[2] = -1;
  r = classify(&p, NULL, 3, by_default, 1);
  assert_true(r.supported == 1);
}

static void fewer_contacts_are_not_stable(void **state)
{
  (void)state;
  pack p;
  begin(&p);
  add(&p, 0, 0, 0);
  add(&p, 0, 0, 2);
  add(&p, 0, 0, 4);
  add(&p, 9, 0, 0);
  packing_classes_report r = classify(&p, NULL, 3, by_default, 1);
  assert_true(r.degree[0] == 1 && r.degree[1] == 2 && r.degree[2] == 1);
  assert_int_equal(r.non_stable, 4);
}

static void in_the_plane_two_contacts_hold(void **state)
{
  (void)state;
  pack p;
  packing_domain *strip = test_rectangle(40, 40, 0);
  begin(&p);
  add(&p, 11, 1, 0);
  add(&p, 13, 1, 0);
  add(&p, 12, 1 + sqrt(3), 0);
  packing_classes_report r = classify(&p, strip, 0, by_default, 0);
  assert_true(r.degree[2] == 3 && r.stable == 1 && r.non_stable == 2);
  r = classify(&p, strip, 0, by_default, 1);
  assert_true(r.degree[3] == 2 && r.stable == 1 && r.firm == 2);
  r = classify(&p, strip, 0, (packing_vec3){0, -1, 5}, 0);
  assert_int_equal(r.stable,
                   0); /* the lower two have a contact beside them and one below */
  r = classify(&p, strip, 0, (packing_vec3){-1, -0.25, 0}, 0);
  assert_int_equal(r.stable, 1);
  packing_domain_destroy(strip);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_sphere_on_three_is_stable),
      cmocka_unit_test(walls_hold_where_they_count),
      cmocka_unit_test(up_turns_with_the_pack),
      cmocka_unit_test(on_the_border_it_rolls),
      cmocka_unit_test(fewer_contacts_are_not_stable),
      cmocka_unit_test(in_the_plane_two_contacts_hold),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
