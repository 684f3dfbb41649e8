/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The measures of order against slow ways to the same numbers: neighbours by all images of all
 * pairs, bond order by Legendre polynomials of the angles between bonds, common neighbours by sets;
 * and what may change nothing: turning, renumbering, scaling, threads. */
#include "test.h"

enum { COUNT = 160, RUNS = 24, MOST_LISTED = 4096, LARGE = 9000 /* three blocks */ };

typedef struct pack {
  double x[COUNT], y[COUNT], z[COUNT], r[COUNT];
  packing_view view;
  packing_domain *domain;
  double size[3];
  unsigned periodic;
  int dim;
} pack;

/* Run k: its dimension, periodic directions, ratio of sizes and density differ; every third has a
 * direction narrower than two diameters. */
static void draw(pack *p, unsigned k, size_t count)
{
  packing_rng *rng = NULL;
  const double ratio = pow(30, k % 4 / 3.0), edge = 3.5 + k % 5;
  double *c[3] = {p->x, p->y, p->z};
  assert_ok(packing_rng_create(NULL, k, PACKING_PURPOSE_USER, 0, &rng));
  p->dim = k % 5 == 0 ? 2 : 3;
  p->size[0] = edge;
  p->size[1] = k % 3 == 0 ? 1.125 : 1.25 * edge;
  p->size[2] = p->dim == 2 ? 0 : 0.75 * edge;
  p->periodic = p->dim == 2 ? k / 5 % 4 : k % 8;
  p->domain = p->dim == 2 ? test_rectangle(p->size[0], p->size[1], p->periodic)
                          : test_box(p->size[0], p->size[1], p->size[2], p->periodic);
  for (size_t i = 0; i < count; i++) {
    for (int a = 0; a < 3; a++)
      c[a][i] = p->size[a] * packing_rng_uniform(rng);
    p->r[i] = 0.5 * pow(ratio, -packing_rng_uniform(rng));
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&p->view, count, p->x, p->y, p->z, p->r);
}

/* All images of all others within reach, the slow way: at most `most` periods away. */
static size_t slow_images(const pack *p, size_t i, int most, double reach,
                          packing_neighbour *list)
{
  int range[3];
  size_t count = 0;
  for (int k = 0; k < 3; k++)
    range[k] = p->periodic & 1u << k ? most : 0;
  for (size_t j = 0; j < p->view.count; j++)
    for (int a = -range[0]; a <= range[0]; a++)
      for (int b = -range[1]; b <= range[1]; b++)
        for (int c = -range[2]; c <= range[2]; c++) {
          const packing_vec3 d = {p->x[j] - p->x[i] + a * p->size[0],
                                  p->y[j] - p->y[i] + b * p->size[1],
                                  p->dim == 2 ? 0 : p->z[j] - p->z[i] + c * p->size[2]};
          const packing_neighbour n = {j, d, sqrt(d.x * d.x + d.y * d.y + d.z * d.z)};
          if ((j == i && a == 0 && b == 0 && c == 0) || n.distance > reach)
            continue;
          assert_true(count < MOST_LISTED);
          list[count++] = n;
        }
  return count;
}

static packing_neighbours *find(packing_context *context, const packing_view *v,
                                packing_domain *domain, int kind, double factor,
                                size_t nearest)
{
  packing_neighbours_def def;
  packing_neighbours *n = NULL;
  packing_neighbours_def_init(&def);
  def.kind = (packing_neighbours_kind)kind;
  def.factor = factor;
  def.nearest = nearest;
  def.gap = kind == PACKING_NEIGHBOURS_WITHIN ? 0.0625 : 0;
  assert_ok(packing_neighbours_create(context, &def, domain, v, &n));
  return n;
}

static size_t list_of(const packing_neighbours *n, size_t i, packing_neighbour *list)
{
  size_t count = 0;
  assert_ok(packing_neighbours_of(n, i, list, MOST_LISTED, &count));
  assert_true(count <= MOST_LISTED);
  return count;
}

/* Each of one list stands in the other. */
static void assert_same_lists(const packing_neighbour *a, packing_neighbour *b,
                              size_t count)
{
  for (size_t k = 0; k < count; k++) {
    size_t m = 0;
    while (m < count &&
           (a[k].j != b[m].j || fabs(a[k].d.x - b[m].d.x) + fabs(a[k].d.y - b[m].d.y) +
                                        fabs(a[k].d.z - b[m].d.z) >
                                    1e-12))
      m++;
    assert_true(m < count);
    assert_near(a[k].distance, b[m].distance, 1e-12);
    b[m].j = SIZE_MAX;
  }
}

static void neighbours_within_are_those_of_all_images(void **state)
{
  (void)state;
  static packing_neighbour fast[MOST_LISTED], slow[MOST_LISTED], near[MOST_LISTED];
  pack p;
  for (unsigned k = 0; k < RUNS; k++) {
    draw(&p, k, COUNT);
    packing_neighbours *n = find(NULL, &p.view, p.domain, 0, 1.2, 1);
    for (size_t i = 0; i < COUNT; i++) {
      const size_t images = slow_images(&p, i, 2, 1.3, slow);
      size_t count = 0;
      for (size_t m = 0; m < images; m++)
        if (slow[m].distance <= 1.2 * (p.r[i] + p.r[slow[m].j]) + 0.0625)
          near[count++] = slow[m];
      assert_int_equal(list_of(n, i, fast), count);
      assert_same_lists(fast, near, count);
    }
    packing_neighbours_destroy(n);
    packing_domain_destroy(p.domain);
  }
}

/* Equally far ones by index, then by image. */
static int by_distance(const void *a, const void *b)
{
  const packing_neighbour *m = a, *n = b;
  const double x[4] = {m->distance, (double)m->j, m->d.x, m->d.y};
  const double y[4] = {n->distance, (double)n->j, n->d.x, n->d.y};
  for (int k = 0; k < 4; k++)
    if (x[k] != y[k])
      return x[k] < y[k] ? -1 : 1;
  return (m->d.z > n->d.z) - (m->d.z < n->d.z);
}

static void nearest_are_the_first_of_all_images(void **state)
{
  (void)state;
  static packing_neighbour fast[MOST_LISTED], slow[MOST_LISTED];
  pack p;
  for (unsigned k = 0; k < RUNS; k++) {
    const size_t particles = k % 2 == 0 ? COUNT : 20, wanted = 1 + 5 * (k % 7);
    draw(&p, k, particles);
    packing_neighbours *n = find(NULL, &p.view, p.domain, 1, 1, wanted);
    for (size_t i = 0; i < particles; i++) {
      const size_t images = slow_images(&p, i, 5, 4.4, slow);
      const size_t expected = p.periodic != 0          ? wanted
                              : wanted < particles - 1 ? wanted
                                                       : particles - 1;
      const size_t count = list_of(n, i, fast);
      assert_int_equal(count, expected);
      if (images < expected)
        continue; /* some farther */
      qsort(slow, images, sizeof slow[0], by_distance);
      assert_same_lists(fast, slow, count);
    }
    packing_neighbours_destroy(n);
    packing_domain_destroy(p.domain);
  }
}

static double legendre(int l, double c)
{
  double last = 1, p = c;
  for (int k = 2; k <= l; k++) {
    const double next = ((2 * k - 1) * c * p - (k - 1) * last) / k;
    last = p;
    p = next;
  }
  return p;
}

/* sqrt(sum of w_a w_b P_l(cos of the angle between bonds a and b)): by the addition theorem the
 * q_l of a weighted set of bonds. */
static double slow_order(int l, const packing_neighbour *bonds, const double *weights,
                         size_t count)
{
  double sum = 0;
  for (size_t a = 0; a < count; a++)
    for (size_t b = 0; b < count; b++) {
      const packing_vec3 u = bonds[a].d, v = bonds[b].d;
      const double c =
          (u.x * v.x + u.y * v.y + u.z * v.z) / (bonds[a].distance * bonds[b].distance);
      sum += weights[a] * weights[b] * legendre(l, c);
    }
  return sqrt(fmax(sum, 0));
}

/* The bonds of the particle and of its neighbours, each particle's together weighing the same. */
static size_t gather(const packing_neighbours *n, size_t i, packing_neighbour *bonds,
                     double *weights, size_t *own)
{
  static packing_neighbour list[MOST_LISTED];
  const size_t near = *own = list_of(n, i, list);
  size_t total = list_of(n, i, bonds);
  for (size_t k = 0; k < near; k++)
    weights[k] = 1.0 / ((double)near * (double)(near + 1));
  for (size_t k = 0; k < near; k++) {
    const size_t more = list_of(n, list[k].j, bonds + total);
    for (size_t m = 0; m < more; m++)
      weights[total + m] = 1.0 / ((double)more * (double)(near + 1));
    total += more;
    assert_true(total < MOST_LISTED);
  }
  return total;
}

static void bond_order_follows_the_addition_theorem(void **state)
{
  (void)state;
  static packing_neighbour bonds[2 * MOST_LISTED];
  static double weights[2 * MOST_LISTED];
  packing_bond_order local[COUNT];
  pack p;
  for (unsigned k = 0; k < RUNS; k++) {
    packing_bond_order_def def;
    packing_bond_order_report report;
    double mean = 0;
    draw(&p, k, COUNT);
    packing_neighbours *n = find(NULL, &p.view, p.domain, k % 2, 0.5, 7);
    packing_bond_order_def_init(&def);
    def.l = 2 + 2 * (int)(k % 6);
    packing_bond_order_report_init(&report);
    assert_ok(packing_measure_bond_order(NULL, &def, n, local, COUNT, &report));
    for (size_t i = 0; i < COUNT; i++)
      mean += local[i].q / COUNT;
    assert_near(report.mean, mean, 1e-13);
    for (size_t i = 0; i < COUNT; i += 8) {
      size_t own = 0;
      const size_t total = gather(n, i, bonds, weights, &own);
      assert_near(local[i].averaged, slow_order(def.l, bonds, weights, total), 1e-7);
      for (size_t m = 0; m < own; m++)
        weights[m] = 1.0 / (double)own;
      assert_near(local[i].q, slow_order(def.l, bonds, weights, own), 1e-7);
    }
    packing_neighbours_destroy(n);
    packing_domain_destroy(p.domain);
  }
}

static void all_bonds_together_follow_it_too(void **state)
{
  (void)state;
  static packing_neighbour bonds[2 * MOST_LISTED];
  static double weights[2 * MOST_LISTED];
  packing_bond_order_report report;
  pack p;
  size_t total = 0;
  draw(&p, 7, COUNT);
  packing_neighbours *n = find(NULL, &p.view, p.domain, 1, 1, 6);
  packing_bond_order_report_init(&report);
  assert_ok(packing_measure_bond_order(NULL, NULL, n, NULL, 0, &report));
  for (size_t i = 0; i < COUNT; i++)
    total += list_of(n, i, bonds + total);
  assert_int_equal(report.bonds, total);
  for (size_t k = 0; k < total; k++)
    weights[k] = 1.0 / (double)total;
  assert_near(report.whole, slow_order(6, bonds, weights, total), 1e-7);
  packing_neighbours_destroy(n);
  packing_domain_destroy(p.domain);
}

static void hexatic_order_is_that_of_the_angles(void **state)
{
  (void)state;
  static packing_neighbour bonds[MOST_LISTED];
  packing_hexatic local[COUNT];
  pack p;
  for (unsigned k = 0; k < 4 * RUNS; k += 5) {
    packing_hexatic_def def;
    packing_hexatic_report report;
    double mean = 0, re_all = 0, im_all = 0, share = 0;
    draw(&p, k, COUNT);
    packing_neighbours *n = find(NULL, &p.view, p.domain, k % 2, 1.2, 6);
    packing_hexatic_def_init(&def);
    def.fold = 2 + (int)(k % 11);
    packing_hexatic_report_init(&report);
    assert_ok(packing_measure_hexatic(NULL, &def, n, local, COUNT, &report));
    for (size_t i = 0; i < COUNT; i++) {
      const size_t count = list_of(n, i, bonds);
      double re = 0, im = 0;
      for (size_t m = 0; m < count; m++) {
        re += cos(def.fold * atan2(bonds[m].d.y, bonds[m].d.x)) / (double)count;
        im += sin(def.fold * atan2(bonds[m].d.y, bonds[m].d.x)) / (double)count;
      }
      assert_int_equal(local[i].neighbours, count);
      assert_near(local[i].re, re, 1e-13);
      assert_near(local[i].im, im, 1e-13);
      assert_near(local[i].modulus, hypot(re, im), 1e-13);
      mean += hypot(re, im) / COUNT;
      re_all += re / COUNT;
      im_all += im / COUNT;
      share += (count == (size_t)def.fold) / (double)COUNT;
    }
    assert_near(report.mean, mean, 1e-12);
    assert_near(report.whole, hypot(re_all, im_all), 1e-12);
    assert_near(report.share, share, 1e-12);
    packing_neighbours_destroy(n);
    packing_domain_destroy(p.domain);
  }
}

enum { CELLS = 4, SITES = 4 * CELLS * CELLS * CELLS };

typedef struct shaken {
  double x[SITES], y[SITES], z[SITES], r[SITES];
  packing_view view;
  packing_domain *cell;
} shaken;

/* Lattices of four (FCC, HCP) or two (BCC) sites a cell, in units of the cell. */
static void shake(shaken *s, int kind, double by)
{
  static const double site[3][4][3] = {
      {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}},
      {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 5.0 / 6, 0.5}, {0, 1.0 / 3, 0.5}},
      {{0, 0, 0}, {0.5, 0.5, 0.5}, {0, 0, 0}, {0, 0, 0}}};
  const double a = sqrt(2), b = 2 / sqrt(3);
  const double edge[3][3] = {{a, a, a}, {1, sqrt(3), 2 * sqrt(2.0 / 3)}, {b, b, b}};
  const int each = kind == 2 ? 2 : 4;
  packing_rng *rng = NULL;
  double *c[3] = {s->x, s->y, s->z};
  assert_ok(packing_rng_create(NULL, 5, PACKING_PURPOSE_USER, 0, &rng));
  s->cell =
      test_box(CELLS * edge[kind][0], CELLS * edge[kind][1], CELLS * edge[kind][2], 7);
  for (int i = 0; i < each * CELLS * CELLS * CELLS; i++) {
    const int cell = i / each;
    const int at[3] = {cell % CELLS, cell / CELLS % CELLS, cell / CELLS / CELLS};
    for (int k = 0; k < 3; k++)
      c[k][i] = (at[k] + site[kind][i % each][k]) * edge[kind][k] +
                by * (packing_rng_uniform(rng) - 0.5);
    s->r[i] = 0.5;
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&s->view, (size_t)(each * CELLS * CELLS * CELLS), s->x, s->y,
                           s->z, s->r);
}

static char linked[SITES][SITES];

static void link_all(const packing_neighbours *n)
{
  static packing_neighbour list[MOST_LISTED];
  memset(linked, 0, sizeof linked);
  for (size_t i = 0; i < packing_neighbours_count(n); i++) {
    const size_t count = list_of(n, i, list);
    for (size_t k = 0; k < count; k++)
      linked[i][list[k].j] = 1;
  }
}

/* Bonds of the piece that holds `at`, each seen from both ends; marks whom it has met. */
static int walk(const size_t *common, size_t count, char *met, size_t at)
{
  int ends = 0;
  met[at] = 1;
  for (size_t k = 0; k < count; k++)
    if (linked[common[at]][common[k]]) {
      ends++;
      if (!met[k])
        ends += walk(common, count, met, k);
    }
  return ends;
}

/* The mark of a bond as one number: 421 and so on. */
static int slow_mark(size_t i, size_t j, size_t particles)
{
  size_t common[SITES], count = 0;
  char met[SITES] = {0};
  int all = 0, longest = 0;
  for (size_t k = 0; k < particles; k++)
    if (linked[i][k] && linked[j][k])
      common[count++] = k;
  for (size_t k = 0; k < count; k++) {
    const int bonds = met[k] ? 0 : walk(common, count, met, k) / 2;
    all += bonds;
    longest = bonds > longest ? bonds : longest;
  }
  return (int)count * 100 + all * 10 + longest;
}

static packing_structure slow_structure(size_t i, size_t particles)
{
  int marks[1000] = {0}, degree = 0;
  for (size_t j = 0; j < particles; j++)
    if (linked[i][j]) {
      const int mark = slow_mark(i, j, particles);
      marks[mark < 1000 ? mark : 0]++;
      degree++;
    }
  if (degree == 12 && marks[421] == 12)
    return PACKING_STRUCTURE_FCC;
  if (degree == 12 && marks[421] == 6 && marks[422] == 6)
    return PACKING_STRUCTURE_HCP;
  if (degree == 14 && marks[666] == 8 && marks[444] == 6)
    return PACKING_STRUCTURE_BCC;
  if (degree == 12 && marks[555] == 12)
    return PACKING_STRUCTURE_ICOSAHEDRAL;
  return PACKING_STRUCTURE_OTHER;
}

static void common_neighbours_are_those_of_sets(void **state)
{
  (void)state;
  static shaken s;
  for (int k = 0; k < 9; k++) {
    packing_structure kinds[SITES];
    packing_common_neighbours_report report;
    size_t number[PACKING_STRUCTURE_END] = {0};
    shake(&s, k % 3, (k % 3 == 2 ? 0.0375 : 0.125) * (k / 3));
    packing_neighbours *n = find(NULL, &s.view, s.cell, 0, 1.1375, 1);
    packing_common_neighbours_report_init(&report);
    assert_ok(packing_measure_common_neighbours(NULL, n, kinds, SITES, &report));
    link_all(n);
    for (size_t i = 0; i < s.view.count; i++) {
      assert_int_equal(kinds[i], slow_structure(i, s.view.count));
      number[kinds[i]]++;
    }
    assert_memory_equal(number, report.number, sizeof number);
    const size_t crystal = number[PACKING_STRUCTURE_FCC + k % 3];
    if (k < 3)
      assert_int_equal(crystal, s.view.count);
    if (k >= 6)
      assert_true(crystal > 0 && crystal < s.view.count);
    packing_neighbours_destroy(n);
    packing_domain_destroy(s.cell);
  }
}

/* All measures of a pack of spheres. */
typedef struct measures {
  packing_bond_order local[LARGE];
  packing_structure kinds[LARGE];
  packing_bond_order_report order;
  packing_common_neighbours_report crystals;
} measures;

static void measure(packing_context *context, const packing_view *v,
                    packing_domain *domain, int kind, measures *m)
{
  packing_bond_order_def def;
  packing_neighbours *n = find(context, v, domain, kind, 1.1375, 12);
  packing_bond_order_def_init(&def);
  def.l = kind == 0 ? 6 : 4;
  packing_bond_order_report_init(&m->order);
  packing_common_neighbours_report_init(&m->crystals);
  assert_ok(packing_measure_bond_order(context, &def, n, m->local, v->count, &m->order));
  if (kind == PACKING_NEIGHBOURS_WITHIN)
    assert_ok(
        packing_measure_common_neighbours(context, n, m->kinds, v->count, &m->crystals));
  packing_neighbours_destroy(n);
}

static void turning_changes_nothing(void **state)
{
  (void)state;
  static shaken s;
  static measures before, after;
  const double c = 0.8, d = 0.6, e = 5.0 / 13, f = 12.0 / 13;
  shake(&s, 0, 0.2);
  for (int kind = 0; kind < 2; kind++) {
    measure(NULL, &s.view, NULL, kind, &before);
    for (size_t i = 0; i < s.view.count; i++) {
      const double x = c * s.x[i] - d * s.y[i], y = d * s.x[i] + c * s.y[i], z = s.z[i];
      s.x[i] = x;
      s.y[i] = e * y - f * z;
      s.z[i] = f * y + e * z;
    }
    measure(NULL, &s.view, NULL, kind, &after);
    for (size_t i = 0; i < s.view.count; i++) {
      assert_near(after.local[i].q, before.local[i].q, 1e-13);
      assert_near(after.local[i].averaged, before.local[i].averaged, 1e-13);
      assert_near(after.local[i].w, before.local[i].w, 1e-11);
      assert_int_equal(after.kinds[i], before.kinds[i]);
    }
    assert_near(after.order.whole, before.order.whole, 1e-13);
    assert_near(after.order.whole_w, before.order.whole_w, 1e-11);
  }
  packing_domain_destroy(s.cell);
}

static void numbering_changes_nothing(void **state)
{
  (void)state;
  static shaken s;
  static measures before, after;
  shake(&s, 1, 0.2);
  for (int kind = 0; kind < 2; kind++) {
    measure(NULL, &s.view, s.cell, kind, &before);
    const size_t count = s.view.count;
    for (size_t i = 0; i < count / 2; i++) {
      double *c[3] = {s.x, s.y, s.z};
      for (int k = 0; k < 3; k++) {
        const double swapped = c[k][i];
        c[k][i] = c[k][count - 1 - i];
        c[k][count - 1 - i] = swapped;
      }
    }
    measure(NULL, &s.view, s.cell, kind, &after);
    for (size_t i = 0; i < count; i++) {
      assert_near(after.local[i].q, before.local[count - 1 - i].q, 1e-13);
      assert_near(after.local[i].averaged, before.local[count - 1 - i].averaged, 1e-13);
      assert_int_equal(after.kinds[i], before.kinds[count - 1 - i]);
    }
  }
  packing_domain_destroy(s.cell);
}

/* Lengths times a power of two: the same bits. */
static void scaling_changes_nothing(void **state)
{
  (void)state;
  static measures before, after;
  pack p;
  for (int kind = 0; kind < 4; kind++) {
    packing_bond_order_def def;
    packing_neighbours_def within;
    packing_bond_order_def_init(&def);
    packing_neighbours_def_init(&within);
    within.kind = (packing_neighbours_kind)(kind % 2);
    for (int turn = 0; turn < 2; turn++) {
      measures *m = turn == 0 ? &before : &after;
      const double by = turn == 0 ? 1 : kind < 2 ? ldexp(1, 60) : ldexp(1, -70);
      packing_neighbours *n = NULL;
      draw(&p, 7, COUNT);
      packing_domain_destroy(p.domain);
      p.domain = test_box(by * p.size[0], by * p.size[1], by * p.size[2], p.periodic);
      for (int i = 0; i < COUNT; i++) {
        p.x[i] *= by;
        p.y[i] *= by;
        p.z[i] *= by;
        p.r[i] *= by;
      }
      assert_ok(packing_neighbours_create(NULL, &within, p.domain, &p.view, &n));
      packing_bond_order_report_init(&m->order);
      assert_ok(packing_measure_bond_order(NULL, &def, n, m->local, COUNT, &m->order));
      packing_neighbours_destroy(n);
      packing_domain_destroy(p.domain);
    }
    assert_memory_equal(before.local, after.local, COUNT * sizeof before.local[0]);
    assert_memory_equal(&before.order, &after.order, sizeof before.order);
  }
}

static uint64_t hash_flat(packing_context *context, const packing_view *v)
{
  static packing_hexatic local[LARGE];
  packing_neighbours_def def;
  packing_neighbours *n = NULL;
  packing_hexatic_report report;
  packing_neighbours_def_init(&def);
  def.dim = 2;
  packing_hexatic_report_init(&report);
  assert_ok(packing_neighbours_create(context, &def, NULL, v, &n));
  assert_ok(packing_measure_hexatic(context, NULL, n, local, LARGE, &report));
  packing_neighbours_destroy(n);
  return test_hash(test_hash(TEST_HASH_START, local, sizeof local), &report,
                   sizeof report);
}

static uint64_t hash_all(packing_context *context, const packing_view *v,
                         packing_domain *domain)
{
  static measures m;
  uint64_t hash = hash_flat(context, v);
  for (int kind = 0; kind < 2; kind++) {
    measure(context, v, domain, kind, &m);
    hash = test_hash(hash, m.local, sizeof m.local);
    hash = test_hash(hash, &m.order, sizeof m.order);
    hash = test_hash(hash, m.kinds, sizeof m.kinds);
    hash = test_hash(hash, &m.crystals, sizeof m.crystals);
  }
  return hash;
}

static void threads_change_nothing(void **state)
{
  (void)state;
  static double x[LARGE], y[LARGE], z[LARGE], r[LARGE];
  const int threads[] = {1, 2, 3, 8};
  packing_view v;
  packing_rng *rng = NULL;
  packing_domain *box = test_box(20, 19, 18, 5);
  assert_ok(packing_rng_create(NULL, 3, PACKING_PURPOSE_USER, 0, &rng));
  for (size_t i = 0; i < LARGE; i++) {
    x[i] = 20 * packing_rng_uniform(rng);
    y[i] = 19 * packing_rng_uniform(rng);
    z[i] = 18 * packing_rng_uniform(rng);
    r[i] = 0.25 + 0.25 * packing_rng_uniform(rng);
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&v, LARGE, x, y, z, r);
  const uint64_t hash = hash_all(NULL, &v, box);
  for (size_t t = 0; t < sizeof threads / sizeof threads[0]; t++) {
    packing_context *context = test_context(threads[t], PACKING_ISA_AUTO);
    assert_true(hash_all(context, &v, box) == hash);
    packing_context_destroy(context);
  }
  packing_domain_destroy(box);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(neighbours_within_are_those_of_all_images),
      cmocka_unit_test(nearest_are_the_first_of_all_images),
      cmocka_unit_test(bond_order_follows_the_addition_theorem),
      cmocka_unit_test(all_bonds_together_follow_it_too),
      cmocka_unit_test(hexatic_order_is_that_of_the_angles),
      cmocka_unit_test(common_neighbours_are_those_of_sets),
      cmocka_unit_test(turning_changes_nothing),
      cmocka_unit_test(numbering_changes_nothing),
      cmocka_unit_test(scaling_changes_nothing),
      cmocka_unit_test(threads_change_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
