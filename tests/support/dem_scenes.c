/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dem_scenes.h"

static const packing_field motion[9] = {
    PACKING_FIELD_X,  PACKING_FIELD_Y,  PACKING_FIELD_Z,
    PACKING_FIELD_VX, PACKING_FIELD_VY, PACKING_FIELD_VZ,
    PACKING_FIELD_WX, PACKING_FIELD_WY, PACKING_FIELD_WZ};

void dem_scene_init(dem_scene *s, packing_domain *domain)
{
  packing_particles_def def;
  memset(s, 0, sizeof *s);
  s->domain = domain;
  packing_particles_def_init(&def);
  def.dim = packing_domain_dim(domain);
  def.columns = PACKING_COLUMN_TYPE | PACKING_COLUMN_VELOCITY | PACKING_COLUMN_SPIN;
  assert_ok(packing_particles_create(NULL, &def, &s->store));
  assert_ok(packing_materials_create(NULL, &s->materials));
  packing_dem_def_init(&s->def);
}

void dem_scene_free(dem_scene *s)
{
  packing_dem_destroy(s->dem);
  for (size_t i = 0; i < s->law_count; i++)
    packing_law_destroy(s->laws[i]);
  packing_materials_destroy(s->materials);
  packing_particles_destroy(s->store);
  packing_domain_destroy(s->domain);
  packing_context_destroy(s->context);
  memset(s, 0, sizeof *s);
}

size_t dem_material(dem_scene *s, double density, double young, double poisson,
                    double damping, double friction)
{
  packing_material_def def;
  size_t index = 0;
  packing_material_def_init(&def);
  def.density = density;
  def.young = young;
  def.poisson = poisson;
  def.damping = damping;
  def.friction = friction;
  assert_ok(packing_materials_add(s->materials, &def, &index));
  return index;
}

void dem_law(dem_scene *s, packing_law *law)
{
  assert_true(s->law_count < 16);
  s->laws[s->law_count++] = law;
}

void dem_hertz(dem_scene *s, int pull)
{
  packing_law_hertz_def def;
  packing_law *law = NULL;
  packing_law_hertz_def_init(&def);
  def.pull = pull;
  assert_ok(packing_law_create_hertz(NULL, &def, &law));
  dem_law(s, law);
}

void dem_sliding(dem_scene *s, double slip_velocity)
{
  packing_law_sliding_def def;
  packing_law *law = NULL;
  packing_law_sliding_def_init(&def);
  def.slip_velocity = slip_velocity;
  assert_ok(packing_law_create_sliding(NULL, &def, &law));
  dem_law(s, law);
}

void dem_near_field(dem_scene *s, double attraction, double attraction_exponent,
                    double repulsion, double repulsion_exponent, double cutoff)
{
  packing_law_near_field_def def;
  packing_law *law = NULL;
  packing_law_near_field_def_init(&def);
  def.attraction = attraction;
  def.attraction_exponent = attraction_exponent;
  def.repulsion = repulsion;
  def.repulsion_exponent = repulsion_exponent;
  def.cutoff = cutoff;
  assert_ok(packing_law_create_near_field(NULL, &def, &law));
  dem_law(s, law);
}

size_t dem_add(dem_scene *s, const dem_body *body)
{
  const int32_t type = body->type == 0 ? 1 : body->type;
  packing_view v;
  packing_view_init_arrays(&v, 1, &body->x.x, &body->x.y, &body->x.z, &body->r);
  const double *const numbers[6] = {&body->v.x, &body->v.y, &body->v.z,
                                    &body->w.x, &body->w.y, &body->w.z};
  packing_column *const columns[6] = {&v.vx, &v.vy, &v.vz, &v.wx, &v.wy, &v.wz};
  for (int c = 0; c < 6; c++)
    *columns[c] = (packing_column){numbers[c], sizeof(double)};
  v.type = (packing_column){&type, sizeof type};
  assert_ok(packing_particles_append(s->store, &v));
  return packing_particles_count(s->store) - 1;
}

static double number(packing_column c, size_t i)
{
  return c.data == NULL
             ? 0.0
             : *(const double *)(const void *)((const char *)c.data + i * c.stride);
}

dem_body dem_get(const dem_scene *s, size_t i)
{
  packing_view v;
  dem_body b;
  packing_particles_view(s->store, &v);
  assert_true(i < v.count);
  b.x = dem_vec(number(v.x, i), number(v.y, i), number(v.z, i));
  b.v = dem_vec(number(v.vx, i), number(v.vy, i), number(v.vz, i));
  b.w = dem_vec(number(v.wx, i), number(v.wy, i), number(v.wz, i));
  b.r = number(v.r, i);
  b.type =
      *(const int32_t *)(const void *)((const char *)v.type.data + i * v.type.stride);
  return b;
}

void dem_put(dem_scene *s, size_t i, const dem_body *body)
{
  const size_t count = packing_particles_count(s->store);
  const double numbers[9] = {body->x.x, body->x.y, body->x.z, body->v.x, body->v.y,
                             body->v.z, body->w.x, body->w.y, body->w.z};
  double *column = malloc(count * sizeof *column);
  assert_non_null(column);
  assert_true(i < count);
  for (int f = 0; f < 9; f++) {
    assert_ok(packing_particles_extract(s->store, motion[f], column, sizeof *column));
    column[i] = numbers[f];
    assert_ok(packing_particles_set(s->store, motion[f], column, sizeof *column));
  }
  free(column);
}

packing_status dem_try(dem_scene *s)
{
  packing_dem *dem = NULL;
  const packing_status status =
      packing_dem_create(s->context, &s->def, s->domain, s->materials, s->laws,
                         s->law_count, s->store, &dem);
  assert_true((status == PACKING_OK) == (dem != NULL));
  if (status == PACKING_OK) {
    packing_dem_destroy(s->dem);
    s->dem = dem;
  }
  return status;
}

void dem_start(dem_scene *s)
{
  test_status(dem_try(s), PACKING_OK, s->context, "packing_dem_create", __FILE__,
              __LINE__);
}

packing_dem_report dem_run(dem_scene *s, uint64_t steps)
{
  packing_dem_report report;
  packing_dem_report_init(&report);
  test_status(packing_dem_step(s->dem, steps, &report), PACKING_OK, s->context,
              "packing_dem_step", __FILE__, __LINE__);
  return report;
}

packing_dem_report dem_run_for(dem_scene *s, double time)
{
  return dem_run(s, (uint64_t)llround(time / s->def.dt));
}

uint64_t dem_hash(const packing_particles *store)
{
  packing_view v;
  packing_particles_view(store, &v);
  const packing_column columns[] = {v.x,  v.y,  v.z,  v.r,  v.vx,
                                    v.vy, v.vz, v.wx, v.wy, v.wz};
  uint64_t hash = test_hash(TEST_HASH_START, &v.count, sizeof v.count);
  for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
    for (size_t i = 0; i < v.count; i++) {
      const double a = number(columns[c], i);
      hash = test_hash(hash, &a, sizeof a);
    }
  return hash;
}

void dem_cloud(dem_scene *s, double r, double ratio, double fraction, int types,
               double speed, uint64_t seed)
{
  packing_psd *psd = ratio > 1 ? test_uniform(r, ratio * r) : test_mono(r);
  packing_particles *places = test_store(packing_domain_dim(s->domain));
  packing_placer *placer = NULL;
  packing_rsa_def def;
  packing_rsa_def_init(&def);
  def.seed = seed;
  def.volume_fraction = fraction;
  assert_ok(packing_rsa_create(NULL, &def, s->domain, psd, places, &placer));
  test_run(placer);
  packing_placer_destroy(placer);
  packing_psd_destroy(psd);
  packing_view v;
  packing_particles_view(places, &v);
  assert_true(v.count > 1);
  const int flat = packing_domain_dim(s->domain) == 2;
  uint64_t random = seed;
  for (size_t i = 0; i < v.count; i++) {
    dem_body b = {.x = {number(v.x, i), number(v.y, i), number(v.z, i)},
                  .r = number(v.r, i),
                  .type = (int32_t)(i % (size_t)types) + 1};
    double a[6];
    for (int k = 0; k < 6; k++)
      a[k] = speed * (2 * dem_random(&random) - 1);
    b.v = dem_vec(a[0], a[1], flat ? 0 : a[2]);
    b.w = dem_vec(flat ? 0 : a[3] / r, flat ? 0 : a[4] / r, a[5] / r);
    dem_add(s, &b);
  }
  packing_particles_destroy(places);
}

static packing_vec3 times(packing_vec3 a, double by)
{
  return dem_vec(a.x * by, a.y * by, a.z * by);
}

void dem_copy(dem_scene *to, const dem_scene *from, double lengths, double velocities)
{
  for (size_t i = 0; i < packing_particles_count(from->store); i++) {
    dem_body b = dem_get(from, i);
    b.x = times(b.x, lengths);
    b.v = times(b.v, velocities);
    b.w = times(b.w, velocities / lengths);
    b.r *= lengths;
    dem_add(to, &b);
  }
}

double dem_mass(double density, double r)
{
  return 4.0 / 3 * DEM_PI * r * r * r * density;
}

double dem_rigid_young(double young, double poisson)
{
  return young / (1 - poisson * poisson);
}

double dem_pair_young(double young_a, double poisson_a, double young_b, double poisson_b)
{
  return 1 / (1 / dem_rigid_young(young_a, poisson_a) +
              1 / dem_rigid_young(young_b, poisson_b));
}

double dem_static_overlap(double load, double reduced_r, double reduced_young)
{
  const double a = 0.75 * load / (reduced_young * sqrt(reduced_r));
  return pow(a, 2.0 / 3);
}

double dem_collision_overlap(double reduced_m, double reduced_r, double reduced_young,
                             double v)
{
  return pow(15.0 / 16 * reduced_m * v * v / (reduced_young * sqrt(reduced_r)), 0.4);
}

double dem_collision_time(double reduced_m, double reduced_r, double reduced_young,
                          double v)
{
  return 2.94327 * dem_collision_overlap(reduced_m, reduced_r, reduced_young, v) / v;
}
