/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planar sections with known answers. */
#include "test.h"

static const double pi = 3.14159265358979323846;

enum { MOST = 512, DISCS = 512, PIXELS = 400 * 400 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
  packing_section_disc disc[DISCS];
  unsigned char pixel[PIXELS];
  packing_section_report report;
  size_t discs;
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

static void measure(pack *p, packing_domain *domain, const packing_section_def *def)
{
  packing_section_report_init(&p->report);
  assert_ok(packing_measure_section(NULL, def, domain, &p->view, p->disc, DISCS,
                                    &p->discs, &p->report));
}

static packing_section_def across(packing_axis axis, double height)
{
  packing_section_def def;
  packing_section_def_init(&def);
  packing_section_def_across(&def, axis, height);
  return def;
}

static packing_section_def oblique(double px, double py, double pz, double nx, double ny,
                                   double nz)
{
  packing_section_def def;
  packing_section_def_init(&def);
  def.point = (packing_vec3){px, py, pz};
  def.normal = (packing_vec3){nx, ny, nz};
  return def;
}

static void discs_lie_where_they_should(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(10, 10, 10, 0);
  add(p, 2, 3, 4, 1);
  add(p, 8, 8, 8, 0.5); /* missed */
  add(p, 0, 7, 5, 2);   /* half outside, when cut across z */
  for (int axis = 0; axis < 3; axis++) {
    const packing_section_def def = across((packing_axis)axis, 4.5);
    measure(p, box, &def);
    assert_close(p->report.container_area, 100.0, 1e-15);
    const double *c[3] = {p->x, p->y, p->z};
    for (size_t k = 0; k < p->discs; k++) {
      const size_t i = p->disc[k].i;
      const double h = c[axis][i] - 4.5;
      assert_true(p->disc[k].u == c[(axis + 1) % 3][i]);
      assert_true(p->disc[k].v == c[(axis + 2) % 3][i]);
      assert_close(p->disc[k].r, sqrt(p->r[i] * p->r[i] - h * h), 1e-15);
    }
  }
  assert_int_equal(p->discs, 2);
  assert_close(p->disc[0].area, pi * 0.75, 1e-15);
  assert_close(p->disc[1].area, pi * 3.75 / 2, 1e-14);
  assert_close(p->report.porosity, 1 - pi * (0.75 + 1.875) / 100, 1e-14);
  assert_true(p->report.lo_u == 0 && p->report.hi_v == 10);
  packing_domain_destroy(box);
  free(p);
}

/* The plane x + y + z = 3/2 cuts a unit cube to a regular hexagon of side 1/sqrt(2), the plane
 * x + y + z = 1 to a triangle. */
static void cubes_have_hexagons(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(1, 1, 1, 0);
  packing_section_def def = oblique(0.5, 0.5, 0.5, 7, 7, 7);
  add(p, 0.5, 0.5, 0.5, 0.25);
  add(p, 1, 0.5, 0, 0.125); /* on a corner of the hexagon: a third */
  measure(p, box, &def);
  assert_close(p->report.container_area, 0.75 * sqrt(3), 1e-12);
  assert_close(p->disc[0].area, pi / 16, 1e-14);
  assert_close(p->disc[1].area, pi / 64 / 3, 1e-9);
  assert_close(p->report.normal.x, 1 / sqrt(3), 1e-15);
  def.point.x = 0;
  measure(p, box, &def);
  assert_close(p->report.container_area, 0.5 * sqrt(3), 1e-12);
  def.point.x = 9;
  measure(p, box, &def);
  assert_true(p->discs == 0 && p->report.container_area == 0);
  assert_true(isnan(p->report.porosity) && p->report.solid_area == 0);
  packing_domain_destroy(box);
  free(p);
}

static packing_domain *cylinder(double radius, double height)
{
  packing_domain_cylinder_def def;
  packing_domain *domain = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = radius;
  def.height = height;
  assert_ok(packing_domain_create_cylinder(NULL, &def, &domain));
  return domain;
}

/* Circle, ellipse, rectangle; a ball's circle; a cone's ellipse, parabola and hyperbola. */
static void conic_sections(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *domain = cylinder(1, 10);
  packing_section_def def = across(PACKING_AXIS_Z, 3);
  add(p, 1, 0, 3, 0.5);
  measure(p, domain, &def);
  assert_close(p->report.container_area, pi, 1e-15);
  /* Discs of radii 1 and 1/2 at distance 1, from the books. */
  const double lens = 0.25 * acos(0.25) + acos(0.875) - 0.5 * sqrt(0.5 * 1.5 * 0.5 * 2.5);
  assert_close(p->report.solid_area, lens, 1e-13);
  def = oblique(0, 0, 5, 1, 0, 1);
  measure(p, domain, &def);
  assert_close(p->report.container_area, pi * sqrt(2), 1e-11);
  def = across(PACKING_AXIS_Y, 0.6);
  measure(p, domain, &def);
  assert_close(p->report.container_area, 16.0, 1e-13);
  packing_domain_destroy(domain);
  packing_domain_sphere_def sphere;
  packing_domain_sphere_def_init(&sphere);
  sphere.radius = 1;
  assert_ok(packing_domain_create_sphere(NULL, &sphere, &domain));
  def = oblique(0.1, 0.2, 0.2, 1, 2, 2); /* at 0.3 from the centre */
  measure(p, domain, &def);
  assert_close(p->report.container_area, pi * (1 - 0.09), 1e-13);
  packing_domain_destroy(domain);
  packing_domain_cone_def cone;
  packing_domain_cone_def_init(&cone);
  cone.top_radius = 1; /* apex at 0 */
  cone.height = 1;
  assert_ok(packing_domain_create_cone(NULL, &cone, &domain));
  def = oblique(0, 0, 0.5, -1, 0,
                1); /* z = x + 1/2 along a side: a parabola, up to z = 1 */
  measure(p, domain, &def);
  /* rho < z: y^2 < x + 1/4, -1/4 < x < 1/2: 4/3 (3/4)^1.5, seen at 45 degrees. */
  assert_close(p->report.container_area, sqrt(2) * 4 / 3 * pow(0.75, 1.5), 1e-11);
  def = across(PACKING_AXIS_X, 0.5); /* y^2 < z^2 - 1/4: a hyperbola */
  measure(p, domain, &def);
  assert_close(p->report.container_area, sqrt(0.75) - 0.25 * acosh(2), 1e-11);
  def = oblique(0, 0, 0.5, -0.5, 0, 1); /* z = x/2 + 1/2: an ellipse */
  measure(p, domain, &def);
  /* y^2 + 3/4 (x - 1/3)^2 < 1/3: half axes 2/3 and 1/sqrt(3), which ends at z = 1. */
  assert_close(p->report.container_area, sqrt(1.25) * pi * 2 / 3 / sqrt(3), 1e-11);
  packing_domain_destroy(domain);
  free(p);
}

/* A tube cut along, beside and through its hole. */
static void holes_are_taken_off(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain_tube_def tube;
  packing_domain *domain = NULL;
  packing_domain_tube_def_init(&tube);
  tube.inner_radius = 0.6;
  tube.outer_radius = 1;
  tube.height = 2;
  assert_ok(packing_domain_create_tube(NULL, &tube, &domain));
  packing_section_def def = across(PACKING_AXIS_Z, 0.3);
  measure(p, domain, &def);
  assert_close(p->report.container_area, pi * 0.64, 1e-14);
  def = across(PACKING_AXIS_X, 0);
  measure(p, domain, &def);
  assert_close(p->report.container_area, 1.6, 1e-12);
  def = across(PACKING_AXIS_X, 0.8);
  measure(p, domain, &def);
  assert_close(p->report.container_area, 2.4, 1e-12);
  add(p, 0.8, 0, 1, 0.5);
  measure(p, domain, &def);
  assert_close(p->report.solid_area, pi / 4, 1e-12);
  packing_domain_destroy(domain);
  free(p);
}

/* Images across the borders of a cell: together each disc is whole. */
static void images_are_discs_too(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(4, 4, 4, 7);
  packing_section_def def = across(PACKING_AXIS_Z, 3.9);
  add(p, 0.1, 0.2, 0, 0.5); /* on a corner, and above from below */
  add(p, 4.1, 2, -4.2, 0.5);
  measure(p, cell, &def);
  assert_int_equal(p->discs, 6);
  for (int i = 0; i < 4; i++)
    assert_int_equal(p->disc[i].i, 0);
  assert_close(p->report.solid_area, pi * (0.24 + 0.24), 1e-13);
  def = oblique(2, 2, 2, 0, 1, 1); /* the diagonal of the cell */
  measure(p, cell, &def);
  assert_close(p->report.container_area, 16 * sqrt(2), 1e-12);
  packing_domain_destroy(cell);
  free(p);
}

/* Simple cubic, cut through centres and between: pi / 4 and nothing; a mean over many heights. */
static void series_of_sections(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(4, 4, 4, 7);
  packing_sections_def def;
  packing_sections_report report;
  packing_section_entry entry[64];
  size_t count = 0;
  for (int i = 0; i < 64; i++)
    add(p, i % 4, i / 4 % 4, i / 16, 0.5);
  packing_sections_def_init(&def);
  packing_sections_report_init(&report);
  assert_int_equal(def.sections, 5);
  def.sections = 2;
  def.from = -0.25;
  def.to = 0.75;
  def.axis = PACKING_AXIS_Y;
  assert_ok(
      packing_measure_sections(NULL, &def, cell, &p->view, entry, 64, &count, &report));
  assert_true(count == 2 && entry[0].height == 0 && entry[1].height == 0.5);
  assert_close(entry[0].porosity, 1 - pi / 4, 1e-14);
  assert_close(entry[0].solid_area, 4 * pi, 1e-14);
  assert_true(entry[1].porosity == 1 && report.sections == 1 + 1);
  assert_near(report.mean, 1 - pi / 8, 1e-14);
  assert_near(report.sd, pi / 4 / sqrt(2), 1e-14);
  assert_near(report.porosity, 1 - pi / 8, 1e-14);
  def.from = def.to = 0;
  def.sections = 64;
  assert_ok(
      packing_measure_sections(NULL, &def, cell, &p->view, entry, 64, &count, &report));
  /* The midpoint rule on a parabola: off by h^2 / 12 of the second derivative. */
  assert_near(report.porosity, 1 - pi / 6, pi / (4 * 16 * 16) / 3);
  assert_true(report.from == 0 && report.to == 4);
  packing_domain_destroy(cell);
  free(p);
}

static packing_section_image_report draw(pack *p, packing_domain *domain,
                                         const packing_section_def *section,
                                         const packing_section_image_def *def)
{
  packing_section_image_report report;
  size_t count = 0;
  packing_section_image_report_init(&report);
  assert_ok(packing_measure_section_image(NULL, section, def, domain, &p->view, p->pixel,
                                          PIXELS, &count, &report));
  assert_int_equal(count, report.rows * report.columns);
  assert_int_equal(count, report.black + report.white + report.outside);
  return report;
}

static void images_show_what_there_is(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(4, 2, 3, 0);
  const packing_section_def section = across(PACKING_AXIS_Z, 1);
  packing_section_image_def def;
  packing_section_image_def_init(&def);
  def.rows = 4;
  def.columns = 8;
  add(p, 1, 1.5, 1, 0.5); /* left, above the middle */
  packing_section_image_report report = draw(p, box, &section, &def);
  static const char *const rows[] = {".##.....", ".##.....", "........", "........"};
  for (size_t k = 0; k < 32; k++)
    assert_int_equal(p->pixel[k], rows[k / 8][k % 8] == '#' ? PACKING_PIXEL_SOLID
                                                            : PACKING_PIXEL_VOID);
  assert_true(report.white == 4 && report.black == 28 && report.occupation == 0.875);
  def.lo_u = -4;
  def.hi_u = 4;
  def.lo_v = 0;
  def.hi_v = 2;
  report = draw(p, box, &section, &def);
  assert_int_equal(report.outside, 16);
  assert_int_equal(p->pixel[3], PACKING_PIXEL_OUTSIDE);
  packing_domain_destroy(box);
  free(p);
}

/* Pixels against areas: in a cylinder full of balls, within the borders' share of pixels. */
static void images_agree_with_areas(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *domain = cylinder(2.1, 4);
  packing_section_image_def def;
  packing_section_image_def_init(&def);
  def.rows = def.columns = 400;
  for (int i = 0; i < 64; i++)
    add(p, i % 4 - 1.5, i / 4 % 4 - 1.5, 0.5 + i / 16, 0.49);
  const double sides[][3] = {{0, 0, 1}, {0.3, 0.4, 1}, {1, 0.1, 0.2}};
  for (int k = 0; k < 3; k++) {
    const packing_section_def section =
        oblique(0.1, 0, 1.7, sides[k][0], sides[k][1], sides[k][2]);
    measure(p, domain, &section);
    const packing_section_image_report report = draw(p, domain, &section, &def);
    const double pixel = (report.hi_u - report.lo_u) * (report.hi_v - report.lo_v) /
                         (double)(def.rows * def.columns);
    assert_true(p->discs > 8);
    assert_near((double)(report.black + report.white) * pixel, p->report.container_area,
                2e-3 * p->report.container_area);
    assert_near(report.occupation, p->report.porosity, 2e-3);
  }
  packing_domain_destroy(domain);
  free(p);
}

/* Areas count an overlap twice, a picture once. */
static void overlaps(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(2, 2, 2, 0);
  const packing_section_def section = across(PACKING_AXIS_Z, 1);
  add(p, 1, 1, 1, 0.5);
  add(p, 1, 1, 1, 0.5);
  measure(p, box, &section);
  assert_close(p->report.solid_area, pi / 2, 1e-14);
  packing_section_image_def def;
  packing_section_image_def_init(&def);
  def.rows = def.columns = 200;
  assert_near(draw(p, box, &section, &def).occupation, 1 - pi / 16, 2e-3);
  packing_domain_destroy(box);
  free(p);
}

static void what_fits_is_written(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(1, 1, 1, 0);
  const packing_section_def section = across(PACKING_AXIS_Z, 0.5);
  for (int i = 0; i < 9; i++)
    add(p, 0.2 + 0.3 * (i % 3), 0.2 + 0.3 * (i / 3), 0.5, 0.1);
  p->disc[4].u = 77;
  packing_section_report_init(&p->report);
  assert_ok(packing_measure_section(NULL, &section, box, &p->view, p->disc, 4, &p->discs,
                                    &p->report));
  assert_true(p->discs == 9 && p->disc[4].u == 77 && p->disc[3].i == 3);
  assert_close(p->report.solid_area, 9 * pi * 0.01, 1e-14);
  packing_section_image_report image;
  size_t count = 0;
  packing_section_image_report_init(&image);
  assert_ok(packing_measure_section_image(NULL, &section, NULL, box, &p->view, NULL, 0,
                                          &count, &image));
  assert_int_equal(count, 250000);
  assert_near(image.occupation, p->report.porosity, 1e-3);
  packing_domain_destroy(box);
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(discs_lie_where_they_should),
      cmocka_unit_test(cubes_have_hexagons),
      cmocka_unit_test(conic_sections),
      cmocka_unit_test(holes_are_taken_off),
      cmocka_unit_test(images_are_discs_too),
      cmocka_unit_test(series_of_sections),
      cmocka_unit_test(images_show_what_there_is),
      cmocka_unit_test(images_agree_with_areas),
      cmocka_unit_test(overlaps),
      cmocka_unit_test(what_fits_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
