/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The regular triangulation against its definition. Most points have small whole coordinates, for
 * which 64-bit integers answer every question exactly. */
#include "delaunay/builder.h"
#include "delaunay/expansion.h"
#include "test.h"

enum { MOST = 4096 };

typedef struct scene {
  int dim;
  size_t count;
  double x[MOST], y[MOST], z[MOST], r[MOST];
} scene;

static uint64_t random_state;

static double uniform(void)
{
  uint64_t z = (random_state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double whole(int below)
{
  return floor(uniform() * below);
}

static scene *new_scene(int dim, uint64_t seed)
{
  scene *s = calloc(1, sizeof *s);
  assert_non_null(s);
  s->dim = dim;
  random_state = seed;
  return s;
}

static void add(scene *s, double x, double y, double z, double r)
{
  const size_t i = s->count++;
  assert_true(i < MOST);
  s->x[i] = x;
  s->y[i] = y;
  s->z[i] = s->dim == 3 ? z : 0;
  s->r[i] = r;
}

static packing_i_delaunay *triangulate(const scene *s)
{
  const packing_i_delaunay_source source = {s->dim, s->count, s->x, s->y, s->z, s->r};
  packing_i_delaunay *t = NULL;
  assert_ok(packing_i_delaunay_create(NULL, &source, &t));
  return t;
}

static int64_t det3(int64_t m[3][3])
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* 6 (2) times the signed volume (area) of a simplex. */
static int64_t volume(const scene *s, const size_t v[4])
{
  int64_t m[3][3];
  for (int i = 0; i < 3; i++) {
    const size_t k = s->dim == 2 && i == 2 ? v[0] : v[i + 1];
    m[i][0] = (int64_t)(s->x[k] - s->x[v[0]]);
    m[i][1] = (int64_t)(s->y[k] - s->y[v[0]]);
    m[i][2] = (int64_t)(s->z[k] - s->z[v[0]]);
  }
  if (s->dim == 2)
    m[2][0] = m[2][1] = 0, m[2][2] = 1;
  return det3(m);
}

/* How far q reaches into the orthogonal sphere of a positive simplex: > 0 in conflict. */
static int64_t conflict(const scene *s, const size_t v[4], size_t q)
{
  int64_t sum = 0;
  for (int i = 0; i <= s->dim; i++) {
    const int64_t x = (int64_t)(s->x[v[i]] - s->x[q]),
                  y = (int64_t)(s->y[v[i]] - s->y[q]),
                  z = (int64_t)(s->z[v[i]] - s->z[q]), a = (int64_t)s->r[v[i]],
                  b = (int64_t)s->r[q];
    size_t w[4] = {v[0], v[1], v[2], v[3]};
    w[i] = q; /* its barycentric share times the lift of vertex i */
    sum += (x * x + y * y + z * z - a * a + b * b) * volume(s, w);
  }
  return sum;
}

static void vertices(const packing_i_delaunay *t, uint32_t cell, size_t v[4])
{
  for (int k = 0; k < 4; k++)
    v[k] = k <= t->dim && t->cell[cell].v[k] != PACKING_I_DELAUNAY_NONE
               ? packing_i_delaunay_vertex(t, cell, k)
               : SIZE_MAX;
}

/* Each neighbour has all corners but one, and leads back. */
static void check_links(const packing_i_delaunay *t)
{
  for (uint32_t c = 0; c < t->cells; c++)
    for (int k = 0; k <= t->dim; k++) {
      const uint32_t n = t->cell[c].n[k];
      assert_true(n < t->cells && n != c);
      const int m = packing_i_delaunay_mirror(t, c, k);
      assert_int_equal(t->cell[n].n[m], c);
      for (int i = 0; i <= t->dim; i++) {
        int found = 0;
        for (int j = 0; j <= t->dim; j++)
          found += j != m && t->cell[n].v[j] == t->cell[c].v[i];
        assert_int_equal(found, i != k);
      }
    }
}

/* Every real cell is positive and empty, every facet of the hull has all on one side, and the
 * cells fill the hull. */
static void check_cells(const scene *s, const packing_i_delaunay *t)
{
  int64_t filled = 0, hull = 0;
  size_t v[4];
  for (uint32_t c = 0; c < t->real; c++) {
    vertices(t, c, v);
    assert_true(volume(s, v) > 0);
    filled += volume(s, v);
    for (size_t q = 0; q < s->count; q++)
      assert_true(conflict(s, v, q) <= 0);
  }
  for (uint32_t c = t->real; c < t->cells; c++) {
    vertices(t, c, v);
    int ghost = 0;
    while (v[ghost] != SIZE_MAX)
      ghost++;
    for (size_t q = 0; q < s->count; q++) {
      v[ghost] = q;
      assert_true(volume(s, v) <= 0);
    }
    v[ghost] = 0;
    hull -= volume(s, v);
  }
  assert_true(filled == hull);
}

static int compare_edges(const void *a, const void *b)
{
  const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
  return p < q ? -1 : p > q;
}

static size_t count_edges(const packing_i_delaunay *t)
{
  uint64_t *edges = calloc(6 * (size_t)t->real + 1, sizeof *edges);
  size_t n = 0, distinct = 0;
  assert_non_null(edges);
  for (uint32_t c = 0; c < t->real; c++)
    for (int i = 0; i <= t->dim; i++)
      for (int j = 0; j < i; j++) {
        const uint64_t a = t->cell[c].v[i], b = t->cell[c].v[j];
        edges[n++] = a < b ? a << 32 | b : b << 32 | a;
      }
  qsort(edges, n, sizeof *edges, compare_edges);
  for (size_t i = 0; i < n; i++)
    distinct += i == 0 || edges[i] != edges[i - 1];
  free(edges);
  return distinct;
}

/* Vertices - edges + facets - cells of a ball is 1. */
static void check_euler(const packing_i_delaunay *t)
{
  size_t points = 0;
  for (uint32_t i = 0; i < t->count; i++)
    points += t->where[i] != PACKING_I_DELAUNAY_NONE;
  const size_t facets =
      ((size_t)t->real * ((size_t)t->dim + 1) + (t->cells - t->real)) / 2;
  if (t->dim == 3)
    assert_int_equal(points + facets, count_edges(t) + t->real + 1);
  else
    assert_int_equal(points + t->real, facets + 1);
  if (t->dim == 2)
    assert_int_equal(facets, count_edges(t));
}

static void check_where(const packing_i_delaunay *t)
{
  for (uint32_t i = 0; i < t->count; i++) {
    int found = t->where[i] == PACKING_I_DELAUNAY_NONE;
    for (int k = 0; !found && k <= t->dim; k++)
      found = t->cell[t->where[i]].v[k] == i;
    assert_true(found);
  }
}

static packing_i_delaunay *check(const scene *s)
{
  packing_i_delaunay *t = triangulate(s);
  assert_int_equal(t->spanned, s->dim);
  check_links(t);
  check_where(t);
  check_euler(t);
  check_cells(s, t);
  return t;
}

static void check_only(scene *s)
{
  packing_i_delaunay_destroy(check(s));
  free(s);
}

static size_t hidden(const packing_i_delaunay *t)
{
  size_t n = 0;
  for (uint32_t i = 0; i < t->count; i++)
    n += t->where[i] == PACKING_I_DELAUNAY_NONE;
  return n;
}

static void random_spheres_have_empty_cells(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (int r = 0; r <= 300; r += 100) {
      scene *s = new_scene(dim, (uint64_t)(dim + r));
      for (int i = 0; i < 400; i++)
        add(s, whole(1000), whole(1000), whole(1000), r == 0 ? 7 : 1 + whole(r));
      check_only(s);
    }
}

/* Of spheres as large as the box most are hidden, and vertices vanish while others come. */
static void large_spheres_hide_others(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 5);
    for (int i = 0; i < 500; i++)
      add(s, whole(500), whole(500), whole(500), whole(700));
    packing_i_delaunay *t = check(s);
    assert_in_range(hidden(t), 100, 480);
    packing_i_delaunay_destroy(t);
    free(s);
  }
}

/* Few places for many points: duplicates, lines and planes everywhere. */
static void crowds_on_few_places_are_sorted_out(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++)
    for (int side = 2; side <= 6; side++)
      for (int radii = 1; radii <= 3; radii += 2) {
        scene *s = new_scene(dim, (uint64_t)(10 * side + radii));
        for (int i = 0; i < 300; i++)
          add(s, whole(side), whole(side), whole(side), whole(radii));
        check_only(s);
      }
}

static void add_lattice(scene *s, int side, int by, const double basis[][3], int n)
{
  for (int i = 0; i < side * side * (s->dim == 3 ? side : 1); i++)
    for (int b = 0; b < n; b++)
      add(s, by * (i % side + basis[b][0]), by * (i / side % side + basis[b][1]),
          by * (i / side / side + basis[b][2]), 1);
}

static void lattices_have_no_flat_cells(void **state)
{
  (void)state;
  static const double cubic[4][3] = {{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}};
  static const double body[2][3] = {{0, 0, 0}, {.5, .5, .5}};
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 1);
    add_lattice(s, 6, 2, cubic, 1);
    check_only(s);
  }
  scene *s = new_scene(3, 1);
  add_lattice(s, 4, 2, cubic, 4);
  packing_i_delaunay *t = check(s);
  assert_int_equal(hidden(t), 0);
  packing_i_delaunay_destroy(t);
  free(s);
  s = new_scene(3, 1);
  add_lattice(s, 5, 2, body, 2);
  check_only(s);
}

/* Points of a sphere x^2 + y^2 + z^2 = 5^2 3^2 (of a circle): all in one orthogonal sphere. */
static void cospherical_points_make_one_ball(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 1);
    const int reach = dim == 3 ? 15 : 65;
    for (int x = -reach; x <= reach; x++)
      for (int y = -reach; y <= reach; y++)
        for (int z = dim == 3 ? -reach : 0; z <= (dim == 3 ? reach : 0); z++)
          if (x * x + y * y + z * z == reach * reach)
            add(s, x, y, z, 3);
    assert_true(s->count >= 36);
    packing_i_delaunay *t = check(s);
    assert_int_equal(hidden(t), 0);
    packing_i_delaunay_destroy(t);
    free(s);
  }
}

static void too_few_dimensions_have_no_cells(void **state)
{
  (void)state;
  for (int spanned = -1; spanned < 3; spanned++)
    for (int dim = 2; dim <= 3; dim++) {
      scene *s = new_scene(dim, 1);
      for (int i = 0; spanned >= 0 && i < 50; i++) {
        const double a = spanned > 0 ? whole(9) : 0, b = spanned > 1 ? whole(9) : 0;
        add(s, 1 + a, 2 + 3 * a - b, 5 - 2 * a + 7 * b, 1);
      }
      if (spanned < dim) {
        packing_i_delaunay *t = triangulate(s);
        const packing_vec3 p = {1, 2, 3};
        assert_int_equal(t->spanned, spanned);
        assert_int_equal(t->cells, 0);
        assert_int_equal(hidden(t), s->count);
        assert_true(packing_i_delaunay_locate(t, &p, 0) == PACKING_I_DELAUNAY_NONE);
        packing_i_delaunay_destroy(t);
      }
      free(s);
    }
}

static void one_simplex_is_one_cell(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 1);
    add(s, 0, 0, 0, 1);
    add(s, 0, 4, 0, 1);
    add(s, 4, 0, 0, 1);
    if (dim == 3)
      add(s, 0, 0, 4, 1);
    packing_i_delaunay *t = check(s);
    assert_int_equal(t->real, 1);
    assert_int_equal(t->cells, dim + 2);
    packing_i_delaunay_destroy(t);
    free(s);
  }
}

/* Sum over cells of a hash of their corners' places and radii, whatever their numbers. */
static uint64_t fingerprint(const scene *s, const packing_i_delaunay *t, double shift)
{
  uint64_t sum = 0;
  for (uint32_t c = 0; c < t->real; c++) {
    uint64_t corners = 0;
    for (int k = 0; k <= t->dim; k++) {
      const size_t v = packing_i_delaunay_vertex(t, c, k);
      const double p[4] = {s->x[v] - shift, s->y[v] - shift, s->z[v], s->r[v]};
      corners += test_hash(TEST_HASH_START, p, sizeof p);
    }
    sum += test_hash(TEST_HASH_START, &corners, sizeof corners);
  }
  return sum;
}

/* Also where lattices leave a choice: numbering and place do not matter. */
static void the_set_of_cells_depends_on_the_spheres_only(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 3), *other = new_scene(dim, 3);
    for (int i = 0; i < (dim == 3 ? 343 : 49); i++)
      add(s, i % 7, i / 7 % 7, i / 49, 0.5);
    for (size_t i = 0; i < s->count; i++) {
      const size_t j = (i * 100 + 17) % s->count;
      add(other, s->x[j] + 64, s->y[j] + 64, s->z[j], s->r[j]);
    }
    packing_i_delaunay *a = triangulate(s), *b = triangulate(other);
    assert_int_equal(a->real, b->real);
    assert_true(fingerprint(s, a, 0) == fingerprint(other, b, 64));
    packing_i_delaunay_destroy(a);
    packing_i_delaunay_destroy(b);
    free(s);
    free(other);
  }
}

/* Powers of two, down and up to where squares leave the range of doubles. */
static void scaling_changes_nothing(void **state)
{
  (void)state;
  static const double by[] = {0x1p-900, 0x1p-37, 0x1p600, 0x1p1000};
  scene *s = new_scene(3, 9), *scaled = new_scene(3, 9);
  for (int i = 0; i < 300; i++)
    add(s, uniform(), uniform(), uniform(), 0.1 * uniform());
  packing_i_delaunay *a = triangulate(s);
  for (size_t k = 0; k < sizeof by / sizeof by[0]; k++) {
    scaled->count = 0;
    for (size_t i = 0; i < s->count; i++)
      add(scaled, by[k] * s->x[i], by[k] * s->y[i], by[k] * s->z[i], by[k] * s->r[i]);
    packing_i_delaunay *b = triangulate(scaled);
    assert_int_equal(a->cells, b->cells);
    assert_memory_equal(a->cell, b->cell, a->cells * sizeof *a->cell);
    packing_i_delaunay_destroy(b);
  }
  packing_i_delaunay_destroy(a);
  free(s);
  free(scaled);
}

/* Whole coordinates of up to 50 bits around a lattice, too close to call in doubles: against the
 * same points minus the large offset, which integers can do. */
static void close_calls_are_exact(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 4), *small = new_scene(dim, 4);
    for (int i = 0; i < 400; i++)
      add(small, 50 * (i % 7) + whole(2), 50 * (i / 7 % 7) + whole(2),
          50 * (i / 49) + whole(2), 25 + whole(2));
    for (size_t i = 0; i < small->count; i++)
      add(s, small->x[i] + 0x1p50, small->y[i] - 0x1p49, small->z[i] + 0x1p48,
          small->r[i]);
    packing_i_delaunay *t = triangulate(s);
    check_links(t);
    check_euler(t);
    check_cells(small, t);
    packing_i_delaunay_destroy(t);
    free(s);
    free(small);
  }
}

static const packing_i_delaunay_point *const *
corners(const packing_i_delaunay_point *q, const packing_i_delaunay_point *p[4])
{
  for (int k = 0; k < 4; k++)
    p[k] = &q[k];
  return p;
}

/* Shears of a cube by full-length numbers keep affine dependence, not doubles': a point and its
 * reflection in the middle of two others lie on one sphere with them when all is mirrored. */
static void predicates_see_exact_zeros(void **state)
{
  (void)state;
  packing_i_exact exact;
  assert_ok(packing_i_exact_create(NULL, &exact));
  random_state = 77;
  for (int n = 0; n < 2000; n++) {
    const double x[2] = {uniform(), uniform()}, y[2] = {uniform(), uniform()},
                 z[2] = {uniform(), uniform()}, r = uniform();
    packing_i_delaunay_point c[8];
    const packing_i_delaunay_point *p[4];
    for (int k = 0; k < 8; k++)
      c[k] = (packing_i_delaunay_point){{x[k & 1], y[k >> 1 & 1], z[k >> 2]}, r};
    packing_i_delaunay_point q[4] = {c[0], c[1], c[2], c[4]};
    const int turn = packing_i_delaunay_orient(3, corners(q, p));
    assert_int_equal(packing_i_exact_orient(3, p), turn);
    if (turn < 0) {
      q[0] = c[1];
      q[1] = c[0];
    }
    for (int k = 0; k < 8; k++) {
      packing_i_delaunay_point o = c[k];
      assert_int_equal(packing_i_delaunay_side(&exact, 3, p, &o), 0);
      o.r = nextafter(r, 2);
      assert_int_equal(packing_i_delaunay_side(&exact, 3, p, &o), 1);
      assert_int_equal(packing_i_exact_side(&exact, 3, p, &o), 1);
      o.r = nextafter(r, 0);
      assert_int_equal(packing_i_delaunay_side(&exact, 3, p, &o), -1);
      assert_int_equal(packing_i_exact_side(&exact, 3, p, &o), -1);
    }
    const packing_i_delaunay_point flat[4] = {c[0], c[1], c[2], c[3]};
    assert_int_equal(packing_i_delaunay_orient(3, corners(flat, p)), 0);
  }
  packing_i_free(packing_i_allocator(NULL), exact.room);
}

/* All three stages say the same of points that doubles can tell apart, in both dimensions. */
static void stages_agree(void **state)
{
  (void)state;
  packing_i_exact exact;
  assert_ok(packing_i_exact_create(NULL, &exact));
  random_state = 78;
  for (int n = 0; n < 4000; n++) {
    const int dim = 2 + n % 2;
    packing_i_delaunay_point c[5];
    const packing_i_delaunay_point *p[4];
    for (int k = 0; k < 5; k++)
      c[k] = (packing_i_delaunay_point){{uniform(), uniform(), dim == 3 ? uniform() : 0},
                                        0.3 * uniform()};
    const int turn = packing_i_delaunay_orient(dim, corners(c, p));
    assert_int_equal(packing_i_exact_orient(dim, p), turn);
    p[0] = turn < 0 ? &c[1] : &c[0];
    p[1] = turn < 0 ? &c[0] : &c[1];
    assert_int_equal(packing_i_exact_side(&exact, dim, p, &c[4]),
                     packing_i_delaunay_side(&exact, dim, p, &c[4]));
  }
  packing_i_free(packing_i_allocator(NULL), exact.room);
}

/* Products of 53-bit whole numbers, by hand in pieces of 32 bits. */
static void expansions_keep_every_bit(void **state)
{
  (void)state;
  double a_room[2], b_room[2], out_room[8], spare[8], sum_room[16];
  packing_i_expansion a = {a_room, 0}, b = {b_room, 0}, out = {out_room, 0},
                      sum = {sum_room, 0};
  packing_i_expansion_set(&a, packing_i_two_sum(0x1p60, 3));
  packing_i_expansion_set(&b, packing_i_two_sum(0x1p60, -3));
  assert_int_equal(a.n, 2);
  packing_i_expansion_multiply(&a, &b, &out, spare); /* 2^120 - 9 */
  assert_int_equal(packing_i_expansion_sign(&out), 1);
  double big[1] = {-0x1p120};
  packing_i_expansion rest = {big, 1};
  packing_i_expansion_add(&out, &rest, &sum);
  assert_int_equal(sum.n, 1);
  assert_true(sum.e[0] == -9);
  packing_i_expansion_set(&a, packing_i_two_sum(0.1, -0.1));
  assert_int_equal(packing_i_expansion_sign(&a), 0);
  packing_i_expansion_multiply(&a, &b, &out, spare);
  assert_int_equal(out.n, 0);
}

static void points_are_found_where_they_are(void **state)
{
  (void)state;
  for (int dim = 2; dim <= 3; dim++) {
    scene *s = new_scene(dim, 21);
    for (int i = 0; i < 500; i++)
      add(s, 4 * uniform(), 4 * uniform(), 4 * uniform(), 0.05);
    packing_i_delaunay *t = triangulate(s);
    uint32_t hint = PACKING_I_DELAUNAY_NONE;
    for (int n = 0; n < 500; n++) {
      const packing_vec3 p = {5 * uniform() - 0.5, 5 * uniform() - 0.5,
                              5 * uniform() - 0.5};
      const packing_i_delaunay_point q = {
          {p.x * t->scale, p.y * t->scale, dim == 3 ? p.z * t->scale : 0}, 0};
      const packing_i_delaunay_point *c[4];
      hint = packing_i_delaunay_locate(t, &p, hint);
      const int ghost = packing_i_delaunay_corners(t, hint, &q, c);
      assert_int_equal(packing_i_delaunay_is_real(t, hint), ghost < 0);
      if (ghost >= 0)
        assert_int_equal(packing_i_delaunay_orient(dim, c), 1);
      for (int k = 0; ghost < 0 && k <= dim; k++) {
        const packing_i_delaunay_point *kept = c[k];
        c[k] = &q;
        assert_true(packing_i_delaunay_orient(dim, c) >= 0);
        c[k] = kept;
      }
    }
    packing_i_delaunay_destroy(t);
    free(s);
  }
}

/* Random doubles: no cell's sphere holds another point, in long doubles. */
static void random_doubles_have_empty_spheres(void **state)
{
  (void)state;
  scene *s = new_scene(3, 33);
  for (int i = 0; i < 400; i++)
    add(s, uniform(), uniform(), uniform(), 0.2 * uniform());
  packing_i_delaunay *t = triangulate(s);
  check_links(t);
  check_euler(t);
  for (uint32_t c = 0; c < t->real; c++)
    for (size_t q = 0; q < s->count; q++) {
      long double m[4][4], sum = 0, most = 0;
      size_t v[4];
      vertices(t, c, v);
      for (int i = 0; i < 4; i++) {
        m[i][0] = (long double)s->x[v[i]] - (long double)s->x[q];
        m[i][1] = (long double)s->y[v[i]] - (long double)s->y[q];
        m[i][2] = (long double)s->z[v[i]] - (long double)s->z[q];
        m[i][3] = m[i][0] * m[i][0] + m[i][1] * m[i][1] + m[i][2] * m[i][2] -
                  (long double)s->r[v[i]] * (long double)s->r[v[i]] +
                  (long double)s->r[q] * (long double)s->r[q];
      }
      for (int i = 0; i < 4; i++) {
        const int a = i == 0, b = i <= 1 ? 2 : 1, e = i <= 2 ? 3 : 2;
        const long double minor = m[a][0] * (m[b][1] * m[e][2] - m[b][2] * m[e][1]) -
                                  m[a][1] * (m[b][0] * m[e][2] - m[b][2] * m[e][0]) +
                                  m[a][2] * (m[b][0] * m[e][1] - m[b][1] * m[e][0]);
        sum += (i % 2 == 0 ? 1 : -1) * m[i][3] * minor;
        most = fmaxl(most, fabsl(m[i][3] * minor));
      }
      assert_true(sum <= 1e-16L * most);
    }
  packing_i_delaunay_destroy(t);
  free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(expansions_keep_every_bit),
      cmocka_unit_test(stages_agree),
      cmocka_unit_test(predicates_see_exact_zeros),
      cmocka_unit_test(one_simplex_is_one_cell),
      cmocka_unit_test(random_spheres_have_empty_cells),
      cmocka_unit_test(random_doubles_have_empty_spheres),
      cmocka_unit_test(large_spheres_hide_others),
      cmocka_unit_test(crowds_on_few_places_are_sorted_out),
      cmocka_unit_test(lattices_have_no_flat_cells),
      cmocka_unit_test(cospherical_points_make_one_ball),
      cmocka_unit_test(too_few_dimensions_have_no_cells),
      cmocka_unit_test(the_set_of_cells_depends_on_the_spheres_only),
      cmocka_unit_test(scaling_changes_nothing),
      cmocka_unit_test(close_calls_are_exact),
      cmocka_unit_test(points_are_found_where_they_are)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
