/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pores and constrictions with known answers. */
#include "test.h"

enum { MOST = 4096 };

/* Constants of verified geometry, in radii of the spheres. */
#define TETRAHEDRAL .224744871391589
#define OCTAHEDRAL .414213562373095
#define CUBIC .732050807568877
#define TRIANGLE .154700538379252

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
  packing_domain *domain;
  packing_pores *pores;
  packing_pores_report report;
  packing_pore *pore;
  packing_constriction *way;
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
  assert_true(i < MOST);
  p->x[i] = x;
  p->y[i] = y;
  p->z[i] = z;
  p->r[i] = r;
}

static void forget(pack *p)
{
  packing_pores_destroy(p->pores);
  free(p->pore);
  free(p->way);
  p->pores = NULL;
  p->pore = NULL;
  p->way = NULL;
}

static void free_pack(pack *p)
{
  forget(p);
  packing_domain_destroy(p->domain);
  free(p);
}

/* Invariants of any network. */
static void check(const pack *p)
{
  const packing_pores_report *r = &p->report;
  size_t ends = 0, cells = 0;
  for (size_t i = 0; i < r->pores; i++) {
    const packing_pore *q = &p->pore[i];
    assert_true(q->radius > 0 && q->cells > 0);
    for (int k = 0; k < r->dim; k++)
      assert_true(q->particles[k] <= q->particles[k + 1] &&
                  q->particles[k + 1] < p->view.count);
    ends += q->coordination;
    cells += q->cells;
  }
  assert_int_equal(ends, 2 * r->constrictions);
  assert_in_range(cells + r->outside + r->closed, r->cells - r->flat_cells, r->cells);
  for (size_t i = 0; i < r->constrictions; i++) {
    const packing_constriction *c = &p->way[i];
    const double narrow = fmin(p->pore[c->a].radius, p->pore[c->b].radius);
    assert_true(c->a <= c->b && c->b < r->pores);
    assert_true(c->radius > 0 && c->radius <= narrow * (1 + 1e-5));
    assert_true(c->a != c->b || c->image[0] != 0 || c->image[1] != 0 || c->image[2] != 0);
  }
}

static void measure_with(pack *p, const packing_pores_def *def, packing_context *context)
{
  size_t count;
  forget(p);
  assert_ok(packing_pores_create(context, def, p->domain, &p->view, &p->pores));
  packing_pores_report_init(&p->report);
  assert_ok(packing_pores_summary(p->pores, &p->report));
  const packing_pores_report *r = &p->report;
  p->pore = calloc(r->pores + 1, sizeof *p->pore);
  p->way = calloc(r->constrictions + 1, sizeof *p->way);
  assert_ok(packing_pores_list(p->pores, 0, r->pores, p->pore, &count));
  assert_int_equal(count, r->pores);
  assert_ok(packing_pores_constrictions(p->pores, 0, r->constrictions, p->way, &count));
  assert_int_equal(count, r->constrictions);
  check(p);
}

static void measure(pack *p)
{
  measure_with(p, NULL, NULL);
}

/* All pores of one radius, and all constrictions. */
static void assert_all(const pack *p, size_t pores, double radius, size_t coordination,
                       size_t ways, double narrow)
{
  assert_int_equal(p->report.pores, pores);
  for (size_t i = 0; i < pores; i++) {
    assert_close(p->pore[i].radius, radius, 2e-13);
    assert_int_equal(p->pore[i].coordination, coordination);
    assert_int_equal(p->pore[i].limit, PACKING_PORE_FREE);
  }
  assert_int_equal(p->report.constrictions, ways);
  for (size_t i = 0; i < ways; i++) {
    assert_close(p->way[i].radius, narrow, 2e-13);
    assert_int_equal(p->way[i].limit, PACKING_PORE_FREE);
  }
}

static void add_lattice(pack *p, const int side[3], const double edge[3],
                        const double basis[][3], int n, double r)
{
  for (int i = 0; i < side[0] * side[1] * side[2]; i++)
    for (int b = 0; b < n; b++)
      add(p, edge[0] * (i % side[0] + basis[b][0]),
          edge[1] * (i / side[0] % side[1] + basis[b][1]),
          edge[2] * (i / side[0] / side[1] + basis[b][2]), r);
}

static const double cubic[1][3] = {{.25, .25, .25}};
static const double body[2][3] = {{0, 0, 0}, {.5, .5, .5}};
static const double face[4][3] = {{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}};
static const double close[4][3] = {
    {0, 0, 0}, {.5, .5, 0}, {.5, 1.0 / 6, .5}, {0, 2.0 / 3, .5}};

static pack *crystal(const int side[3], const double edge[3], const double basis[][3],
                     int n, double r)
{
  pack *p = new_pack();
  add_lattice(p, side, edge, basis, n, r);
  p->domain = test_box(side[0] * edge[0], side[1] * edge[1], side[2] * edge[2], 7);
  measure(p);
  return p;
}

/* Cells of one to 125 lattice cells, of edges that doubles hold exactly and that they do not. */
static void simple_cubic_has_one_pore_a_sphere(void **state)
{
  (void)state;
  static const int sides[4][3] = {{1, 1, 1}, {2, 1, 3}, {4, 4, 4}, {5, 3, 4}};
  for (int s = 0; s < 4; s++)
    for (int odd = 0; odd < 2; odd++) {
      const double r = odd ? 0.3517 : 0.5, edge[3] = {2 * r, 2 * r, 2 * r};
      const size_t n = (size_t)sides[s][0] * (size_t)sides[s][1] * (size_t)sides[s][2];
      pack *p = crystal(sides[s], edge, cubic, 1, r);
      assert_all(p, n, CUBIC * r, 6, 3 * n, OCTAHEDRAL * r);
      assert_int_equal(p->report.flat_cells, 0);
      free_pack(p);
    }
}

static void body_centred_has_twelve_tetrahedra_a_cell(void **state)
{
  (void)state;
  static const int sides[3][3] = {{1, 1, 1}, {2, 3, 1}, {3, 4, 3}};
  for (int s = 0; s < 3; s++)
    for (int odd = 0; odd < 2; odd++) {
      const double a = odd ? 1.1547 : 1, r = a * sqrt(3) / 4, edge[3] = {a, a, a};
      const size_t n = (size_t)sides[s][0] * (size_t)sides[s][1] * (size_t)sides[s][2];
      pack *p = crystal(sides[s], edge, body, 2, r);
      assert_all(p, 12 * n, a * (sqrt(5) / 4 - sqrt(3) / 4), 4, 24 * n,
                 a * (0.375 * sqrt(2) - sqrt(3) / 4));
      free_pack(p);
    }
}

/* Octahedral holes are one pore, not four slivers; a third of the pores. */
static void assert_close_packing(const pack *p, size_t spheres, double r)
{
  size_t octahedral = 0;
  assert_int_equal(p->report.pores, 3 * spheres);
  for (size_t i = 0; i < p->report.pores; i++) {
    const int large = p->pore[i].radius > 0.3 * r;
    octahedral += (size_t)large;
    assert_close(p->pore[i].radius, r * (large ? OCTAHEDRAL : TETRAHEDRAL), 2e-13);
    assert_int_equal(p->pore[i].coordination, large ? 8 : 4);
    assert_in_range(p->pore[i].cells, large ? 4 : 1, large ? 5 : 1);
  }
  assert_int_equal(octahedral, spheres);
  assert_int_equal(p->report.constrictions, 8 * spheres);
  for (size_t i = 0; i < p->report.constrictions; i++) {
    assert_close(p->way[i].radius, r * TRIANGLE, 3e-13);
    assert_int_equal(p->way[i].limit, PACKING_PORE_FREE);
  }
}

static void close_packings_have_octahedra_and_tetrahedra(void **state)
{
  (void)state;
  static const int sides[3][3] = {{1, 1, 1}, {2, 1, 2}, {4, 3, 4}};
  for (int s = 0; s < 3; s++)
    for (int odd = 0; odd < 2; odd++) {
      const size_t n =
          4 * (size_t)sides[s][0] * (size_t)sides[s][1] * (size_t)sides[s][2];
      const double a = odd ? 0.7317 : 1, r = a * sqrt(2) / 4, cube[3] = {a, a, a};
      const double hexagonal[3] = {a, a * sqrt(3), a * sqrt(8.0 / 3)};
      pack *p = crystal(sides[s], cube, face, 4, r);
      assert_close_packing(p, n, r);
      free_pack(p);
      p = crystal(sides[s], hexagonal, close, 4, a / 2);
      assert_close_packing(p, n, a / 2);
      free_pack(p);
    }
}

/* Where images lead: from a pore by the constriction to the other end, along the lattice. */
static void images_lead_to_the_other_end(void **state)
{
  (void)state;
  for (int side = 1; side <= 3; side++) {
    const int sides[3] = {side, side, side};
    const double edge[3] = {1, 1, 1};
    pack *p = crystal(sides, edge, cubic, 1, 0.5);
    for (size_t i = 0; i < p->report.constrictions; i++) {
      const packing_constriction *c = &p->way[i];
      const packing_vec3 a = p->pore[c->a].centre, b = p->pore[c->b].centre;
      const double d[3] = {b.x + side * c->image[0] - a.x, b.y + side * c->image[1] - a.y,
                           b.z + side * c->image[2] - a.z};
      assert_near(sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), 1, 1e-14);
      const packing_vec3 half = packing_domain_separation(p->domain, &a, &c->centre);
      assert_near(fabs(half.x * d[0] + half.y * d[1] + half.z * d[2]), 0.5, 1e-14);
    }
    free_pack(p);
  }
}

/* Soddy's inner spheres: four that touch each other, of any radii; also far from the origin. */
static void touching_spheres_have_soddys_pore(void **state)
{
  (void)state;
  static const double radii[4][5] = {{1, 1, 1, 1, TETRAHEDRAL},
                                     {1, 2, 3, 4, .476220238080706},
                                     {1, 1, 1, 2, .261324772583615},
                                     {2, 2, 3, 3, 6.0 / 11}};
  for (int s = 0; s < 4; s++) {
    const double *r = radii[s];
    /* sphere 1 at 0, 2 along x, 3 in the plane, 4 above: F13's local frame */
    const double x2 = r[0] + r[1], d3 = r[0] + r[2], d4 = r[0] + r[3];
    const double x3 = (d3 * d3 - (r[1] + r[2]) * (r[1] + r[2]) + x2 * x2) / (2 * x2);
    const double y3 = sqrt(d3 * d3 - x3 * x3);
    const double x4 = (d4 * d4 - (r[1] + r[3]) * (r[1] + r[3]) + x2 * x2) / (2 * x2);
    const double y4 =
        (d4 * d4 - (r[2] + r[3]) * (r[2] + r[3]) + x3 * x3 + y3 * y3 - 2 * x3 * x4) /
        (2 * y3);
    pack *p = new_pack();
    add(p, 0, 0, 0, r[0]);
    add(p, x2, 0, 0, r[1]);
    add(p, x3, y3, 0, r[2]);
    add(p, x4, y4, sqrt(d4 * d4 - x4 * x4 - y4 * y4), r[3]);
    measure(p);
    assert_int_equal(p->report.pores, 1);
    assert_int_equal(p->report.cells, 1);
    assert_int_equal(p->report.constrictions, 0);
    assert_close(p->pore[0].radius, r[4], 1e-14);
    const packing_vec3 c = p->pore[0].centre;
    for (int i = 0; i < 4; i++)
      assert_close(
          sqrt(pow(c.x - p->x[i], 2) + pow(c.y - p->y[i], 2) + pow(c.z - p->z[i], 2)),
          p->r[i] + r[4], 1e-14);
    free_pack(p);
  }
}

/* Three spheres that touch each other in a plane, one above and one below: two pores and Descartes'
 * circle (1, 2, 3) between them. */
static void touching_spheres_have_descartes_constriction(void **state)
{
  (void)state;
  const double z = 2.43669858620224; /* of a sphere 1.5 that touches all three */
  pack *p = new_pack();
  add(p, 0, 0, 0, 1);
  add(p, 3, 0, 0, 2);
  add(p, 0, 4, 0, 3);
  add(p, 0.5, 0.25, z, 1.5);
  add(p, 0.5, 0.25, -z, 1.5);
  measure(p);
  assert_int_equal(p->report.pores, 2);
  assert_int_equal(p->report.constrictions, 1);
  assert_int_equal(p->way[0].limit, PACKING_PORE_FREE);
  assert_close(p->way[0].radius, 6.0 / 23, 1e-13);
  assert_near(p->way[0].centre.z, 0, 1e-13);
  assert_true(p->way[0].particles[0] == 0 && p->way[0].particles[2] == 2);
  assert_close(p->pore[0].radius, p->pore[1].radius, 1e-13);
  free_pack(p);
}

/* A tetrahedron whose spheres nearly close the hole, and nearly equal ones: what is left is right to
 * the rounding of the centres. */
static void narrow_holes_keep_their_digits(void **state)
{
  (void)state;
  const double around = sqrt(3); /* of corners (+-1, +-1, +-1) */
  for (int n = 1; n <= 12; n++) {
    const double left = pow(10, -n), tiny = n % 2 == 0 ? 1e-14 : 0;
    pack *p = new_pack();
    add(p, 1, 1, 1, around - left);
    add(p, 1, -1, -1, around - left - tiny);
    add(p, -1, 1, -1, around - left + tiny);
    add(p, -1, -1, 1, around - left);
    measure(p);
    assert_int_equal(p->report.pores, 1);
    assert_near(p->pore[0].radius, left, 1e-15 + 2 * tiny);
    free_pack(p);
  }
}

/* Descartes' circles in the plane. */
static void touching_discs_have_soddys_pore(void **state)
{
  (void)state;
  static const double radii[4][4] = {{1, 1, 1, TRIANGLE},
                                     {1, 2, 3, 6.0 / 23},
                                     {1, 1, 2, .187672642712109},
                                     {2, 3, 6, .474937185533100}};
  packing_pores_def def;
  packing_pores_def_init(&def);
  def.dim = 2;
  for (int s = 0; s < 4; s++) {
    const double *r = radii[s], x2 = r[0] + r[1], d3 = r[0] + r[2];
    const double x3 = (d3 * d3 - (r[1] + r[2]) * (r[1] + r[2]) + x2 * x2) / (2 * x2);
    pack *p = new_pack();
    add(p, 0, 0, 5, r[0]);
    add(p, x2, 0, (double)NAN, r[1]);
    add(p, x3, sqrt(d3 * d3 - x3 * x3), 7, r[2]);
    measure_with(p, &def, NULL);
    assert_int_equal(p->report.pores, 1);
    assert_close(p->pore[0].radius, r[3], 1e-13);
    assert_true(p->pore[0].particles[3] == PACKING_NO_INDEX && p->pore[0].centre.z == 0);
    free_pack(p);
  }
}

/* Square lattice: pores sqrt 2 - 1, gaps g / 2; hexagonal: pores in triangles, gaps too. */
static void discs_on_lattices(void **state)
{
  (void)state;
  for (int side = 1; side <= 4; side++) {
    const size_t n = (size_t)(side * side);
    pack *p = new_pack();
    for (int i = 0; i < side * side; i++)
      add(p, 0.25 + i % side, 0.25 + i / side, 0, 0.4);
    p->domain = test_rectangle(side, side, 3);
    measure(p);
    assert_all(p, n, sqrt(0.5) - 0.4, 4, 2 * n, 0.1);
    assert_true(p->way[0].particles[2] == PACKING_NO_INDEX);
    free_pack(p);
    p = new_pack();
    for (int i = 0; i < side * side; i++)
      for (int b = 0; b < 2; b++)
        add(p, i % side + 0.5 * b, sqrt(3) * (i / side + 0.5 * b), 0, 0.4);
    p->domain = test_rectangle(side, sqrt(3) * side, 3);
    measure(p);
    assert_all(p, 4 * n, 1 / sqrt(3) - 0.4, 3, 6 * n, 0.1);
    free_pack(p);
  }
}

/* In a box with walls: a cubic lattice whose outer spheres touch the walls has pores between
 * spheres only; beside the walls there is no cell. */
static void walls_end_the_network(void **state)
{
  (void)state;
  const int sides[3] = {4, 4, 4};
  const double edge[3] = {1, 1, 1}, centred[1][3] = {{.5, .5, .5}};
  pack *p = new_pack();
  add_lattice(p, sides, edge, centred, 1, 0.5);
  p->domain = test_box(4, 4, 4, 0);
  measure(p);
  assert_int_equal(p->report.pores, 27);
  assert_int_equal(p->report.constrictions, 3 * 9 * 2);
  assert_close(p->report.min_r, 0.5 * CUBIC, 1e-14);
  assert_close(p->report.max_r, 0.5 * CUBIC, 1e-14);
  assert_close(p->report.mean_constriction_r, 0.5 * OCTAHEDRAL, 1e-14);
  assert_true(p->report.mean_coordination == 4);
  packing_domain_destroy(p->domain);
  p->domain = NULL; /* the box around the particles */
  measure(p);
  assert_int_equal(p->report.pores, 27);
  free_pack(p);
}

/* A wall through a layer of pores, off their centres: those on one side are cut, those on the
 * other are out. */
static void walls_cut_pores(void **state)
{
  (void)state;
  pack *p = new_pack();
  for (int i = 0; i < 27; i++)
    add(p, i % 3, i / 3 % 3, i / 9, 0.5);
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size.x = def.size.y = 4;
  def.size.z = 1.7;
  def.corner.x = def.corner.y = def.corner.z = -0.125;
  assert_ok(packing_domain_create_box(NULL, &def, &p->domain));
  measure(p); /* centres at 0.5 and 1.5; the wall at 1.575 */
  assert_int_equal(p->report.pores, 8);
  assert_int_equal(p->report.cut, 4);
  for (size_t i = 0; i < 8; i++) {
    const int low = p->pore[i].centre.z < 1;
    assert_close(p->pore[i].radius, low ? 0.5 * CUBIC : 0.075, 1e-12);
    assert_int_equal(p->pore[i].limit, low ? PACKING_PORE_FREE : PACKING_PORE_BY_WALL);
  }
  assert_int_equal(p->report.constrictions, 12);
  def.size.z = 1.525; /* the wall at 1.4 */
  packing_domain_destroy(p->domain);
  assert_ok(packing_domain_create_box(NULL, &def, &p->domain));
  measure(p);
  assert_int_equal(p->report.pores, 4);
  assert_true(p->report.outside >= 20);
  free_pack(p);
}

/* A small sphere in the middle of a hole that the power diagram gives to others does not go
 * unseen: its own cells are there, and their spheres are empty. */
static void every_sphere_is_empty(void **state)
{
  (void)state;
  uint64_t seed = 0;
  packing_rng *rng = NULL;
  for (int dim = 2; dim <= 3; dim++)
    for (int periodic = 0; periodic <= 1; periodic++) {
      pack *p = new_pack();
      assert_ok(packing_rng_create(NULL, 11, 0, seed++, &rng));
      p->domain = dim == 3 ? test_box(6, 6, 6, periodic ? 7 : 0)
                           : test_rectangle(6, 6, periodic ? 3 : 0);
      for (int i = 0; i < 300; i++) {
        double u[4];
        for (int k = 0; k < 4; k++)
          u[k] = packing_rng_uniform(rng);
        add(p, 6 * u[0], 6 * u[1], dim == 3 ? 6 * u[2] : 0,
            (dim == 3 ? 0.5 : 0.2) * u[3] * u[3]);
      }
      measure(p);
      assert_true(p->report.pores > 300);
      for (size_t i = 0; i < p->report.pores + p->report.constrictions; i++) {
        const int is_pore = i < p->report.pores;
        const packing_vec3 c =
            is_pore ? p->pore[i].centre : p->way[i - p->report.pores].centre;
        const double r = is_pore ? p->pore[i].radius : p->way[i - p->report.pores].radius;
        double nearest = INFINITY;
        for (size_t j = 0; j < p->view.count; j++) {
          const packing_vec3 q = {p->x[j], p->y[j], p->z[j]};
          const packing_vec3 d = packing_domain_separation(p->domain, &c, &q);
          nearest = fmin(nearest, sqrt(d.x * d.x + d.y * d.y + d.z * d.z) - p->r[j]);
        }
        const double wall = packing_domain_signed_distance(p->domain, &c, NULL);
        assert_true(fmin(nearest, wall) >= r * (1 - 2e-6));
        const packing_pore_limit limit =
            is_pore ? p->pore[i].limit : p->way[i - p->report.pores].limit;
        if (limit != PACKING_PORE_OPEN)
          assert_near(limit == PACKING_PORE_BY_WALL ? wall : nearest, r,
                      2e-6 * r + 1e-12);
      }
      packing_rng_destroy(rng);
      free_pack(p);
    }
}

static void nothing_has_no_pores(void **state)
{
  (void)state;
  for (int count = 0; count < 6; count++) {
    pack *p = new_pack();
    for (int i = 0; i < count; i++)
      add(p, i, 2 * i, count > 4 ? 1 : -i, 0.5);
    measure(p);
    assert_int_equal(p->report.pores, 0);
    assert_int_equal(p->report.cells, 0);
    assert_true(isnan(p->report.min_r) && isnan(p->report.mean_coordination));
    free_pack(p);
  }
  pack *p = new_pack();
  p->domain = test_box(1, 1, 1, 7);
  measure(p);
  assert_int_equal(p->report.pores, 0);
  free_pack(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(simple_cubic_has_one_pore_a_sphere),
      cmocka_unit_test(body_centred_has_twelve_tetrahedra_a_cell),
      cmocka_unit_test(close_packings_have_octahedra_and_tetrahedra),
      cmocka_unit_test(images_lead_to_the_other_end),
      cmocka_unit_test(touching_spheres_have_soddys_pore),
      cmocka_unit_test(touching_discs_have_soddys_pore),
      cmocka_unit_test(touching_spheres_have_descartes_constriction),
      cmocka_unit_test(narrow_holes_keep_their_digits),
      cmocka_unit_test(discs_on_lattices),
      cmocka_unit_test(walls_end_the_network),
      cmocka_unit_test(walls_cut_pores),
      cmocka_unit_test(every_sphere_is_empty),
      cmocka_unit_test(nothing_has_no_pores)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
