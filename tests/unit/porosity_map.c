/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local porosity with known answers. */
#include "test.h"

static const double pi = 3.14159265358979323846;

enum { MOST = 512, CELLS = 512 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
  packing_porosity_cell cell[CELLS];
  packing_porosity_map_report report;
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

static packing_porosity_map_def options(size_t nx, size_t ny, size_t nz)
{
  packing_porosity_map_def def;
  packing_porosity_map_def_init(&def);
  def.nx = nx;
  def.ny = ny;
  def.nz = nz;
  return def;
}

static void measure(pack *p, packing_domain *domain, const packing_porosity_map_def *def)
{
  size_t count = 0;
  packing_porosity_map_report_init(&p->report);
  assert_ok(packing_measure_porosity_map(NULL, def, domain, &p->view, p->cell, CELLS,
                                         &count, &p->report));
  assert_int_equal(count, p->report.nx * p->report.ny * p->report.nz);
}

static double ball(double r)
{
  return 4 * pi / 3 * r * r * r;
}

/* Cells on the corners of a simple cubic crystal's: an eighth of a ball in each. */
static void a_crystal_is_even(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(3, 3, 3, 7);
  const packing_porosity_map_def def = options(6, 6, 6);
  for (int i = 0; i < 27; i++)
    add(p, i % 3 - 3, i / 3 % 3 + 6, i / 9, 0.5);
  measure(p, cell, &def);
  for (int i = 0; i < 216; i++) {
    assert_close(p->cell[i].volume, 0.125, 1e-15);
    assert_close(p->cell[i].solid, ball(0.5) / 8, 1e-13);
    assert_near(p->cell[i].porosity, 1 - pi / 6, 1e-13);
  }
  assert_close(p->report.solid, 27 * ball(0.5), 1e-14);
  assert_near(p->report.mean, 1 - pi / 6, 1e-14);
  assert_true(p->report.sd < 1e-13 && p->report.error < 1e-12);
  packing_domain_destroy(cell);
  free(p);
}

/* The ball of radius .02 cut .005 above its centre. */
static void cells_cut_where_they_should(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(2, 3, 4, 0);
  const packing_porosity_map_def def = options(2, 3, 4);
  add(p, 1.5, 2.5, 1.995, 0.02);
  measure(p, box, &def);
  const size_t below = 1 + 2 * (2 + 3 * 1), above = 1 + 2 * (2 + 3 * 2);
  assert_close(p->cell[below].solid, 2.290744643243e-5, 1e-12);
  assert_close(p->cell[below].solid + p->cell[above].solid, 3.351032163829e-5, 1e-12);
  for (size_t i = 0; i < 24; i++)
    if (i != below && i != above)
      assert_true(p->cell[i].solid == 0 && p->cell[i].porosity == 1);
  packing_domain_destroy(box);
  free(p);
}

static void cells_are_cut_at_the_container(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain_cylinder_def cylinder;
  packing_domain *domain = NULL;
  const packing_porosity_map_def def = options(4, 4, 1);
  packing_domain_cylinder_def_init(&cylinder);
  cylinder.radius = 1;
  cylinder.height = 2;
  assert_ok(packing_domain_create_cylinder(NULL, &cylinder, &domain));
  add(p, 0, 0, 0, 0.75); /* half of it, about the axis */
  measure(p, domain, &def);
  const double inner = 0.25, corner = (pi - (2 * pi / 3 + sqrt(3))) / 4 + 0.25;
  /* The circle's quadrant: cells beside the axis whole, the corner by pi / 12 ... */
  const double beside = pi / 12 + sqrt(3) / 8 - 0.25;
  assert_close(p->cell[5].volume, 2 * inner, 1e-15);
  assert_close(p->cell[4].volume, 2 * beside, 1e-12);
  assert_close(p->cell[0].volume, 2 * (pi / 4 - inner - 2 * beside), 1e-11);
  assert_near(corner, pi / 4 - inner - 2 * beside, 1e-14);
  assert_close(p->report.volume, 2 * pi, 1e-12);
  assert_close(p->report.solid, 0.5 * ball(0.75), 1e-12);
  assert_close(p->cell[5].solid, p->cell[10].solid, 1e-12);
  packing_domain_destroy(domain);
  free(p);
}

static void a_box_of_ones_own(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *square = test_rectangle(4, 4, 0);
  packing_porosity_map_def def = options(2, 1, 9);
  def.bounds.lo = (packing_vec3){3, 1, 0};
  def.bounds.hi = (packing_vec3){5, 2, 0};
  add(p, 4, 1.5, 0, 0.25);
  add(p, 1, 1.5, 0, 0.5); /* elsewhere */
  measure(p, square, &def);
  assert_int_equal(p->report.nz, 1);
  assert_close(p->cell[0].solid, pi / 32, 1e-14);
  assert_true(p->cell[1].solid == 0 && p->cell[1].volume == 0);
  assert_true(isnan(p->cell[1].porosity));
  assert_close(p->report.mean, 1 - pi / 32, 1e-14);
  assert_true(p->report.sd < 1e-14);
  packing_domain_destroy(square);
  free(p);
}

/* One cell full, one empty: sd by hand. */
static void deviation_weighs_by_volume(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *cell = test_box(2, 1, 1, 6);
  const packing_porosity_map_def def = options(2, 1, 1);
  add(p, 0.5, 0.5, 0.5, 0.5);
  measure(p, cell, &def);
  assert_near(p->report.mean, 1 - pi / 12, 1e-14);
  assert_near(p->report.sd, pi / 12, 1e-14);
  packing_domain_destroy(cell);
  free(p);
}

static void what_fits_is_written(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(1, 1, 1, 0);
  size_t count = 0;
  packing_porosity_map_report_init(&p->report);
  assert_ok(packing_measure_porosity_map(NULL, NULL, box, &p->view, NULL, 0, &count,
                                         &p->report));
  assert_true(count == 1000 && p->report.mean == 1);
  p->cell[2].volume = 77;
  assert_ok(packing_measure_porosity_map(NULL, NULL, box, &p->view, p->cell, 2, &count,
                                         &p->report));
  assert_close(p->cell[1].volume, 0.001, 1e-13);
  assert_true(count == 1000 && p->cell[2].volume == 77);
  packing_domain_destroy(box);
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_crystal_is_even),
      cmocka_unit_test(cells_cut_where_they_should),
      cmocka_unit_test(cells_are_cut_at_the_container),
      cmocka_unit_test(a_box_of_ones_own),
      cmocka_unit_test(deviation_weighs_by_volume),
      cmocka_unit_test(what_fits_is_written),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
