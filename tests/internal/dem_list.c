/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stepper's lists against all pairs, one by one, in scenes made to be nasty: when they are
 * made, and in every step while the particles fly about. There are no forces, so particles pass
 * through each other and leave the box where it is not periodic. */
#include "dem/stepper_internal.h"
#include "dem_scenes.h"

typedef struct plan {
  const char *name;
  int dim;
  unsigned periodic;
  packing_vec3 size, corner;
  size_t count;
  double r_min, r_max;
  double reach;   /* of a law of distance, 0: none */
  unsigned level; /* bit k: all stand at one place along axis k */
  double lattice; /* > 0: places are whole multiples of it, all different */
} plan;

static const double speed = 1;

static void nothing(void *user, const packing_contact_batch *batch)
{
  (void)user;
  (void)batch;
}

static packing_domain *container(const plan *p)
{
  packing_domain *domain = NULL;
  if (p->dim == 2) {
    packing_domain_rectangle_def def;
    packing_domain_rectangle_def_init(&def);
    def.size_x = p->size.x;
    def.size_y = p->size.y;
    def.corner = p->corner;
    def.periodic = p->periodic;
    assert_ok(packing_domain_create_rectangle(NULL, &def, &domain));
    return domain;
  }
  packing_domain_box_def def;
  packing_domain_box_def_init(&def);
  def.size = p->size;
  def.corner = p->corner;
  def.periodic = p->periodic;
  assert_ok(packing_domain_create_box(NULL, &def, &domain));
  return domain;
}

static double place(const plan *p, size_t k, int axis, uint64_t *random)
{
  const double size = packing_i_component(p->size, axis);
  double at = (0.001 + 0.998 * dem_random(random)) * size;
  if (axis >= p->dim)
    return 0;
  if (p->level >> axis & 1)
    at = 0.5 * size;
  if (p->lattice > 0) {
    const size_t n = (size_t)(size / p->lattice - 0.5);
    for (int before = 0; before < axis; before++)
      k /= n;
    at = (double)(1 + k % n) * p->lattice;
  }
  return packing_i_component(p->corner, axis) + at;
}

static void populate(dem_scene *s, const plan *p, uint64_t *random)
{
  for (size_t k = 0; k < p->count; k++) {
    dem_body b = {.r = p->r_min * pow(p->r_max / p->r_min, dem_random(random))};
    b.x = dem_vec(place(p, k, 0, random), place(p, k, 1, random), place(p, k, 2, random));
    double v[3] = {0, 0, 0};
    for (int axis = 0; axis < p->dim; axis++)
      if (!(p->level >> axis & 1))
        v[axis] = speed * (2 * dem_random(random) - 1);
    b.v = dem_vec(v[0], v[1], v[2]);
    dem_add(s, &b);
  }
}

static void begin(dem_scene *s, const plan *p, int threads, uint64_t seed)
{
  dem_scene_init(s, container(p));
  s->context = test_context(threads, PACKING_ISA_AUTO);
  dem_material(s, 1, 1e-9, 0, 0, 0); /* so soft that any step is short */
  if (p->reach > 0) {
    packing_law_custom_def def;
    packing_law *law = NULL;
    packing_law_custom_def_init(&def);
    def.evaluate = nothing;
    def.reach = p->reach;
    assert_ok(packing_law_create_custom(NULL, &def, &law));
    dem_law(s, law);
  }
  populate(s, p, &seed);
  s->def.max_start_overlap = 1e9;
  s->def.dt = 0.03 * p->r_min / speed;
  dem_start(s);
}

static double distance2(const packing_dem *dem, const double *positions, size_t i,
                        size_t j)
{
  const double *a = positions + PACKING_I_POSITION * i;
  const double *b = positions + PACKING_I_POSITION * j;
  const packing_vec3 d = packing_i_domain_separation(
      dem->domain, packing_i_vec(a[0], a[1], a[2]), packing_i_vec(b[0], b[1], b[2]));
  return packing_i_dot(d, d);
}

static int slab_of(const packing_dem *dem, size_t p)
{
  for (int s = 0; s < dem->cut.slabs; s++)
    if (p - dem->slab[s].first < dem->slab[s].count)
      return s;
  fail_msg("particle %zu is in no slab", p);
  return 0;
}

/* listed[i * count + j], i < j, counts; no slab may touch more than itself and the next, and no
 * two that work at the same time may touch one. */
static void collect(const packing_dem *dem, unsigned char *listed)
{
  const int slabs = dem->cut.slabs;
  assert_true(!dem->cut.ring || (slabs >= 4 && slabs % 2 == 0));
  memset(listed, 0, dem->count * dem->count);
  for (int s = 0; s < slabs; s++) {
    const packing_i_slab *slab = &dem->slab[s];
    assert_true(slab->list_count <= slab->list_room);
    for (size_t k = slab->list_first; k < slab->list_first + slab->list_count; k++) {
      const size_t i = dem->list_i[k], j = dem->list_j[k];
      assert_true(i < dem->count && j < dem->count && i != j);
      assert_int_equal(slab_of(dem, i), s);
      const int t = slab_of(dem, j);
      assert_true(t == s || t == s + 1 || (dem->cut.ring && s == slabs - 1 && t == 0));
      listed[(i < j ? i : j) * dem->count + (i < j ? j : i)]++;
    }
  }
}

/* Each pair that was near enough when the list was made is there once, no other, up to rounding;
 * each that touches now is there. */
static size_t check_pairs(const packing_dem *dem, unsigned char *listed)
{
  size_t touching = 0, wrong = 0;
  collect(dem, listed);
  for (size_t i = 0; i < dem->count; i++)
    for (size_t j = i + 1; j < dem->count; j++) {
      const double ri = dem->position[PACKING_I_POSITION * i + 3],
                   rj = dem->position[PACKING_I_POSITION * j + 3];
      const double range = packing_i_dem_range(dem, ri, rj);
      const double then = sqrt(distance2(dem, dem->built, i, j)) / range;
      const double near = fmax(ri + rj, dem->reach);
      const unsigned times = listed[i * dem->count + j];
      const int touches = distance2(dem, dem->position, i, j) < near * near;
      wrong += times > 1 || (touches && times == 0) ||
               (fabs(then - 1) > 1e-9 && times != (then < 1));
      touching += (size_t)touches;
    }
  assert_int_equal(wrong, 0);
  return touching;
}

static void check_walls(const packing_dem *dem)
{
  for (size_t p = 0; p < dem->count; p++) {
    const packing_i_slab *slab = &dem->slab[slab_of(dem, p)];
    const double *at = dem->position + PACKING_I_POSITION * p;
    const packing_vec3 x = packing_i_vec(at[0], at[1], at[2]);
    packing_i_near_wall near[PACKING_I_NEAR_WALLS];
    size_t found = 0;
    for (size_t k = slab->first; k < slab->first + slab->wall_count; k++)
      found += dem->near_wall[k] == p;
    assert_true(found <= 1);
    if (packing_i_domain_near_walls(dem->domain, &x, at[3], near) > 0)
      assert_int_equal(found, 1);
  }
}

/* What the report says of the contacts of its last step, from the store before it. */
static void check_report(const dem_scene *s, const packing_dem_report *report,
                         size_t touching)
{
  if (s->dem->reach > 0)
    return;
  assert_int_equal(report->contacts, touching);
}

static void try_plan(const plan *p, int threads, uint64_t seed)
{
  dem_scene s;
  begin(&s, p, threads, seed);
  unsigned char *listed = malloc(p->count * p->count);
  assert_non_null(listed);
  size_t touching = check_pairs(s.dem, listed);
  for (int k = 0; k < 12; k++) {
    const packing_dem_report report = dem_run(&s, 1);
    check_report(&s, &report, touching);
    touching = check_pairs(s.dem, listed);
    check_walls(s.dem);
    /* Far away, then on. */
    if (k % 4 == 3) {
      dem_run(&s, k < 8 ? 40 : 300);
      touching = check_pairs(s.dem, listed);
    }
  }
  free(listed);
  dem_scene_free(&s);
}

static const plan plans[] = {
    {"a pair", 3, 0, {1, 1, 1}, {0, 0, 0}, 2, 0.1, 0.1, 0, 0, 0},
    {"alone", 3, 7, {1, 1, 1}, {0, 0, 0}, 1, 0.1, 0.1, 0, 0, 0},
    {"at one height", 3, 0, {1, 1, 1}, {0, 0, 0}, 400, 0.01, 0.02, 0, 4, 0},
    {"in a row", 3, 1, {1, 1, 1}, {0, 0, 0}, 400, 0.001, 0.02, 0, 6, 0},
    {"sizes 1 to 30", 3, 0, {1, 1, 1}, {0, 0, 0}, 500, 0.005, 0.15, 0, 0, 0},
    {"sizes 1 to 30, periodic", 3, 7, {1, 1, 1}, {0, 0, 0}, 500, 0.005, 0.15, 0, 0, 0},
    {"sizes 1 to 3000", 3, 5, {1, 1, 1}, {0, 0, 0}, 500, 5e-5, 0.15, 0, 0, 0},
    {"two interaction distances", 3, 7, {1, 1, 1}, {-7, 3, 0}, 300, 0.02, 0.25, 0, 0, 0},
    {"barely more", 3, 7, {1.1, 1.2, 1.05}, {0, 0, 0}, 300, 0.24, 0.25, 0, 0, 0},
    {"one direction", 3, 2, {1, 1, 1}, {0, 0, 0}, 300, 0.02, 0.25, 0, 0, 0},
    {"a thin wire", 3, 1, {20, 0.5, 0.5}, {0, 0, 0}, 500, 0.02, 0.12, 0, 0, 0},
    {"an open wire", 3, 6, {20, 0.5, 0.5}, {0, 0, 0}, 500, 0.02, 0.12, 0, 0, 0},
    {"a ring of all", 3, 7, {1, 9, 1}, {0, 0, 0}, 600, 0.02, 0.25, 0, 0, 0},
    {"flat", 2, 0, {1, 1, 0}, {0, 0, 0}, 600, 0.005, 0.05, 0, 0, 0},
    {"flat, periodic", 2, 3, {1, 4, 0}, {0, 0, 0}, 600, 0.005, 0.1, 0, 0, 0},
    {"far reach", 3, 1, {1, 1, 1}, {0, 0, 0}, 400, 0.005, 0.02, 0.3, 0, 0},
    {"far reach, two cells", 3, 7, {1, 1, 1}, {0, 0, 0}, 300, 0.005, 0.02, 0.5, 0, 0},
    {"reach of small ones", 3, 3, {1, 1, 1}, {0, 0, 0}, 400, 0.005, 0.15, 0.04, 0, 0},
    {"lattice", 3, 7, {1, 1, 1}, {0, 0, 0}, 340, 0.0625, 0.0625, 0, 0, 0.125},
    {"open lattice", 3, 0, {1, 1, 1}, {0, 0, 0}, 500, 0.05, 0.05, 0, 0, 0.1},
    {"far from 0", 3, 4, {1, 1, 2}, {4e5, -7e5, 1e6}, 500, 0.005, 0.1, 0, 0, 0},
};

static void lists_hold_all_pairs(void **state)
{
  (void)state;
  for (size_t k = 0; k < sizeof plans / sizeof *plans; k++)
    try_plan(&plans[k], 1 + (int)(k % 2), 1000 + k);
}

/* Rings of all lengths, so that the number of slabs goes from 1 through all that may be. */
static void rings_of_any_length(void **state)
{
  (void)state;
  for (int k = 0; k < 24; k++) {
    plan p = {"ring", 3, 1, {0, 0.3, 0.3}, {0, 0, 0}, 400, 0.02, 0.1, 0, 0, 0};
    p.size.x = 0.4 + 0.0917 * k;
    try_plan(&p, 1, (uint64_t)k);
  }
}

/* A wire that shortens: the number of slabs changes while contacts are counted. */
static void contacts_are_counted_when_slabs_change(void **state)
{
  (void)state;
  const plan p = {"wire", 3, 0, {4, 0.5, 0.5}, {0, 0, 0}, 500, 0.05, 0.1, 0, 0, 0};
  dem_scene s;
  int changes = 0;
  begin(&s, &p, 1, 7);
  for (size_t k = 0; k < p.count; k++) {
    dem_body b = dem_get(&s, k);
    b.v = dem_vec(1.5 * (2 - b.x.x), 0, 0);
    dem_put(&s, k, &b);
  }
  assert_ok(packing_dem_reload(s.dem));
  unsigned char *listed = malloc(p.count * p.count);
  assert_non_null(listed);
  for (int k = 0; k < 200; k++) {
    const int slabs = s.dem->cut.slabs;
    const size_t touching = check_pairs(s.dem, listed);
    const packing_dem_report report = dem_run(&s, 1);
    assert_int_equal(report.contacts, touching);
    changes += s.dem->cut.slabs != slabs;
  }
  assert_true(changes > 0);
  free(listed);
  dem_scene_free(&s);
}

/* A large sphere alone in its slab, right below a slab full of small ones, has hundreds of
 * neighbours: no reason to set aside as many for each small one. */
static void room_goes_by_pairs(void **state)
{
  (void)state;
  const double large = 10, small = 0.5;
  dem_scene s;
  dem_scene_init(&s, test_box(22, 22, 200, 0));
  dem_material(&s, 1, 1, 0.25, 0, 0);
  dem_hertz(&s, 0);
  dem_body b = {.x = {1, 1, 1}, .v = {100, 0, 0}, .r = small}; /* for a thick skin */
  dem_add(&s, &b);
  b = (dem_body){.x = {11, 11, 19.9}, .r = large};
  dem_add(&s, &b);
  const packing_vec3 middle = b.x;
  b.r = small;
  for (int k = 0; k < 21 * 21 * 46; k++) {
    b.x = dem_vec(1 + k % 21, 1 + k / 21 % 21, 23.5 + k / 441);
    if (packing_i_norm(packing_i_sub(b.x, middle)) > large + small)
      dem_add(&s, &b);
  }
  s.def.dt = 1e-3;
  dem_start(&s);
  size_t pairs = 0;
  for (int k = 0; k < s.dem->cut.slabs; k++)
    pairs += s.dem->slab[k].list_count;
  assert_true(s.dem->slab[0].count == 2 && s.dem->slab[0].list_count > 500);
  assert_true(s.dem->list_capacity < 7 * pairs);
  dem_scene_free(&s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lists_hold_all_pairs),
      cmocka_unit_test(rings_of_any_length),
      cmocka_unit_test(room_goes_by_pairs),
      cmocka_unit_test(contacts_are_counted_when_slabs_change),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
