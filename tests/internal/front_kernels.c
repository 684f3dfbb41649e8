/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The vector kernels of the pocket front against plain loops, and bit for bit against each other for
 * all instruction sets. What stands in the padding is not a number. */
#include "test.h"

#include "place/front_kernels.h"

enum { MOST = 64, PAIRS = 2 * MOST * MOST };

static packing_rng *rng;

static double between(double a, double b)
{
  return a + (b - a) * packing_rng_uniform(rng);
}

static packing_vec3 point(double far)
{
  return packing_i_vec(between(-far, far), between(-far, far), between(-far, far));
}

/* Aligned arrays; padding is NaN. */
typedef double column[MOST] __attribute__((aligned(64)));

typedef struct around {
  column x, y, z, a, b, r;
  uint32_t id[MOST];
  packing_i_front_halo halo;
} around;

static void taint(double *c, size_t from, size_t to)
{
  for (size_t n = from; n < to; n++)
    c[n] = (double)NAN;
}

static void around_init(around *s, size_t count)
{
  double *const all[] = {s->x, s->y, s->z, s->a, s->b, s->r};
  for (size_t k = 0; k < 6; k++)
    taint(all[k], 0, MOST);
  const packing_i_front_halo halo = {s->x, s->y,  s->z,  s->a, s->b,
                                     s->r, s->id, count, MOST};
  s->halo = halo;
}

/* Spheres close about one of radius `own`, and one wall last where there is room. */
static void around_fill(around *s, size_t count, double own)
{
  around_init(s, count);
  for (size_t t = 0; t < count; t++) {
    packing_i_front_body body;
    s->r[t] = between(0.5, 1.5);
    packing_vec3 p = point(1);
    p = packing_i_scale(p, (own + s->r[t]) * between(1, 2) / packing_i_norm(p));
    body = packing_i_front_sphere(p, s->r[t], own);
    if (t + 1 == count && count > 3) {
      body = packing_i_front_wall(packing_i_scale(p, 1 / packing_i_norm(p)),
                                  between(1, 1.4));
      s->r[t] = HUGE_VAL;
    }
    s->x[t] = body.p.x;
    s->y[t] = body.p.y;
    s->z[t] = body.p.z;
    s->a[t] = body.a;
    s->b[t] = body.b;
    s->id[t] = (uint32_t)(100 + t);
  }
}

/* The sets the machine has; the first is the baseline. */
static size_t sets(const packing_i_front_kernels *set[3])
{
  static const packing_isa all[] = {PACKING_ISA_BASELINE, PACKING_ISA_AVX2,
                                    PACKING_ISA_AVX512};
  size_t count = 0;
  for (size_t k = 0; k < 3; k++)
    if (packing_isa_available(all[k]))
      set[count++] = packing_i_front_kernels_for(all[k]);
  return count;
}

/* ---- gather ---- */

static void gather_plainly(const packing_i_front_bin *bin, uint32_t first,
                           const packing_vec3 *centre, double reach, around *want)
{
  for (unsigned k = 0; k < bin->count; k++) {
    const double x = bin->x[k] - centre->x, y = bin->y[k] - centre->y,
                 z = bin->z[k] - centre->z, far = bin->r[k] + reach;
    if (!(x * x + y * y + z * z <= far * far))
      continue;
    const size_t t = want->halo.count++;
    want->x[t] = x;
    want->y[t] = y;
    want->z[t] = z;
    want->r[t] = bin->r[k];
    want->id[t] = first + k;
  }
}

static void gather(void **state)
{
  (void)state;
  const packing_i_front_kernels *set[3];
  const size_t count = sets(set);
  for (int n = 0; n < 20000; n++) {
    packing_i_front_bin bin[2] __attribute__((aligned(64)));
    memset(bin, 0, sizeof bin);
    for (unsigned m = 0; m < 2; m++) {
      bin[m].count = (uint32_t)(8.999 * packing_rng_uniform(rng));
      for (unsigned k = 0; k < 8; k++) {
        bin[m].x[k] = k < bin[m].count ? between(-3, 3) : HUGE_VAL;
        bin[m].y[k] = between(-3, 3);
        bin[m].z[k] = between(-3, 3);
        bin[m].r[k] = between(0.3, 1.1);
      }
    }
    const packing_i_front_bin *const bins[2] = {bin, bin + 1};
    const uint32_t first[2] = {800, 1600};
    const packing_vec3 centre = point(3);
    const double reach = between(0.1, 3);
    around want, got;
    around_init(&want, (size_t)(n % 40));
    for (unsigned m = 0; m < 2; m++)
      gather_plainly(bin + m, first[m], &centre, reach, &want);
    for (size_t k = 0; k < count; k++) {
      around_init(&got, (size_t)(n % 40));
      assert_true(set[k]->gather(bins, first, 2, &centre, reach, &got.halo));
      assert_int_equal(got.halo.count, want.halo.count);
      for (size_t t = (size_t)(n % 40); t < want.halo.count; t++) {
        assert_true(got.x[t] == want.x[t] && got.y[t] == want.y[t] &&
                    got.z[t] == want.z[t] && got.r[t] == want.r[t]);
        assert_int_equal(got.id[t], want.id[t]);
      }
    }
  }
}

/* ---- bodies ---- */

static void bodies(void **state)
{
  (void)state;
  const packing_i_front_kernels *set[3];
  const size_t sets_held = sets(set);
  for (size_t count = 0; count <= 40; count++)
    for (size_t k = 0; k < sets_held; k++) {
      around s;
      const double own = between(0.5, 1.5);
      around_fill(&s, count, own);
      around plain = s;
      set[k]->bodies(&s.halo, count, own);
      for (size_t t = 0; t < count; t++) {
        if (!(s.r[t] < HUGE_VAL))
          continue;
        const packing_i_front_body body = packing_i_front_sphere(
            packing_i_vec(plain.x[t], plain.y[t], plain.z[t]), plain.r[t], own);
        assert_true(s.a[t] == body.a && s.b[t] == body.b);
      }
    }
}

/* ---- pairs and sieve ---- */

typedef struct caps {
  column x, y, z, square, top, room, reach, cosine;
  uint32_t halo[MOST], order[MOST];
  packing_i_front_caps c;
} caps;

static void caps_init(caps *s, size_t count)
{
  double *const all[] = {s->x,   s->y,    s->z,     s->square,
                         s->top, s->room, s->reach, s->cosine};
  for (size_t k = 0; k < 8; k++)
    taint(all[k], 0, MOST);
  const packing_i_front_caps c = {s->x,      s->y,     s->z,     s->square,
                                  s->top,    s->room,  s->reach, s->halo,
                                  s->cosine, s->order, count,    MOST};
  s->c = c;
}

static void caps_fill(caps *s, const around *of, size_t count, double reference)
{
  caps_init(s, count);
  for (size_t t = 0; t < count; t++) {
    s->x[t] = of->x[t];
    s->y[t] = of->y[t];
    s->z[t] = of->z[t];
    s->square[t] = of->x[t] * of->x[t] + of->y[t] * of->y[t] + of->z[t] * of->z[t];
    s->top[t] = of->a[t] + of->b[t] * reference;
    s->room[t] = s->top[t] + 1e-12;
    s->reach[t] = of->r[t] + reference;
    s->halo[t] = (uint32_t)t;
  }
}

typedef struct found {
  double x[PAIRS] __attribute__((aligned(64)));
  double y[PAIRS] __attribute__((aligned(64)));
  double z[PAIRS] __attribute__((aligned(64)));
  uint32_t pair[PAIRS];
  packing_i_front_candidates c;
} found;

static found *found_new(void)
{
  found *f = aligned_alloc(64, sizeof *f);
  assert_non_null(f);
  taint(f->x, 0, PAIRS);
  taint(f->y, 0, PAIRS);
  taint(f->z, 0, PAIRS);
  const packing_i_front_candidates c = {f->x, f->y, f->z, f->pair, 0, PAIRS};
  f->c = c;
  return f;
}

static int same_candidates(const found *a, const found *b)
{
  if (a->c.count != b->c.count)
    return 0;
  const size_t bytes = a->c.count * sizeof *a->x;
  return memcmp(a->x, b->x, bytes) == 0 && memcmp(a->y, b->y, bytes) == 0 &&
         memcmp(a->z, b->z, bytes) == 0 &&
         memcmp(a->pair, b->pair, a->c.count * sizeof *a->pair) == 0;
}

/* Where the candidate of a pair is; the count: nowhere. */
static size_t find(const found *f, uint32_t pair)
{
  size_t n = 0;
  while (n < f->c.count && f->pair[n] != pair)
    n++;
  return n;
}

/* Every pair that a curve can be made of, at the reference radius. Pairs at the edge of having a
 * solution, or of being within reach, are either way. */
static void check_pairs(const found *f, const around *of, const caps *s, double own,
                        double reference)
{
  size_t seen = 0;
  for (size_t i = 0; i < s->c.count; i++)
    for (size_t j = i + 1; j < s->c.count; j++) {
      const packing_i_front_body one = {packing_i_vec(of->x[i], of->y[i], of->z[i]),
                                        of->a[i], of->b[i]},
                                 two = {packing_i_vec(of->x[j], of->y[j], of->z[j]),
                                        of->a[j], of->b[j]};
      const packing_vec3 d = packing_i_sub(one.p, two.p);
      const double reach = s->reach[i] + s->reach[j];
      packing_i_front_curve curve = {0};
      packing_vec3 c[2];
      int there = packing_i_dot(d, d) <= reach * reach;
      for (int side = 0; side < 2; side++)
        there = there &&
                packing_i_front_curve_init(own, &one, &two, side ? -1 : 1, &curve) &&
                packing_i_front_curve_at(&curve, reference, &c[side]);
      const uint32_t pair = (uint32_t)(i << 16 | j << 1);
      const int given = find(f, pair) < f->c.count;
      seen += given ? 2 : 0;
      if (given != there) { /* at the edge only */
        const double gap = fabs(packing_i_norm(d) - reach);
        const double s2 =
            curve.s2[0] + reference * (curve.s2[1] + reference * curve.s2[2]);
        assert_true(gap < 1e-9 || fabs(s2) < 1e-9);
        continue;
      }
      for (uint32_t side = 0; side < 2 && given; side++) {
        const size_t n = find(f, pair | side);
        assert_true(n < f->c.count);
        assert_near(f->x[n], c[side].x, 1e-6);
        assert_near(f->y[n], c[side].y, 1e-6);
        assert_near(f->z[n], c[side].z, 1e-6);
      }
    }
  assert_int_equal(seen, f->c.count);
}

/* The widest first, of all that could be touched, and the plane before them. */
static void check_caps(const caps *s, const around *of, size_t plane, double reference,
                       double distance)
{
  size_t wanted = 0;
  for (size_t t = 0; t < of->halo.count; t++)
    wanted += t == plane ||
              fabs(of->a[t] + of->b[t] * reference) <=
                  sqrt(of->x[t] * of->x[t] + of->y[t] * of->y[t] + of->z[t] * of->z[t]) *
                      distance;
  assert_int_equal(s->c.count, wanted);
  double before = -3;
  for (size_t n = 0; n < s->c.count; n++) {
    const size_t t = s->halo[n];
    assert_true(s->x[n] == of->x[t] && s->y[n] == of->y[t] && s->z[n] == of->z[t]);
    assert_true(s->top[n] == of->a[t] + of->b[t] * reference);
    assert_true(s->reach[n] == of->r[t] + reference);
    const double cosine = t == plane ? -2 : s->top[n] / (sqrt(s->square[n]) * distance);
    assert_true(before < cosine || (before == cosine && s->halo[n - 1] < t));
    before = cosine;
  }
}

static void caps_by_width(void **state)
{
  (void)state;
  const packing_i_front_kernels *set[3];
  const size_t sets_held = sets(set);
  for (int n = 0; n < 4000; n++) {
    const size_t count = (size_t)n % 41;
    const double own = between(0.5, 1.5), reference = between(0.4, 1);
    const size_t plane = n % 3 == 0 && count > 0 ? count / 2 : PACKING_I_FRONT_NO_BODY;
    around of;
    caps s[3];
    around_fill(&of, count, own);
    for (size_t t = 3; t + 3 < count; t += 5) { /* equal ones go by their number */
      of.x[t] = of.x[t - 1];
      of.y[t] = of.y[t - 1];
      of.z[t] = of.z[t - 1];
      of.a[t] = of.a[t - 1];
      of.b[t] = of.b[t - 1];
    }
    for (size_t k = 0; k < sets_held; k++) {
      caps_init(&s[k], 0);
      set[k]->caps(&of.halo, plane, reference, own + reference, &s[k].c);
      check_caps(&s[k], &of, plane, reference, own + reference);
      assert_int_equal(s[k].c.count, s[0].c.count);
      assert_memory_equal(s[k].halo, s[0].halo, s[0].c.count * sizeof *s->halo);
    }
  }
}

static void pairs_and_sieve(void **state)
{
  (void)state;
  const packing_i_front_kernels *set[3];
  const size_t sets_held = sets(set);
  size_t seen = 0, free_ones = 0;
  for (int n = 0; n < 400; n++) {
    const size_t count = (size_t)n % 41;
    const double own = between(0.5, 1.5), reference = between(0.4, 1);
    around of;
    caps s;
    found *first = NULL;
    around_fill(&of, count, own);
    caps_fill(&s, &of, count, reference);
    for (size_t k = 0; k < sets_held; k++) {
      found *f = found_new();
      set[k]->pairs(&s.c, count, own + reference, &f->c);
      if (k == 0) {
        check_pairs(f, &of, &s, own, reference);
        seen += f->c.count;
      }
      /* What the sieve keeps, by a plain loop. */
      found *want = found_new();
      for (size_t m = 0; m < f->c.count; m++) {
        int free_of = 1;
        for (size_t t = 0; t < count; t++)
          free_of &= f->x[m] * s.x[t] + f->y[m] * s.y[t] + f->z[m] * s.z[t] <= s.room[t];
        if (!free_of)
          continue;
        const size_t at = want->c.count++;
        want->x[at] = f->x[m];
        want->y[at] = f->y[m];
        want->z[at] = f->z[m];
        want->pair[at] = f->pair[m];
      }
      set[k]->sieve(&s.c, &f->c);
      assert_true(same_candidates(f, want));
      free(want);
      if (k == 0) {
        first = f;
        free_ones += f->c.count;
        continue;
      }
      assert_true(same_candidates(first, f));
      free(f);
    }
    free(first);
  }
  assert_true(seen > 10000 && free_ones > 300);
}

/* ---- interval and bounds ---- */

/* The bounds of all bodies, one by one; what is met within a rounding of r counts for neither. */
static void slow_interval(const packing_i_front_curve *curve, const around *of, size_t j,
                          size_t k, double r, double slack,
                          packing_i_front_interval *result)
{
  result->lo = r;
  for (int e = 0; e < 3; e++)
    result->exit[e] = HUGE_VAL;
  for (size_t t = 0; t < of->halo.count; t++) {
    if (t == j || t == k)
      continue;
    const packing_i_front_body body = {packing_i_vec(of->x[t], of->y[t], of->z[t]),
                                       of->a[t], of->b[t]};
    const packing_i_front_bound bound = packing_i_front_curve_bound(curve, &body, r);
    double next = bound.first;
    if (bound.room < -slack) {
      result->lo = fmax(result->lo, bound.first);
      next = bound.second;
    }
    for (int e = 0; e < 3; e++)
      if (next < result->exit[e]) {
        const double later = result->exit[e];
        result->exit[e] = next;
        next = later;
      }
  }
}

static int about(double a, double b)
{
  return a == b || fabs(a - b) <= 1e-7 * fmax(fabs(a), fabs(b));
}

static void interval(void **state)
{
  (void)state;
  const packing_i_front_kernels *set[3];
  const size_t sets_held = sets(set);
  const double cap = 2.5;
  size_t seen = 0, blocked = 0, met = 0;
  for (int n = 0; n < 40000; n++) {
    const size_t count = 2 + (size_t)n % 39;
    const double own = between(0.5, 1.5);
    around of;
    around_fill(&of, count, own);
    const size_t j = (size_t)(packing_rng_uniform(rng) * (double)count),
                 k = (j + 1 + (size_t)n % (count - 1)) % count;
    const packing_i_front_body one = {packing_i_vec(of.x[j], of.y[j], of.z[j]), of.a[j],
                                      of.b[j]},
                               two = {packing_i_vec(of.x[k], of.y[k], of.z[k]), of.a[k],
                                      of.b[k]};
    packing_i_front_curve curve;
    if (!packing_i_front_curve_init(own, &one, &two, n % 2 ? 1 : -1, &curve))
      continue;
    double r = packing_i_front_curve_start(&curve, 0.4);
    if (!(r < 1))
      continue;
    r *= 1 + 1e-6;
    packing_i_front_interval want, got[3];
    slow_interval(&curve, &of, j, k, r, 1e-9, &want);
    for (size_t s = 0; s < sets_held; s++) {
      set[s]->interval(&curve, &of.halo, j, k, r, cap, 1e-9, &got[s]);
      assert_memory_equal(&got[s], &got[0], sizeof got[0]);
    }
    seen++;
    if (want.lo > cap) { /* no radius is left, and it says so */
      assert_true(got[0].lo > cap || got[0].lo == want.lo || got[0].exit[0] <= got[0].lo);
      continue;
    }
    blocked += want.lo > r;
    met += want.exit[0] < cap;
    assert_true(about(got[0].lo, want.lo));
    for (int e = 0; e < 3; e++) {
      if (want.exit[e] < cap)
        assert_true(about(got[0].exit[e], want.exit[e]));
      else
        assert_true(got[0].exit[e] >= cap);
    }
  }
  assert_true(seen > 5000 && blocked > 100 && met > 1000);
}

static void bounds(void **state)
{
  (void)state;
  enum { COLUMNS = 21 };
  const packing_i_front_kernels *set[3];
  const size_t sets_held = sets(set);
  for (size_t count = 0; count <= 40; count++)
    for (int turn = 0; turn < 40; turn++) {
      static double c[3][COLUMNS][MOST] __attribute__((aligned(64)));
      packing_i_front_bound want[MOST];
      for (size_t k = 0; k < COLUMNS; k++)
        taint(c[0][k], 0, MOST);
      for (size_t n = 0; n < count; n++) {
        around of;
        packing_i_front_curve curve;
        double r;
        do {
          around_fill(&of, 3, 1);
          const packing_i_front_body one = {packing_i_vec(of.x[0], of.y[0], of.z[0]),
                                            of.a[0], of.b[0]},
                                     two = {packing_i_vec(of.x[1], of.y[1], of.z[1]),
                                            of.a[1], of.b[1]};
          r = packing_i_front_curve_init(1, &one, &two, 1, &curve)
                  ? packing_i_front_curve_start(&curve, 0.4)
                  : HUGE_VAL;
        } while (!(r < 2));
        r *= 1 + 1e-6;
        const packing_i_front_body body = {packing_i_vec(of.x[2], of.y[2], of.z[2]),
                                           of.a[2], of.b[2]};
        want[n] = packing_i_front_curve_bound(&curve, &body, r);
        const double row[18] = {curve.base.x,
                                curve.base.y,
                                curve.base.z,
                                curve.slope.x,
                                curve.slope.y,
                                curve.slope.z,
                                curve.side.x,
                                curve.side.y,
                                curve.side.z,
                                curve.s2[0],
                                curve.s2[1],
                                curve.s2[2],
                                r,
                                body.p.x,
                                body.p.y,
                                body.p.z,
                                body.a,
                                body.b};
        for (size_t k = 0; k < 18; k++)
          c[0][k][n] = row[k];
      }
      memcpy(c[1], c[0], sizeof c[0]);
      memcpy(c[2], c[0], sizeof c[0]);
      for (size_t s = 0; s < sets_held; s++) {
        packing_i_front_curves curves;
        for (size_t k = 0; k < 3; k++) {
          curves.base[k] = c[s][k];
          curves.slope[k] = c[s][3 + k];
          curves.side[k] = c[s][6 + k];
          curves.s2[k] = c[s][9 + k];
        }
        curves.lo = c[s][12];
        curves.x = c[s][13];
        curves.y = c[s][14];
        curves.z = c[s][15];
        curves.a = c[s][16];
        curves.b = c[s][17];
        curves.room = c[s][18];
        curves.first = c[s][19];
        curves.second = c[s][20];
        set[s]->bounds(&curves, count);
        for (size_t n = 0; n < count; n++) {
          assert_near(c[s][18][n], want[n].room, 1e-9);
          assert_true(about(c[s][19][n], want[n].first));
          assert_true(about(c[s][20][n], want[n].second));
          for (size_t k = 18; k < COLUMNS; k++)
            assert_memory_equal(&c[s][k][n], &c[0][k][n], sizeof(double));
        }
      }
    }
}

static int begin(void **state)
{
  (void)state;
  return packing_rng_create(NULL, 13, PACKING_PURPOSE_USER, 0, &rng) != PACKING_OK;
}

static int end(void **state)
{
  (void)state;
  packing_rng_destroy(rng);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gather),        cmocka_unit_test(bodies),
      cmocka_unit_test(caps_by_width), cmocka_unit_test(pairs_and_sieve),
      cmocka_unit_test(interval),      cmocka_unit_test(bounds),
  };
  return cmocka_run_group_tests(tests, begin, end);
}
