/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Porosity profiles with known answers. */
#include "test.h"

static const double pi = 3.14159265358979323846;

enum { MOST = 512, BINS = 64 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
  packing_profile_bin bin[BINS];
  packing_profile_report report;
} pack;

static pack *new_pack(void)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  packing_view_init_arrays(&p->view, 0, p->x, p->y, p->z, p->r);
  return p;
}

static void add(pack *p, double x, double y, double z, double r)
{
  const size_t i = p->view.count++;
  p->x[i] = x;
  p->y[i] = y;
  p->z[i] = z;
  p->r[i] = r;
}

static void measure(pack *p, packing_domain *domain, const packing_profile_def *def)
{
  size_t count = 0;
  packing_profile_report_init(&p->report);
  assert_ok(packing_measure_profile(NULL, def, domain, &p->view, p->bin, BINS, &count,
                                    &p->report));
  assert_int_equal(count, def == NULL ? 50 : def->bins);
}

static packing_profile_def options(packing_profile_kind kind, packing_axis axis,
                                   size_t bins)
{
  packing_profile_def def;
  packing_profile_def_init(&def);
  def.kind = kind;
  def.axis = axis;
  def.bins = bins;
  return def;
}

static double ball(double r)
{
  return 4 * pi / 3 * r * r * r;
}

static double cap(double r, double h)
{
  return pi * h * h * (3 * r - h) / 3;
}

/* A simple cubic crystal whose layers lie on the borders of the cell: every slab as thick as a
 * radius has half of each of its balls, every thinner one what caps say. */
static void slabs_of_a_crystal(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(4, 4, 4, 7);
  for (int i = 0; i < 64; i++)
    add(p, i % 4, i / 4 % 4, i / 16 - 4 * (i % 3), 0.5); /* also outside of the cell */
  for (int axis = 0; axis < 3; axis++) {
    packing_profile_def def = options(PACKING_PROFILE_SLABS, (packing_axis)axis, 8);
    measure(p, cell, &def);
    for (int k = 0; k < 8; k++) {
      assert_true(p->bin[k].from == 0.5 * k && p->bin[k].to == 0.5 * (k + 1));
      assert_close(p->bin[k].volume, 8.0, 1e-15);
      assert_near(p->bin[k].porosity, 1 - pi / 6, 1e-14);
    }
    def.bins = 16;
    measure(p, cell, &def);
    for (int k = 0; k < 16; k++) {
      const int outer = k % 4 == 1 || k % 4 == 2;
      const double solid =
          16 * (outer ? cap(0.5, 0.25) : 0.5 * ball(0.5) - cap(0.5, 0.25));
      assert_close(p->bin[k].solid, solid, 1e-13);
      assert_near(p->bin[k].porosity, 1 - solid / 4, 1e-14);
    }
    assert_close(p->report.solid, 64 * ball(0.5), 1e-14);
    assert_close(p->report.volume, 64.0, 1e-15);
    assert_true(p->report.error >= 0 && p->report.error < 1e-12);
    def.from = -4; /* three periods */
    def.to = 8;
    measure(p, cell, &def);
    assert_close(p->report.solid, 3 * 64 * ball(0.5), 1e-14);
    assert_close(p->report.volume, 3.0 * 64, 1e-15);
  }
  packing_domain_destroy(cell);
  free(p);
}

static void cuts_of_the_literature(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(1, 1, 1, 0), *square = test_rectangle(1, 1, 0);
  packing_profile_def def = options(PACKING_PROFILE_SLABS, PACKING_AXIS_Z, 2);
  /* A ball of radius .02 cut .005 above its centre, by a border and by the container. */
  add(p, 0.3, 0.3, 0.495, 0.02);
  measure(p, box, &def);
  assert_close(p->bin[0].solid, 2.290744643243e-5, 1e-12);
  assert_close(p->bin[0].solid + p->bin[1].solid, 3.351032163829e-5, 1e-12);
  p->z[0] = 0.995;
  measure(p, box, &def);
  assert_true(p->bin[0].solid == 0 && p->bin[0].porosity == 1);
  assert_close(p->bin[1].solid, 2.290744643243e-5, 1e-12);
  /* A disc of radius .01 cut .004 above. */
  def.axis = PACKING_AXIS_Y;
  p->z[0] = (double)NAN;
  p->r[0] = 0.01;
  p->y[0] = 0.496;
  measure(p, square, &def);
  assert_close(p->bin[0].solid, 2.348919228459e-4, 1e-12);
  assert_close(p->report.solid, pi * 1e-4, 1e-13);
  packing_domain_destroy(box);
  packing_domain_destroy(square);
  free(p);
}

static packing_domain *cylinder(double radius, double height, packing_axis axis)
{
  packing_domain_cylinder_def def;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = radius;
  def.height = height;
  def.axis = axis;
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  return domain;
}

/* A ball on the axis has 4/3 pi (r^3 - (r^2 - R^2)^1.5) within the radius R. */
static void cylindrical_shells(void **state)
{
  (void)state;
  for (int axis = 0; axis < 3; axis++) {
    pack *p = new_pack();
    packing_domain *domain = cylinder(2, 5, (packing_axis)axis);
    const packing_profile_def def =
        options(PACKING_PROFILE_CYLINDERS, (packing_axis)axis, 8);
    const double r = 1.3,
                 at[3] = {axis == 0 ? 2 : 0, axis == 1 ? 2 : 0, axis == 2 ? 2 : 0};
    double before = 0;
    add(p, at[0], at[1], at[2], r);
    measure(p, domain, &def);
    for (int k = 0; k < 8; k++) {
      const double out = 0.25 * (k + 1), in = 0.25 * k;
      const double within =
          out < r ? ball(1) * (r * r * r - pow(r * r - out * out, 1.5)) : ball(r);
      assert_close(p->bin[k].volume, 5 * pi * (out * out - in * in), 1e-12);
      assert_near(p->bin[k].solid, within - before, 1e-10 * ball(r));
      before = within;
    }
    assert_close(p->report.solid, ball(r), 1e-13);
    assert_close(p->report.volume, 20 * pi, 1e-13);
    packing_domain_destroy(domain);
    free(p);
  }
}

/* Two balls of radius 1 at distance 1 share 5 pi / 12; a shell round the middle of one. */
static void spherical_shells(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(9, 8, 7, 0);
  packing_profile_def def = options(PACKING_PROFILE_SPHERES, PACKING_AXIS_Z, 1);
  def.own_centre = 1;
  def.centre = (packing_vec3){4, 4, 3};
  def.to = 1;
  add(p, 4, 5, 3, 1);
  measure(p, box, &def);
  assert_close(p->bin[0].solid, 5 * pi / 12, 1e-13);
  assert_close(p->bin[0].volume, 4 * pi / 3, 1e-12);
  def.from = 1;
  def.to = 2;
  measure(p, box, &def);
  assert_close(p->bin[0].solid, 4 * pi / 3 - 5 * pi / 12, 1e-13);
  assert_close(p->bin[0].volume, 7 * 4 * pi / 3, 1e-12);
  /* To the farthest corner, by default. */
  def.from = def.to = 0;
  def.bins = 20;
  measure(p, box, &def);
  assert_close(p->report.to, sqrt(25 + 16 + 16), 1e-15);
  assert_close(p->report.volume, 504.0, 1e-12);
  assert_close(p->report.solid, ball(1), 1e-13);
  packing_domain_destroy(box);
  free(p);
}

/* Discs of radii 1 and 1 at distance 1: 2 pi / 3 - sqrt(3) / 2. */
static void rings(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain_circle_def circle;
  packing_domain *domain = NULL;
  packing_domain_circle_def_init(&circle);
  circle.radius = 2.5;
  circle.centre.x = 1;
  assert_ok(packing_domain_create_circle(NULL, &circle, &domain));
  add(p, 2, 0, 17, 1);
  for (int kind = 1; kind <= 2; kind++) {
    const packing_profile_def def =
        options((packing_profile_kind)kind, PACKING_AXIS_Z, 5);
    measure(p, domain, &def);
    assert_true(p->report.to == 2.5 && p->report.centre.x == 1);
    assert_close(p->bin[0].solid + p->bin[1].solid, 2 * pi / 3 - sqrt(0.75), 1e-13);
    assert_close(p->report.solid, pi, 1e-14);
    for (int k = 0; k < 5; k++)
      assert_close(p->bin[k].volume, pi * 0.25 * (2 * k + 1), 1e-13);
  }
  packing_domain_destroy(domain);
  free(p);
}

/* Slabs of containers that are no boxes. */
static void containers_in_slabs(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *domain = NULL;
  packing_domain_cone_def cone;
  packing_domain_sphere_def sphere;
  packing_domain_cone_def_init(&cone);
  cone.bottom_radius = 1;
  cone.top_radius = 3;
  cone.height = 4;
  assert_ok(packing_domain_create_cone(NULL, &cone, &domain));
  packing_profile_def def = options(PACKING_PROFILE_SLABS, PACKING_AXIS_Z, 4);
  measure(p, domain, &def);
  for (int k = 0; k < 4; k++) {
    const double a = 1 + 0.5 * k, b = a + 0.5;
    assert_close(p->bin[k].volume, pi / 3 * (a * a + a * b + b * b), 1e-13);
    assert_true(p->bin[k].porosity == 1);
  }
  packing_domain_destroy(domain);
  packing_domain_sphere_def_init(&sphere);
  sphere.radius = 2;
  assert_ok(packing_domain_create_sphere(NULL, &sphere, &domain));
  measure(p, domain, &def);
  assert_close(p->bin[0].volume, cap(2, 1), 1e-13);
  assert_close(p->bin[1].volume, cap(2, 2) - cap(2, 1), 1e-13);
  packing_domain_destroy(domain);
  /* A cylinder lying down: segments of its circle. */
  domain = cylinder(1, 3, PACKING_AXIS_X);
  measure(p, domain, &def);
  const double segment = pi / 3 - sqrt(3) / 4; /* below half a radius */
  assert_close(p->bin[0].volume, 3 * segment, 1e-12);
  assert_close(p->bin[1].volume, 3 * (pi / 2 - segment), 1e-12);
  /* A range that reaches beyond: nothing there. */
  def.from = -3;
  def.to = 1;
  measure(p, domain, &def);
  assert_true(p->bin[0].volume == 0 && isnan(p->bin[0].porosity));
  packing_domain_destroy(domain);
  free(p);
}

/* Shells grow into the images; along the axis one period counts. */
static void shells_in_periodic_cells(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(4, 4, 4, 7);
  packing_profile_def def = options(PACKING_PROFILE_CYLINDERS, PACKING_AXIS_Z, 4);
  add(p, 0.1, 0, 3.9, 0.5); /* near the corner of the cell, and its end */
  def.own_centre = 1;
  def.centre = (packing_vec3){4, 4, 0};
  measure(p, cell, &def);
  assert_true(p->report.to == 2);
  assert_close(p->bin[0].volume, 4 * pi * 0.25, 1e-13);
  assert_close(p->report.solid, ball(0.5), 1e-13);
  def.to = 5; /* it and four images lie wholly within */
  measure(p, cell, &def);
  assert_close(p->report.volume, 4 * pi * 25, 1e-13);
  assert_close(p->report.solid, 5 * ball(0.5), 1e-13);
  def.kind = PACKING_PROFILE_SPHERES;
  def.to = 0;
  measure(p, cell, &def);
  assert_true(p->report.to == 2);
  assert_close(p->report.volume, ball(2), 1e-13);
  assert_close(p->report.solid, ball(0.5), 1e-13);
  packing_domain_destroy(cell);
  free(p);
}

static void what_fits_is_written(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(1, 1, 1, 0);
  size_t count = 0;
  packing_profile_report_init(&p->report);
  assert_ok(
      packing_measure_profile(NULL, NULL, box, &p->view, NULL, 0, &count, &p->report));
  assert_int_equal(count, 50);
  assert_true(p->report.volume > 0.999 && p->report.porosity == 1);
  p->bin[3].volume = 77;
  assert_ok(
      packing_measure_profile(NULL, NULL, box, &p->view, p->bin, 3, &count, &p->report));
  assert_close(p->bin[2].volume, 0.02, 1e-13);
  assert_true(count == 50 && p->bin[3].volume == 77);
  packing_domain_destroy(box);
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slabs_of_a_crystal),
      cmocka_unit_test(cuts_of_the_literature),
      cmocka_unit_test(cylindrical_shells),
      cmocka_unit_test(spherical_shells),
      cmocka_unit_test(rings),
      cmocka_unit_test(containers_in_slabs),
      cmocka_unit_test(shells_in_periodic_cells),
      cmocka_unit_test(what_fits_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
