/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The advancing front, fast and dense, in every container with every kind of sizes: what comes
 * out is a pack, dense, without overlap, and nothing outside. */
#include "pocket_scenes.h"

/* ---- containers ---- */

static const scene rooms[] = {
    {SCENE_BOX, 13.1, 11.7, 12.3, 0, {-3, 2, 1}, 2, 0, 0},
    {SCENE_BOX, 10.9, 11.3, 12.1, 0, {0, 0, 0}, 2, 1, 0},
    {SCENE_BOX, 12.9, 11.3, 10.7, 0, {4000, -3000, 7000}, 2, 0, 0},
    {SCENE_CYLINDER, 6.3, 12.7, 0, 0, {1, 2, 3}, 0, 0, 0},
    {SCENE_CYLINDER, 6.1, 11.7, 0, 0, {-1, 2, 3}, 1, 0, 0},
    {SCENE_CYLINDER, 5.9, 12.1, 0, 0, {1, -2, 3}, 2, 1, 0},
    {SCENE_TUBE, 4.1, 9.3, 9.1, 0, {0, 0, 0}, 2, 0, 0},
    {SCENE_CONE, 8.1, 2.3, 12.1, 0, {0, 0, 0}, 1, 0, 0},
    {SCENE_SILO, 6.9, 16.3, 2.7, 4.9, {0, 0, 0}, 2, 0, 0},
    {SCENE_SPHERE, 7.3, 0, 0, 0, {5, 5, 5}, 2, 0, 0},
    {SCENE_RECTANGLE, 23.1, 21.7, 0, 0, {0, 0, 0}, 1, 0, 0},
    {SCENE_RECTANGLE, 23.1, 21.7, 0, 0, {-100, 500, 0}, 1, 1, 0},
    {SCENE_CIRCLE, 13.3, 0, 0, 0, {1, 1, 0}, 1, 0, 0},
    {SCENE_ANNULUS, 6.3, 14.7, 0, 0, {0, 0, 0}, 1, 0, 0},
};
enum { ROOMS = sizeof rooms / sizeof *rooms };

static packing_domain *polygon(void)
{
  static const double x[] = {0, 24, 24, 13, 13, 0, 5, 11, 8},
                      y[] = {0, 0, 20, 20, 9, 23, 4, 4, 8};
  static const size_t sizes[] = {6, 3};
  packing_domain_polygon_def def;
  packing_domain *domain = NULL;
  packing_domain_polygon_def_init(&def);
  def.count = 9;
  def.x = x;
  def.y = y;
  def.rings = 2;
  def.sizes = sizes;
  assert_ok(packing_domain_create_polygon(NULL, &def, &domain));
  return domain;
}

static packing_domain *combine(packing_operation operation, const scene *a,
                               const scene *b)
{
  packing_domain_combination_def def;
  packing_domain *domain = NULL;
  packing_domain_combination_def_init(&def);
  def.operation = operation;
  def.a = scene_make(a);
  def.b = scene_make(b);
  assert_ok(packing_domain_create_combination(NULL, &def, &domain));
  packing_domain_destroy(def.a);
  packing_domain_destroy(def.b);
  return domain;
}

static packing_domain *joined(void)
{
  const scene a = {SCENE_BOX, 10.3, 9.1, 8.7, 0, {0, 0, 0}, 2, 0, 0},
              b = {SCENE_SPHERE, 5.9, 0, 0, 0, {11, 4, 4}, 2, 0, 0};
  return combine(PACKING_UNION, &a, &b);
}

static packing_domain *pierced(void)
{
  const scene a = {SCENE_BOX, 12.3, 11.1, 10.7, 0, {0, 0, 0}, 2, 0, 0},
              b = {SCENE_CYLINDER, 2.3, 30, 0, 0, {6, 5, -5}, 2, 0, 0};
  return combine(PACKING_DIFFERENCE, &a, &b);
}

/* An octahedron with corners 11 from its centre. */
static packing_domain *octahedron(void)
{
  double vertex[18] = {0};
  uint32_t triangle[24];
  size_t t = 0;
  for (size_t k = 0; k < 6; k++)
    vertex[3 * k + k / 2] = (k & 1 ? -11 : 11);
  for (unsigned sign = 0; sign < 8; sign++) {
    const uint32_t a = sign & 1, b = 2 + (sign >> 1 & 1), c = 4 + (sign >> 2 & 1);
    const int odd = ((sign ^ sign >> 1 ^ sign >> 2) & 1) != 0;
    triangle[t++] = a;
    triangle[t++] = odd ? c : b;
    triangle[t++] = odd ? b : c;
  }
  packing_mesh_def def;
  packing_mesh *mesh = NULL;
  packing_mesh_def_init(&def);
  def.vertices = vertex;
  def.vertex_count = 6;
  def.triangles = triangle;
  def.triangle_count = 8;
  assert_ok(packing_mesh_create(NULL, &def, &mesh));
  packing_domain_mesh_def of;
  packing_domain *domain = NULL;
  packing_domain_mesh_def_init(&of);
  of.mesh = mesh;
  assert_ok(packing_domain_create_mesh(NULL, &of, &domain));
  packing_mesh_destroy(mesh);
  return domain;
}

static packing_domain *(*const made[])(void) = {polygon, joined, pierced, octahedron};
enum { MADE = sizeof made / sizeof *made };

static packing_domain *room(size_t k)
{
  return k < ROOMS ? scene_make(&rooms[k]) : made[k - ROOMS]();
}

/* ---- sizes ---- */

static packing_psd *two_classes(void)
{
  static const double r[3] = {0.5, 0.8, 1.2};
  static const double w[3] = {0.5, 0.3, 0.2};
  packing_psd_discrete_def def;
  packing_psd *psd = NULL;
  packing_psd_discrete_def_init(&def);
  def.r = r;
  def.share = w;
  def.count = 3;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_discrete(NULL, &def, &psd));
  return psd;
}

static packing_psd *mixture(void)
{
  packing_psd *part[2] = {test_uniform(0.5, 0.6), test_mono(1.1)};
  static const double w[2] = {0.7, 0.3};
  packing_psd_mixture_def def;
  packing_psd *psd = NULL;
  packing_psd_mixture_def_init(&def);
  def.parts = part;
  def.share = w;
  def.count = 2;
  def.by = PACKING_BY_NUMBER;
  assert_ok(packing_psd_create_mixture(NULL, &def, &psd));
  packing_psd_destroy(part[0]);
  packing_psd_destroy(part[1]);
  return psd;
}

static packing_psd *equal(void)
{
  return test_mono(0.9);
}

static packing_psd *uniform(void)
{
  return test_uniform(0.7, 1.3);
}

static packing_psd *wide(void)
{
  return test_uniform(0.15, 1.5);
}

static packing_psd *(*const sizes[])(void) = {equal, uniform, two_classes, mixture, wide};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* ---- properties ---- */

static packing_placer_report fill(packing_domain *domain, packing_psd *psd,
                                  packing_front_mode mode,
                                  packing_front_direction direction,
                                  packing_particles *store)
{
  packing_front_def def = pocket_def(mode);
  def.direction = direction;
  def.seed = 17;
  assert_ok(packing_particles_add_columns(store, PACKING_COLUMN_COMPONENT));
  return pocket_pack(NULL, &def, domain, psd, store);
}

static void in_every_container(void **state)
{
  (void)state;
  for (size_t k = 0; k < ROOMS + MADE; k++)
    for (size_t s = 0; s < SIZES; s++)
      for (int way = (int)((k + s) % 2); way < 4; way += 2) {
        if (k == ROOMS + 1 && s != 1)
          continue; /* a union's distances take their time */
        packing_domain *domain = room(k);
        const int dim = packing_domain_dim(domain);
        packing_psd *psd = sizes[s]();
        packing_particles *store = test_store(dim);
        const packing_placer_report report =
            fill(domain, psd, pocket_modes[way & 1], (packing_front_direction)(way >> 1),
                 store);
        const double least = dim == 2 ? 0.6 : 0.37;
        if (report.volume_fraction <= least)
          print_message("# room %zu sizes %zu way %d: %g\n", k, s, way,
                        report.volume_fraction);
        assert_true(report.volume_fraction > least);
        packing_particles_destroy(store);
        packing_psd_destroy(psd);
        packing_domain_destroy(domain);
      }
}

/* Cells of 2 to 10 diameters, any directions periodic. */
static void in_periodic_cells(void **state)
{
  (void)state;
  static const double edge[] = {2, 2.3, 3.1, 4.0, 5.3, 9.7};
  for (int dim = 2; dim <= 3; dim++)
    for (size_t e = 0; e < sizeof edge / sizeof *edge; e++)
      for (unsigned periodic = 1; periodic < (dim == 2 ? 4U : 8U); periodic++)
        for (int way = (int)((e + periodic) % 2); way < 4; way += 3)
          for (size_t s = (e + periodic / 2) % 2; s < 2; s += 2) {
            const double l = 2 * edge[e];
            packing_domain *domain = dim == 2 ? test_rectangle(l, 1.07 * l, periodic)
                                              : test_box(l, 1.07 * l, 1.13 * l, periodic);
            packing_psd *psd = s == 0 ? test_mono(1) : test_uniform(0.6, 1);
            packing_particles *store = test_store(dim);
            const packing_placer_report report =
                fill(domain, psd, pocket_modes[way & 1],
                     (packing_front_direction)(way >> 1), store);
            const double least = dim == 2 ? 0.45 : 0.25;
            if (report.volume_fraction <= least)
              print_message("# dim %d edge %g periodic %u way %d sizes %zu: %g, %zu\n",
                            dim, l, periodic, way, s, report.volume_fraction,
                            report.placed);
            assert_true(report.placed >= 4);
            assert_true(report.volume_fraction > least);
            packing_particles_destroy(store);
            packing_psd_destroy(psd);
            packing_domain_destroy(domain);
          }
}

/* Periods that hold one particle, or not the largest. */
static void in_the_smallest_periods(void **state)
{
  (void)state;
  for (unsigned periodic = 1; periodic < 8; periodic++)
    for (int way = 0; way < 2; way++)
      for (int s = 0; s < 3; s++) {
        packing_domain *domain = test_box(2.1, 2.05, 2.2, periodic);
        packing_psd *psd = s == 0   ? test_mono(1)
                           : s == 1 ? test_uniform(0.3, 1)
                                    : test_uniform(0.3, 1.4);
        packing_particles *store = test_store(3);
        const packing_placer_report report =
            fill(domain, psd, pocket_modes[way], PACKING_FRONT_OUTWARD, store);
        assert_true(report.placed >= 1);
        packing_particles_destroy(store);
        packing_psd_destroy(psd);
        packing_domain_destroy(domain);
      }
}

/* Containers barely wider than a particle, and those that hold just one. */
static void in_thin_containers(void **state)
{
  (void)state;
  static const scene thin[] = {
      {SCENE_BOX, 2, 2, 2, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 2, 2, 2, 0, {5, -7, 3}, 2, 0, 7},
      {SCENE_SPHERE, 1, 0, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_CYLINDER, 1, 2, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_CIRCLE, 1, 0, 0, 0, {0, 0, 0}, 1, 0, 0},
      {SCENE_RECTANGLE, 2, 2, 0, 0, {0, 0, 0}, 1, 0, 0},
      {SCENE_BOX, 30, 30, 2, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 30, 30, 2.2, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 2.1, 2.1, 30, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_BOX, 2.1, 2.1, 30, 0, {0, 0, 0}, 2, 0, 3},
      {SCENE_BOX, 2.1, 2.1, 30, 0, {0, 0, 0}, 2, 0, 4},
      {SCENE_CYLINDER, 1.2, 40, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_CYLINDER, 1.0, 40, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_SPHERE, 2.05, 0, 0, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_RECTANGLE, 40, 2.1, 0, 0, {0, 0, 0}, 1, 0, 0},
      {SCENE_RECTANGLE, 40, 2, 0, 0, {0, 0, 0}, 1, 0, 0},
      {SCENE_TUBE, 5, 7.1, 9, 0, {0, 0, 0}, 2, 0, 0},
      {SCENE_ANNULUS, 5, 7.05, 0, 0, {0, 0, 0}, 2, 0, 0},
  };
  static const size_t least[] = {1,  1,  1,  1,  1, 1,  130, 150, 12,
                                 12, 12, 16, 16, 2, 16, 16,  50,  14};
  for (size_t k = 0; k < sizeof thin / sizeof *thin; k++)
    for (int way = 0; way < 4; way++) {
      packing_domain *domain = scene_make(&thin[k]);
      packing_psd *psd = test_mono(1);
      packing_particles *store = test_store(packing_domain_dim(domain));
      const packing_placer_report report = fill(
          domain, psd, pocket_modes[way & 1], (packing_front_direction)(way >> 1), store);
      if (report.placed < least[k])
        print_message("# thin %zu way %d: %zu\n", k, way, report.placed);
      assert_true(report.placed >= least[k]);
      if (least[k] == 1)
        assert_int_equal(report.placed, 1);
      packing_particles_destroy(store);
      packing_psd_destroy(psd);
      packing_domain_destroy(domain);
    }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(in_every_container),
      cmocka_unit_test(in_periodic_cells),
      cmocka_unit_test(in_the_smallest_periods),
      cmocka_unit_test(in_thin_containers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
