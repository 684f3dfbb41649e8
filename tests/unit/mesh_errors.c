/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes that are refused, with the field that is to blame; outputs stay as they are. */
#include "mesh_scenes.h"

static packing_context *context;
static shape *cube;

static int set_up(void **state)
{
  (void)state;
  context = test_context(1, PACKING_ISA_AUTO);
  cube = shape_of(SHAPE_CUBE);
  return 0;
}

static int tear_down(void **state)
{
  (void)state;
  packing_context_destroy(context);
  free(cube);
  return 0;
}

static packing_mesh_def def_of_cube(void)
{
  packing_mesh_def def;
  packing_mesh_def_init(&def);
  def.vertex_count = cube->vertices;
  def.vertices = &cube->vertex[0][0];
  def.triangle_count = cube->triangles;
  def.triangles = &cube->triangle[0][0];
  return def;
}

static void refuse(const packing_mesh_def *def, packing_status status, const char *field)
{
  packing_mesh *mesh = NULL;
  assert_fails(context, packing_mesh_create(context, def, &mesh), status, field);
  assert_null(mesh);
  assert_status(packing_mesh_create(NULL, def, &mesh), status);
}

static void test_fields(void **state)
{
  (void)state;
  const packing_mesh_def good = def_of_cube();
  packing_mesh_def d = good;
  packing_mesh *mesh = NULL;
  assert_fails(context, packing_mesh_create(context, NULL, &mesh), PACKING_ERR_INVALID,
               "def");
  assert_fails(context, packing_mesh_create(context, &good, NULL), PACKING_ERR_INVALID,
               "mesh");
  d.struct_size = 0;
  refuse(&d, PACKING_ERR_ABI, "struct_size");
  d = good;
  d.vertices = NULL;
  refuse(&d, PACKING_ERR_INVALID, "vertices");
  d = good;
  d.vertex_count = 2;
  refuse(&d, PACKING_ERR_RANGE, "vertex_count");
  d.vertex_count = SIZE_MAX;
  refuse(&d, PACKING_ERR_RANGE, "vertex_count");
  d = good;
  d.triangle_count = 0;
  refuse(&d, PACKING_ERR_RANGE, "triangle_count");
  d.triangle_count = ((size_t)1 << 28) + 1;
  refuse(&d, PACKING_ERR_RANGE, "triangle_count");
  d = good;
  d.triangles = NULL;
  refuse(&d, PACKING_ERR_RANGE, "triangle_count");
  const double merges[] = {-1, 0.02, NAN, HUGE_VAL};
  for (int i = 0; i < 4; i++) {
    d = good;
    d.merge = merges[i];
    refuse(&d, i < 2 ? PACKING_ERR_RANGE : PACKING_ERR_INVALID, "merge");
  }
  const double scales[] = {0, -1, NAN, HUGE_VAL};
  for (int i = 0; i < 4; i++) {
    d = good;
    d.scale = scales[i];
    refuse(&d, i < 2 ? PACKING_ERR_RANGE : PACKING_ERR_INVALID, "scale");
  }
  d = good;
  d.shift.y = NAN;
  refuse(&d, PACKING_ERR_INVALID, "shift.y");
}

static void test_arrays(void **state)
{
  (void)state;
  packing_mesh_def d = def_of_cube();
  cube->vertex[3][1] = NAN;
  refuse(&d, PACKING_ERR_INVALID, "vertices");
  assert_non_null(strstr(packing_context_message(context), "y of vertex 3"));
  cube->vertex[3][1] = HUGE_VAL;
  refuse(&d, PACKING_ERR_INVALID, "vertices");
  cube->vertex[3][1] = 1;
  cube->triangle[7][2] = 8;
  refuse(&d, PACKING_ERR_RANGE, "triangles");
  assert_non_null(strstr(packing_context_message(context), "triangle 7"));
  cube->triangle[7][2] = UINT32_MAX;
  refuse(&d, PACKING_ERR_RANGE, "triangles");
}

/* Lengths whose cubes are no doubles; a shift in which all is lost. */
static void test_extremes(void **state)
{
  (void)state;
  packing_mesh_def d = def_of_cube();
  d.scale = 1e110;
  refuse(&d, PACKING_ERR_RANGE, "vertices");
  d.scale = 1e-110;
  refuse(&d, PACKING_ERR_RANGE, "vertices");
  d.scale = 1e-300;
  refuse(&d, PACKING_ERR_RANGE, "vertices");
  for (int i = 0; i < 24; i++)
    cube->vertex[i / 3][i % 3] = 0;
  d = def_of_cube();
  packing_mesh *mesh = NULL;
  packing_mesh_report r;
  assert_ok(packing_mesh_create(context, &d, &mesh)); /* all in one place */
  packing_mesh_report_init(&r);
  assert_ok(packing_mesh_check(context, mesh, &r));
  assert_int_equal(r.defect, PACKING_MESH_DEGENERATE);
  assert_int_equal(r.count, 12);
  packing_mesh_destroy(mesh);
  d.merge = 1e-3;
  refuse(&d, PACKING_ERR_GEOMETRY, "merge");
}

static void test_questions(void **state)
{
  (void)state;
  packing_mesh *mesh = shape_mesh(cube);
  packing_mesh_report r = {0};
  packing_mesh_view v = {0};
  assert_fails(context, packing_mesh_check(context, NULL, &r), PACKING_ERR_INVALID,
               "mesh");
  assert_fails(context, packing_mesh_check(context, mesh, NULL), PACKING_ERR_INVALID,
               "report");
  assert_fails(context, packing_mesh_check(context, mesh, &r), PACKING_ERR_ABI,
               "struct_size");
  assert_fails(context, packing_mesh_arrays(context, NULL, &v), PACKING_ERR_INVALID,
               "mesh");
  assert_fails(context, packing_mesh_arrays(context, mesh, NULL), PACKING_ERR_INVALID,
               "report");
  assert_fails(context, packing_mesh_arrays(context, mesh, &v), PACKING_ERR_ABI,
               "struct_size");
  packing_mesh_destroy(mesh);
}

static void test_containers(void **state)
{
  (void)state;
  packing_domain_mesh_def def;
  packing_domain *domain = NULL, *inset = NULL;
  packing_mesh *mesh = shape_mesh(cube);
  packing_domain_mesh_def_init(&def);
  assert_fails(context, packing_domain_create_mesh(context, NULL, &domain),
               PACKING_ERR_INVALID, "def");
  assert_fails(context, packing_domain_create_mesh(context, &def, &domain),
               PACKING_ERR_INVALID, "mesh");
  def.mesh = mesh;
  assert_fails(context, packing_domain_create_mesh(context, &def, NULL),
               PACKING_ERR_INVALID, "domain");
  def.struct_size = 3;
  assert_fails(context, packing_domain_create_mesh(context, &def, &domain),
               PACKING_ERR_ABI, "struct_size");
  assert_null(domain);
  packing_domain_mesh_def_init(&def);
  def.mesh = mesh;
  assert_ok(packing_domain_create_mesh(NULL, &def, &domain));
  assert_fails(context, packing_domain_create_inset(context, domain, 0.5, &inset),
               PACKING_ERR_GEOMETRY, "distance");
  assert_fails(context, packing_domain_create_inset(context, domain, -1, &inset),
               PACKING_ERR_RANGE, "distance");
  assert_null(inset);
  packing_domain_destroy(domain);
  packing_mesh_destroy(mesh);
}

/* About the radius of the largest ball within: what is left is told, or why not; never more than
 * there is. The inset of a tetrahedron is one, smaller by the distance over that radius. */
static void test_little_is_left(void **state)
{
  (void)state;
  static const double share[] = {0.9,      0.99, 0.9999, 1 - 1e-9, 1,
                                 1 + 1e-9, 1.01, 2,      1e300};
  shape *s = shape_of(SHAPE_TETRAHEDRON);
  packing_domain *domain = shape_domain(s, 1);
  packing_mesh *mesh = shape_mesh(s);
  const double volume = packing_domain_volume(domain);
  const double radius = 3 * volume / packing_mesh_area(mesh);
  for (size_t i = 0; i < sizeof share / sizeof *share; i++) {
    packing_domain *inset = NULL;
    const packing_status status =
        packing_domain_create_inset(context, domain, radius * share[i], &inset);
    if (status == PACKING_OK) {
      const double left = volume * pow(1 - share[i], 3);
      assert_true(share[i] < 1);
      assert_near(packing_domain_volume(inset), left, 2e-2 * left);
    } else {
      assert_true(status == PACKING_ERR_GEOMETRY || status == PACKING_ERR_RANGE);
      test_names(context, "distance", "inset", __FILE__, __LINE__);
      assert_null(inset);
    }
    packing_domain_destroy(inset);
  }
  packing_mesh_destroy(mesh);
  packing_domain_destroy(domain);
  free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(test_fields, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_arrays, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_extremes, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_questions, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_containers, set_up, tear_down),
      cmocka_unit_test_setup_teardown(test_little_is_left, set_up, tear_down),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
