/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Crystals in periodic cells of one unit cell (where a pair touches by several images, and a
 * sphere itself) up to many: coordination, fabric and density to rounding. */
#include "crystals.h"

static const int sizes[][3] = {{1, 1, 1}, {2, 1, 1}, {1, 3, 2}, {2, 2, 2},
                               {3, 3, 3}, {1, 1, 9}, {7, 5, 4}};

enum { SIZES = sizeof sizes / sizeof sizes[0] };

static void assert_coordination(const test_crystal *c, const test_crystal_pack *p)
{
  packing_coordination_def def;
  packing_coordination_report r;
  packing_coordination_def_init(&def);
  def.dim = c->dim;
  packing_coordination_report_init(&r);
  assert_ok(packing_measure_coordination(NULL, &def, p->cell, &p->view, &r));
  assert_int_equal(r.contacts, p->view.count * c->contacts / 2);
  assert_int_equal(r.histogram[c->contacts], p->view.count);
  assert_true(r.mean == (double)c->contacts && r.mean_no_rattlers == r.mean);
  assert_int_equal(r.rattlers, 0);
}

static void assert_fabric(const test_crystal *c, const packing_contacts *contacts)
{
  packing_fabric_report f;
  packing_fabric_report_init(&f);
  assert_ok(packing_contacts_fabric(contacts, NULL, &f));
  assert_int_equal(f.count, packing_contacts_count(contacts));
  assert_int_equal(f.dim, c->dim);
  double mean = 0, squares = 0;
  for (int i = 0; i < 3; i++) {
    assert_near(f.eigenvalues[i], c->fabric[i], 1e-12);
    for (int j = 0; j < 3; j++)
      assert_near(f.tensor[i][j], i == j ? c->fabric[i] : 0, 1e-12);
  }
  for (int k = 0; k < c->dim; k++)
    mean += c->fabric[k] / c->dim;
  for (int k = 0; k < c->dim; k++)
    squares += (c->fabric[k] - mean) * (c->fabric[k] - mean);
  assert_near(f.sd, sqrt(squares / (c->dim - 1)), 1e-12);
  assert_close(
      f.noise_floor,
      sqrt(c->dim == 2 ? 1 / (8.0 * (double)f.count) : 4 / (45 * (double)f.count)),
      1e-15);
}

/* Every contact touches, along a unit vector; every particle has its share. */
static void assert_list(const test_crystal *c, const packing_contacts *contacts, double d)
{
  const size_t n = packing_contacts_count(contacts);
  packing_contact *list = malloc(n * sizeof *list);
  size_t count = 0;
  assert_non_null(list);
  assert_int_equal(packing_contacts_wall_count(contacts), 0);
  assert_ok(packing_contacts_list(contacts, 0, n, list, &count));
  assert_int_equal(count, n);
  for (size_t k = 0; k < n; k++) {
    const packing_vec3 u = list[k].normal;
    assert_near(list[k].gap, 0, 1e-14 * d * 10);
    assert_near(u.x * u.x + u.y * u.y + u.z * u.z, 1, 1e-14);
    assert_true(list[k].i <= list[k].j && list[k].wall == -1);
  }
  size_t *degrees = malloc(packing_contacts_particles(contacts) * sizeof *degrees);
  assert_non_null(degrees);
  assert_ok(packing_contacts_degrees(contacts, degrees, NULL));
  for (size_t i = 0; i < packing_contacts_particles(contacts); i++)
    assert_int_equal(degrees[i], c->contacts);
  free(degrees);
  free(list);
}

static void crystals_have_their_contacts_and_fabric(void **state)
{
  (void)state;
  for (int k = 0; k < TEST_CRYSTALS; k++)
    for (int s = 0; s < SIZES; s++) {
      const test_crystal *c = test_crystal_of(k);
      const double d = s % 2 == 0 ? 1 : 0.0137;
      test_crystal_pack p = test_crystal_make(c, sizes[s], d);
      packing_contacts *contacts = NULL;
      assert_ok(packing_contacts_create(NULL, NULL, p.cell, &p.view, &contacts));
      assert_coordination(c, &p);
      assert_fabric(c, contacts);
      assert_list(c, contacts, d);
      packing_contacts_destroy(contacts);
      test_crystal_free(&p);
    }
}

static void crystals_have_their_density(void **state)
{
  (void)state;
  for (int k = 0; k < TEST_CRYSTALS; k++)
    for (int s = 0; s < SIZES; s++) {
      const test_crystal *c = test_crystal_of(k);
      test_crystal_pack p = test_crystal_make(c, sizes[s], 0.73);
      packing_volume_report r;
      packing_volume_report_init(&r);
      assert_ok(packing_measure_volume(NULL, NULL, p.cell, &p.view, &r));
      assert_near(r.volume_fraction, c->fraction, 1e-12);
      assert_near(r.inner_fraction, c->fraction, 1e-12);
      assert_true(r.error <= 1e-12);
      test_crystal_free(&p);
    }
}

/* Neighbours touch within rounding, by the nearest image or by a particle's own. */
static void crystals_pass_the_audit(void **state)
{
  (void)state;
  for (int k = 0; k < TEST_CRYSTALS; k++)
    for (int s = 0; s < SIZES; s++) {
      test_crystal_pack p = test_crystal_make(test_crystal_of(k), sizes[s], 0.73);
      packing_audit_report r;
      packing_audit_report_init(&r);
      assert_ok(packing_audit(NULL, NULL, p.cell, &p.view, &r));
      assert_int_equal(r.passed, 1);
      assert_near(r.min_gap, 0, 1e-13);
      assert_true(r.max_overlap == fmax(0, 0 - r.min_gap));
      test_crystal_free(&p);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(crystals_have_their_contacts_and_fabric),
      cmocka_unit_test(crystals_have_their_density),
      cmocka_unit_test(crystals_pass_the_audit),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
