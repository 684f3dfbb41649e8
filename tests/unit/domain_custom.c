/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Custom containers, as twins of built-in ones. */
#include "domain_scenes.h"

/* What the user has: a built-in container, and a count of releases. */
typedef struct twin {
  packing_domain *domain;
  int released;
  int answer_nan; /* after so many answers; 0: never */
  size_t calls;
} twin;

static double twin_distance(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  twin *t = user;
  t->calls++;
  if (t->answer_nan != 0 && t->calls > (size_t)t->answer_nan)
    return (double)NAN;
  return packing_domain_signed_distance(t->domain, point, normal);
}

static void twin_release(void *user)
{
  twin *t = user;
  packing_domain_destroy(t->domain);
  t->released++;
}

static packing_domain_custom_def twin_def(twin *t, const scene *s)
{
  packing_domain_custom_def def;
  packing_domain_custom_def_init(&def);
  memset(t, 0, sizeof *t);
  t->domain = scene_make(s);
  def.dim = scene_dim(s);
  def.signed_distance = twin_distance;
  def.release = twin_release;
  def.user = t;
  packing_domain_bounds(t->domain, &def.bounds);
  return def;
}

static void twins_answer_alike(void **state)
{
  (void)state;
  const enum scene_kind kinds[] = {SCENE_BOX,  SCENE_CYLINDER, SCENE_TUBE,   SCENE_CONE,
                                   SCENE_SILO, SCENE_SPHERE,   SCENE_ANNULUS};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    const scene s = scene_of(kinds[i]);
    twin t;
    packing_domain *domain = NULL;
    const packing_domain_custom_def def = twin_def(&t, &s);
    assert_ok(packing_domain_create_custom(NULL, &def, &domain));
    assert_string_equal(packing_domain_kind(domain), "custom");
    assert_int_equal(packing_domain_dim(domain), scene_dim(&s));
    assert_close(packing_domain_volume(domain), packing_domain_volume(t.domain), 1e-4);
    uint64_t random = 61 + i;
    for (int k = 0; k < 12; k++) {
      const packing_vec3 p = scene_random_point(&random, domain, 0.2);
      const double r = pow(10, -1.5 + 1.8 * scene_random(&random));
      const double ball =
          scene_dim(&s) == 2 ? TEST_PI * r * r : 4.0 / 3.0 * TEST_PI * r * r * r;
      packing_vec3 n, m;
      double v, w, error;
      assert_true(packing_domain_signed_distance(domain, &p, &n) ==
                  packing_domain_signed_distance(t.domain, &p, &m));
      assert_memory_equal(&n, &m, sizeof n);
      assert_int_equal(packing_domain_holds(domain, &p, r),
                       packing_domain_holds(t.domain, &p, r));
      assert_ok(packing_domain_sphere_volume(domain, &p, r, 1e-9, &v, &error));
      assert_ok(packing_domain_sphere_volume(t.domain, &p, r, 1e-9, &w, NULL));
      assert_true(error <= 1e-4 * ball);
      assert_near(v, w, 1e-4 * ball);
    }
    packing_domain_destroy(domain);
    assert_int_equal(t.released, 1);
  }
}

static void insets_share_the_user_s_data(void **state)
{
  (void)state;
  const scene s = scene_of(SCENE_SILO);
  twin t;
  packing_domain *domain = NULL, *inset = NULL, *deeper = NULL, *twin_inset = NULL;
  const packing_domain_custom_def def = twin_def(&t, &s);
  assert_ok(packing_domain_create_custom(NULL, &def, &domain));
  assert_ok(packing_domain_create_inset(NULL, domain, 0.125, &inset));
  packing_domain_destroy(domain);
  assert_ok(packing_domain_create_inset(NULL, inset, 0.125, &deeper));
  packing_domain_destroy(inset);
  assert_int_equal(t.released, 0);
  assert_ok(packing_domain_create_inset(NULL, t.domain, 0.25, &twin_inset));
  assert_close(packing_domain_volume(deeper), packing_domain_volume(twin_inset), 1e-4);
  packing_bounds custom, built_in;
  packing_domain_bounds(deeper, &custom);
  packing_domain_bounds(twin_inset, &built_in);
  assert_true(custom.lo.x <= built_in.lo.x + 1e-15 &&
              custom.hi.z >= built_in.hi.z - 1e-15);
  const packing_vec3 p = {0.3, -0.2, 0.9};
  assert_near(packing_domain_signed_distance(deeper, &p, NULL),
              packing_domain_signed_distance(twin_inset, &p, NULL), 1e-15);
  packing_domain *nothing = NULL;
  assert_status(packing_domain_create_inset(NULL, deeper, 9, &nothing),
                PACKING_ERR_GEOMETRY);
  assert_status(packing_domain_create_inset(NULL, deeper, 0.75, &nothing),
                PACKING_ERR_GEOMETRY);
  packing_domain_destroy(twin_inset);
  packing_domain_destroy(deeper);
  assert_int_equal(t.released, 1);
}

/* A ball as its distance alone; in 3D a volume to 1e-8 is out of reach. */
static double ball(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  (void)user;
  const double d = sqrt(p->x * p->x + p->y * p->y + p->z * p->z);
  if (normal != NULL) {
    const packing_vec3 in = {d > 0 ? -p->x / d : 1, d > 0 ? -p->y / d : 0,
                             d > 0 ? -p->z / d : 0};
    *normal = in;
  }
  return 1 - d;
}

/* What cannot be computed well enough is said to be so, not to be empty; particles still fit. */
static void volumes_out_of_reach_are_no_empty_containers(void **state)
{
  (void)state;
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = NULL, *inset = NULL;
  packing_domain_custom_def def;
  packing_domain_custom_def_init(&def);
  def.signed_distance = ball;
  def.bounds.lo.x = def.bounds.lo.y = def.bounds.lo.z = -1;
  def.bounds.hi.x = def.bounds.hi.y = def.bounds.hi.z = 1;
  def.volume_tolerance = 1e-8;
  assert_fails(context, packing_domain_create_custom(context, &def, &domain),
               PACKING_ERR_RANGE, "volume_tolerance");
  def.volume = 4.1887902047863905;
  assert_ok(packing_domain_create_custom(context, &def, &domain));
  assert_fails(context, packing_domain_create_inset(context, domain, 0.1, &inset),
               PACKING_ERR_RANGE, "volume_tolerance");
  packing_psd *psd = test_mono(0.2);
  packing_particles *store = test_store(3);
  packing_placer *placer = NULL;
  packing_rsa_def rsa;
  packing_rsa_def_init(&rsa);
  rsa.count = 5;
  assert_ok(packing_rsa_create(context, &rsa, domain, psd, store, &placer));
  assert_int_equal(test_run(placer).placed, 5);
  packing_placer_destroy(placer);
  packing_particles_destroy(store);
  packing_psd_destroy(psd);
  packing_domain_destroy(domain);
  packing_context_destroy(context);
}

static void stated_volumes_are_taken(void **state)
{
  (void)state;
  const scene s = scene_of(SCENE_CIRCLE);
  twin t;
  packing_domain *domain = NULL;
  packing_domain_custom_def def = twin_def(&t, &s);
  def.volume = 2.385;
  def.release = NULL;
  assert_ok(packing_domain_create_custom(NULL, &def, &domain));
  assert_true(packing_domain_volume(domain) == 2.385);
  assert_int_equal(t.calls, 1);
  packing_domain_destroy(domain);
  def.volume = 0;
  def.volume_tolerance = 1e-5;
  assert_ok(packing_domain_create_custom(NULL, &def, &domain));
  assert_close(packing_domain_volume(domain), packing_domain_volume(t.domain), 1e-5);
  packing_domain_destroy(domain);
  packing_domain_destroy(t.domain);
}

static double nowhere(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  (void)point;
  if (normal != NULL)
    memset(normal, 0, sizeof *normal);
  return -100;
}

/* Distances that no cell can be small enough for. */
static double never_decided(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  if (normal != NULL)
    *normal = (packing_vec3){(double)NAN, 0, 0};
  const int64_t bits = (int64_t)(fabs(point->x + 3 * point->y + 7 * point->z) * 1e6);
  return bits % 2 ? 1e-12 : -1e-12;
}

#define REFUSE(member, value, status, field)                                             \
  do {                                                                                   \
    packing_domain_custom_def bad = good;                                                \
    bad.member = (value);                                                                \
    assert_fails(context, packing_domain_create_custom(context, &bad, &domain),          \
                 (status), (field));                                                     \
    assert_null(domain);                                                                 \
  } while (0)

static void custom_refuses(void **state)
{
  (void)state;
  const scene s = scene_of(SCENE_SPHERE), flat = scene_of(SCENE_CIRCLE);
  packing_context *context = test_context(1, PACKING_ISA_AUTO);
  packing_domain *domain = NULL;
  twin t, u;
  packing_domain_custom_def good = twin_def(&t, &s);
  REFUSE(struct_size, 8, PACKING_ERR_ABI, "struct_size");
  REFUSE(dim, 4, PACKING_ERR_RANGE, "dim");
  REFUSE(signed_distance, NULL, PACKING_ERR_INVALID, "signed_distance");
  REFUSE(bounds.lo.x, (double)NAN, PACKING_ERR_INVALID, "bounds.lo.x");
  REFUSE(bounds.hi.y, HUGE_VAL, PACKING_ERR_INVALID, "bounds.hi.y");
  REFUSE(bounds.hi.z, good.bounds.lo.z, PACKING_ERR_RANGE, "bounds.hi.z");
  REFUSE(volume, (double)NAN, PACKING_ERR_INVALID, "volume");
  REFUSE(volume, -1, PACKING_ERR_RANGE, "volume");
  REFUSE(volume_tolerance, 0, PACKING_ERR_RANGE, "volume_tolerance");
  REFUSE(volume_tolerance, 1, PACKING_ERR_RANGE, "volume_tolerance");
  REFUSE(signed_distance, nowhere, PACKING_ERR_GEOMETRY, "bounds");
  good.volume = 1;
  REFUSE(signed_distance, never_decided, PACKING_ERR_GEOMETRY, "signed_distance");
  good.volume = 0;
  assert_fails(context, packing_domain_create_custom(context, NULL, &domain),
               PACKING_ERR_INVALID, "def");
  assert_fails(context, packing_domain_create_custom(context, &good, NULL),
               PACKING_ERR_INVALID, "domain");
  t.answer_nan = 1000; /* not at the probe */
  assert_fails(context, packing_domain_create_custom(context, &good, &domain),
               PACKING_ERR_GEOMETRY, "signed_distance");
  assert_int_equal(t.released, 0); /* what was never made is not released */
  packing_domain_destroy(t.domain);
  good = twin_def(&u, &flat);
  REFUSE(bounds.lo.z, -1, PACKING_ERR_RANGE, "bounds.lo.z");
  REFUSE(bounds.hi.z, 1, PACKING_ERR_RANGE, "bounds.hi.z");
  packing_domain_destroy(u.domain);
  packing_context_destroy(context);
}

static void cut_volumes_notice_nan(void **state)
{
  (void)state;
  const scene s = scene_of(SCENE_SPHERE);
  twin t;
  packing_domain *domain = NULL;
  const packing_domain_custom_def def = twin_def(&t, &s);
  assert_ok(packing_domain_create_custom(NULL, &def, &domain));
  const packing_vec3 p = {0.21, -0.43, 1};
  double v = 2.385;
  t.answer_nan = 1;
  assert_status(packing_domain_sphere_volume(domain, &p, 0.5, 1e-4, &v, NULL),
                PACKING_ERR_GEOMETRY);
  assert_true(v == 2.385);
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(twins_answer_alike),
      cmocka_unit_test(insets_share_the_user_s_data),
      cmocka_unit_test(volumes_out_of_reach_are_no_empty_containers),
      cmocka_unit_test(stated_volumes_are_taken),
      cmocka_unit_test(custom_refuses),
      cmocka_unit_test(cut_volumes_notice_nan),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
