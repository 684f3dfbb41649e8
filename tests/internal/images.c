/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pairs with all their images against every image there is, tried one by one. */
#include "test.h"
#include "measure/images.h"

enum { MOST = 60, RUNS = 400, MOST_PAIRS = 400000 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  double edge[3];
  unsigned periodic;
  packing_view view;
  packing_domain *domain;
} pack;

typedef struct list {
  double factor, gap;
  size_t count;
  packing_i_image *pairs;
} list;

static list new_list(double factor, double gap)
{
  list l = {factor, gap, 0, malloc(MOST_PAIRS * sizeof *l.pairs)};
  assert_non_null(l.pairs);
  return l;
}

static int within(const list *l, const packing_i_image *p)
{
  return p->distance <= (p->r_i + p->r_j) * l->factor + l->gap;
}

static void keep(void *arg, const packing_i_image *p)
{
  list *l = arg;
  if (!within(l, p))
    return;
  assert_true(l->count < MOST_PAIRS);
  l->pairs[l->count++] = *p;
}

static int by_pair(const void *a, const void *b)
{
  const packing_i_image *p = a, *q = b;
  if (p->i != q->i)
    return p->i < q->i ? -1 : 1;
  if (p->j != q->j)
    return p->j < q->j ? -1 : 1;
  for (int k = 0; k < 3; k++)
    if (p->image[k] != q->image[k])
      return p->image[k] < q->image[k] ? -1 : 1;
  return 0;
}

/* Run k: dimension, periodic directions, width of the cell in diameters (a tenth to ten), spread
 * of sizes and number of particles differ. */
static void draw(pack *p, unsigned k)
{
  packing_rng *rng = NULL;
  assert_ok(packing_rng_create(NULL, k, PACKING_PURPOSE_USER, 0, &rng));
  const int flat = k % 5 == 0;
  const size_t count = 1 + packing_rng_below(rng, k % 3 == 0 ? 4 : MOST);
  const double spread = pow(10, (k % 4) - 1.0);
  p->periodic = k / 5 % 8 & (flat ? 3U : 7U);
  for (int a = 0; a < 3; a++)
    p->edge[a] = 2 * pow(10, packing_rng_uniform(rng) * (count < 5 ? 2 : 1) - 1);
  p->domain = flat ? test_rectangle(p->edge[0], p->edge[1], p->periodic)
                   : test_box(p->edge[0], p->edge[1], p->edge[2], p->periodic);
  for (size_t i = 0; i < count; i++) {
    p->x[i] = p->edge[0] * packing_rng_uniform(rng);
    p->y[i] = p->edge[1] * packing_rng_uniform(rng);
    p->z[i] = flat ? 0 : p->edge[2] * packing_rng_uniform(rng);
    p->r[i] = (k % 4 == 0 ? 1 : pow(spread, -packing_rng_uniform(rng))) *
              (count < 5 ? 1 : 0.25);
  }
  packing_rng_destroy(rng);
  packing_view_init_arrays(&p->view, count, p->x, p->y, p->z, p->r);
}

static int is_backward(const packing_i_image *p)
{
  for (int k = 0; k < 3; k++)
    if (p->image[k] != 0)
      return p->image[k] < 0;
  return 1; /* nothing with itself */
}

static void try_pair(const pack *p, list *l, size_t i, size_t j, const int *most)
{
  for (int a = -most[0]; a <= most[0]; a++)
    for (int b = -most[1]; b <= most[1]; b++)
      for (int c = -most[2]; c <= most[2]; c++) {
        const packing_vec3 d = {p->x[j] - p->x[i] + a * p->edge[0],
                                p->y[j] - p->y[i] + b * p->edge[1],
                                p->z[j] - p->z[i] + c * p->edge[2]};
        const packing_i_image pair = {i,
                                      j,
                                      d,
                                      sqrt(d.x * d.x + d.y * d.y + d.z * d.z),
                                      p->r[i],
                                      p->r[j],
                                      {(int16_t)a, (int16_t)b, (int16_t)c}};
        if (i != j || !is_backward(&pair))
          keep(l, &pair);
      }
}

/* The same pairs with the same bits. */
static void assert_same(const list *a, const list *b)
{
  assert_int_equal(a->count, b->count);
  for (size_t k = 0; k < a->count; k++) {
    const packing_i_image *p = &a->pairs[k], *q = &b->pairs[k];
    assert_int_equal(by_pair(p, q), 0);
    assert_true(p->distance == q->distance && p->r_i == q->r_i && p->r_j == q->r_j);
    assert_true(p->d.x == q->d.x && p->d.y == q->d.y && p->d.z == q->d.z);
  }
}

static list visit(const pack *p, double factor, double gap, int *many)
{
  packing_i_images *images = NULL;
  list l = new_list(factor, gap);
  assert_ok(packing_i_images_create(NULL, p->domain, &p->view, factor, gap, &images));
  for (size_t b = 0; b < packing_i_images_blocks(images); b++)
    packing_i_images_visit(images, b, keep, &l);
  *many = packing_i_images_are_many(images);
  packing_i_images_destroy(images);
  qsort(l.pairs, l.count, sizeof *l.pairs, by_pair);
  return l;
}

static void every_image_is_met_once(void **state)
{
  (void)state;
  static const double factors[] = {1, 1.05, 0, 1, 2};
  size_t several = 0, own = 0, far = 0, narrow = 0;
  pack p;
  for (unsigned k = 0; k < RUNS; k++) {
    int most[3] = {0, 0, 0}, many = 0;
    draw(&p, k);
    const double factor = factors[k % 5], gap = k % 5 == 2 ? 1.25 : k % 5 == 3 ? 0.4 : 0;
    double r_max = 0;
    for (size_t i = 0; i < p.view.count; i++)
      r_max = fmax(r_max, p.r[i]);
    for (int a = 0; a < 3; a++)
      if (p.periodic & 1U << a)
        most[a] = (int)((2 * r_max * factor + gap) / p.edge[a]) + 2;
    list want = new_list(factor, gap), got = visit(&p, factor, gap, &many);
    for (size_t i = 0; i < p.view.count; i++)
      for (size_t j = i; j < p.view.count; j++)
        try_pair(&p, &want, i, j, most);
    qsort(want.pairs, want.count, sizeof *want.pairs, by_pair);
    assert_same(&got, &want);
    narrow += (size_t)many;
    for (size_t n = 0; n < got.count; n++) {
      const packing_i_image *q = &got.pairs[n];
      own += (size_t)(q->i == q->j);
      far += (size_t)(abs(q->image[0]) > 1);
      several += (size_t)(n > 0 && q->i == q[-1].i && q->j == q[-1].j);
      assert_true(many || q->i != q->j);
    }
    free(want.pairs);
    free(got.pairs);
    packing_domain_destroy(p.domain);
  }
  assert_true(own > 1000 && far > 1000 && several > 1000);
  assert_true(narrow > RUNS / 4 && narrow < 3 * RUNS / 4);
}

/* Centres outside the cell are those inside it, moved. */
static void centres_outside_the_cell_are_wrapped(void **state)
{
  (void)state;
  pack p;
  int many = 0;
  draw(&p, 38); /* periodic along x, y and z */
  assert_int_equal(p.periodic, 7);
  list inside = visit(&p, 1, 0.5, &many);
  for (size_t i = 0; i < p.view.count; i += 3) {
    p.x[i] += 3 * p.edge[0];
    p.z[i] -= 2 * p.edge[2];
  }
  list outside = visit(&p, 1, 0.5, &many);
  assert_true(inside.count > 20);
  assert_int_equal(inside.count, outside.count);
  for (size_t k = 0; k < inside.count; k++) {
    assert_int_equal(by_pair(&inside.pairs[k], &outside.pairs[k]), 0);
    assert_near(inside.pairs[k].distance, outside.pairs[k].distance, 1e-14 * 40);
  }
  free(inside.pairs);
  free(outside.pairs);
  packing_domain_destroy(p.domain);
}

static void count_pair(void *arg, const packing_i_image *p)
{
  *(size_t *)arg += (size_t)(p->distance <= p->r_i + p->r_j);
}

/* Two diameters wide and long: three contacts a particle, by two images each across. Would take
 * an hour if the cost were that of all pairs. */
static void a_long_narrow_column_stays_linear(void **state)
{
  (void)state;
  enum { LENGTH = 40000, COUNT = 4 * LENGTH };
  double *c = malloc(4 * COUNT * sizeof *c);
  packing_i_images *images = NULL;
  packing_view v;
  size_t found = 0;
  assert_non_null(c);
  packing_domain *column = test_box(2, 2, LENGTH, 7);
  for (int i = 0; i < COUNT; i++) {
    c[i] = i % 2;
    c[COUNT + i] = i / 2 % 2;
    c[2 * COUNT + i] = i / 4;
    c[3 * COUNT + i] = 0.5;
  }
  packing_view_init_arrays(&v, COUNT, c, c + COUNT, c + 2 * COUNT, c + 3 * COUNT);
  assert_ok(packing_i_images_create(NULL, column, &v, 1, 0, &images));
  for (size_t b = 0; b < packing_i_images_blocks(images); b++)
    packing_i_images_visit(images, b, count_pair, &found);
  assert_int_equal(found, 3 * COUNT);
  packing_i_images_destroy(images);
  packing_domain_destroy(column);
  free(c);
}

static void reaches_that_are_no_reach_are_refused(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_i_images *images = NULL;
  pack p;
  draw(&p, 38);
  assert_fails(context,
               packing_i_images_create(context, p.domain, &p.view, -1, 0, &images),
               PACKING_ERR_RANGE, "factor");
  assert_fails(
      context,
      packing_i_images_create(context, p.domain, &p.view, 1, (double)NAN, &images),
      PACKING_ERR_INVALID, "gap");
  assert_fails(context,
               packing_i_images_create(context, p.domain, &p.view, 1, 1e6, &images),
               PACKING_ERR_RANGE, "gap");
  assert_fails(context, packing_i_images_create(context, p.domain, NULL, 1, 0, &images),
               PACKING_ERR_INVALID, "view");
  assert_null(images);
  packing_i_images_destroy(NULL);
  packing_domain_destroy(p.domain);
  packing_context_destroy(context);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_image_is_met_once),
      cmocka_unit_test(centres_outside_the_cell_are_wrapped),
      cmocka_unit_test(a_long_narrow_column_stays_linear),
      cmocka_unit_test(reaches_that_are_no_reach_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
