/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fabric of planted directions: of contacts, of walls and of orientations. */
#include "test.h"

enum { MOST = 4000 };

#define PI 3.14159265358979323846

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST], q[4][MOST];
  packing_view view;
} pack;

static pack *new_pack(void)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  packing_view_init_arrays(&p->view, 0, p->x, p->y, p->z, p->r);
  packing_column *q[4] = {&p->view.qw, &p->view.qx, &p->view.qy, &p->view.qz};
  for (int k = 0; k < 4; k++) {
    q[k]->data = p->q[k];
    q[k]->stride = sizeof p->q[k][0];
  }
  return p;
}

/* Two touching spheres of radius 1, away from all others, whose normal is d / |d|. */
static void add_pair(pack *p, packing_vec3 d)
{
  const double s = 2 / sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  const size_t i = p->view.count;
  for (size_t k = 0; k < 2; k++) {
    p->x[i + k] = 10 * (double)i + (double)k * s * d.x;
    p->y[i + k] = (double)k * s * d.y;
    p->z[i + k] = (double)k * s * d.z;
    p->r[i + k] = 1;
  }
  p->view.count += 2;
}

static packing_fabric_report measure(const pack *p, packing_domain *domain, int dim,
                                     packing_contacts_of of)
{
  packing_contacts_def def;
  packing_fabric_def fabric;
  packing_contacts *c = NULL;
  packing_fabric_report r;
  packing_contacts_def_init(&def);
  def.dim = dim;
  packing_fabric_def_init(&fabric);
  fabric.of = of;
  packing_fabric_report_init(&r);
  assert_ok(packing_contacts_create(NULL, &def, domain, &p->view, &c));
  assert_ok(packing_contacts_fabric(c, &fabric, &r));
  packing_contacts_destroy(c);
  return r;
}

/* F v = lambda v, unit vectors at right angles, lambda falling, trace 1, largest part positive. */
static void assert_eigen(const packing_fabric_report *r)
{
  double trace = 0;
  for (int k = 0; k < 3; k++) {
    const double *v = r->eigenvectors[k];
    double largest = 0;
    trace += r->tensor[k][k];
    assert_true(k == 0 || r->eigenvalues[k] <= r->eigenvalues[k - 1]);
    for (int i = 0; i < 3; i++) {
      double sum = 0;
      for (int j = 0; j < 3; j++)
        sum += r->tensor[i][j] * v[j];
      assert_near(sum, r->eigenvalues[k] * v[i], 1e-14);
      largest = fabs(v[i]) > fabs(largest) ? v[i] : largest;
      assert_true(r->tensor[i][k] == r->tensor[k][i]);
    }
    assert_true(largest > 0);
    for (int n = 0; n < 3; n++) {
      const double *w = r->eigenvectors[n];
      assert_near(v[0] * w[0] + v[1] * w[1] + v[2] * w[2], n == k, 1e-14);
    }
  }
  assert_near(trace, 1, 1e-14);
}

static void one_direction_has_one_eigenvalue(void **state)
{
  (void)state;
  const packing_vec3 d[] = {{1, 0, 0}, {0, 0, -3}, {1, 2, 2}, {-2, 1, -2}, {1, 1, 1}};
  for (size_t k = 0; k < sizeof d / sizeof d[0]; k++) {
    pack *p = new_pack();
    add_pair(p, d[k]);
    const packing_fabric_report r = measure(p, NULL, 3, PACKING_CONTACTS_OF_PAIRS);
    const double length = sqrt(d[k].x * d[k].x + d[k].y * d[k].y + d[k].z * d[k].z);
    assert_int_equal(r.count, 1);
    assert_near(r.eigenvalues[0], 1, 1e-14);
    assert_near(r.eigenvalues[1], 0, 1e-14);
    assert_near(r.eigenvalues[2], 0, 1e-14);
    assert_near(fabs(r.eigenvectors[0][0] * d[k].x + r.eigenvectors[0][1] * d[k].y +
                     r.eigenvectors[0][2] * d[k].z),
                length, 1e-13);
    assert_near(r.sd, sqrt(1.0 / 3), 1e-14);
    assert_near(r.noise_floor, sqrt(4.0 / 45), 1e-15);
    assert_eigen(&r);
    free(p);
  }
}

/* Of 3 + 2 + 1 contacts along three axes at right angles, turned: eigenvalues 1/2, 1/3, 1/6. */
static void eigenvalues_are_the_shares_of_the_axes(void **state)
{
  (void)state;
  pack *p = new_pack();
  const packing_vec3 axis[3] = {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}};
  for (int k = 0; k < 3; k++)
    for (int n = 0; n < 3 - k; n++)
      add_pair(p, axis[k]);
  const packing_fabric_report r = measure(p, NULL, 0, PACKING_CONTACTS_OF_PAIRS);
  assert_int_equal(r.count, 6);
  assert_near(r.eigenvalues[0], 1.0 / 2, 1e-14);
  assert_near(r.eigenvalues[1], 1.0 / 3, 1e-14);
  assert_near(r.eigenvalues[2], 1.0 / 6, 1e-14);
  assert_near(r.sd, 1.0 / 6, 1e-14);
  assert_near(r.eigenvectors[2][0], -1.0 / 3, 1e-13);
  assert_near(r.eigenvectors[2][1], 2.0 / 3, 1e-13);
  assert_eigen(&r);
  free(p);
}

static void walls_stand_apart(void **state)
{
  (void)state;
  pack *p = new_pack();
  packing_domain *box = test_box(4, 3, 2, 0);
  p->view.count = 2;
  for (size_t i = 0; i < 2; i++) {
    p->x[i] = 1 + 2 * (double)i;
    p->y[i] = p->z[i] = p->r[i] = 1;
  }
  packing_fabric_report r = measure(p, box, 0, PACKING_CONTACTS_OF_PAIRS);
  assert_true(r.count == 1 && r.tensor[0][0] == 1);
  r = measure(p, box, 0, PACKING_CONTACTS_OF_WALLS); /* 2 along x, 2 along y, 4 along z */
  assert_int_equal(r.count, 8);
  assert_near(r.tensor[0][0], 0.25, 1e-15);
  assert_near(r.tensor[1][1], 0.25, 1e-15);
  assert_near(r.tensor[2][2], 0.5, 1e-15);
  assert_eigen(&r);
  r = measure(p, box, 0, PACKING_CONTACTS_OF_ALL);
  assert_int_equal(r.count, 9);
  assert_near(r.tensor[0][0], 3.0 / 9, 1e-15);
  packing_domain_destroy(box);
  free(p);
}

static void the_plane_has_two_eigenvalues(void **state)
{
  (void)state;
  pack *p = new_pack();
  for (int k = 0; k < 3; k++)
    add_pair(p, (packing_vec3){3, 4, 0});
  add_pair(p, (packing_vec3){-4, 3, 0});
  packing_fabric_report r = measure(p, NULL, 2, PACKING_CONTACTS_OF_PAIRS);
  assert_int_equal(r.dim, 2);
  assert_near(r.eigenvalues[0], 0.75, 1e-14);
  assert_near(r.eigenvalues[1], 0.25, 1e-14);
  assert_true(r.eigenvalues[2] == 0 && r.eigenvectors[2][2] == 1);
  assert_near(r.sd, 0.5 / sqrt(2), 1e-14);
  assert_near(r.noise_floor, sqrt(1.0 / 32), 1e-15);
  assert_eigen(&r);
  p->view.count = 6; /* one direction: 0 twice, and z still comes last */
  r = measure(p, NULL, 2, PACKING_CONTACTS_OF_PAIRS);
  assert_near(r.eigenvectors[1][0], 0.8, 1e-14);
  assert_near(r.eigenvectors[1][1], -0.6, 1e-14);
  assert_true(r.eigenvectors[2][2] == 1 && r.eigenvectors[1][2] == 0);
  free(p);
}

/* Random directions: each diagonal term within 4.5 standard deviations of 1/3 or 1/2, off-diagonal
 * ones too (theirs are smaller: 1/15 < 4/45). False alarms: 15 terms, 1e-4. */
static void random_directions_stay_at_the_noise_floor(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    pack *p = new_pack();
    packing_rng *rng = NULL;
    assert_ok(packing_rng_create(NULL, 11, PACKING_PURPOSE_USER, 0, &rng));
    while (p->view.count < MOST)
      add_pair(p, (packing_vec3){packing_rng_normal(rng), packing_rng_normal(rng),
                                 dim == 2 ? 0 : packing_rng_normal(rng)});
    const packing_fabric_report r = measure(p, NULL, dim, PACKING_CONTACTS_OF_PAIRS);
    assert_int_equal(r.count, MOST / 2);
    for (int i = 0; i < dim; i++)
      for (int j = 0; j < dim; j++)
        assert_near(r.tensor[i][j], i == j ? 1.0 / dim : 0, 4.5 * r.noise_floor);
    assert_true(r.sd > 0.1 * r.noise_floor && r.sd < 4.5 * r.noise_floor);
    assert_eigen(&r);
    packing_rng_destroy(rng);
    free(p);
  }
}

static void add_quaternion(pack *p, double w, double x, double y, double z)
{
  const size_t i = p->view.count++;
  p->r[i] = 1;
  p->q[0][i] = w;
  p->q[1][i] = x;
  p->q[2][i] = y;
  p->q[3][i] = z;
}

static packing_fabric_report orient(const pack *p, packing_vec3 axis, int dim)
{
  packing_orientations_def def;
  packing_fabric_report r;
  packing_orientations_def_init(&def);
  def.axis = axis;
  def.dim = dim;
  packing_fabric_report_init(&r);
  assert_ok(packing_measure_orientations(NULL, &def, &p->view, &r));
  return r;
}

static void orientations_turn_the_axis(void **state)
{
  (void)state;
  const packing_vec3 none = {0, 0, 0}, y = {0, 5, 0};
  const double a = 0.7;
  pack *p = new_pack();
  add_quaternion(p, cos(a / 2), sin(a / 2), 0, 0); /* about x: z to (0, -sin, cos) */
  packing_fabric_report r = orient(p, none, 3);
  assert_int_equal(r.count, 1);
  assert_near(r.eigenvectors[0][1], -sin(a), 1e-14);
  assert_near(r.eigenvectors[0][2], cos(a), 1e-14);
  r = orient(p, y, 3); /* y to (0, cos, sin) */
  assert_near(r.eigenvectors[0][1], cos(a), 1e-14);
  assert_near(r.eigenvectors[0][2], sin(a), 1e-14);
  p->view.count = 0;
  add_quaternion(p, 1, 1, 1, 1); /* x to y to z to x, whatever the length */
  add_quaternion(p, 1e200, 1e200, 1e200, 1e200);
  add_quaternion(p, -1e-310, -1e-310, -1e-310, -1e-310);
  r = orient(p, none, 3);
  assert_int_equal(r.count, 3);
  assert_near(r.tensor[0][0], 1, 1e-14);
  r = orient(p, y, 3);
  assert_near(r.tensor[2][2], 1, 1e-14);
  free(p);
}

static void orientations_in_the_plane_turn_about_z(void **state)
{
  (void)state;
  const packing_vec3 none = {0, 0, 0};
  pack *p = new_pack();
  add_quaternion(p, cos(PI / 6), 0, 0, sin(PI / 6));
  add_quaternion(p, -sin(PI / 6), 0, 0, cos(PI / 6)); /* by 180 degrees more */
  packing_fabric_report r = orient(p, none, 2);
  assert_int_equal(r.count, 2);
  assert_near(r.eigenvalues[0], 1, 1e-14);
  assert_near(r.eigenvectors[0][0], 0.5, 1e-14);
  assert_near(r.eigenvectors[0][1], sqrt(3) / 2, 1e-14);
  assert_near(r.noise_floor, 0.25, 1e-15);
  p->view.count = 0;
  r = orient(p, none, 2);
  assert_true(r.count == 0 && isnan(r.eigenvalues[0]));
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_direction_has_one_eigenvalue),
      cmocka_unit_test(eigenvalues_are_the_shares_of_the_axes),
      cmocka_unit_test(walls_stand_apart),
      cmocka_unit_test(the_plane_has_two_eigenvalues),
      cmocka_unit_test(random_directions_stay_at_the_noise_floor),
      cmocka_unit_test(orientations_turn_the_axis),
      cmocka_unit_test(orientations_in_the_plane_turn_about_z),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
