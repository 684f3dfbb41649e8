/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What profiles, maps and sections refuse, and that they leave their outputs alone then. */
#include "test.h"

typedef struct scene {
  packing_context *context;
  packing_domain *box, *square, *bad;
  double x[2], y[2], z[2], r[2];
  packing_view view;
  size_t count;
} scene;

static double no_number(void *user, const packing_vec3 *point, packing_vec3 *normal)
{
  (void)user;
  if (normal != NULL)
    *normal = (packing_vec3){0, 0, 1};
  return point->x < 0.75 ? 0.5 - fabs(point->x - 0.5) : (double)NAN;
}

static scene *new_scene(void)
{
  scene *s = calloc(1, sizeof *s);
  packing_domain_custom_def def;
  assert_non_null(s);
  s->context = test_context(1, PACKING_ISA_AUTO);
  s->box = test_box(1, 1, 1, 0);
  s->square = test_rectangle(1, 1, 0);
  packing_domain_custom_def_init(&def);
  def.signed_distance = no_number;
  def.bounds.hi = (packing_vec3){1, 1, 1};
  def.volume = 1;
  assert_ok(packing_domain_create_custom(NULL, &def, &s->bad));
  for (int i = 0; i < 2; i++) {
    s->x[i] = 0.3 + 0.5 * i;
    s->y[i] = s->z[i] = 0.5;
    s->r[i] = 0.25;
  }
  packing_view_init_arrays(&s->view, 2, s->x, s->y, s->z, s->r);
  s->count = 4711;
  return s;
}

static void free_scene(scene *s)
{
  assert_int_equal(s->count, 4711);
  packing_domain_destroy(s->box);
  packing_domain_destroy(s->square);
  packing_domain_destroy(s->bad);
  packing_context_destroy(s->context);
  free(s);
}

#define NAN_ ((double)NAN)
#define INF_ ((double)INFINITY)

static void profiles_refuse(void **state)
{
  (void)state;
  scene *s = new_scene();
  packing_profile_def def;
  packing_profile_report report;
  packing_profile_bin bin[64] = {{0, 0, 0, 0, 0}};
  packing_profile_report_init(&report);
#define REFUSED(status, field, domain_, ...)                                             \
  do {                                                                                   \
    packing_profile_def_init(&def);                                                      \
    __VA_ARGS__;                                                                         \
    assert_fails(s->context,                                                             \
                 packing_measure_profile(s->context, &def, (domain_), &s->view, bin, 64, \
                                         &s->count, &report),                            \
                 (status), (field));                                                     \
  } while (0)
  REFUSED(PACKING_ERR_RANGE, "kind", s->box, def.kind = (packing_profile_kind)3);
  REFUSED(PACKING_ERR_RANGE, "kind", s->box, def.kind = (packing_profile_kind)-1);
  REFUSED(PACKING_ERR_RANGE, "axis", s->box, def.axis = (packing_axis)3);
  REFUSED(PACKING_ERR_RANGE, "axis", s->square, def.axis = PACKING_AXIS_Z);
  REFUSED(PACKING_ERR_RANGE, "own_centre", s->box, def.own_centre = 2);
  REFUSED(PACKING_ERR_INVALID, "centre.y", s->box, def.centre.y = NAN_);
  REFUSED(PACKING_ERR_INVALID, "from", s->box, def.from = NAN_);
  REFUSED(PACKING_ERR_INVALID, "to", s->box, def.to = INF_);
  REFUSED(PACKING_ERR_RANGE, "to", s->box, (def.from = 1, def.to = 1));
  REFUSED(PACKING_ERR_RANGE, "to", s->box, (def.from = 1, def.to = 0.5));
  REFUSED(PACKING_ERR_RANGE, "to", s->box, (def.from = -1e308, def.to = 1e308));
  REFUSED(PACKING_ERR_RANGE, "from", s->box,
          (def.kind = PACKING_PROFILE_SPHERES, def.from = -1, def.to = 1));
  REFUSED(PACKING_ERR_RANGE, "bins", s->box, def.bins = 0);
  REFUSED(PACKING_ERR_RANGE, "tolerance", s->box, def.tolerance = 0);
  REFUSED(PACKING_ERR_RANGE, "tolerance", s->box, def.tolerance = 1);
  REFUSED(PACKING_ERR_INVALID, "tolerance", s->box, def.tolerance = NAN_);
  REFUSED(PACKING_ERR_ABI, "struct_size", s->box, def.struct_size = 1);
  REFUSED(PACKING_ERR_INVALID, "domain", NULL, (void)0);
  REFUSED(PACKING_ERR_GEOMETRY, "domain", s->bad, (void)0);
  s->r[1] = 0;
  REFUSED(PACKING_ERR_RANGE, "particle 1", s->box, (void)0);
  s->r[1] = 0.1;
  s->z[1] = NAN_;
  REFUSED(PACKING_ERR_INVALID, "z", s->box, (void)0);
  s->z[1] = 0.5;
#undef REFUSED
  packing_domain *cell = test_box(1, 1, 1, 7);
  packing_profile_def_init(&def);
  def.kind = PACKING_PROFILE_SPHERES;
  def.to = 1e6;
  assert_fails(s->context,
               packing_measure_profile(s->context, &def, cell, &s->view, bin, 64,
                                       &s->count, &report),
               PACKING_ERR_RANGE, "to");
  packing_domain_destroy(cell);
  cell = test_box(1e-9, 1, 1, 1);
  assert_fails(s->context,
               packing_measure_profile(s->context, NULL, cell, &s->view, bin, 64,
                                       &s->count, &report),
               PACKING_ERR_RANGE, "r");
  packing_domain_destroy(cell);
  assert_fails(s->context,
               packing_measure_profile(s->context, NULL, s->box, &s->view, NULL, 64,
                                       &s->count, &report),
               PACKING_ERR_INVALID, "bins");
  assert_fails(
      s->context,
      packing_measure_profile(s->context, NULL, s->box, &s->view, bin, 64, NULL, &report),
      PACKING_ERR_INVALID, "count");
  assert_fails(s->context,
               packing_measure_profile(s->context, NULL, s->box, &s->view, bin, 64,
                                       &s->count, NULL),
               PACKING_ERR_INVALID, "report");
  assert_fails(s->context,
               packing_measure_profile(s->context, NULL, s->box, NULL, bin, 64, &s->count,
                                       &report),
               PACKING_ERR_INVALID, "view");
  report.struct_size = 0;
  assert_fails(s->context,
               packing_measure_profile(s->context, NULL, s->box, &s->view, bin, 64,
                                       &s->count, &report),
               PACKING_ERR_ABI, "struct_size");
  assert_true(bin[0].volume == 0 && bin[0].to == 0 && report.volume == 0);
  free_scene(s);
}

static void maps_refuse(void **state)
{
  (void)state;
  scene *s = new_scene();
  packing_porosity_map_def def;
  packing_porosity_map_report report;
  packing_porosity_cell cell[1000] = {{0, 0, 0}};
  packing_porosity_map_report_init(&report);
#define REFUSED(status, field, domain_, ...)                                             \
  do {                                                                                   \
    packing_porosity_map_def_init(&def);                                                 \
    __VA_ARGS__;                                                                         \
    assert_fails(s->context,                                                             \
                 packing_measure_porosity_map(s->context, &def, (domain_), &s->view,     \
                                              cell, 1000, &s->count, &report),           \
                 (status), (field));                                                     \
  } while (0)
  REFUSED(PACKING_ERR_INVALID, "bounds.lo.z", s->box, def.bounds.lo.z = NAN_);
  REFUSED(PACKING_ERR_INVALID, "bounds.hi.x", s->box, def.bounds.hi.x = INF_);
  REFUSED(PACKING_ERR_RANGE, "bounds.hi.y", s->box, def.bounds.hi.x = 1);
  REFUSED(PACKING_ERR_RANGE, "nx", s->box, def.nx = 0);
  REFUSED(PACKING_ERR_RANGE, "ny", s->box, def.ny = 0);
  REFUSED(PACKING_ERR_RANGE, "nz", s->box, def.nz = 0);
  REFUSED(PACKING_ERR_RANGE, "nz", s->box, def.nz = SIZE_MAX / 16);
  REFUSED(PACKING_ERR_NOMEM, "memory", s->box, def.nz = SIZE_MAX / 3300);
  REFUSED(PACKING_ERR_RANGE, "tolerance", s->box, def.tolerance = 1);
  REFUSED(PACKING_ERR_ABI, "struct_size", s->box, def.struct_size = 1);
  REFUSED(PACKING_ERR_INVALID, "domain", NULL, (void)0);
  REFUSED(PACKING_ERR_GEOMETRY, "domain", s->bad, (void)0);
  packing_domain *periodic = test_box(1, 1, 1, 7);
  REFUSED(PACKING_ERR_RANGE, "bounds", periodic,
          def.bounds.hi = ((packing_vec3){1e9, 1, 1}));
  packing_domain_destroy(periodic);
#undef REFUSED
  assert_fails(s->context,
               packing_measure_porosity_map(s->context, NULL, s->box, &s->view, NULL, 1,
                                            &s->count, &report),
               PACKING_ERR_INVALID, "cells");
  assert_fails(s->context,
               packing_measure_porosity_map(s->context, NULL, s->box, &s->view, cell,
                                            1000, NULL, &report),
               PACKING_ERR_INVALID, "count");
  assert_fails(s->context,
               packing_measure_porosity_map(s->context, NULL, s->box, &s->view, cell,
                                            1000, &s->count, NULL),
               PACKING_ERR_INVALID, "report");
  assert_true(cell[0].volume == 0 && report.volume == 0);
  free_scene(s);
}

static void sections_refuse(void **state)
{
  (void)state;
  scene *s = new_scene();
  packing_section_def def;
  packing_section_report report;
  packing_section_disc disc[4] = {{0, 0, 0, 0, 0}};
  packing_section_report_init(&report);
#define REFUSED(status, field, domain_, ...)                                             \
  do {                                                                                   \
    packing_section_def_init(&def);                                                      \
    def.point.z = 0.5;                                                                   \
    __VA_ARGS__;                                                                         \
    assert_fails(s->context,                                                             \
                 packing_measure_section(s->context, &def, (domain_), &s->view, disc, 4, \
                                         &s->count, &report),                            \
                 (status), (field));                                                     \
  } while (0)
  REFUSED(PACKING_ERR_INVALID, "point.x", s->box, def.point.x = NAN_);
  REFUSED(PACKING_ERR_INVALID, "normal.y", s->box, def.normal.y = INF_);
  REFUSED(PACKING_ERR_RANGE, "normal", s->box, def.normal.z = 0);
  REFUSED(PACKING_ERR_RANGE, "tolerance", s->box, def.tolerance = -1);
  REFUSED(PACKING_ERR_UNSUPPORTED, "domain", s->square, (void)0);
  REFUSED(PACKING_ERR_INVALID, "domain", NULL, (void)0);
  REFUSED(PACKING_ERR_GEOMETRY, "domain", s->bad, (void)0);
  REFUSED(PACKING_ERR_ABI, "struct_size", s->box, def.struct_size = 1);
#undef REFUSED
  assert_fails(s->context,
               packing_measure_section(s->context, NULL, s->box, &s->view, NULL, 1,
                                       &s->count, &report),
               PACKING_ERR_INVALID, "discs");
  assert_fails(
      s->context,
      packing_measure_section(s->context, NULL, s->box, &s->view, disc, 4, NULL, &report),
      PACKING_ERR_INVALID, "count");
  assert_fails(s->context,
               packing_measure_section(s->context, NULL, s->box, &s->view, disc, 4,
                                       &s->count, NULL),
               PACKING_ERR_INVALID, "report");
  assert_true(disc[0].r == 0 && report.container_area == 0);
  free_scene(s);
}

static void series_refuse(void **state)
{
  (void)state;
  scene *s = new_scene();
  packing_sections_def def;
  packing_sections_report report;
  packing_section_entry entry[8] = {{0, 0, 0, 0}};
  packing_sections_report_init(&report);
#define REFUSED(status, field, domain_, ...)                                             \
  do {                                                                                   \
    packing_sections_def_init(&def);                                                     \
    __VA_ARGS__;                                                                         \
    assert_fails(s->context,                                                             \
                 packing_measure_sections(s->context, &def, (domain_), &s->view, entry,  \
                                          8, &s->count, &report),                        \
                 (status), (field));                                                     \
  } while (0)
  REFUSED(PACKING_ERR_RANGE, "axis", s->box, def.axis = (packing_axis)-1);
  REFUSED(PACKING_ERR_RANGE, "sections", s->box, def.sections = 0);
  REFUSED(PACKING_ERR_INVALID, "from", s->box, def.from = INF_);
  REFUSED(PACKING_ERR_RANGE, "to", s->box, def.from = 1);
  REFUSED(PACKING_ERR_RANGE, "tolerance", s->box, def.tolerance = 2);
  REFUSED(PACKING_ERR_UNSUPPORTED, "domain", s->square, (void)0);
  REFUSED(PACKING_ERR_INVALID, "domain", NULL, (void)0);
  REFUSED(PACKING_ERR_GEOMETRY, "domain", s->bad, (void)0);
  REFUSED(PACKING_ERR_ABI, "struct_size", s->box, def.struct_size = 1);
  REFUSED(PACKING_ERR_NOMEM, "memory", s->box, def.sections = SIZE_MAX / 8);
#undef REFUSED
  assert_fails(s->context,
               packing_measure_sections(s->context, NULL, s->box, &s->view, NULL, 1,
                                        &s->count, &report),
               PACKING_ERR_INVALID, "entries");
  assert_fails(s->context,
               packing_measure_sections(s->context, NULL, s->box, &s->view, entry, 8,
                                        NULL, &report),
               PACKING_ERR_INVALID, "count");
  assert_fails(s->context,
               packing_measure_sections(s->context, NULL, s->box, &s->view, entry, 8,
                                        &s->count, NULL),
               PACKING_ERR_INVALID, "report");
  assert_true(entry[0].container_area == 0 && report.sections == 0);
  free_scene(s);
}

static void images_refuse(void **state)
{
  (void)state;
  scene *s = new_scene();
  packing_section_def section;
  packing_section_image_def def;
  packing_section_image_report report;
  static unsigned char pixel[250000];
  packing_section_image_report_init(&report);
  pixel[0] = 99;
#define REFUSED(status, field, domain_, ...)                                             \
  do {                                                                                   \
    packing_section_def_init(&section);                                                  \
    packing_section_image_def_init(&def);                                                \
    section.point.z = 0.5;                                                               \
    __VA_ARGS__;                                                                         \
    assert_fails(s->context,                                                             \
                 packing_measure_section_image(s->context, &section, &def, (domain_),    \
                                               &s->view, pixel, sizeof pixel, &s->count, \
                                               &report),                                 \
                 (status), (field));                                                     \
  } while (0)
  REFUSED(PACKING_ERR_RANGE, "rows", s->box, def.rows = 0);
  REFUSED(PACKING_ERR_RANGE, "columns", s->box, def.columns = 0);
  REFUSED(PACKING_ERR_RANGE, "rows", s->box, def.rows = SIZE_MAX / 2);
  REFUSED(PACKING_ERR_RANGE, "capacity", s->box, def.rows = 501);
  REFUSED(PACKING_ERR_INVALID, "lo_u", s->box, def.lo_u = NAN_);
  REFUSED(PACKING_ERR_RANGE, "hi_u", s->box, def.lo_u = 1);
  REFUSED(PACKING_ERR_RANGE, "hi_v", s->box, def.hi_u = 1);
  REFUSED(PACKING_ERR_RANGE, "point", s->box, section.point.z = 7);
  REFUSED(PACKING_ERR_RANGE, "normal", s->box, section.normal.z = 0);
  REFUSED(PACKING_ERR_UNSUPPORTED, "domain", s->square, (void)0);
  REFUSED(PACKING_ERR_INVALID, "domain", NULL, (void)0);
  REFUSED(PACKING_ERR_GEOMETRY, "domain", s->bad, (void)0);
  REFUSED(PACKING_ERR_ABI, "struct_size", s->box, def.struct_size = 1);
#undef REFUSED
  assert_fails(s->context,
               packing_measure_section_image(s->context, NULL, NULL, s->box, &s->view,
                                             NULL, sizeof pixel, &s->count, &report),
               PACKING_ERR_INVALID, "pixels");
  assert_fails(s->context,
               packing_measure_section_image(s->context, NULL, NULL, s->box, &s->view,
                                             pixel, sizeof pixel, NULL, &report),
               PACKING_ERR_INVALID, "count");
  assert_fails(s->context,
               packing_measure_section_image(s->context, NULL, NULL, s->box, &s->view,
                                             pixel, sizeof pixel, &s->count, NULL),
               PACKING_ERR_INVALID, "report");
  assert_true(pixel[0] == 99 && report.rows == 0);
  free_scene(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(profiles_refuse), cmocka_unit_test(maps_refuse),
      cmocka_unit_test(sections_refuse), cmocka_unit_test(series_refuse),
      cmocka_unit_test(images_refuse),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
