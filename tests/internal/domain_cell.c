/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What balls, containers and cells have in common, against sums over parts, other ways round
 * and points. */
#include "domain/domain_internal.h"
#include "domain/domain_kinds.h"
#include "domain_scenes.h"

static const double endless = HUGE_VAL;

static packing_i_cell round_cell(packing_i_cell_kind kind, int axis, packing_vec3 centre,
                                 double radius)
{
  packing_i_cell cell = {kind,
                         {{-endless, -endless, -endless}, {endless, endless, endless}},
                         axis,
                         centre,
                         radius};
  return cell;
}

static double common(const packing_domain *domain, const packing_i_cell *cell,
                     packing_vec3 centre, double r)
{
  double volume = -1, error = -1;
  assert_int_equal(
      packing_i_domain_cell_volume(domain, cell, &centre, r, 1e-12, &volume, &error), 0);
  assert_true(volume >= 0 && error >= 0);
  assert_true(error <= 1e-9 * (r > 0 ? TEST_PI * pow(r, packing_domain_dim(domain)) * 2
                                     : packing_domain_volume(domain)));
  return volume;
}

static double whole(int dim, double r)
{
  return dim == 2 ? TEST_PI * r * r : 4.0 / 3.0 * TEST_PI * r * r * r;
}

/* The eight octants round a point. */
static double over_octants(const packing_domain *domain, packing_i_cell cell,
                           packing_vec3 at, packing_vec3 centre, double r)
{
  double sum = 0;
  for (int k = 0; k < (packing_domain_dim(domain) == 2 ? 4 : 8); k++) {
    cell.box.lo = (packing_vec3){k & 1 ? at.x : -endless, k & 2 ? at.y : -endless,
                                 k & 4 ? at.z : -endless};
    cell.box.hi = (packing_vec3){k & 1 ? endless : at.x, k & 2 ? endless : at.y,
                                 k & 4 ? endless : at.z};
    if (packing_domain_dim(domain) == 2) {
      cell.box.lo.z = -endless;
      cell.box.hi.z = endless;
    }
    sum += common(domain, &cell, centre, r);
  }
  return sum;
}

static scene turned(enum scene_kind kind, int turn)
{
  scene s = scene_of(kind);
  if (kind >= SCENE_CYLINDER && kind <= SCENE_SILO)
    s.axis = turn % 3;
  if (kind == SCENE_BOX)
    s.periodic = turn % 3 == 0 ? 0 : turn % 3 == 1 ? 5 : 7;
  return s;
}

static void octants_share_out_what_the_container_holds(void **state)
{
  (void)state;
  for (int kind = 0; kind < SCENE_END; kind++)
    for (int turn = 0; turn < 30; turn++) {
      const scene s = turned((enum scene_kind)kind, turn);
      packing_domain *domain = scene_make(&s);
      uint64_t random = (uint64_t)(100 * kind + turn);
      const packing_vec3 p = scene_random_point(&random, domain, 0.2);
      const double r = pow(10, -1.5 + 1.8 * scene_random(&random));
      packing_vec3 at = p;
      at.x += 1.2 * r * (2 * scene_random(&random) - 1);
      at.y += 1.2 * r * (2 * scene_random(&random) - 1);
      at.z += 1.2 * r * (2 * scene_random(&random) - 1);
      double v;
      assert_ok(packing_domain_sphere_volume(domain, &p, r, 1e-12, &v, NULL));
      packing_i_cell all = round_cell(PACKING_I_CELL_BOX, 0, p, 0);
      assert_near(common(domain, &all, p, r), v, 1e-12 * whole(scene_dim(&s), r));
      assert_near(over_octants(domain, all, at, p, r), v,
                  2e-11 * whole(scene_dim(&s), r));
      packing_domain_destroy(domain);
    }
}

static void octants_share_out_round_cells(void **state)
{
  (void)state;
  for (int kind = 0; kind < SCENE_END; kind++)
    for (int turn = 0; turn < 36; turn++) {
      const scene s = turned((enum scene_kind)kind, turn);
      packing_domain *domain = scene_make(&s);
      uint64_t random = (uint64_t)(1000 + 100 * kind + turn);
      const packing_vec3 p = scene_random_point(&random, domain, 0.1);
      const packing_vec3 q = scene_random_point(&random, domain, 0.1);
      const double r = pow(10, -1 + scene_random(&random));
      const packing_i_cell cell =
          round_cell(turn % 4 == 3 ? PACKING_I_CELL_BALL : PACKING_I_CELL_CYLINDER,
                     turn / 3 % 3, q, 0.2 + scene_random(&random));
      packing_vec3 at = p;
      at.x += 0.5 * r * (2 * scene_random(&random) - 1);
      at.y += 0.5 * r * (2 * scene_random(&random) - 1);
      const double v = common(domain, &cell, p, r);
      assert_near(over_octants(domain, cell, at, p, r), v,
                  2e-10 * whole(scene_dim(&s), r));
      packing_domain_destroy(domain);
    }
}

static int in_cell(const packing_i_cell *c, int dim, packing_vec3 p)
{
  double d2 = 0;
  for (int k = 0; k < dim; k++) {
    const double x = packing_i_component(p, k);
    if (x < packing_i_component(c->box.lo, k) || x > packing_i_component(c->box.hi, k))
      return 0;
    if (c->kind == PACKING_I_CELL_BALL || dim == 2 || k != c->axis)
      d2 += pow(x - packing_i_component(c->centre, k), 2);
  }
  return c->kind == PACKING_I_CELL_BOX || d2 <= c->radius * c->radius;
}

/* The share of n points of a ball, evenly spread (the additive recurrence of the plastic
 * number's kin), that lie in the container and the cell. */
static double by_points(const scene *s, const packing_i_cell *cell, packing_vec3 centre,
                        double r, int n)
{
  const int dim = scene_dim(s);
  int in = 0, tried = 0;
  for (int i = 0; tried < n; i++) {
    const double x = fmod(0.5 + i * 0.8191725133961645, 1) * 2 - 1;
    const double y = fmod(0.5 + i * 0.6710436067037893, 1) * 2 - 1;
    const double z = dim == 2 ? 0 : fmod(0.5 + i * 0.5497004779019703, 1) * 2 - 1;
    if (x * x + y * y + z * z > 1)
      continue;
    const packing_vec3 p = {centre.x + r * x, centre.y + r * y, centre.z + r * z};
    tried++;
    in += scene_inside(s, p) && in_cell(cell, dim, p);
  }
  return (double)in / tried * whole(dim, r);
}

static void parts_agree_with_points(void **state)
{
  (void)state;
  for (int kind = 0; kind < SCENE_END; kind++)
    for (int turn = 0; turn < 24; turn++) {
      const scene s = turned((enum scene_kind)kind, turn);
      packing_domain *domain = scene_make(&s);
      uint64_t random = (uint64_t)(5000 + 100 * kind + turn);
      const packing_vec3 p = scene_random_point(&random, domain, 0);
      const double r = pow(10, -0.7 + 0.7 * scene_random(&random));
      packing_vec3 q = p;
      q.x += r * (2 * scene_random(&random) - 1);
      q.y += r * (2 * scene_random(&random) - 1);
      q.z += r * (2 * scene_random(&random) - 1);
      packing_i_cell cell = round_cell((packing_i_cell_kind)(turn % 3), turn / 3 % 3, q,
                                       r * (0.4 + 0.8 * scene_random(&random)));
      if (turn % 2)
        cell.box.lo.x = p.x - 0.3 * r, cell.box.hi.y = p.y + 0.4 * r;
      assert_near(common(domain, &cell, p, r), by_points(&s, &cell, p, r, 8000),
                  8e-3 * whole(scene_dim(&s), r));
      packing_domain_destroy(domain);
    }
}

/* The container alone: octants, and a huge ball in its place. */
static void containers_are_cut_like_balls(void **state)
{
  (void)state;
  for (int kind = 0; kind < SCENE_END; kind++)
    for (int turn = 0; turn < 12; turn++) {
      const scene s = turned((enum scene_kind)kind, 3 * (turn / 3) + (kind ? turn : 0));
      packing_domain *domain = scene_make(&s);
      uint64_t random = (uint64_t)(9000 + 100 * kind + turn);
      const packing_vec3 q = scene_random_point(&random, domain, 0);
      const double v = packing_domain_volume(domain);
      packing_i_cell cell = round_cell(PACKING_I_CELL_BOX, 0, q, 0);
      packing_bounds b;
      packing_domain_bounds(domain, &b);
      assert_near(over_octants(domain, cell, q, q, 0), v, 1e-11 * v);
      cell = round_cell(turn % 2 ? PACKING_I_CELL_BALL : PACKING_I_CELL_CYLINDER,
                        turn / 2 % 3, q, 0.3 + 0.8 * scene_random(&random));
      assert_near(common(domain, &cell, q, 0), common(domain, &cell, q, 40),
                  1e-7 * whole(scene_dim(&s), 40));
      assert_near(over_octants(domain, cell, q, q, 0), common(domain, &cell, q, 0),
                  1e-11 * v);
      packing_domain_destroy(domain);
    }
}

/* Where books have formulas. */
static void formulas_are_met(void **state)
{
  (void)state;
  packing_domain *box = test_box(40, 40, 40, 0);
  const packing_vec3 c = {20, 20, 20};
  const double r = 1.37;
  for (int axis = 0; axis < 3; axis++) {
    /* A ball less its napkin ring; Viviani's curve. */
    packing_i_cell cell = round_cell(PACKING_I_CELL_CYLINDER, axis, c, 0.9);
    assert_close(common(box, &cell, c, r),
                 4.0 / 3.0 * TEST_PI * (r * r * r - pow(r * r - 0.81, 1.5)), 1e-13);
    packing_vec3 aside = c;
    packing_i_set_component(&aside, (axis + 1) % 3, 20 + 0.5 * r);
    cell.radius = 0.5 * r;
    assert_close(common(box, &cell, aside, r),
                 2.0 / 3.0 * (TEST_PI - 4.0 / 3.0) * r * r * r, 1e-13);
  }
  /* Balls of radii 1 and 1 at distance 1: 5 pi / 12. */
  packing_i_cell ball = round_cell(PACKING_I_CELL_BALL, 0, c, 1);
  assert_close(common(box, &ball, (packing_vec3){20, 21, 20}, 1), 5 * TEST_PI / 12,
               1e-14);
  /* Two crossed cylinders of radius 1: Steinmetz, 16 / 3. */
  packing_domain_cylinder_def def;
  packing_domain *cylinder = NULL;
  packing_domain_cylinder_def_init(&def);
  def.radius = 1;
  def.height = 40;
  def.axis = PACKING_AXIS_X;
  def.base = (packing_vec3){0, 20, 20};
  assert_ok(packing_domain_create_cylinder(NULL, &def, &cylinder));
  packing_i_cell crossed = round_cell(PACKING_I_CELL_CYLINDER, 1, c, 1);
  assert_close(common(cylinder, &crossed, c, 0), 16.0 / 3.0, 1e-12);
  assert_close(common(cylinder, &crossed, c, 9), 16.0 / 3.0, 1e-8);
  packing_domain_destroy(cylinder);
  packing_domain_destroy(box);
}

/* Elliptic integrals against the quadrature that cuts balls at cylindrical containers: all sizes,
 * axes through the centre, through the surface, walls that touch it from within. Quadrature may
 * stop short where the wall passes close by the centre; two such cases in 40 digits. */
static void elliptic_integrals_agree_with_quadrature(void **state)
{
  (void)state;
  uint64_t random = 17;
  double error;
  assert_close(
      packing_i_ball_cylinder(0.053488876655027197, 0.7, 0.70099600058190326, &error),
      0.00030697957573369853229, 1e-14);
  assert_close(
      packing_i_ball_cylinder(0.05369480147480242, 0.7, 0.69820873784624948, &error),
      0.00033578774006647686575, 1e-14);
  for (int i = 0; i < 400; i++) {
    const double r = pow(10, -2.5 + 3 * scene_random(&random));
    const double radius = 0.7;
    double d = fabs(radius + r * (2 * scene_random(&random) - 1));
    if (i % 8 < 4)
      d = i % 8 == 0 ? 0 : i % 8 == 1 ? radius : i % 8 == 2 ? fabs(r - radius) : d;
    /* The base halves the ball, which leaves it to the slices. */
    const scene s = {SCENE_CYLINDER, radius, 200, 0, 0, {0, 0, 0}, 2, 0, 0};
    packing_domain *domain = scene_make(&s);
    const packing_vec3 p = {d, 0, 0};
    double v, slices;
    assert_ok(packing_domain_sphere_volume(domain, &p, r, 1e-13, &v, &slices));
    assert_near(packing_i_ball_cylinder(r, radius, d, &error), 2 * v, 2 * slices + error);
    assert_true(error <= 1e-11 * whole(3, r) && slices <= 1e-9 * whole(3, r));
    packing_domain_destroy(domain);
  }
}

/* Walls that pass the centre at some thousandths of the radius, the base far below: values of
 * integrals in 25 digits. Heights that count from the base are 3e-10 of the ball off. */
static void walls_near_the_centre_cut_balls_exactly(void **state)
{
  (void)state;
  static const double known[][3] = {{0.865191, 0.857321, 1.6478938918194714},
                                    {1.45763, 1.46311, 1.8058295951048943},
                                    {5.37204, 5.37591, 2.0091254828731073}};
  for (int k = 0; k < 3; k++) {
    const double radius = known[k][0], ball = whole(3, 1);
    const packing_vec3 p = {known[k][1], 0, 0};
    const scene cylinder = {SCENE_CYLINDER, radius, 1000, 0, 0, {0, 0, -500}, 2, 0, 0};
    const scene half = {SCENE_CYLINDER, radius, 200, 0, 0, {0, 0, 0}, 2, 0, 0};
    const scene *const scenes[] = {&cylinder, &half};
    for (int i = 0; i < 2; i++) {
      packing_domain *domain = scene_make(scenes[i]);
      double v, error;
      assert_ok(packing_domain_sphere_volume(domain, &p, 1, 1e-13, &v, &error));
      assert_near((i + 1) * v, known[k][2], (i + 1) * error);
      assert_near((i + 1) * v, known[k][2], (i == 0 ? 1e-13 : 1e-11) * ball);
      packing_domain_destroy(domain);
    }
  }
}

/* Three discs of radius 1 round the corners of a triangle with sides 1: Reuleaux. */
static void discs_have_what_reuleaux_says(void **state)
{
  (void)state;
  const double far[2] = {-endless, -endless}, near[2] = {endless, endless};
  packing_i_disc d[3] = {{5, 3, 1}, {6, 3, 1}, {5.5, 3 + sqrt(0.75), 1}};
  const double reuleaux = 0.5 * (TEST_PI - sqrt(3));
  assert_close(packing_i_discs_area(3, d, far, near), reuleaux, 1e-14);
  d[1] = d[0];
  d[2] = d[0];
  assert_close(packing_i_discs_area(3, d, far, near), TEST_PI, 1e-15);
  d[2].r = 0;
  assert_true(packing_i_discs_area(3, d, far, near) == 0);
  /* A straight wall as a circle of radius 1e6 beside a disc of radius 1, and an edge across. */
  packing_i_disc e[2] = {{0, 0, 1}, {0, -1e6 + 0.25, 1e6}};
  const double left[2] = {0, -endless};
  double error;
  const double lo[3] = {0, -endless, 0}, hi[3] = {endless, 0.25, 0};
  assert_close(packing_i_discs_area(2, e, left, near),
               packing_i_cut_planes(2, 1, lo, hi, &error), 1e-6);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(octants_share_out_what_the_container_holds),
      cmocka_unit_test(octants_share_out_round_cells),
      cmocka_unit_test(parts_agree_with_points),
      cmocka_unit_test(containers_are_cut_like_balls),
      cmocka_unit_test(formulas_are_met),
      cmocka_unit_test(elliptic_integrals_agree_with_quadrature),
      cmocka_unit_test(walls_near_the_centre_cut_balls_exactly),
      cmocka_unit_test(discs_have_what_reuleaux_says),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
