/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws of the user: what they are told of a contact, and what is remembered for them: kept over
 * lists made again and particles sorted anew, zero where a contact begins, odd numbers with their
 * sign changed where the partners have swapped their roles. */
#include "dem_scenes.h"

static packing_law *custom(packing_law_function evaluate, void *user, size_t history,
                           unsigned even, double reach)
{
  packing_law_custom_def def;
  packing_law *law = NULL;
  packing_law_custom_def_init(&def);
  def.evaluate = evaluate;
  def.user = user;
  def.history_size = history;
  def.history_even = even;
  def.reach = reach;
  assert_ok(packing_law_create_custom(NULL, &def, &law));
  return law;
}

enum { PLACES = 4096, NUMBERS = 3 };

/* What is known of a contact from outside. Radii differ all, so a contact is told by r*, and one
 * with a wall by the wall's direction besides. */
typedef struct acquaintance {
  double key;
  double count; /* steps it has lasted */
  uint64_t last_step;
  double nx;
} acquaintance;

typedef struct witness {
  uint64_t step; /* the one being made */
  double r_min;
  acquaintance known[PLACES];
  size_t wrong, begun, came_back, swapped, misaligned;
  double oldest;
} witness;

static double key_of(const witness *w, const packing_contact_batch *b, size_t k)
{
  const double r = b->reduced_r[k];
  if (r < w->r_min)
    return r; /* of two particles, whose r* is less than either radius */
  return r *
         (5 + round(2 * b->nx[k]) + 8 * round(2 * b->ny[k]) + 64 * round(2 * b->nz[k]));
}

static acquaintance *meet(witness *w, double key)
{
  uint64_t bits;
  memcpy(&bits, &key, sizeof bits);
  size_t at = (size_t)(bits * UINT64_C(0x9E3779B97F4A7C15) >> 52);
  for (size_t k = 0; k < PLACES; k++, at = (at + 1) % PLACES)
    if (w->known[at].key == key || w->known[at].key == 0)
      break;
  w->known[at].key = key;
  return &w->known[at];
}

/* History: 0 counts steps (even), 1 is n_x of the last step (odd), 2 the key (even). */
static void look(witness *w, const packing_contact_batch *b, size_t k)
{
  double *count = &b->history[k], *nx = &b->history[b->stride + k],
         *name = &b->history[2 * b->stride + k];
  const double key = key_of(w, b, k);
  acquaintance *a = meet(w, key);
  const int goes_on = a->last_step != 0 && a->last_step + 1 == w->step;
  const int steep = fabs(b->nx[k]) > 0.2;
  if (goes_on) {
    w->wrong += *count != a->count || *name != key;
    w->wrong += steep && *nx * b->nx[k] <= 0;
    w->swapped += steep && a->nx * b->nx[k] < 0;
  } else {
    w->wrong += *count != 0 || *nx != 0 || *name != 0;
    w->begun++;
    w->came_back += a->last_step != 0;
    a->count = 0;
  }
  *count += 1;
  *nx = b->nx[k];
  *name = key;
  a->count += 1;
  a->nx = b->nx[k];
  a->last_step = w->step;
  w->oldest = fmax(w->oldest, *count);
}

static int aligned(const void *array)
{
  return (uintptr_t)array % 64 == 0;
}

static void watch(void *user, const packing_contact_batch *b)
{
  witness *w = user;
  w->misaligned += !aligned(b->nx) || !aligned(b->ny) || !aligned(b->nz) ||
                   !aligned(b->distance) || !aligned(b->overlap) ||
                   !aligned(b->reduced_r) || !aligned(b->reduced_m) ||
                   !aligned(b->approach) || !aligned(b->ux) || !aligned(b->uy) ||
                   !aligned(b->uz) || !aligned(b->normal) || !aligned(b->fx) ||
                   !aligned(b->fy) || !aligned(b->fz) || !aligned(b->history);
  for (size_t k = 0; k < b->count; k++)
    look(w, b, k);
}

/* A bed on a smooth floor that drifts through a cell periodic across: contacts last long, while
 * their particles cross cells and borders. */
static void drifting_bed(dem_scene *s)
{
  dem_scene_init(s, test_box(0.2, 0.16, 0.3, PACKING_PERIODIC_X | PACKING_PERIODIC_Y));
  s->context = test_context(1, PACKING_ISA_AUTO);
  dem_material(s, 1000, 1e6, 0.25, 0.3, 0);
  dem_hertz(s, 0);
  dem_cloud(s, 0.01, 2, 0.25, 1, 0.2, 41);
  for (size_t i = 0; i < packing_particles_count(s->store); i++) {
    dem_body b = dem_get(s, i);
    b.v.x += 3;
    b.v.y -= 2;
    dem_put(s, i, &b);
  }
  s->def.gravity.z = -50;
  s->def.dt = 5e-5;
  s->def.max_start_overlap = 0.9; /* it is reloaded in full motion */
}

static packing_dem_report step_with(dem_scene *s, witness *const *w, size_t count,
                                    int steps)
{
  packing_dem_report report;
  packing_dem_report_init(&report);
  for (int k = 0; k < steps; k++) {
    for (size_t l = 0; l < count; l++)
      w[l]->step++;
    report = dem_run(s, 1);
  }
  return report;
}

static witness *new_witness(void)
{
  witness *w = calloc(1, sizeof *w);
  assert_non_null(w);
  w->r_min = 0.01;
  w->step = 1;
  return w;
}

/* Two laws at once, each with its own memory. */
static void contacts_are_remembered(void **state)
{
  (void)state;
  dem_scene s;
  witness *const w[2] = {new_witness(), new_witness()};
  drifting_bed(&s);
  dem_law(&s, custom(watch, w[0], 3, 5, 0));
  dem_law(&s, custom(watch, w[1], 3, 5, 0));
  dem_start(&s);
  const packing_dem_report report = step_with(&s, w, 2, 4000);
  assert_true(report.rebuilds > 50 && report.wall_contacts > 5 && report.contacts > 100);
  for (int l = 0; l < 2; l++) {
    assert_int_equal(w[l]->wrong, 0);
    assert_int_equal(w[l]->misaligned, 0);
    /* Or it shows nothing: long contacts, new ones, old partners, swapped roles. */
    assert_true(w[l]->oldest > 1000);
    assert_true(w[l]->begun > 200 && w[l]->came_back > 50);
    assert_true(w[l]->swapped > 20);
    free(w[l]);
  }
  dem_scene_free(&s);
}

/* A reload forgets: all contacts begin anew. */
static void reload_forgets(void **state)
{
  (void)state;
  dem_scene s;
  witness *const w = new_witness();
  drifting_bed(&s);
  dem_law(&s, custom(watch, w, 3, 5, 0));
  dem_start(&s);
  step_with(&s, &w, 1, 1500);
  assert_int_equal(w->wrong, 0);
  memset(w->known, 0, sizeof w->known);
  const size_t begun = w->begun;
  const size_t contacts = dem_run(&s, 1).contacts;
  assert_true(w->wrong >
              contacts / 2); /* the witness has forgotten, the stepper has not */
  w->wrong = 0;
  memset(w->known, 0, sizeof w->known);
  assert_ok(packing_dem_reload(s.dem));
  step_with(&s, &w, 1, 100);
  assert_int_equal(w->wrong, 0);
  assert_true(w->begun > begun + contacts / 2);
  free(w);
  dem_scene_free(&s);
}

/* Pushes by what it remembers: an even number that grows, and an odd one along n, so that all
 * bits of the result hang on the history. */
static void grows(void *user, const packing_contact_batch *b)
{
  (void)user;
  for (size_t k = 0; k < b->count; k++) {
    double *age = &b->history[b->stride + k], *way = &b->history[k];
    *age += b->dt;
    *way += b->dt * b->ux[k];
    b->normal[k] += 2e-2 * *age;
    b->fx[k] += 1e2 * *way;
  }
}

static void history_is_the_same_for_all_threads(void **state)
{
  (void)state;
  uint64_t first = 0;
  static const int threads[] = {1, 3, 8};
  for (size_t t = 0; t < sizeof threads / sizeof *threads; t++)
    for (int isa = PACKING_ISA_BASELINE; isa < PACKING_ISA_END; isa++) {
      if (!packing_isa_available((packing_isa)isa))
        continue;
      dem_scene s;
      drifting_bed(&s);
      packing_context_destroy(s.context);
      s.context = test_context(threads[t], (packing_isa)isa);
      dem_law(&s, custom(grows, NULL, 2, 2, 0));
      dem_start(&s);
      dem_run(&s, 600);
      const uint64_t hash = dem_hash(s.store);
      first = first == 0 ? hash : first;
      assert_true(hash == first);
      dem_scene_free(&s);
    }
}

/* A spring along the way slid since first touch, without damping: the partners' total momentum is
 * kept, and the force is that of the way, with the right sign, whoever is i. */
static void springs(void *user, const packing_contact_batch *b)
{
  const double *stiffness = user;
  for (size_t k = 0; k < b->count; k++) {
    const double u[3] = {b->ux[k], b->uy[k], b->uz[k]};
    double *const f[3] = {b->fx, b->fy, b->fz};
    for (size_t d = 0; d < 3; d++) {
      double *way = &b->history[d * b->stride + k];
      *way += b->dt * u[d];
      f[d][k] += *stiffness * *way;
    }
  }
}

/* A sphere on a floor, pressed down and given a push along it: it swings on its tangential spring
 * with omega^2 = k / m, for many lists, as rotation is locked. */
static void a_spring_with_a_wall(void **state)
{
  (void)state;
  double stiffness = 100;
  dem_scene s;
  dem_scene_init(&s, test_box(1, 1, 1, 0));
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0);
  dem_hertz(&s, 0);
  dem_law(&s, custom(springs, &stiffness, 3, 0, 0));
  const double m = dem_mass(1000, 0.01);
  const dem_body b = {
      .x = {0.5, 0.5,
            0.01 - dem_static_overlap(m * 9.81, 0.01, dem_rigid_young(1e8, 0.25))},
      .v = {0.3, 0.4, 0},
      .r = 0.01};
  dem_add(&s, &b);
  s.def.gravity.z = -9.81;
  s.def.rotations = 0;
  s.def.dt = 1e-6;
  dem_start(&s);
  const double omega = sqrt(stiffness / m), quarter = DEM_PI / 2 / omega;
  uint64_t rebuilds = dem_run_for(&s, quarter).rebuilds;
  /* First order in omega dt = 1.5e-4, and a part of a step. */
  assert_close(dem_get(&s, 0).x.x, 0.5 + 0.3 / omega, 1e-4);
  assert_close(dem_get(&s, 0).x.y, 0.5 + 0.4 / omega, 1e-4);
  rebuilds = dem_run_for(&s, 4 * quarter).rebuilds;
  assert_true(rebuilds > 3);
  assert_close(dem_get(&s, 0).x.x - 0.5, 0.3 / omega, 1e-3);
  assert_close(dem_get(&s, 0).x.y - 0.5, 0.4 / omega, 1e-3);
  dem_scene_free(&s);
}

/* One contact as a law saw it. */
typedef struct sight {
  double n[3], distance, overlap, reduced_r, reduced_m, approach, u[3], dt;
  packing_pair_material material;
} sight;

typedef struct sights {
  size_t count;
  sight seen[8];
  double normal, f[3];
} sights;

static void record(void *user, const packing_contact_batch *b)
{
  sights *s = user;
  assert_true(b->struct_size >= sizeof *b);
  assert_null(b->history);
  for (size_t k = 0; k < b->count && s->count < 8; k++) {
    const sight one = {{b->nx[k], b->ny[k], b->nz[k]},
                       b->distance[k],
                       b->overlap[k],
                       b->reduced_r[k],
                       b->reduced_m[k],
                       b->approach[k],
                       {b->ux[k], b->uy[k], b->uz[k]},
                       b->dt,
                       b->materials[b->pair == NULL ? 0 : b->pair[k]]};
    s->seen[s->count++] = one;
    b->normal[k] += s->normal;
    b->fx[k] += s->f[0];
    b->fy[k] += s->f[1];
    b->fz[k] += s->f[2];
  }
}

/* Two spheres of unlike materials along x, the second turning about y and z; either may be i. */
static void a_law_is_told_of_a_pair(void **state)
{
  (void)state;
  sights told = {0, {{{0}, 0, 0, 0, 0, 0, {0}, 0, {0, 0, 0}}}, 0.5, {0, 0.25, 0}};
  dem_scene s;
  dem_scene_init(&s, test_box(1, 1, 1, 0));
  s.context = test_context(1, PACKING_ISA_AUTO);
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_material(&s, 3000, 1e8, 0.25, 0.3, 0.6);
  dem_law(&s, custom(record, &told, 0, 0, 0));
  const dem_body a = {.x = {0.5, 0.5, 0.5}, .v = {1, 2, 3}, .r = 0.01, .type = 1};
  const dem_body c = {.x = {0.5299, 0.5, 0.5},
                      .v = {-1, 0, 1},
                      .w = {50, 100, 200},
                      .r = 0.02,
                      .type = 2};
  dem_add(&s, &a);
  dem_add(&s, &c);
  s.def.dt = 1e-6;
  dem_start(&s);
  dem_run(&s, 1);
  assert_int_equal(told.count, 1);
  const sight *k = &told.seen[0];
  const double ma = dem_mass(1000, 0.01), mc = dem_mass(3000, 0.02);
  const double to = k->n[0] > 0 ? 1 : -1; /* -1: the second is i */
  assert_close(k->n[0], to, 1e-14);
  assert_true(k->n[1] == 0 && k->n[2] == 0);
  /* Positions near .5 round by 1e-16. */
  assert_close(k->distance, 0.0299, 1e-13);
  assert_close(k->overlap, 1e-4, 1e-11);
  assert_close(k->reduced_r, 0.02 / 3, 1e-14);
  assert_close(k->reduced_m, ma * mc / (ma + mc), 1e-14);
  assert_close(k->approach, 2.0, 1e-14);
  /* v_c - v_a = (-2, -2, -2); the arm of c is .02 less half the overlap, toward -x, and
   * w x (-arm, 0, 0) = arm (0, -w_z, w_y). */
  const double arm = 0.02 - 0.5e-4;
  assert_near(k->u[0], 0, 1e-14);
  assert_close(to * k->u[1], -2 - arm * 200, 1e-12);
  assert_close(to * k->u[2], -2 + arm * 100, 1e-11);
  assert_true(k->dt == 1e-6);
  assert_close(k->material.young, dem_rigid_young(1e8, 0.25) / 2, 1e-14);
  assert_close(k->material.damping, 0.2, 1e-14);
  assert_close(k->material.friction, 0.4, 1e-14);
  /* Force on i: -normal n + f. */
  const dem_body after = dem_get(&s, 0);
  assert_close((after.v.x - 1) * ma / 1e-6, -0.5, 1e-9);
  assert_close((after.v.y - 2) * ma / 1e-6, to * 0.25, 1e-9);
  assert_close(after.w.z * 0.4 * ma * 1e-4 / 1e-6, to * 0.25 * (0.01 - 0.5e-4), 1e-9);
  dem_scene_free(&s);
}

static void a_law_is_told_of_a_wall(void **state)
{
  (void)state;
  sights told = {0, {{{0}, 0, 0, 0, 0, 0, {0}, 0, {0, 0, 0}}}, 0.5, {0.25, 0, 0}};
  dem_scene s;
  dem_scene_init(&s, test_box(1, 1, 1, 0));
  s.context = test_context(1, PACKING_ISA_AUTO);
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_law(&s, custom(record, &told, 0, 0, 0));
  const dem_body a = {
      .x = {0.5, 0.5, 0.00995}, .v = {1, 2, -3}, .w = {10, 20, 30}, .r = 0.01};
  dem_add(&s, &a);
  s.def.dt = 1e-6;
  dem_start(&s);
  dem_run(&s, 1);
  assert_int_equal(told.count, 1);
  const sight *k = &told.seen[0];
  const double m = dem_mass(1000, 0.01), arm = 0.00995;
  assert_true(k->n[0] == 0 && k->n[1] == 0 && k->n[2] == -1);
  assert_close(k->distance, 0.00995, 1e-14);
  assert_close(k->overlap, 5e-5, 1e-12);
  assert_close(k->reduced_r, 0.01, 1e-15);
  assert_close(k->reduced_m, m, 1e-14);
  assert_close(k->approach, 3.0, 1e-15);
  /* The wall stands: u = -(v + w x (-arm z)), and w x (0, 0, -arm) = arm (-w_y, w_x, 0). */
  assert_close(k->u[0], -(1 - arm * 20), 1e-13);
  assert_close(k->u[1], -(2 + arm * 10), 1e-13);
  assert_near(k->u[2], 0, 1e-14);
  assert_close(k->material.young, dem_rigid_young(1e8, 0.25), 1e-14);
  assert_true(k->material.damping == 0.1 && k->material.friction == 0.2);
  const dem_body after = dem_get(&s, 0);
  assert_close((after.v.z + 3) * m / 1e-6, 0.5, 1e-9);
  assert_close((after.v.x - 1) * m / 1e-6, 0.25, 1e-9);
  assert_close((after.w.y - 20) * 0.4 * m * 1e-4 / 1e-6, -0.25 * arm, 1e-9);
  dem_scene_free(&s);
}

/* A law of a reach sees pairs nearer than that, touching or not, and no walls. */
static void a_law_with_a_reach(void **state)
{
  (void)state;
  sights told = {0, {{{0}, 0, 0, 0, 0, 0, {0}, 0, {0, 0, 0}}}, 0.5, {0, 0, 0}};
  dem_scene s;
  dem_scene_init(&s, test_box(1, 1, 1, PACKING_PERIODIC_X));
  s.context = test_context(1, PACKING_ISA_AUTO);
  dem_material(&s, 1000, 1e8, 0.25, 0.1, 0.2);
  dem_law(&s, custom(record, &told, 0, 0, 0.1));
  static const packing_vec3 at[4] = {
      {0.01, 0.5, 0.00995}, {0.93, 0.5, 0.00995}, {0.06, 0.5, 0.5}, {0.175, 0.5, 0.5}};
  for (int k = 0; k < 4; k++) {
    const dem_body b = {.x = at[k], .r = 0.01};
    dem_add(&s, &b);
  }
  s.def.dt = 1e-6;
  dem_start(&s);
  dem_run(&s, 1);
  assert_int_equal(told.count, 1); /* 0 and 1, over the border, .08 apart */
  assert_close(told.seen[0].distance, 0.08, 1e-13);
  assert_close(told.seen[0].overlap, -0.06, 1e-13);
  const double m = dem_mass(1000, 0.01);
  assert_close(dem_get(&s, 0).v.x * m / 1e-6, 0.5, 1e-9);
  assert_close(dem_get(&s, 1).v.x * m / 1e-6, -0.5, 1e-9);
  assert_true(dem_get(&s, 0).v.z == 0 && dem_get(&s, 2).v.x == 0);
  dem_scene_free(&s);
}

/* Steppers keep their laws, domain and context, and a copy of the table of materials. */
static void what_a_stepper_is_made_from_may_go(void **state)
{
  (void)state;
  uint64_t hash[2];
  for (int gone = 0; gone < 2; gone++) {
    dem_scene s;
    drifting_bed(&s);
    dem_start(&s);
    if (gone) {
      packing_law_destroy(s.laws[0]);
      s.law_count = 0;
      packing_materials_destroy(s.materials);
      packing_domain_destroy(s.domain);
      packing_context_destroy(s.context);
      s.materials = NULL;
      s.domain = NULL;
      s.context = NULL;
    }
    dem_run(&s, 200);
    hash[gone] = dem_hash(s.store);
    dem_scene_free(&s);
  }
  assert_true(hash[0] == hash[1]);
}

/* Counts entries up to the next multiple of 8 that are no ordinary numbers. */
static void look_beyond(void *user, const packing_contact_batch *b)
{
  size_t *odd = user;
  const double *const columns[] = {b->nx,      b->ny,        b->nz,        b->distance,
                                   b->overlap, b->reduced_r, b->reduced_m, b->approach,
                                   b->ux,      b->uy,        b->uz,        b->normal,
                                   b->fx,      b->fy,        b->fz};
  for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
    for (size_t k = b->count; k % 8 != 0; k++)
      *odd += columns[c][k] != columns[c][b->count - 1];
  for (size_t k = b->count; b->pair != NULL && k % 8 != 0; k++)
    *odd += b->pair[k] != b->pair[b->count - 1];
}

/* What a law may read past the last pair is the last pair again, whatever the vectors' width. */
static void numbers_past_the_last_pair(void **state)
{
  (void)state;
  for (int isa = PACKING_ISA_BASELINE; isa < PACKING_ISA_END; isa++)
    for (int reach = 0; reach < 2; reach++) {
      if (!packing_isa_available((packing_isa)isa))
        continue;
      size_t odd = 0;
      dem_scene s;
      dem_scene_init(&s, test_box(0.25, 0.25, 0.25, 1));
      s.context = test_context(1, (packing_isa)isa);
      dem_material(&s, 1000, 1e6, 0.25, 0.1, 0.3);
      dem_material(&s, 2000, 1e6, 0.25, 0.1, 0.3);
      dem_law(&s, custom(look_beyond, &odd, 0, 0, reach ? 0.03 : 0));
      dem_cloud(&s, 0.01, 2, 0.3, 2, 1, 9);
      s.def.dt = 1e-4;
      dem_start(&s);
      for (int k = 0; k < 50; k++)
        dem_run(&s, 1);
      assert_int_equal(odd, 0);
      dem_scene_free(&s);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contacts_are_remembered),
      cmocka_unit_test(reload_forgets),
      cmocka_unit_test(history_is_the_same_for_all_threads),
      cmocka_unit_test(a_spring_with_a_wall),
      cmocka_unit_test(a_law_is_told_of_a_pair),
      cmocka_unit_test(a_law_is_told_of_a_wall),
      cmocka_unit_test(a_law_with_a_reach),
      cmocka_unit_test(what_a_stepper_is_made_from_may_go),
      cmocka_unit_test(numbers_past_the_last_pair),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
