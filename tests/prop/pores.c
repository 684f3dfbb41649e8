/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pores against every quadruple (triple) of small packs, and what may not change them. */
#include "test.h"

enum { MOST = 1200, FOUND = 4096 };

typedef struct pack {
  int dim;
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
} pack;

static uint64_t random_state;

static double uniform(void)
{
  uint64_t z = (random_state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static pack *random_pack(int dim, size_t count, double least, double most, uint64_t seed)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  p->dim = dim;
  random_state = seed;
  for (size_t i = 0; i < count; i++) {
    p->x[i] = uniform();
    p->y[i] = uniform();
    p->z[i] = dim == 3 ? uniform() : 0;
    p->r[i] = least + (most - least) * uniform();
  }
  packing_view_init_arrays(&p->view, count, p->x, p->y, p->z, p->r);
  return p;
}

static packing_pores *measure(const pack *p, packing_context *context,
                              packing_domain *domain, packing_pores_merge merge)
{
  packing_pores *pores = NULL;
  packing_pores_def def;
  packing_pores_def_init(&def);
  def.dim = p->dim;
  def.merge = merge;
  assert_ok(packing_pores_create(context, &def, domain, &p->view, &pores));
  return pores;
}

static packing_pores_report report_of(const packing_pores *pores)
{
  packing_pores_report r;
  packing_pores_report_init(&r);
  assert_ok(packing_pores_summary(pores, &r));
  return r;
}

typedef struct ball {
  long double x, y, z, r;
} ball;

/* The spheres tangent to all of k + 1 particles from outside, by formula F14 in the local frame of
 * the first three (two), long doubles; at most two. */
static int tangent(const pack *p, const size_t v[4], ball out[2])
{
  const int dim = p->dim;
  long double d[3][3] = {{0}}, a[3] = {0}, b[3] = {0}, u[3], w[3], det;
  for (int i = 0; i < dim; i++) {
    d[i][0] = (long double)p->x[v[i + 1]] - (long double)p->x[v[0]];
    d[i][1] = (long double)p->y[v[i + 1]] - (long double)p->y[v[0]];
    d[i][2] = (long double)p->z[v[i + 1]] - (long double)p->z[v[0]];
    const long double r0 = (long double)p->r[v[0]], r = (long double)p->r[v[i + 1]];
    a[i] =
        (d[i][0] * d[i][0] + d[i][1] * d[i][1] + d[i][2] * d[i][2] + r0 * r0 - r * r) / 2;
    b[i] = r - r0;
  }
  if (dim == 2)
    d[2][2] = 1;
  det = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
        d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
        d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  for (int c = 0; c < 3; c++) { /* Cramer */
    u[c] = w[c] = 0;
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3, k = (i + 2) % 3, e = (c + 1) % 3, f = (c + 2) % 3;
      const long double cofactor = d[j][e] * d[k][f] - d[j][f] * d[k][e];
      u[c] += a[i] * cofactor / det;
      w[c] += b[i] * cofactor / det;
    }
  }
  const long double r0 = (long double)p->r[v[0]];
  const long double qa = w[0] * w[0] + w[1] * w[1] + w[2] * w[2] - 1,
                    qb = -(u[0] * w[0] + u[1] * w[1] + u[2] * w[2] + r0),
                    qc = u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - r0 * r0;
  const long double disc = qb * qb - qa * qc;
  int n = 0;
  for (int s = -1; s <= 1 && disc >= 0; s += 2) {
    const long double r = (-qb + s * sqrtl(disc)) / qa;
    if (r > 0)
      out[n++] = (ball){(long double)p->x[v[0]] + u[0] - r * w[0],
                        (long double)p->y[v[0]] + u[1] - r * w[1],
                        (long double)p->z[v[0]] + u[2] - r * w[2], r};
  }
  return n;
}

static int is_free(const pack *p, const ball *b)
{
  for (size_t i = 0; i < p->view.count; i++) {
    const long double x = (long double)p->x[i] - b->x, y = (long double)p->y[i] - b->y,
                      z = (long double)p->z[i] - b->z;
    if (sqrtl(x * x + y * y + z * z) < (long double)p->r[i] + b->r * (1 - 1e-9L))
      return 0;
  }
  return 1;
}

/* Inside the box around the particles. */
static int is_inside(const pack *p, const ball *b)
{
  int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
  for (size_t i = 0; i < p->view.count; i++) {
    const long double c[3] = {b->x, b->y, b->z};
    const double q[3] = {p->x[i], p->y[i], p->z[i]};
    for (int k = 0; k < p->dim; k++) {
      low[k] |= c[k] > (long double)(q[k] - p->r[i]);
      high[k] |= c[k] < (long double)(q[k] + p->r[i]);
    }
  }
  for (int k = 0; k < p->dim; k++)
    if (!low[k] || !high[k])
      return 0;
  return 1;
}

/* All empty tangent spheres. */
static size_t all_voids(const pack *p, ball *found)
{
  size_t n = 0, v[4];
  const size_t count = p->view.count;
  for (v[0] = 0; v[0] < count; v[0]++)
    for (v[1] = v[0] + 1; v[1] < count; v[1]++)
      for (v[2] = v[1] + 1; v[2] < count; v[2]++)
        for (v[3] = p->dim == 3 ? v[2] + 1 : count - 1; v[3] < count; v[3]++) {
          ball b[2];
          const int roots = tangent(p, v, b);
          for (int i = 0; i < roots; i++)
            if (is_inside(p, &b[i]) && is_free(p, &b[i])) {
              assert_true(n < FOUND);
              found[n++] = b[i];
            }
        }
  return n;
}

/* How many of the pores that are free stand in the list, and how many are not. */
static void match(const packing_pores *pores, const ball *list, size_t count,
                  size_t *matched, size_t *strange)
{
  size_t n;
  const packing_pores_report r = report_of(pores);
  packing_pore *pore = calloc(r.pores + 1, sizeof *pore);
  assert_non_null(pore);
  assert_ok(packing_pores_list(pores, 0, r.pores, pore, &n));
  *matched = *strange = 0;
  for (size_t i = 0; i < n; i++) {
    int found = 0;
    for (size_t k = 0; k < count && !found; k++)
      found = fabs((double)list[k].r - pore[i].radius) <= 1e-7 * pore[i].radius &&
              fabs((double)list[k].x - pore[i].centre.x) <= 1e-7 * pore[i].radius &&
              fabs((double)list[k].y - pore[i].centre.y) <= 1e-7 * pore[i].radius;
    if (pore[i].limit == PACKING_PORE_FREE) {
      *matched += (size_t)found;
      *strange += (size_t)!found;
    }
  }
  free(pore);
}

/* Equal spheres: the triangulation has exactly the empty tangent spheres. */
static void equal_spheres_have_every_void(void **state)
{
  (void)state;
  ball *list = calloc(FOUND, sizeof *list);
  assert_non_null(list);
  for (int dim = 2; dim <= 3; dim++)
    for (uint64_t seed = 1; seed <= 3; seed++) {
      size_t matched, strange;
      pack *p = random_pack(dim, dim == 3 ? 36 : 80, 0.02, 0.02, seed);
      const size_t count = all_voids(p, list);
      packing_pores *pores = measure(p, NULL, NULL, PACKING_PORES_MERGE_NONE);
      match(pores, list, count, &matched, &strange);
      assert_true(count > 50);
      assert_int_equal(strange, 0);
      assert_int_equal(matched, count);
      assert_int_equal(report_of(pores).blocked, 0);
      packing_pores_destroy(pores);
      free(p);
    }
  free(list);
}

/* Unequal spheres, ten to one, many of which overlap: what is called free is a void; four of five
 * are found, and next to none is left blocked. */
static void unequal_spheres_have_no_false_void(void **state)
{
  (void)state;
  ball *list = calloc(FOUND, sizeof *list);
  assert_non_null(list);
  for (int dim = 2; dim <= 3; dim++)
    for (uint64_t seed = 1; seed <= 3; seed++) {
      size_t matched, strange;
      pack *p = random_pack(dim, dim == 3 ? 36 : 80, 0.01, 0.1, seed);
      const size_t count = all_voids(p, list);
      packing_pores *pores = measure(p, NULL, NULL, PACKING_PORES_MERGE_NONE);
      match(pores, list, count, &matched, &strange);
      assert_int_equal(strange, 0);
      assert_true(5 * matched > 4 * count);
      assert_true(50 * report_of(pores).blocked < count + 50);
      packing_pores_destroy(pores);
      free(p);
    }
  free(list);
}

static uint64_t hash_network(const packing_pores *pores, double scale)
{
  size_t n;
  packing_pores_report r = report_of(pores);
  packing_pore *pore = calloc(r.pores + 1, sizeof *pore);
  packing_constriction *way = calloc(r.constrictions + 1, sizeof *way);
  assert_ok(packing_pores_list(pores, 0, r.pores, pore, &n));
  assert_ok(packing_pores_constrictions(pores, 0, r.constrictions, way, &n));
  for (size_t i = 0; i < r.pores; i++) {
    pore[i].centre.x /= scale;
    pore[i].centre.y /= scale;
    pore[i].centre.z /= scale;
    pore[i].radius /= scale;
  }
  for (size_t i = 0; i < r.constrictions; i++) {
    way[i].centre.x /= scale;
    way[i].centre.y /= scale;
    way[i].centre.z /= scale;
    way[i].radius /= scale;
  }
  double *const lengths[] = {&r.min_r,
                             &r.mean_r,
                             &r.max_r,
                             &r.min_constriction_r,
                             &r.mean_constriction_r,
                             &r.max_constriction_r};
  for (size_t i = 0; i < 6; i++)
    *lengths[i] /= scale;
  const size_t counts[] = {r.pores,  r.constrictions,        r.cells,
                           r.closed, r.closed_constrictions, r.open_constrictions};
  uint64_t h = test_hash(TEST_HASH_START, counts, sizeof counts);
  for (size_t i = 0; i < 6; i++)
    h = test_hash(h, lengths[i], sizeof(double));
  for (size_t i = 0; i < r.pores; i++) { /* not the bytes between members */
    const packing_pore *q = &pore[i];
    h = test_hash(h, &q->centre, sizeof q->centre);
    h = test_hash(h, &q->radius, sizeof q->radius);
    h = test_hash(h, q->particles, sizeof q->particles);
    const size_t numbers[] = {q->cells, q->coordination, (size_t)q->limit};
    h = test_hash(h, numbers, sizeof numbers);
  }
  for (size_t i = 0; i < r.constrictions; i++) {
    const packing_constriction *c = &way[i];
    const size_t numbers[] = {c->a, c->b, (size_t)c->limit};
    h = test_hash(h, numbers, sizeof numbers);
    h = test_hash(h, c->image, sizeof c->image);
    h = test_hash(h, &c->centre, sizeof c->centre);
    h = test_hash(h, &c->radius, sizeof c->radius);
    h = test_hash(h, c->particles, sizeof c->particles);
  }
  free(pore);
  free(way);
  return h;
}

static packing_domain *cell(int dim, double size, unsigned periodic)
{
  return dim == 3 ? test_box(size, size, size, periodic)
                  : test_rectangle(size, size, periodic);
}

/* By powers of two, bit for bit: open and periodic, random and on lattices. */
static void scaling_scales_the_network(void **state)
{
  (void)state;
  static const double by[] = {0x1p-40, 0x1p10, 0x1p300};
  for (int dim = 2; dim <= 3; dim++)
    for (unsigned periodic = 0; periodic < 8; periodic += 7)
      for (int merge = 0; merge < 2; merge++) {
        pack *p = random_pack(dim, 400, 0.01, 0.05, 7);
        for (int i = 0; i < 64; i++) {
          p->x[i] = 0.2 * (i % 4);
          p->y[i] = 0.2 * (i / 4 % 4);
          p->z[i] = dim == 3 ? 0.2 * (i / 16) : 0;
          p->r[i] = 0.05;
        }
        packing_domain *domain = cell(dim, 1, dim == 3 ? periodic : periodic & 3U);
        packing_pores *pores = measure(p, NULL, domain, (packing_pores_merge)merge);
        const uint64_t hash = hash_network(pores, 1);
        assert_true(report_of(pores).pores > 100);
        packing_pores_destroy(pores);
        packing_domain_destroy(domain);
        for (int k = 0; k < 3; k++) {
          pack *q = malloc(sizeof *q);
          assert_non_null(q);
          *q = *p;
          packing_view_init_arrays(&q->view, 400, q->x, q->y, q->z, q->r);
          for (size_t i = 0; i < 400; i++) {
            q->x[i] *= by[k];
            q->y[i] *= by[k];
            q->z[i] *= by[k];
            q->r[i] *= by[k];
          }
          domain = cell(dim, by[k], dim == 3 ? periodic : periodic & 3U);
          pores = measure(q, NULL, domain, (packing_pores_merge)merge);
          assert_true(hash_network(pores, by[k]) == hash);
          packing_pores_destroy(pores);
          packing_domain_destroy(domain);
          free(q);
        }
        free(p);
      }
}

static void threads_change_nothing(void **state)
{
  (void)state;
  pack *p = random_pack(3, MOST, 0.005, 0.03, 8);
  packing_domain *domain = cell(3, 1, 3);
  uint64_t hash = 0;
  for (int threads = 1; threads <= 4; threads++) {
    packing_context *context = test_context(threads, PACKING_ISA_AUTO);
    packing_pores *pores = measure(p, context, domain, PACKING_PORES_MERGE_OVERLAP);
    const uint64_t h = hash_network(pores, 1);
    hash = threads == 1 ? h : hash;
    assert_true(h == hash);
    packing_pores_destroy(pores);
    packing_context_destroy(context);
  }
  packing_domain_destroy(domain);
  free(p);
}

static double sum_of_radii(const packing_pores *pores)
{
  const packing_pores_report r = report_of(pores);
  return r.mean_r * (double)(r.pores - r.blocked - r.cut);
}

/* A periodic pack moved along itself, and one of 2 x 2 x 2 (2 x 2) of its cells, has the same
 * pores, once or 8 (4) times. */
static void periodic_packs_have_no_borders(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (int lattice = 0; lattice < 2; lattice++) {
      const size_t count = dim == 3 ? 64 : 16, images = dim == 3 ? 8 : 4;
      pack *p = random_pack(dim, count, 0.03, 0.06, 9), *q = random_pack(dim, 0, 0, 0, 1);
      for (size_t i = 0; i < count && lattice; i++) {
        p->x[i] = 0.25 * (double)(i % 4);
        p->y[i] = 0.25 * (double)(i / 4 % 4);
        p->z[i] = 0.25 * (double)(i / 16);
        p->r[i] = 0.125;
      }
      packing_domain *one = cell(dim, 1, dim == 3 ? 7 : 3),
                     *two = cell(dim, 2, dim == 3 ? 7 : 3);
      packing_pores *pores = measure(p, NULL, one, PACKING_PORES_MERGE_NONE);
      const packing_pores_report r = report_of(pores);
      const double sum = sum_of_radii(pores);
      packing_pores_destroy(pores);
      q->view.count = count * images;
      for (size_t i = 0; i < q->view.count; i++) {
        q->x[i] = p->x[i / images] + (double)(i % 2);
        q->y[i] = p->y[i / images] + (double)(i / 2 % 2);
        q->z[i] = p->z[i / images] + (double)(dim == 3 ? i / 4 % 2 : 0);
        q->r[i] = p->r[i / images];
      }
      pores = measure(q, NULL, two, PACKING_PORES_MERGE_NONE);
      const packing_pores_report s = report_of(pores);
      assert_int_equal(s.pores, images * r.pores);
      assert_int_equal(s.cells, images * r.cells);
      assert_int_equal(s.constrictions, images * r.constrictions);
      assert_int_equal(s.open_constrictions, images * r.open_constrictions);
      assert_int_equal(s.blocked, images * r.blocked);
      assert_int_equal(s.hidden, images * r.hidden);
      assert_close(sum_of_radii(pores), (double)images * sum, 1e-12);
      packing_pores_destroy(pores);
      for (size_t i = 0; i < count; i++)
        p->x[i] += 0.37;
      pores = measure(p, NULL, one, PACKING_PORES_MERGE_NONE);
      const packing_pores_report t = report_of(pores);
      assert_int_equal(t.pores, r.pores);
      assert_int_equal(t.constrictions, r.constrictions);
      assert_close(sum_of_radii(pores), sum, 1e-12);
      packing_pores_destroy(pores);
      packing_domain_destroy(one);
      packing_domain_destroy(two);
      free(p);
      free(q);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {cmocka_unit_test(equal_spheres_have_every_void),
                                     cmocka_unit_test(unequal_spheres_have_no_false_void),
                                     cmocka_unit_test(scaling_scales_the_network),
                                     cmocka_unit_test(threads_change_nothing),
                                     cmocka_unit_test(periodic_packs_have_no_borders)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
