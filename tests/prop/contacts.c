/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact network of random packs that overlap, in cells of any width, against every image
 * of every pair and every wall; and what rotating and scaling a pack does to it. */
#include "test.h"

enum { COUNT = 120, RUNS = 80, MOST = 60000 };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  double edge[3];
  unsigned periodic;
  packing_view view;
  packing_domain *domain;
  int dim;
} pack;

typedef struct network {
  size_t count;
  size_t walls;
  packing_contact *list;
} network;

/* Run k: dimension, periodic directions, width of the cell and spread of sizes differ. */
static void draw(pack *p, unsigned k)
{
  packing_rng *rng = NULL;
  double *c[3] = {p->x, p->y, p->z};
  assert_ok(packing_rng_create(NULL, k, PACKING_PURPOSE_USER, 0, &rng));
  p->dim = k % 5 == 0 ? 2 : 3;
  p->periodic = k / 2 % 8 & (p->dim == 2 ? 3U : 7U);
  for (int a = 0; a < 3; a++)
    p->edge[a] = 0.7 + 9 * pow(packing_rng_uniform(rng), 2);
  for (size_t i = 0; i < COUNT; i++) {
    for (int a = 0; a < 3; a++)
      c[a][i] = a < p->dim ? p->edge[a] * packing_rng_uniform(rng) : 0;
    p->r[i] = 0.6 * pow(k % 3 == 0 ? 1 : 20, -packing_rng_uniform(rng));
  }
  p->domain = p->dim == 2 ? test_rectangle(p->edge[0], p->edge[1], p->periodic)
                          : test_box(p->edge[0], p->edge[1], p->edge[2], p->periodic);
  packing_rng_destroy(rng);
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

static packing_contacts *find(const pack *p, double tolerance, double gap)
{
  packing_contacts_def def;
  packing_contacts *contacts = NULL;
  packing_contacts_def_init(&def);
  def.tolerance = tolerance;
  def.gap = gap;
  assert_ok(packing_contacts_create(NULL, &def, p->domain, &p->view, &contacts));
  return contacts;
}

static network list_of(const packing_contacts *contacts)
{
  network n = {packing_contacts_count(contacts), packing_contacts_wall_count(contacts),
               malloc(MOST * sizeof *n.list)};
  size_t count = 0;
  assert_true(n.list != NULL && n.count + n.walls <= MOST);
  assert_ok(packing_contacts_list(contacts, 0, MOST, n.list, &count));
  assert_int_equal(count, n.count + n.walls);
  return n;
}

static void note(network *n, const packing_contact *c)
{
  assert_true(n->count + n->walls < MOST);
  n->list[n->count + n->walls] = *c;
}

/* All images of a pair, in the order of the list. */
static void try_pair(const pack *p, network *n, size_t i, size_t j, const int *most,
                     double tolerance, double gap)
{
  for (int a = -most[0]; a <= most[0]; a++)
    for (int b = -most[1]; b <= most[1]; b++)
      for (int c = -most[2]; c <= most[2]; c++) {
        const int forward = a > 0 || (a == 0 && (b > 0 || (b == 0 && c > 0)));
        const packing_vec3 d = {p->x[j] - p->x[i] + a * p->edge[0],
                                p->y[j] - p->y[i] + b * p->edge[1],
                                p->z[j] - p->z[i] + c * p->edge[2]};
        const double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z),
                     r = p->r[i] + p->r[j];
        const packing_contact contact = {
            i, j, {d.x / length, d.y / length, d.z / length}, length - r, {a, b, c}, -1};
        if ((i == j && !forward) || !(length - r <= tolerance * r + gap))
          continue;
        note(n, &contact);
        n->count++;
      }
}

static void try_walls(const pack *p, network *n, size_t i, double tolerance, double gap)
{
  const double x[3] = {p->x[i], p->y[i], p->z[i]};
  for (int a = 0; a < p->dim; a++)
    for (int side = 0; side < 2; side++) {
      const double off = (side == 0 ? x[a] : p->edge[a] - x[a]) - p->r[i];
      const double one = side == 0 ? -1 : 1;
      const packing_contact contact = {
          i,   PACKING_NO_INDEX, {a == 0 ? one : 0, a == 1 ? one : 0, a == 2 ? one : 0},
          off, {0, 0, 0},        2 * a + side};
      if ((p->periodic & 1U << a) || !(off <= tolerance * p->r[i] + gap))
        continue;
      note(n, &contact);
      n->walls++;
    }
}

static network brute(const pack *p, double tolerance, double gap)
{
  network n = {0, 0, malloc(MOST * sizeof *n.list)};
  int most[3] = {0, 0, 0};
  assert_non_null(n.list);
  for (int a = 0; a < 3; a++)
    if (p->periodic & 1U << a)
      most[a] = (int)((1.2 * (1 + tolerance) + gap) / p->edge[a]) + 2;
  for (size_t i = 0; i < COUNT; i++)
    for (size_t j = i; j < COUNT; j++)
      try_pair(p, &n, i, j, most, tolerance, gap);
  for (size_t i = 0; i < COUNT; i++)
    try_walls(p, &n, i, tolerance, gap);
  return n;
}

/* Bit for bit, but for the sign of a 0. */
static void assert_same(const packing_contact *a, const packing_contact *b)
{
  assert_true(a->i == b->i && a->j == b->j && a->wall == b->wall && a->gap == b->gap);
  assert_memory_equal(a->image, b->image, sizeof a->image);
  assert_true(a->normal.x == b->normal.x && a->normal.y == b->normal.y &&
              a->normal.z == b->normal.z);
}

static void assert_degrees(const packing_contacts *contacts, const network *n)
{
  size_t degrees[COUNT], walls[COUNT], want[COUNT] = {0}, want_walls[COUNT] = {0};
  for (size_t k = 0; k < n->count; k++) {
    want[n->list[k].i]++;
    want[n->list[k].j]++;
  }
  for (size_t k = n->count; k < n->count + n->walls; k++)
    want_walls[n->list[k].i]++;
  assert_ok(packing_contacts_degrees(contacts, degrees, walls));
  assert_memory_equal(degrees, want, sizeof want);
  assert_memory_equal(walls, want_walls, sizeof want_walls);
}

/* Rattlers by looking at everyone again and again. */
static void assert_coordination(const packing_contacts *contacts, const network *n,
                                int dim)
{
  packing_coordination_report r;
  int gone[COUNT] = {0}, again = 1;
  size_t removed = 0, ends = 0;
  packing_coordination_report_init(&r);
  assert_ok(packing_contacts_coordination(contacts, &r));
  while (again) {
    int left[COUNT] = {0};
    again = 0;
    ends = 0;
    for (size_t k = 0; k < n->count; k++)
      if (!gone[n->list[k].i] && !gone[n->list[k].j]) {
        left[n->list[k].i]++;
        left[n->list[k].j]++;
        ends += 2;
      }
    for (size_t i = 0; i < COUNT; i++)
      if (!gone[i] && left[i] <= dim) {
        gone[i] = again = 1;
        removed++;
      }
  }
  assert_true(r.contacts == n->count && r.rattlers == removed);
  if (removed < COUNT)
    assert_close(r.mean_no_rattlers, (double)ends / (double)(COUNT - removed), 1e-15);
}

static void assert_fabric(const packing_contacts *contacts, const network *n)
{
  long double sum[3][3] = {{0}};
  packing_fabric_report r;
  packing_fabric_report_init(&r);
  assert_ok(packing_contacts_fabric(contacts, NULL, &r));
  assert_int_equal(r.count, n->count);
  for (size_t k = 0; k < n->count; k++) {
    const packing_vec3 u = n->list[k].normal;
    const double v[3] = {u.x, u.y, u.z};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++)
        sum[a][b] += (long double)v[a] * v[b];
  }
  for (int a = 0; a < 3 && n->count > 0; a++)
    for (int b = 0; b < 3; b++)
      assert_near(r.tensor[a][b], (double)(sum[a][b] / (long double)n->count), 1e-14);
}

static void the_network_agrees_with_all_images(void **state)
{
  (void)state;
  size_t own = 0, several = 0, walls = 0;
  for (unsigned k = 0; k < RUNS; k++) {
    pack p;
    const double tolerance = k % 4 == 0 ? 0 : 0.03 * (k % 4), gap = k % 7 == 0 ? 0.2 : 0;
    draw(&p, k);
    packing_contacts *contacts = find(&p, tolerance, gap);
    network got = list_of(contacts), want = brute(&p, tolerance, gap);
    assert_int_equal(got.count, want.count);
    assert_int_equal(got.walls, want.walls);
    for (size_t n = 0; n < got.count + got.walls; n++) {
      assert_same(&got.list[n], &want.list[n]);
      own += (size_t)(got.list[n].i == got.list[n].j);
      several += (size_t)(n > 0 && n < got.count && got.list[n].i == got.list[n - 1].i &&
                          got.list[n].j == got.list[n - 1].j);
    }
    walls += got.walls;
    assert_degrees(contacts, &want);
    assert_coordination(contacts, &want, p.dim);
    assert_fabric(contacts, &want);
    free(got.list);
    free(want.list);
    packing_contacts_destroy(contacts);
    packing_domain_destroy(p.domain);
  }
  assert_true(own > 100 && several > 100 && walls > 100);
}

static packing_fabric_report fabric_of(const pack *p)
{
  packing_fabric_report r;
  packing_contacts *contacts = find(p, 0.125, 0);
  packing_fabric_report_init(&r);
  assert_ok(packing_contacts_fabric(contacts, NULL, &r));
  packing_contacts_destroy(contacts);
  return r;
}

/* F turns with the pack: R F R^T, with the same eigenvalues. R is that of a unit quaternion. */
static void fabric_turns_with_the_pack(void **state)
{
  (void)state;
  const double w = 0.5, x = 0.1, y = -0.7, z = 0.5; /* squares add up to 1 */
  const double turn[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  for (unsigned k = 1; k < 5; k++) {
    pack p, q;
    draw(&p, k);
    q = p;
    packing_domain_destroy(p.domain);
    p.domain = q.domain = NULL;
    packing_view_init_arrays(&q.view, COUNT, q.x, q.y, q.z, q.r);
    packing_view_init_arrays(&p.view, COUNT, p.x, p.y, p.z, p.r);
    for (size_t i = 0; i < COUNT; i++) {
      const double at[3] = {p.x[i], p.y[i], p.z[i]};
      double *c[3] = {q.x, q.y, q.z};
      for (int a = 0; a < 3; a++)
        c[a][i] = turn[a][0] * at[0] + turn[a][1] * at[1] + turn[a][2] * at[2];
    }
    const packing_fabric_report f = fabric_of(&p), g = fabric_of(&q);
    assert_true(f.count > 20 && f.count == g.count);
    for (int a = 0; a < 3; a++) {
      assert_near(f.eigenvalues[a], g.eigenvalues[a], 1e-12);
      for (int b = 0; b < 3; b++) {
        double sum = 0;
        for (int c = 0; c < 3; c++)
          for (int d = 0; d < 3; d++)
            sum += turn[a][c] * f.tensor[c][d] * turn[b][d];
        assert_near(g.tensor[a][b], sum, 1e-12);
      }
    }
  }
}

static void scale(pack *p, int e)
{
  double *c[4] = {p->x, p->y, p->z, p->r};
  for (int a = 0; a < 4; a++)
    for (size_t i = 0; i < COUNT; i++)
      c[a][i] = ldexp(c[a][i], e);
  for (int a = 0; a < 3; a++)
    p->edge[a] = ldexp(p->edge[a], e);
  p->domain = p->dim == 2 ? test_rectangle(p->edge[0], p->edge[1], p->periodic)
                          : test_box(p->edge[0], p->edge[1], p->edge[2], p->periodic);
  packing_view_init_arrays(&p->view, COUNT, p->x, p->y, p->z, p->r);
}

static void scaling_by_powers_of_two_scales_the_gaps_only(void **state)
{
  (void)state;
  for (unsigned k = 0; k < 12; k++)
    for (int e = -60; e <= 60; e += 40) {
      pack p, q;
      draw(&p, k);
      q = p;
      scale(&q, e);
      packing_contacts *a = find(&p, 0.05, 0.1), *b = find(&q, 0.05, ldexp(0.1, e));
      network m = list_of(a), n = list_of(b);
      packing_fabric_report f, g;
      packing_classes_report c, d;
      packing_fabric_report_init(&f);
      packing_fabric_report_init(&g);
      packing_classes_report_init(&c);
      packing_classes_report_init(&d);
      assert_true(m.count == n.count && m.walls == n.walls && m.count > 0);
      for (size_t i = 0; i < m.count + m.walls; i++) {
        m.list[i].gap = ldexp(m.list[i].gap, e);
        assert_same(&m.list[i], &n.list[i]);
      }
      assert_ok(packing_contacts_fabric(a, NULL, &f));
      assert_ok(packing_contacts_fabric(b, NULL, &g));
      assert_memory_equal(&f, &g, sizeof f);
      assert_ok(packing_contacts_classes(a, NULL, &c));
      assert_ok(packing_contacts_classes(b, NULL, &d));
      assert_memory_equal(&c, &d, sizeof c);
      free(m.list);
      free(n.list);
      packing_contacts_destroy(a);
      packing_contacts_destroy(b);
      packing_domain_destroy(p.domain);
      packing_domain_destroy(q.domain);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_network_agrees_with_all_images),
      cmocka_unit_test(fabric_turns_with_the_pack),
      cmocka_unit_test(scaling_by_powers_of_two_scales_the_gaps_only),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
