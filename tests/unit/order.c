/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bond order, hexatic order and common neighbours with known answers: lattices, down to a single
 * periodic unit cell, whose particles have images for neighbours. */
#include "test.h"

static const double Q4_FCC = 0.190941, Q6_FCC = 0.574524;

static packing_particles *lattice(packing_lattice_kind kind, packing_domain *domain)
{
  packing_lattice_def def;
  packing_placer *placer = NULL;
  packing_psd *psd = test_mono(0.5);
  packing_particles *particles = test_store(packing_domain_dim(domain));
  packing_lattice_def_init(&def);
  def.kind = kind;
  assert_ok(packing_lattice_create(NULL, &def, domain, psd, particles, &placer));
  (void)test_run(placer);
  packing_placer_destroy(placer);
  packing_psd_destroy(psd);
  return particles;
}

static packing_neighbours *within(const packing_view *v, packing_domain *domain,
                                  double factor, double margin, int dim)
{
  packing_neighbours_def def;
  packing_neighbours *neighbours = NULL;
  packing_neighbours_def_init(&def);
  def.factor = factor;
  def.margin = margin;
  def.dim = dim;
  assert_ok(packing_neighbours_create(NULL, &def, domain, v, &neighbours));
  return neighbours;
}

static packing_neighbours *nearest(const packing_view *v, packing_domain *domain,
                                   size_t count)
{
  packing_neighbours_def def;
  packing_neighbours *neighbours = NULL;
  packing_neighbours_def_init(&def);
  def.kind = PACKING_NEIGHBOURS_NEAREST;
  def.nearest = count;
  assert_ok(packing_neighbours_create(NULL, &def, domain, v, &neighbours));
  return neighbours;
}

static packing_bond_order_report bond_order(const packing_neighbours *n, int l)
{
  packing_bond_order_def def;
  packing_bond_order_report report;
  packing_bond_order_def_init(&def);
  def.l = l;
  packing_bond_order_report_init(&report);
  assert_ok(packing_measure_bond_order(NULL, &def, n, NULL, 0, &report));
  return report;
}

static packing_hexatic_report hexatic(const packing_neighbours *n, int fold)
{
  packing_hexatic_def def;
  packing_hexatic_report report;
  packing_hexatic_def_init(&def);
  def.fold = fold;
  packing_hexatic_report_init(&report);
  assert_ok(packing_measure_hexatic(NULL, &def, n, NULL, 0, &report));
  return report;
}

static packing_common_neighbours_report crystals(const packing_neighbours *n)
{
  packing_common_neighbours_report report;
  packing_common_neighbours_report_init(&report);
  assert_ok(packing_measure_common_neighbours(NULL, n, NULL, 0, &report));
  return report;
}

/* A lattice of spheres of diameter 1 whose cell, periodic in all directions, is (x, y, z). */
typedef struct crystal {
  packing_lattice_kind kind;
  double x, y, z;
  double factor;
  size_t bonds; /* of each particle */
  double q4, q6, w4, w6;
  packing_structure structure;
} crystal;

/* Every particle and all bonds together have the values. */
static void assert_orders(const crystal *c, const packing_neighbours *n)
{
  const double q[2] = {c->q4, c->q6}, w[2] = {c->w4, c->w6};
  for (int k = 0; k < 2; k++) {
    const packing_bond_order_report r = bond_order(n, 4 + 2 * k);
    assert_int_equal(r.counted, packing_neighbours_count(n));
    assert_int_equal(r.bonds, c->bonds * r.counted);
    assert_int_equal(r.isolated, 0);
    assert_near(r.mean, q[k], 1e-6);
    assert_near(r.mean_averaged, q[k], 1e-6);
    assert_near(r.whole, q[k], 1e-6);
    assert_near(r.mean_w, w[k], 1e-6);
    assert_near(r.whole_w, w[k], 1e-6);
  }
}

static void assert_crystal(const crystal *c, int cells)
{
  packing_view v;
  packing_domain *cell = test_box(cells * c->x, cells * c->y, cells * c->z, 7);
  packing_particles *particles = lattice(c->kind, cell);
  packing_particles_view(particles, &v);
  packing_neighbours *n = within(&v, cell, c->factor, 0, 3);
  assert_orders(c, n);
  const packing_common_neighbours_report r = crystals(n);
  assert_int_equal(r.counted, v.count);
  assert_int_equal(r.number[c->structure], v.count);
  packing_neighbours_destroy(n);
  n = nearest(&v, cell, c->bonds);
  assert_orders(c, n);
  packing_neighbours_destroy(n);
  packing_particles_destroy(particles);
  packing_domain_destroy(cell);
}

static void crystals_have_their_values(void **state)
{
  (void)state;
  const double a = sqrt(2), b = 2 / sqrt(3), c = sqrt(3), h = 2 * sqrt(2.0 / 3);
  const crystal known[] = {
      {PACKING_LATTICE_FCC, a, a, a, 1.2, 12, Q4_FCC, Q6_FCC, -0.159317, -0.013161,
       PACKING_STRUCTURE_FCC},
      {PACKING_LATTICE_HCP, 1, c, h, 1.2, 12, 0.097222, 0.484762, 0.134097, -0.012442,
       PACKING_STRUCTURE_HCP},
      {PACKING_LATTICE_SC, 1, 1, 1, 1.2, 6, 0.763763, 0.353553, 0.159317, 0.013161,
       PACKING_STRUCTURE_OTHER},
      {PACKING_LATTICE_BCC, b, b, b, 1.1, 8, 0.509175, 0.628539, -0.159317, 0.013161,
       PACKING_STRUCTURE_OTHER},
      {PACKING_LATTICE_BCC, b, b, b, 1.2, 14, 0.036370, 0.510688, 0.159317, 0.013161,
       PACKING_STRUCTURE_BCC},
  };
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
    for (int cells = 1; cells <= 4; cells++)
      assert_crystal(&known[k], cells);
}

/* A sphere and twelve around it: six axes of five-fold symmetry. */
static size_t icosahedron(double *x, double *y, double *z, double *r)
{
  const double golden = (1 + sqrt(5)) / 2, scale = 1 / sqrt(1 + golden * golden);
  size_t count = 1;
  x[0] = y[0] = z[0] = 0;
  for (int k = 0; k < 12; k++, count++) {
    const double one = k & 1 ? scale : -scale, two = (k & 2 ? golden : -golden) * scale;
    x[count] = k / 4 == 0 ? one : k / 4 == 1 ? two : 0;
    y[count] = k / 4 == 1 ? 0 : k / 4 == 0 ? two : one;
    z[count] = k / 4 == 0 ? 0 : k / 4 == 1 ? one : two;
  }
  for (size_t i = 0; i < count; i++)
    r[i] = 0.5;
  return count;
}

static void an_icosahedron_is_told(void **state)
{
  (void)state;
  double x[13], y[13], z[13], r[13];
  packing_structure kinds[13];
  packing_bond_order local[13];
  packing_bond_order_def def;
  packing_bond_order_report report;
  packing_common_neighbours_report found;
  packing_view v;
  packing_view_init_arrays(&v, icosahedron(x, y, z, r), x, y, z, r);
  packing_neighbours *n = within(&v, NULL, 1.2, 0, 3);
  packing_bond_order_def_init(&def);
  packing_bond_order_report_init(&report);
  assert_ok(packing_measure_bond_order(NULL, &def, n, local, 13, &report));
  assert_near(local[0].q, 0.663325, 1e-6);
  assert_near(local[0].w, -0.169754, 1e-6);
  def.l = 4;
  assert_ok(packing_measure_bond_order(NULL, &def, n, local, 13, &report));
  assert_near(local[0].q, 0, 1e-14);
  assert_true(local[0].w == 0); /* no shape to speak of */
  packing_common_neighbours_report_init(&found);
  assert_ok(packing_measure_common_neighbours(NULL, n, kinds, 13, &found));
  assert_int_equal(kinds[0], PACKING_STRUCTURE_ICOSAHEDRAL);
  assert_int_equal(kinds[1], PACKING_STRUCTURE_OTHER);
  assert_int_equal(found.number[PACKING_STRUCTURE_ICOSAHEDRAL], 1);
  assert_int_equal(found.number[PACKING_STRUCTURE_OTHER], 12);
  packing_neighbours_destroy(n);
}

/* Two bonds at an angle of acos(c): q_l^2 = (1 + P_l(c)) / 2, for every degree. */
static void two_bonds_follow_legendre(void **state)
{
  (void)state;
  const double c = 0.3125, s = sqrt(1 - c * c);
  double x[3] = {0.25, 1.25, 0.25 + c}, y[3] = {1, 1, 1 + s}, z[3] = {3, 3, 3};
  double r[3] = {0.5, 0.5, 0.5}, p[13] = {1, c};
  packing_view v;
  packing_view_init_arrays(&v, 3, x, y, z, r);
  packing_neighbours *n = within(&v, NULL, 1.0625, 0, 3);
  for (int l = 2; l <= 12; l++)
    p[l] = ((2 * l - 1) * c * p[l - 1] - (l - 1) * p[l - 2]) / l;
  for (int l = 2; l <= 12; l += 2) {
    packing_bond_order local;
    packing_bond_order_def def;
    packing_bond_order_report report;
    packing_bond_order_def_init(&def);
    def.l = l;
    packing_bond_order_report_init(&report);
    assert_ok(packing_measure_bond_order(NULL, &def, n, &local, 1, &report));
    assert_close(local.q, sqrt((1 + p[l]) / 2), 1e-13);
    /* Its neighbours have one bond each, the mean of three moments is that of both bonds. */
    assert_close(local.averaged, local.q * 2 / 3 * 1.5, 1e-13);
    assert_close(report.mean, (local.q + 2) / 3, 1e-13);
  }
  packing_neighbours_destroy(n);
}

static void discs_have_hexatic_order(void **state)
{
  (void)state;
  packing_view v;
  packing_domain *cell = test_rectangle(1, sqrt(3), 3), *square = test_rectangle(1, 1, 3);
  packing_particles *particles = lattice(PACKING_LATTICE_HEXAGONAL, cell);
  packing_particles_view(particles, &v);
  assert_int_equal(v.count, 2);
  packing_neighbours *n = within(&v, cell, 1.2, 0, 3);
  packing_hexatic_report r = hexatic(n, 6);
  assert_int_equal(r.counted, 2);
  assert_near(r.mean, 1, 1e-12);
  assert_near(r.whole, 1, 1e-12);
  assert_true(r.share == 1 && r.isolated == 0);
  assert_near(hexatic(n, 4).mean, 0, 1e-12);
  packing_neighbours_destroy(n);
  packing_particles_destroy(particles);
  particles = lattice(PACKING_LATTICE_SQUARE, square);
  packing_particles_view(particles, &v);
  n = within(&v, square, 1.2, 0, 3);
  assert_near(hexatic(n, 6).mean, 0, 1e-12);
  assert_near(hexatic(n, 4).mean, 1, 1e-12);
  assert_true(hexatic(n, 4).share == 1 && hexatic(n, 6).share == 0);
  packing_neighbours_destroy(n);
  packing_particles_destroy(particles);
  packing_domain_destroy(cell);
  packing_domain_destroy(square);
}

/* Two grains, turned by 30 degrees against each other: each disc is ordered, the whole is not. */
static void grains_are_ordered_but_not_together(void **state)
{
  (void)state;
  double x[15], y[15], r[15];
  packing_hexatic local[15];
  packing_hexatic_def def;
  packing_hexatic_report report;
  packing_view v;
  for (int i = 0; i < 14; i++) {
    const double angle = acos(-1) / 6 * (2 * (i % 7) + i / 7);
    x[i] = (i % 7 < 6 ? cos(angle) : 0) + 10 * (i / 7);
    y[i] = i % 7 < 6 ? sin(angle) : 0;
    r[i] = 0.5;
  }
  x[14] = 20;
  y[14] = 0;
  r[14] = 0.5;
  packing_view_init_arrays(&v, 15, x, y, NULL, r);
  packing_neighbours *n = within(&v, NULL, 1.2, 0, 2);
  packing_hexatic_def_init(&def);
  packing_hexatic_report_init(&report);
  assert_ok(packing_measure_hexatic(NULL, &def, n, local, 15, &report));
  assert_int_equal(report.counted, 15);
  assert_int_equal(report.isolated, 1);
  assert_near(report.mean, 14.0 / 15, 1e-12);
  assert_near(report.whole, 0, 1e-12);
  assert_near(report.share, 2.0 / 15, 1e-15);
  for (int i = 0; i < 14; i++) {
    assert_near(local[i].re, i < 7 ? 1 : -1, 1e-12);
    assert_near(local[i].im, 0, 1e-12);
    assert_int_equal(local[i].neighbours, i % 7 < 6 ? 3 : 6);
  }
  assert_true(local[14].re == 0 && local[14].modulus == 0 && local[14].neighbours == 0);
  packing_neighbours_destroy(n);
}

/* A cubic block in a box: only the innermost is away from walls and open top. */
static void the_margin_keeps_the_outer_ones_out(void **state)
{
  (void)state;
  packing_view v;
  packing_domain_box_def def;
  packing_domain *box = NULL;
  packing_domain_box_def_init(&def);
  def.size.x = def.size.y = def.size.z = 5;
  def.open_top = 1;
  assert_ok(packing_domain_create_box(NULL, &def, &box));
  packing_particles *particles = lattice(PACKING_LATTICE_SC, box);
  packing_particles_view(particles, &v);
  v.count = 125; /* bottom first: without the layer above the top */
  packing_neighbours *n = within(&v, box, 1.2, 1.25, 3);
  packing_bond_order_report r = bond_order(n, 4);
  assert_int_equal(r.counted, 27);
  assert_int_equal(r.bonds, 27 * 6);
  assert_near(r.mean, 0.763763, 1e-6);
  assert_int_equal(crystals(n).counted, 27);
  packing_neighbours_destroy(n);
  n = within(&v, box, 1.2, 0, 3);
  r = bond_order(n, 4);
  assert_int_equal(r.counted, 125);
  assert_int_equal(r.bonds, 2 * 3 * 4 * 25);
  packing_neighbours_destroy(n);
  n = within(&v, box, 1.2, 3, 3);
  r = bond_order(n, 4);
  assert_true(r.counted == 0 && isnan(r.mean) && isnan(r.whole) && isnan(r.whole_w));
  packing_neighbours_destroy(n);
  packing_particles_destroy(particles);
  packing_domain_destroy(box);
}

/* One sphere in a cube of its size has its own images for neighbours. */
static void neighbours_may_be_images(void **state)
{
  (void)state;
  const double x = 0.25, y = 7.5, z = -3, r = 0.5;
  packing_neighbour list[6];
  size_t count = 0;
  packing_view v;
  packing_domain *cell = test_box(1, 1, 1, 7);
  packing_view_init_arrays(&v, 1, &x, &y, &z, &r);
  packing_neighbours *n = nearest(&v, cell, 6);
  assert_ok(packing_neighbours_of(n, 0, NULL, 0, &count));
  assert_int_equal(count, 6);
  assert_ok(packing_neighbours_of(n, 0, list, 6, &count));
  packing_vec3 sum = {0, 0, 0};
  for (int k = 0; k < 6; k++) {
    assert_int_equal(list[k].j, 0);
    assert_true(list[k].distance == 1);
    sum.x += list[k].d.x;
    sum.y += list[k].d.y;
    sum.z += list[k].d.z;
  }
  assert_true(sum.x == 0 && sum.y == 0 && sum.z == 0);
  packing_neighbours_destroy(n);
  n = nearest(&v, cell, 256); /* balls of many periods */
  assert_ok(packing_neighbours_of(n, 0, list, 6, &count));
  assert_int_equal(count, 256);
  packing_neighbours_destroy(n);
  packing_domain_destroy(cell);
}

static void few_particles_have_few_neighbours(void **state)
{
  (void)state;
  double x[3] = {0, 1, 1e9}, y[3] = {0}, z[3] = {0}, r[3] = {0.5, 0.5, 0.5};
  packing_neighbour list[2];
  size_t count = 7;
  packing_view v;
  packing_view_init_arrays(&v, 3, x, y, z, r);
  packing_neighbours *n = nearest(&v, NULL, 12);
  assert_ok(packing_neighbours_of(n, 2, list, 2, &count));
  assert_int_equal(count, 2);
  assert_true(list[0].d.x + list[1].d.x == -2e9 + 1);
  packing_neighbours_destroy(n);
  v.count = 1;
  n = nearest(&v, NULL, 12);
  assert_ok(packing_neighbours_of(n, 0, NULL, 0, &count));
  assert_int_equal(count, 0);
  packing_bond_order_report q = bond_order(n, 6);
  assert_true(q.counted == 1 && q.isolated == 1 && q.bonds == 0 && q.mean == 0);
  assert_true(isnan(q.whole) && isnan(q.mean_w));
  packing_neighbours_destroy(n);
  v.count = 0;
  for (int k = 0; k < 2; k++) {
    n = k == 0 ? nearest(&v, NULL, 12) : within(&v, NULL, 1.2, 0, 3);
    q = bond_order(n, 6);
    assert_true(packing_neighbours_count(n) == 0 && q.counted == 0 && isnan(q.mean));
    if (k == 1)
      assert_int_equal(crystals(n).counted, 0);
    packing_neighbours_destroy(n);
  }
  n = within(&v, NULL, 1.2, 0, 2);
  assert_true(isnan(hexatic(n, 6).mean) && isnan(hexatic(n, 6).share));
  packing_neighbours_destroy(n);
}

/* Equal centres are neighbours, but a bond of no length has no direction. */
static void coincident_centres_give_no_direction(void **state)
{
  (void)state;
  double x[3] = {0, 0, 1}, y[3] = {0}, z[3] = {0}, r[3] = {0.5, 0.5, 0.5};
  packing_bond_order local[3];
  packing_bond_order_report report;
  packing_view v;
  packing_view_init_arrays(&v, 3, x, y, z, r);
  packing_neighbours *n = within(&v, NULL, 1.2, 0, 3);
  packing_bond_order_report_init(&report);
  assert_ok(packing_measure_bond_order(NULL, NULL, n, local, 3, &report));
  assert_int_equal(report.bonds, 6);
  assert_close(local[0].q, 0.5, 1e-14);
  assert_near(local[2].q, 1, 1e-14);
  packing_neighbours_destroy(n);
}

static void structures_have_names(void **state)
{
  (void)state;
  const char *names[] = {"other", "fcc", "hcp", "bcc", "icosahedral"};
  for (int k = 0; k < PACKING_STRUCTURE_END; k++)
    assert_string_equal(packing_structure_name((packing_structure)k), names[k]);
  assert_string_equal(packing_structure_name(PACKING_STRUCTURE_END), "unknown");
  assert_string_equal(packing_structure_name((packing_structure)-1), "unknown");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(crystals_have_their_values),
      cmocka_unit_test(an_icosahedron_is_told),
      cmocka_unit_test(two_bonds_follow_legendre),
      cmocka_unit_test(discs_have_hexatic_order),
      cmocka_unit_test(grains_are_ordered_but_not_together),
      cmocka_unit_test(the_margin_keeps_the_outer_ones_out),
      cmocka_unit_test(neighbours_may_be_images),
      cmocka_unit_test(few_particles_have_few_neighbours),
      cmocka_unit_test(coincident_centres_give_no_direction),
      cmocka_unit_test(structures_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
