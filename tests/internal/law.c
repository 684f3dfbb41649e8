/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kernels of the laws against the paper's equations, on every instruction set. */
#include "dem/dem_internal.h"
#include "test.h"

enum { ROOM = 272, GUARD = 8, KINDS = 3 };

/* A batch and the room it lies in. */
typedef struct scene {
  _Alignas(64) double nx[ROOM], ny[ROOM], nz[ROOM];
  double distance[ROOM], overlap[ROOM], reduced_r[ROOM], reduced_m[ROOM], approach[ROOM];
  double ux[ROOM], uy[ROOM], uz[ROOM], normal[ROOM], fx[ROOM], fy[ROOM], fz[ROOM];
  uint32_t pair[ROOM];
  packing_pair_material materials[KINDS];
  packing_contact_batch batch;
} scene;

static double uniform(uint64_t *state)
{
  *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (double)(*state >> 11) * 0x1p-53;
}

static double between(uint64_t *state, double low, double high)
{
  return low + (high - low) * uniform(state);
}

static void wire(scene *s, size_t count, int by_pair)
{
  s->batch = (packing_contact_batch){.struct_size = sizeof s->batch,
                                     .count = count,
                                     .dt = 1e-4,
                                     .nx = s->nx,
                                     .ny = s->ny,
                                     .nz = s->nz,
                                     .distance = s->distance,
                                     .overlap = s->overlap,
                                     .reduced_r = s->reduced_r,
                                     .reduced_m = s->reduced_m,
                                     .approach = s->approach,
                                     .ux = s->ux,
                                     .uy = s->uy,
                                     .uz = s->uz,
                                     .pair = by_pair ? s->pair : NULL,
                                     .materials = s->materials,
                                     .normal = s->normal,
                                     .fx = s->fx,
                                     .fy = s->fy,
                                     .fz = s->fz};
}

/* Contacts over some decades, with forces of earlier laws; beyond `count` harmless numbers. */
static void fill(scene *s, size_t count, int by_pair, uint64_t seed)
{
  uint64_t state = seed;
  memset(s, 0, sizeof *s);
  wire(s, count, by_pair);
  for (int m = 0; m < KINDS; m++)
    s->materials[m] = (packing_pair_material){pow(10, between(&state, 5, 9)),
                                              between(&state, 0, 0.7), uniform(&state)};
  for (size_t k = 0; k < ROOM; k++) {
    const double r = pow(10, between(&state, -4, 0));
    s->nx[k] = 1;
    s->overlap[k] = k < count ? r * pow(10, between(&state, -8, -1)) : 0;
    s->distance[k] = 2 * r - s->overlap[k];
    s->reduced_r[k] = r / 2;
    s->reduced_m[k] = r * r * r * between(&state, 100, 9000);
    s->approach[k] = between(&state, -2, 2);
    s->ux[k] = 0;
    s->uy[k] = between(&state, -1, 1);
    s->uz[k] = between(&state, -1, 1) * pow(10, between(&state, -9, 0));
    s->pair[k] = (uint32_t)(KINDS * uniform(&state));
    s->normal[k] = between(&state, -3, 3);
    s->fx[k] = between(&state, -3, 3);
    s->fy[k] = between(&state, -3, 3);
    s->fz[k] = between(&state, -3, 3);
  }
}

/* Forces to compare: normal, fx, fy, fz. */
static double *force(scene *s, int a)
{
  double *const all[] = {s->normal, s->fx, s->fy, s->fz};
  return all[a];
}

static void run(const packing_law *law, packing_isa isa, scene *s)
{
  law->ops->kernel(law, isa)(law->user, &s->batch);
}

static packing_law *hertz(int pull)
{
  packing_law_hertz_def def;
  packing_law *law = NULL;
  packing_law_hertz_def_init(&def);
  def.pull = pull;
  assert_ok(packing_law_create_hertz(NULL, &def, &law));
  return law;
}

static packing_law *sliding(double slip_velocity)
{
  packing_law_sliding_def def;
  packing_law *law = NULL;
  packing_law_sliding_def_init(&def);
  def.slip_velocity = slip_velocity;
  assert_ok(packing_law_create_sliding(NULL, &def, &law));
  return law;
}

static packing_law *near_field(double a1, double b1, double a2, double b2, double cutoff)
{
  packing_law_near_field_def def;
  packing_law *law = NULL;
  packing_law_near_field_def_init(&def);
  def.attraction = a1;
  def.attraction_exponent = b1;
  def.repulsion = a2;
  def.repulsion_exponent = b2;
  def.cutoff = cutoff;
  assert_ok(packing_law_create_near_field(NULL, &def, &law));
  return law;
}

static const packing_pair_material *material(const scene *s, size_t k)
{
  return &s->materials[s->batch.pair == NULL ? 0 : s->pair[k]];
}

/* Equations 7 and 10 as the paper has them, but for the sign of the overlap. */
static void hertz_follows_the_equations(void **state)
{
  (void)state;
  static scene s, before;
  for (int pull = 0; pull < 2; pull++)
    for (int by_pair = 0; by_pair < 2; by_pair++) {
      packing_law *law = hertz(pull);
      fill(&s, 256, by_pair, 11);
      before = s;
      run(law, PACKING_ISA_BASELINE, &s);
      int cut = 0;
      for (size_t k = 0; k < 256; k++) {
        const packing_pair_material *m = material(&s, k);
        const double delta = s.overlap[k], r = s.reduced_r[k], mass = s.reduced_m[k];
        const double elastic = 4.0 / 3.0 * sqrt(r) * m->young * pow(delta, 1.5);
        const double c =
            2 * m->damping * sqrt(2 * m->young * mass * sqrt(r)) * pow(delta, 0.25);
        double push = elastic + c * s.approach[k];
        if (push < 0)
          cut++;
        if (push < 0 && !pull)
          push = 0;
        assert_near(s.normal[k], before.normal[k] + push,
                    1e-14 * (elastic + c * fabs(s.approach[k]) + fabs(s.normal[k])));
      }
      assert_true(cut > 20 && cut < 236);
      for (int a = 1; a < 4; a++)
        assert_memory_equal(force(&s, a), force(&before, a), sizeof s.fx);
      packing_law_destroy(law);
    }
}

/* Equations 12 to 15, with the regularised direction. */
static void sliding_follows_the_equations(void **state)
{
  (void)state;
  static scene s, before;
  packing_law *law = sliding(0.01);
  for (int by_pair = 0; by_pair < 2; by_pair++) {
    fill(&s, 256, by_pair, 12);
    before = s;
    run(law, PACKING_ISA_BASELINE, &s);
    for (size_t k = 0; k < 256; k++) {
      const double u = hypot(hypot(s.ux[k], s.uy[k]), s.uz[k]);
      const double f = material(&s, k)->friction * fabs(s.normal[k]) / hypot(u, 0.01);
      assert_near(s.fx[k] - before.fx[k], f * s.ux[k], 1e-15 * (f + 3));
      assert_near(s.fy[k] - before.fy[k], f * s.uy[k], 1e-15 * (f + 3));
      assert_near(s.fz[k] - before.fz[k], f * s.uz[k], 1e-15 * (f + 3));
    }
    assert_memory_equal(s.normal, before.normal, sizeof s.normal);
  }
  packing_law_destroy(law);
}

static void sliding_has_its_limits(void **state)
{
  (void)state;
  static scene s;
  packing_law *law = sliding(0.25);
  memset(&s, 0, sizeof s);
  wire(&s, 4, 0);
  s.materials[0].friction = 0.5;
  s.normal[0] = 8; /* at rest: none */
  s.normal[1] = 8, s.ux[1] = 1e9;
  s.normal[2] = -8, s.uy[2] = 0.25; /* what pulls rubs too */
  s.normal[3] = 8, s.uz[3] = -1e200;
  run(law, PACKING_ISA_AUTO, &s);
  assert_true(s.fx[0] == 0 && s.fy[0] == 0 && s.fz[0] == 0);
  assert_close(s.fx[1], 4.0, 1e-15);
  assert_close(s.fy[2], 4 / sqrt(2), 1e-15);
  assert_true(isfinite(s.fz[3]));
  packing_law_destroy(law);
  /* The smallest velocity that is taken still divides nothing by 0. */
  law = sliding(1.5e-154);
  s.fx[0] = s.fy[0] = s.fz[0] = 0;
  run(law, PACKING_ISA_AUTO, &s);
  assert_true(s.fx[0] == 0 && s.fy[0] == 0 && s.fz[0] == 0);
  packing_law_destroy(law);
}

static const int sets[] = {PACKING_ISA_AVX2, PACKING_ISA_AVX512, PACKING_ISA_AUTO};

/* All of [0, count); what lies beyond the next multiple of 8 is never touched. */
static void same_bytes(const packing_law *law, size_t count, int by_pair)
{
  static scene plain, vector, before;
  fill(&plain, count, by_pair, 100 + count);
  before = plain;
  run(law, PACKING_ISA_BASELINE, &plain);
  const size_t padded = (count + 7) / 8 * 8;
  for (int a = 0; a < 4; a++)
    assert_memory_equal(force(&plain, a) + padded, force(&before, a) + padded,
                        GUARD * sizeof(double));
  for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
    if (!packing_isa_available((packing_isa)sets[i]))
      continue;
    vector = before;
    wire(&vector, count, by_pair);
    run(law, (packing_isa)sets[i], &vector);
    for (int a = 0; a < 4; a++) {
      assert_memory_equal(force(&vector, a), force(&plain, a), count * sizeof(double));
      assert_memory_equal(force(&vector, a) + padded, force(&before, a) + padded,
                          GUARD * sizeof(double));
    }
  }
}

static void instruction_sets_agree(void **state)
{
  (void)state;
  packing_law *laws[] = {hertz(0), hertz(1), sliding(1e-3),
                         near_field(1, 2, 0.5, 3.5, 0.3)};
  for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
    for (size_t count = 0; count <= 40; count++)
      for (int by_pair = 0; by_pair < 2; by_pair++)
        same_bytes(laws[i], count, by_pair);
    same_bytes(laws[i], 256, 0);
    same_bytes(laws[i], 256, 1);
    packing_law_destroy(laws[i]);
  }
}

static void one_material_is_a_table_of_one(void **state)
{
  (void)state;
  static scene one, table;
  packing_law *laws[] = {hertz(0), sliding(1e-3)};
  for (int i = 0; i < 2; i++) {
    fill(&one, 100, 0, 5);
    table = one;
    wire(&table, 100, 1);
    memset(table.pair, 0, sizeof table.pair);
    run(laws[i], PACKING_ISA_AUTO, &one);
    run(laws[i], PACKING_ISA_AUTO, &table);
    for (int a = 0; a < 4; a++)
      assert_memory_equal(force(&one, a), force(&table, a), 100 * sizeof(double));
    packing_law_destroy(laws[i]);
  }
}

/* The cut is of the law's own force. */
static void pull_is_cut_off(void **state)
{
  (void)state;
  static scene s;
  for (int pull = 0; pull < 2; pull++) {
    packing_law *law = hertz(pull);
    memset(&s, 0, sizeof s);
    wire(&s, 2, 0);
    s.materials[0] = (packing_pair_material){3, 0.5, 0};
    for (size_t k = 0; k < 2; k++) {
      s.reduced_r[k] = s.overlap[k] = s.reduced_m[k] = 1;
      s.normal[k] = 7;
    }
    s.approach[0] = -100;
    run(law, PACKING_ISA_AUTO, &s);
    assert_near(s.normal[0], pull ? 7 + 4 - 100 * sqrt(6) : 7, 1e-12);
    assert_close(s.normal[1], 7.0 + 4, 1e-15);
    packing_law_destroy(law);
  }
}

/* What is no number must be seen later on, not be cut off. */
static void nan_is_not_hidden(void **state)
{
  (void)state;
  static scene s;
  packing_law *laws[] = {hertz(0), hertz(1), sliding(1)};
  for (int i = 0; i < 3; i++)
    for (int set = PACKING_ISA_BASELINE; set < PACKING_ISA_END; set++) {
      if (!packing_isa_available((packing_isa)set))
        continue;
      fill(&s, 16, 0, 3);
      s.approach[5] = s.uy[5] = (double)NAN;
      run(laws[i], (packing_isa)set, &s);
      for (size_t k = 0; k < 16; k++)
        assert_int_equal(isnan(i < 2 ? s.normal[k] : s.fy[k]) != 0, k == 5);
    }
  for (int i = 0; i < 3; i++)
    packing_law_destroy(laws[i]);
}

/* All lengths times 2^7: forces too, bit for bit. */
static void lengths_scale(void **state)
{
  (void)state;
  static scene s, large;
  const double by = 128;
  packing_law *laws[] = {hertz(0), hertz(1), sliding(1e-3)};
  packing_law *large_laws[] = {hertz(0), hertz(1), sliding(1e-3 * by)};
  for (int i = 0; i < 3; i++) {
    fill(&s, 200, 1, 77);
    large = s;
    wire(&large, 200, 1);
    double *const lengths[] = {large.distance, large.overlap, large.reduced_r,
                               large.approach, large.ux,      large.uy,
                               large.uz,       large.normal,  large.fx,
                               large.fy,       large.fz};
    for (size_t a = 0; a < sizeof lengths / sizeof *lengths; a++)
      for (size_t k = 0; k < ROOM; k++)
        lengths[a][k] *= by;
    for (int m = 0; m < KINDS; m++)
      large.materials[m].young /= by;
    run(laws[i], PACKING_ISA_AUTO, &s);
    run(large_laws[i], PACKING_ISA_AUTO, &large);
    for (size_t k = 0; k < 200; k++)
      assert_true(large.normal[k] == by * s.normal[k] && large.fx[k] == by * s.fx[k] &&
                  large.fy[k] == by * s.fy[k] && large.fz[k] == by * s.fz[k]);
    packing_law_destroy(laws[i]);
    packing_law_destroy(large_laws[i]);
  }
}

static double at_distance(const packing_law *law, double d)
{
  static scene s;
  memset(&s, 0, sizeof s);
  wire(&s, 1, 0);
  s.distance[0] = d;
  run(law, PACKING_ISA_AUTO, &s);
  return s.normal[0];
}

static void near_field_follows_the_equation(void **state)
{
  (void)state;
  /* alpha_1 = 3, beta_1 = 2; alpha_2 = 5, beta_2 = 4: they cancel at d^2 = 5 / 3. */
  packing_law *law = near_field(3, 2, 5, 4, 2);
  assert_true(law->reach == 2);
  assert_close(at_distance(law, 1), 5.0 - 3, 1e-15);
  assert_close(at_distance(law, 0.5), 5.0 * 16 - 3 * 4, 1e-15);
  assert_near(at_distance(law, sqrt(5.0 / 3.0)), 0, 1e-15);
  assert_true(at_distance(law, 1.2) > 0 && at_distance(law, 1.4) < 0);
  assert_true(at_distance(law, nextafter(2, 0)) < 0);
  assert_true(at_distance(law, 2) == 0);
  packing_law_destroy(law);
  law = near_field(3, 2, 0, 4, 2); /* an absent term is absent even at 0 */
  assert_true(at_distance(law, 0) == -HUGE_VAL);
  assert_close(at_distance(law, 0.5), -12.0, 1e-15);
  packing_law_destroy(law);
}

typedef struct user_data {
  int calls, released;
  const packing_contact_batch *seen;
} user_data;

static void evaluate(void *user, const packing_contact_batch *batch)
{
  user_data *u = user;
  u->calls++;
  u->seen = batch;
}

static void let_go(void *user)
{
  ((user_data *)user)->released++;
}

static void custom_laws_pass_through(void **state)
{
  (void)state;
  static scene s;
  user_data u = {0, 0, NULL};
  packing_law_custom_def def;
  packing_law *law = NULL;
  packing_law_custom_def_init(&def);
  def.evaluate = evaluate;
  def.user = &u;
  def.release = let_go;
  def.history_size = 4;
  def.history_even = 0x9;
  assert_ok(packing_law_create_custom(NULL, &def, &law));
  assert_true(law->reach == 0 && law->history_size == 4 && law->history_even == 9);
  wire(&s, 3, 0);
  for (int set = PACKING_ISA_AUTO; set < PACKING_ISA_END; set++)
    run(law, (packing_isa)set, &s);
  assert_int_equal(u.calls, PACKING_ISA_END);
  assert_ptr_equal(u.seen, &s.batch);
  assert_ptr_equal(packing_i_law_retain(law), law);
  packing_law_destroy(law);
  assert_int_equal(u.released, 0);
  packing_law_destroy(law);
  assert_int_equal(u.released, 1);
  def.history_size = 0;
  def.history_even = 0;
  def.reach = 2.5;
  def.release = NULL;
  assert_ok(packing_law_create_custom(NULL, &def, &law));
  assert_true(law->reach == 2.5);
  packing_law_destroy(law);
}

static void built_in_laws_act_at_contacts(void **state)
{
  (void)state;
  packing_law *laws[] = {hertz(0), sliding(1)};
  for (int i = 0; i < 2; i++) {
    assert_true(laws[i]->reach == 0 && laws[i]->history_size == 0);
    assert_ptr_equal(laws[i]->user, laws[i]);
    packing_law_destroy(laws[i]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(hertz_follows_the_equations),
      cmocka_unit_test(sliding_follows_the_equations),
      cmocka_unit_test(sliding_has_its_limits),
      cmocka_unit_test(instruction_sets_agree),
      cmocka_unit_test(one_material_is_a_table_of_one),
      cmocka_unit_test(pull_is_cut_off),
      cmocka_unit_test(nan_is_not_hidden),
      cmocka_unit_test(lengths_scale),
      cmocka_unit_test(near_field_follows_the_equation),
      cmocka_unit_test(custom_laws_pass_through),
      cmocka_unit_test(built_in_laws_act_at_contacts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
