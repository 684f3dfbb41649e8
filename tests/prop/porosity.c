/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles, maps and sections in every container: their parts add up to the whole that
 * packing_measure_volume() finds, points agree with them, threads and units change no bit. */
#include "domain_scenes.h"

enum { MOST = 6000, CELLS = 8 * 7 * 6, BINS = 20, DISCS = 4096 };

typedef struct pack {
  double x[MOST], y[MOST], z[MOST], r[MOST];
  packing_view view;
} pack;

/* Balls anywhere in and about a container, overlapping each other and its walls. */
static pack *new_pack(const packing_domain *domain, size_t count, double r, uint64_t seed)
{
  pack *p = calloc(1, sizeof *p);
  assert_non_null(p);
  uint64_t random = seed;
  for (size_t i = 0; i < count; i++) {
    const packing_vec3 at = scene_random_point(&random, domain, 0.05);
    p->x[i] = at.x;
    p->y[i] = at.y;
    p->z[i] = at.z;
    p->r[i] = r * (0.5 + scene_random(&random));
  }
  packing_view_init_arrays(&p->view, count, p->x, p->y, p->z, p->r);
  return p;
}

static packing_volume_report whole(packing_domain *domain, const pack *p)
{
  packing_volume_def def;
  packing_volume_report report;
  packing_volume_def_init(&def);
  def.tolerance = 1e-13;
  packing_volume_report_init(&report);
  assert_ok(packing_measure_volume(NULL, &def, domain, &p->view, &report));
  return report;
}

static packing_profile_report profile(packing_context *context, packing_domain *domain,
                                      const pack *p, packing_profile_kind kind, int axis,
                                      packing_profile_bin bins[BINS])
{
  packing_profile_def def;
  packing_profile_report report;
  size_t count;
  packing_profile_def_init(&def);
  def.kind = kind;
  def.axis = (packing_axis)axis;
  def.bins = BINS;
  packing_profile_report_init(&report);
  assert_ok(packing_measure_profile(context, &def, domain, &p->view, bins, BINS, &count,
                                    &report));
  return report;
}

static packing_porosity_map_report map(packing_context *context, packing_domain *domain,
                                       const pack *p, packing_porosity_cell cells[CELLS])
{
  packing_porosity_map_def def;
  packing_porosity_map_report report;
  size_t count;
  packing_porosity_map_def_init(&def);
  def.nx = 8;
  def.ny = 7;
  def.nz = 6;
  packing_porosity_map_report_init(&report);
  assert_ok(packing_measure_porosity_map(context, &def, domain, &p->view, cells, CELLS,
                                         &count, &report));
  return report;
}

/* Each kind of container along each axis, boxes also periodic. */
enum { SCENES = SCENE_END * 3 };

static scene scene_number(int i)
{
  scene s = scene_of((enum scene_kind)(i / 3));
  if (s.kind >= SCENE_CYLINDER && s.kind <= SCENE_SILO)
    s.axis = i % 3;
  if (s.kind == SCENE_BOX)
    s.periodic = i % 3 == 0 ? 0 : i % 3 == 1 ? 5 : 7;
  if (s.kind == SCENE_RECTANGLE)
    s.periodic = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 3;
  return s;
}

static void slabs_and_cells_add_up(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = scene_number(i);
    packing_domain *domain = scene_make(&s);
    pack *p = new_pack(domain, 40, 0.12, (uint64_t)i);
    packing_profile_bin bins[BINS];
    packing_porosity_cell cells[CELLS];
    const packing_volume_report all = whole(domain, p);
    for (int axis = 0; axis < scene_dim(&s); axis++) {
      const packing_profile_report found =
          profile(NULL, domain, p, PACKING_PROFILE_SLABS, axis, bins);
      assert_close(found.solid, all.solid_volume, 1e-12);
      assert_close(found.volume, all.domain_volume, 1e-12);
      assert_true(found.error < 1e-10);
    }
    const packing_porosity_map_report found = map(NULL, domain, p, cells);
    assert_close(found.solid, all.solid_volume, 1e-12);
    assert_close(found.volume, all.domain_volume, 1e-12);
    assert_near(found.mean, 1 - all.volume_fraction, 1e-11);
    double solid = 0;
    for (int c = 0; c < 8 * 7 * (scene_dim(&s) == 2 ? 1 : 6); c++)
      solid += cells[c].solid;
    assert_close(solid, found.solid, 1e-13);
    packing_domain_destroy(domain);
    free(p);
  }
}

/* Shells about the middle reach all of a container that is not periodic. */
static void shells_add_up(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = scene_number(i);
    if (s.periodic)
      continue;
    packing_domain *domain = scene_make(&s);
    pack *p = new_pack(domain, 40, 0.12, (uint64_t)i + 100);
    packing_profile_bin bins[BINS];
    const packing_volume_report all = whole(domain, p);
    for (int k = 0; k < 4; k++) {
      const packing_profile_report found = profile(
          NULL, domain, p, k < 3 ? PACKING_PROFILE_CYLINDERS : PACKING_PROFILE_SPHERES,
          k % 3, bins);
      assert_close(found.solid, all.solid_volume, 1e-11);
      assert_close(found.volume, all.domain_volume, 1e-11);
      for (int b = 0; b < BINS; b++)
        assert_true(bins[b].solid >= 0 && bins[b].volume >= 0);
    }
    packing_domain_destroy(domain);
    free(p);
  }
}

static int in_bin(const packing_profile_report *f, packing_profile_kind kind, int axis,
                  int dim, packing_vec3 p)
{
  double d[3] = {p.x - f->centre.x, p.y - f->centre.y, p.z - f->centre.z}, sum = 0;
  if (kind == PACKING_PROFILE_SLABS)
    return (int)((scene_coordinate(p, axis) - f->from) / (f->to - f->from) * BINS);
  for (int k = 0; k < dim; k++)
    if (dim == 2 || kind == PACKING_PROFILE_SPHERES || k != axis)
      sum += d[k] * d[k];
  return (int)(sqrt(sum) / f->to * BINS);
}

static size_t holders(const pack *p, packing_vec3 at, int dim)
{
  size_t count = 0;
  for (size_t i = 0; i < p->view.count; i++) {
    const double dx = at.x - p->x[i], dy = at.y - p->y[i],
                 dz = dim == 2 ? 0 : at.z - p->z[i];
    count += dx * dx + dy * dy + dz * dz <= p->r[i] * p->r[i];
  }
  return count;
}

/* Random points of the bounds: of those in a bin and in the container, the share in particles
 * (counted by how many). Bins with 100 points and more; the bound is 6 standard errors of a sum
 * whose terms have the deviation seen, that is 2e-9 for a normal one and, as it is not quite, some
 * 1e-7 a bin; 27 scenes of 20 bins: false alarms in 5e-5 of all seeds. The seed is fixed. */
static void points_agree(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = scene_number(i);
    if (s.periodic)
      continue;
    packing_domain *domain = scene_make(&s);
    pack *p = new_pack(domain, 50, 0.15, (uint64_t)i + 200);
    const int dim = scene_dim(&s), axis = dim == 2 ? i % 2 : i % 3;
    const packing_profile_kind kind = (packing_profile_kind)((i / 3 + i) % 3);
    packing_profile_bin bins[BINS];
    double n[BINS] = {0}, sum[BINS] = {0}, squares[BINS] = {0};
    const packing_profile_report found = profile(NULL, domain, p, kind, axis, bins);
    uint64_t random = (uint64_t)i + 300;
    for (int k = 0; k < 20000; k++) {
      packing_vec3 at = scene_random_point(&random, domain, 0);
      if (dim == 2)
        at.z = 0;
      if (!scene_inside(&s, at))
        continue;
      const int bin = in_bin(&found, kind, axis, dim, at);
      const double h = (double)holders(p, at, dim);
      assert_in_range(bin, 0, BINS - 1);
      n[bin]++;
      sum[bin] += h;
      squares[bin] += h * h;
    }
    for (int b = 0; b < BINS; b++) {
      if (n[b] < 100)
        continue;
      const double mean = sum[b] / n[b], sd = sqrt(squares[b] / n[b] - mean * mean);
      assert_near(bins[b].porosity, 1 - mean, 6 * (sd + 0.05) / sqrt(n[b]));
    }
    packing_domain_destroy(domain);
    free(p);
  }
}

/* Cavalieri: areas of sections, integrated over the heights, are volumes. The areas bend where
 * particles begin and end, which leaves the midpoint rule an error of the order of the square
 * of the step. */
static void sections_add_up_to_volumes(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = scene_number(i);
    if (scene_dim(&s) == 2)
      continue;
    packing_domain *domain = scene_make(&s);
    pack *p = new_pack(domain, 12, 0.3, (uint64_t)i + 400);
    const packing_volume_report all = whole(domain, p);
    for (int axis = i % 2; axis < 3; axis += 2) {
      packing_sections_def def;
      packing_sections_report report;
      packing_section_entry entry[100];
      size_t count;
      double solid = 0, area = 0;
      packing_sections_def_init(&def);
      packing_sections_report_init(&report);
      def.axis = (packing_axis)axis;
      def.sections = 100;
      def.tolerance = 1e-6;
      assert_ok(packing_measure_sections(NULL, &def, domain, &p->view, entry, 100, &count,
                                         &report));
      for (size_t k = 0; k < count; k++) {
        solid += entry[k].solid_area * (report.to - report.from) / 100;
        area += entry[k].container_area * (report.to - report.from) / 100;
      }
      assert_close(area, all.domain_volume, 1e-3);
      assert_close(solid, all.solid_volume, 3e-3);
      assert_near(report.porosity, 1 - all.volume_fraction, 2e-3);
    }
    packing_domain_destroy(domain);
    free(p);
  }
}

/* An oblique section against points of its window; 6 standard errors, as above. */
static void oblique_sections_agree_with_points(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i++) {
    const scene s = scene_number(i);
    if (scene_dim(&s) == 2 || s.periodic)
      continue;
    packing_domain *domain = scene_make(&s);
    pack *p = new_pack(domain, 60, 0.2, (uint64_t)i + 500);
    packing_section_def def;
    packing_section_report f;
    size_t discs;
    uint64_t random = (uint64_t)i;
    packing_section_def_init(&def);
    packing_section_report_init(&f);
    def.point = scene_random_point(&random, domain, -0.2);
    def.normal = (packing_vec3){scene_random(&random) - 0.5, scene_random(&random) - 0.5,
                                scene_random(&random) - 0.5};
    assert_ok(packing_measure_section(NULL, &def, domain, &p->view, NULL, 0, &discs, &f));
    const double window = (f.hi_u - f.lo_u) * (f.hi_v - f.lo_v);
    double in = 0, sum = 0, squares = 0;
    enum { POINTS = 20000 };
    for (int k = 0; k < POINTS; k++) {
      const double u = f.lo_u + (f.hi_u - f.lo_u) * scene_random(&random);
      const double v = f.lo_v + (f.hi_v - f.lo_v) * scene_random(&random);
      const packing_vec3 at = {f.origin.x + u * f.u_axis.x + v * f.v_axis.x,
                               f.origin.y + u * f.u_axis.y + v * f.v_axis.y,
                               f.origin.z + u * f.u_axis.z + v * f.v_axis.z};
      if (!scene_inside(&s, at))
        continue;
      const double h = (double)holders(p, at, 3);
      in++;
      sum += h;
      squares += h * h;
    }
    assert_near(f.container_area, in / POINTS * window, 6 * 0.5 * window / sqrt(POINTS));
    assert_near(f.solid_area, sum / POINTS * window,
                6 * window * sqrt(squares / POINTS) / sqrt(POINTS));
    packing_domain_destroy(domain);
    free(p);
  }
}

static uint64_t hash_all(packing_context *context, packing_domain *domain, const pack *p)
{
  packing_profile_bin bins[BINS];
  packing_porosity_cell cells[CELLS];
  packing_section_def plane;
  packing_section_report section;
  static packing_section_disc disc[DISCS];
  static unsigned char pixel[100 * 100];
  packing_section_image_def image_def;
  packing_section_image_report image;
  size_t count;
  uint64_t hash = TEST_HASH_START;
  for (int kind = 0; kind < 3; kind++) {
    profile(context, domain, p, (packing_profile_kind)kind, 2, bins);
    hash = test_hash(hash, bins, sizeof bins);
  }
  map(context, domain, p, cells);
  hash = test_hash(hash, cells, sizeof cells);
  packing_section_def_init(&plane);
  packing_section_report_init(&section);
  plane.point = (packing_vec3){0.3, 0.1, 0.7};
  plane.normal = (packing_vec3){1, 2, 3};
  assert_ok(packing_measure_section(context, &plane, domain, &p->view, disc, DISCS,
                                    &count, &section));
  assert_in_range(count, 10, DISCS);
  hash = test_hash(hash, disc, count * sizeof *disc);
  hash = test_hash(hash, &section, sizeof section);
  packing_section_image_def_init(&image_def);
  packing_section_image_report_init(&image);
  image_def.rows = image_def.columns = 100;
  assert_ok(packing_measure_section_image(context, &plane, &image_def, domain, &p->view,
                                          pixel, sizeof pixel, &count, &image));
  return test_hash(hash, pixel, sizeof pixel);
}

static void threads_change_nothing(void **state)
{
  (void)state;
  const enum scene_kind kinds[] = {SCENE_BOX, SCENE_CYLINDER};
  for (int i = 0; i < 2; i++) {
    scene s = scene_of(kinds[i]);
    s.periodic = i == 0 ? 3 : 0;
    packing_domain *domain = scene_make(&s);
    /* More than one block of 4096. */
    pack *p = new_pack(domain, i == 0 ? MOST : 4200, 0.02, 7);
    const uint64_t hash = hash_all(NULL, domain, p);
    for (int threads = 2; threads <= 3; threads++) {
      packing_context *context = test_context(threads, PACKING_ISA_AUTO);
      assert_true(hash_all(context, domain, p) == hash);
      packing_context_destroy(context);
    }
    packing_domain_destroy(domain);
    free(p);
  }
}

/* Lengths times 2^e: areas and volumes to the last bit. */
static void units_change_nothing(void **state)
{
  (void)state;
  for (int i = 0; i < SCENES; i += 4) {
    const scene s = scene_number(i);
    packing_domain *domain = scene_make(&s);
    pack *p = new_pack(domain, 20, 0.15, (uint64_t)i + 600);
    const int dim = scene_dim(&s);
    for (int e = -40; e <= 40; e += 80) {
      const scene t = scene_scaled(s, ldexp(1, e));
      packing_domain *large = scene_make(&t);
      pack *q = new_pack(domain, 20, 0.15, (uint64_t)i + 600);
      packing_profile_bin a[BINS], b[BINS];
      packing_porosity_cell c[CELLS], d[CELLS];
      for (size_t k = 0; k < q->view.count; k++) {
        q->x[k] = ldexp(q->x[k], e);
        q->y[k] = ldexp(q->y[k], e);
        q->z[k] = ldexp(q->z[k], e);
        q->r[k] = ldexp(q->r[k], e);
      }
      for (int kind = 0; kind < 3; kind++) {
        profile(NULL, domain, p, (packing_profile_kind)kind, dim - 1, a);
        profile(NULL, large, q, (packing_profile_kind)kind, dim - 1, b);
        for (int k = 0; k < BINS; k++)
          assert_true(ldexp(a[k].solid, dim * e) == b[k].solid &&
                      ldexp(a[k].volume, dim * e) == b[k].volume);
      }
      map(NULL, domain, p, c);
      map(NULL, large, q, d);
      for (int k = 0; k < 8 * 7 * (dim == 2 ? 1 : 6); k++)
        assert_true(ldexp(c[k].solid, dim * e) == d[k].solid &&
                    ldexp(c[k].volume, dim * e) == d[k].volume);
      packing_section_def plane;
      packing_section_report f, g;
      size_t discs[2];
      packing_section_def_init(&plane);
      packing_section_report_init(&f);
      packing_section_report_init(&g);
      plane.point = (packing_vec3){0.3, -0.1, 0.7};
      plane.normal = (packing_vec3){1, -2, 0.5};
      if (dim == 3) {
        assert_ok(packing_measure_section(NULL, &plane, domain, &p->view, NULL, 0,
                                          &discs[0], &f));
        plane.point.x = ldexp(plane.point.x, e);
        plane.point.y = ldexp(plane.point.y, e);
        plane.point.z = ldexp(plane.point.z, e);
        assert_ok(packing_measure_section(NULL, &plane, large, &q->view, NULL, 0,
                                          &discs[1], &g));
        assert_true(discs[0] == discs[1] && f.porosity == g.porosity &&
                    ldexp(f.solid_area, 2 * e) == g.solid_area);
      }
      packing_domain_destroy(large);
      free(q);
    }
    packing_domain_destroy(domain);
    free(p);
  }
}

/* A container of the user's: a ball, and the built-in one. */
static double ball_distance(void *user, const packing_vec3 *p, packing_vec3 *normal)
{
  const double *radius = user;
  const double rho = sqrt(p->x * p->x + p->y * p->y + p->z * p->z);
  if (normal != NULL)
    *normal = rho > 0 ? (packing_vec3){-p->x / rho, -p->y / rho, -p->z / rho}
                      : (packing_vec3){1, 0, 0};
  return *radius - rho;
}

static void custom_containers_come_near(void **state)
{
  (void)state;
  double radius = 1;
  packing_domain_custom_def def;
  packing_domain *custom = NULL;
  packing_domain_custom_def_init(&def);
  def.signed_distance = ball_distance;
  def.user = &radius;
  def.bounds.lo = (packing_vec3){-1, -1, -1};
  def.bounds.hi = (packing_vec3){1, 1, 1};
  def.volume = 4 * TEST_PI / 3;
  assert_ok(packing_domain_create_custom(NULL, &def, &custom));
  const scene s = {SCENE_SPHERE, 1, 0, 0, 0, {0, 0, 0}, 2, 0, 0};
  packing_domain *sphere = scene_make(&s);
  pack *p = new_pack(custom, 5, 0.2, 8);
  packing_profile_bin a[BINS], b[BINS];
  profile(NULL, sphere, p, PACKING_PROFILE_SLABS, 2, a);
  profile(NULL, custom, p, PACKING_PROFILE_SLABS, 2, b);
  for (int k = 0; k < BINS; k++) {
    assert_near(b[k].solid, a[k].solid, 5 * 2e-4 * 0.1);
    assert_near(b[k].volume, a[k].volume, 1e-3 * a[k].volume + 1e-5);
  }
  packing_profile_def shells;
  packing_profile_report report;
  size_t count;
  packing_profile_def_init(&shells);
  packing_profile_report_init(&report);
  shells.kind = PACKING_PROFILE_CYLINDERS;
  shells.to = 1;
  shells.bins = 4;
  assert_ok(
      packing_measure_profile(NULL, &shells, sphere, &p->view, a, BINS, &count, &report));
  assert_ok(
      packing_measure_profile(NULL, &shells, custom, &p->view, b, BINS, &count, &report));
  for (int k = 0; k < 4; k++) {
    assert_near(b[k].solid, a[k].solid, 5 * 2e-4 * 0.1);
    assert_near(b[k].volume, a[k].volume, 3e-3);
  }
  packing_section_def plane;
  packing_section_report f, g;
  size_t discs;
  packing_section_def_init(&plane);
  packing_section_report_init(&f);
  packing_section_report_init(&g);
  plane.point.z = 0.2;
  assert_ok(packing_measure_section(NULL, &plane, sphere, &p->view, NULL, 0, &discs, &f));
  assert_ok(packing_measure_section(NULL, &plane, custom, &p->view, NULL, 0, &discs, &g));
  assert_close(g.container_area, f.container_area, 1e-3);
  assert_near(g.solid_area, f.solid_area, 1e-3);
  packing_domain_destroy(custom);
  packing_domain_destroy(sphere);
  free(p);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(slabs_and_cells_add_up),
      cmocka_unit_test(shells_add_up),
      cmocka_unit_test(points_agree),
      cmocka_unit_test(sections_add_up_to_volumes),
      cmocka_unit_test(oblique_sections_agree_with_points),
      cmocka_unit_test(threads_change_nothing),
      cmocka_unit_test(units_change_nothing),
      cmocka_unit_test(custom_containers_come_near),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
