/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes with closed forms; every defect provoked and located; containers of meshes. */
#include "mesh_scenes.h"

static void check_contents(int kind, double area, double volume)
{
  shape *s = shape_of(kind);
  packing_mesh *mesh = shape_mesh(s);
  packing_domain *domain = shape_domain(s, 1);
  packing_mesh_report report;
  assert_close(packing_mesh_area(mesh), area, 1e-14);
  assert_close(packing_mesh_volume(mesh), volume, 1e-14);
  assert_true(packing_domain_volume(domain) == packing_mesh_volume(mesh));
  packing_mesh_report_init(&report);
  assert_ok(packing_mesh_check(NULL, mesh, &report));
  assert_int_equal(report.defect, PACKING_MESH_SOUND);
  assert_int_equal(report.count, 0);
  assert_int_equal(report.parts, kind == SHAPE_HOLLOW ? 2 : 1);
  assert_true(report.triangle == PACKING_NO_INDEX && report.other == PACKING_NO_INDEX);
  packing_domain_destroy(domain);
  packing_mesh_destroy(mesh);
  free(s);
}

static void test_contents(void **state)
{
  (void)state;
  check_contents(SHAPE_CUBE, 6, 1);
  check_contents(SHAPE_TETRAHEDRON, 8 * sqrt(3), 8.0 / 3);
  check_contents(SHAPE_OCTAHEDRON, 4 * sqrt(3), 4.0 / 3);
  check_contents(SHAPE_ANGLE, 2 * 3 + 8, 3);
  check_contents(SHAPE_STAR,
                 2 * 7 * 0.15 * sin(MESH_PI / 7) +
                     14 * 0.4 * sqrt(1 + 0.15 * 0.15 - 2 * 0.15 * cos(MESH_PI / 7)),
                 0.4 * 7 * 0.15 * sin(MESH_PI / 7));
  check_contents(SHAPE_HOLLOW,
                 2 * (2.3 * 2.3 + 2 * 2.3 * 2.3) +
                     2 * (0.5 * 0.9 + 0.9 * 0.8 + 0.8 * 0.5),
                 2.3 * 2.3 * 2.3 - 0.5 * 0.9 * 0.8);
}

/* Slices of a polygon turned by steps of 2 pi / n: between two of them a point at rho is as far from
 * the axis as rho cos(pi / n) and the way across is 2 rho sin(pi / n), so by Pappus V = n sin(2 pi /
 * n) times area and mean radius of the polygon. */
static void test_contents_of_a_torus(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_TORUS);
  packing_mesh *mesh = shape_mesh(s);
  const double slice = 0.5 * 13 * 0.37 * 0.37 * sin(2 * MESH_PI / 13);
  assert_close(packing_mesh_volume(mesh), slice * 24 * sin(2 * MESH_PI / 24), 1e-13);
  assert_true(packing_mesh_volume(mesh) < 2 * MESH_PI * MESH_PI * 0.37 * 0.37);
  packing_mesh_destroy(mesh);
  free(s);
}

/* Corners on the sphere: within, converging with the square of the edge. */
static void test_contents_of_spheres(void **state)
{
  (void)state;
  double off[5];
  for (int level = 0; level < 5; level++) {
    shape *s = shape_new();
    shape_sphere(s, level);
    assert_int_equal(s->triangles, 8 << 2 * level);
    packing_mesh *mesh = shape_mesh(s);
    off[level] = 4 * MESH_PI / 3 - packing_mesh_volume(mesh);
    assert_true(off[level] > 0);
    if (level > 2)
      assert_near(off[level - 1] / off[level], 4, 0.3);
    packing_mesh_destroy(mesh);
    free(s);
  }
}

/* Distances with closed forms. */
static void test_distances(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_OCTAHEDRON);
  packing_domain *domain = shape_domain(s, 1);
  packing_vec3 n;
  const packing_vec3 middle = {0, 0, 0}, beyond_corner = {3, 0, 0},
                     beyond_edge = {2, 2, 0}, beyond_face = {1, 1, 1};
  assert_close(packing_domain_signed_distance(domain, &middle, &n), 1 / sqrt(3), 1e-15);
  assert_close(packing_domain_signed_distance(domain, &beyond_corner, &n), -2.0, 1e-15);
  assert_true(n.x == -1 && n.y == 0 && n.z == 0);
  assert_close(packing_domain_signed_distance(domain, &beyond_edge, &n), -1.5 * sqrt(2),
               1e-15);
  assert_near(n.x, -sqrt(0.5), 1e-15);
  assert_close(packing_domain_signed_distance(domain, &beyond_face, &n), -2 / sqrt(3),
               1e-15);
  assert_true(packing_domain_holds(domain, &middle, 0.577));
  assert_false(packing_domain_holds(domain, &middle, 0.578));
  assert_string_equal(packing_domain_kind(domain), "mesh");
  assert_int_equal(packing_domain_dim(domain), 3);
  assert_int_equal(packing_domain_periodic(domain), 0);
  packing_domain_destroy(domain);
  free(s);
}

/* On the surface the distance is 0 and the normal shows inwards: at corners too. */
static void test_normals_on_the_surface(void **state)
{
  (void)state;
  for (int kind = 0; kind < SHAPE_END; kind++) {
    shape *s = shape_of(kind);
    packing_domain *domain = shape_domain(s, 1);
    for (size_t v = 0; v < s->vertices; v++) {
      packing_vec3 n;
      const packing_vec3 p = shape_vec(s->vertex[v]);
      assert_near(packing_domain_signed_distance(domain, &p, &n), 0, 1e-16);
      assert_near(shape_norm(n), 1, 1e-14);
    }
    packing_domain_destroy(domain);
    free(s);
  }
}

/* Far beyond what squares can hold: outside. */
static void test_points_far_off(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  packing_domain *domain = shape_domain(s, 1);
  packing_vec3 n;
  const packing_vec3 points[] = {{1e200, 0, 0}, {HUGE_VAL, 0, 0}, {0, -HUGE_VAL, 0}};
  for (int i = 0; i < 3; i++) {
    assert_true(packing_domain_signed_distance(domain, &points[i], &n) < 0);
    assert_false(packing_domain_holds(domain, &points[i], 0));
  }
  const packing_vec3 none = {NAN, 0, 0};
  assert_true(isnan(packing_domain_signed_distance(domain, &none, NULL)));
  assert_false(packing_domain_holds(domain, &none, 0));
  packing_domain_destroy(domain);
  free(s);
}

/* ---- defects ---- */

static packing_mesh_report report_of(const shape *s)
{
  packing_mesh_report r;
  packing_mesh *mesh = shape_mesh(s);
  packing_mesh_report_init(&r);
  assert_ok(packing_mesh_check(NULL, mesh, &r));
  packing_mesh_destroy(mesh);
  return r;
}

/* The container is refused with the defect's words and its triangle. */
static void check_refused(const shape *s, const packing_mesh_report *r)
{
  packing_context *context = test_context(2, PACKING_ISA_AUTO);
  packing_mesh *mesh = shape_mesh(s);
  packing_domain *domain = NULL;
  char number[32];
  (void)snprintf(number, sizeof number, "%zu", r->triangle);
  assert_status(shape_domain_of(context, mesh, &domain), PACKING_ERR_GEOMETRY);
  const char *message = packing_context_message(context);
  assert_non_null(strstr(message, packing_mesh_defect_string(r->defect)));
  assert_non_null(strstr(message, number));
  assert_null(strchr(message, '\n'));
  assert_null(domain);
  packing_mesh_destroy(mesh);
  packing_context_destroy(context);
}

static void check_defect(shape *s, packing_mesh_defect defect, size_t count,
                         size_t triangle, size_t other)
{
  const packing_mesh_report r = report_of(s);
  assert_int_equal(r.defect, defect);
  assert_int_equal(r.count, count);
  assert_int_equal(r.triangle, triangle);
  assert_true(r.other == other);
  check_refused(s, &r);
  free(s);
}

static const size_t none = PACKING_NO_INDEX;

static void test_degenerate(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  shape_triangle(s, 0, 7, 7); /* two corners in one place */
  check_defect(s, PACKING_MESH_DEGENERATE, 1, 12, none);
  s = shape_of(SHAPE_CUBE);
  const uint32_t middle = shape_vertex(s, 0.5, 0.5, 0.5);
  shape_triangle(s, 0, middle, 7); /* on a line, exactly */
  check_defect(s, PACKING_MESH_DEGENERATE, 1, 12, none);
}

static void test_open(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  s->triangles--;
  const packing_mesh_report r = report_of(s);
  assert_int_equal(r.defect, PACKING_MESH_OPEN);
  assert_int_equal(r.count, 3);
  assert_true(r.point.x == 1 || r.point.y == 1 || r.point.z == 1);
  check_defect(s, PACKING_MESH_OPEN, 3, r.triangle, none);
  s = shape_of(SHAPE_SPHERE); /* a single triangle gone, in the midst */
  memmove(s->triangle[100], s->triangle[101],
          (s->triangles - 101) * sizeof s->triangle[0]);
  s->triangles--;
  assert_int_equal(report_of(s).defect, PACKING_MESH_OPEN);
  assert_int_equal(report_of(s).count, 3);
  free(s);
}

static void test_non_manifold(void **state)
{
  (void)state;
  shape *s = shape_new(); /* two boxes that share an edge */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){1, 1, 0}, (packing_vec3){2, 2, 1}, 0);
  const packing_mesh_report r = report_of(s);
  assert_int_equal(r.defect, PACKING_MESH_NON_MANIFOLD);
  assert_int_equal(r.count, 1);
  assert_true(r.point.x == 1 && r.point.y == 1 && r.point.z == 0.5);
  check_defect(s, PACKING_MESH_NON_MANIFOLD, 1, r.triangle, r.other);
}

static void test_orientation(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  const uint32_t kept = s->triangle[5][1];
  s->triangle[5][1] = s->triangle[5][2];
  s->triangle[5][2] = kept;
  const packing_mesh_report r = report_of(s);
  assert_true(r.triangle == 5 || r.other == 5);
  check_defect(s, PACKING_MESH_ORIENTATION, 3, r.triangle, r.other);
}

static void test_pinched(void **state)
{
  (void)state;
  shape *s = shape_new(); /* two boxes that share a corner */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){1, 1, 1}, (packing_vec3){2, 2, 2}, 0);
  const packing_mesh_report r = report_of(s);
  assert_true(r.point.x == 1 && r.point.y == 1 && r.point.z == 1);
  check_defect(s, PACKING_MESH_PINCHED, 1, r.triangle, none);
}

static void test_zero_thickness(void **state)
{
  (void)state;
  shape *s = shape_new(); /* one triangle, seen from both sides */
  for (int i = 0; i < 3; i++)
    shape_vertex(s, i == 1, i == 2, 0);
  shape_triangle(s, 0, 1, 2);
  shape_triangle(s, 0, 2, 1);
  check_defect(s, PACKING_MESH_ZERO_THICKNESS, 1, 0, 1);
  s = shape_new(); /* a sheet: two triangles a side */
  for (int i = 0; i < 4; i++)
    shape_vertex(s, i & 1, i >> 1, 0.3 * (i & 1));
  shape_triangle(s, 0, 1, 3);
  shape_triangle(s, 0, 3, 2);
  shape_triangle(s, 0, 3, 1);
  shape_triangle(s, 0, 2, 3);
  assert_int_equal(report_of(s).defect, PACKING_MESH_NON_MANIFOLD);
  free(s);
  s = shape_new(); /* a blade folded to less than 1e-6 rad */
  static const double xy[][2] = {{0, 0}, {1, -1e-7}, {1, 1e-7}};
  static const double centre[2] = {0.7, 0};
  shape_prism(s, xy, 3, centre, 1);
  assert_int_equal(report_of(s).defect, PACKING_MESH_ZERO_THICKNESS);
  free(s);
  s = shape_new(); /* boxes that lie on each other */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){0.25, 0.25, 1}, (packing_vec3){0.5, 0.75, 2}, 0);
  const packing_mesh_report r = report_of(s);
  assert_int_equal(r.defect, PACKING_MESH_ZERO_THICKNESS);
  assert_near(r.point.z, 1, 1e-15);
  free(s);
}

static void test_self_intersecting(void **state)
{
  (void)state;
  shape *s = shape_new();
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){0.75, 0.25, 0.25}, (packing_vec3){1.5, 0.5, 0.625}, 0);
  const packing_mesh_report r = report_of(s);
  assert_int_equal(r.defect, PACKING_MESH_SELF_INTERSECTING);
  assert_true(r.point.x == 1 && r.point.y >= 0.25 && r.point.y <= 0.5);
  assert_true(r.triangle < 12 && r.other >= 12 && r.count >= 8);
  check_refused(s, &r);
  free(s);
  s = shape_of(SHAPE_SPIKES); /* a spike pushed through the far side */
  for (int k = 0; k < 3; k++)
    s->vertex[7][k] *= -20;
  assert_int_equal(report_of(s).defect, PACKING_MESH_SELF_INTERSECTING);
  free(s);
  s = shape_new(); /* a corner that touches a face from above, no more */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_octahedron(s);
  for (size_t v = 8; v < 14; v++) {
    s->vertex[v][0] = 0.5 + 0.25 * s->vertex[v][0];
    s->vertex[v][1] = 0.375 + 0.25 * s->vertex[v][1];
    s->vertex[v][2] = 1.25 + 0.25 * s->vertex[v][2];
  }
  for (size_t t = 12; t < s->triangles; t++)
    for (int i = 0; i < 3; i++)
      s->triangle[t][i] += 8;
  const packing_mesh_report touch = report_of(s);
  assert_int_equal(touch.defect, PACKING_MESH_SELF_INTERSECTING);
  assert_near(touch.point.z, 1, 1e-15);
  for (size_t v = 8; v < 14; v++) /* a rounding higher it touches no more */
    s->vertex[v][2] = nextafter(s->vertex[v][2], 9);
  assert_int_equal(report_of(s).defect, PACKING_MESH_SOUND);
  free(s);
}

static void test_inverted(void **state)
{
  (void)state;
  shape *s = shape_new();
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 1);
  check_defect(s, PACKING_MESH_INVERTED, 1, 0, none);
  s = shape_new(); /* a solid box within a solid box */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){0.2, 0.2, 0.2}, (packing_vec3){0.7, 0.7, 0.7}, 0);
  check_defect(s, PACKING_MESH_INVERTED, 1, 12, none);
  s = shape_new(); /* a cavity outside */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){2, 0, 0}, (packing_vec3){2.5, 1, 1}, 1);
  check_defect(s, PACKING_MESH_INVERTED, 1, 12, none);
  s = shape_new(); /* a solid in a cavity, and one beside: sound */
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
  shape_box(s, (packing_vec3){0.1, 0.1, 0.1}, (packing_vec3){0.9, 0.9, 0.9}, 1);
  shape_box(s, (packing_vec3){0.2, 0.2, 0.2}, (packing_vec3){0.7, 0.7, 0.7}, 0);
  shape_box(s, (packing_vec3){2, 0, 0}, (packing_vec3){2.5, 1, 1}, 0);
  const packing_mesh_report r = report_of(s);
  assert_int_equal(r.defect, PACKING_MESH_SOUND);
  assert_int_equal(r.parts, 4);
  free(s);
}

/* Thin triangles without roundings: exactness is what lets these pass. */
static void test_needles_are_sound(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  for (size_t v = 0; v < 8; v++) {
    s->vertex[v][0] = s->vertex[v][0] * 1e6 + 1e7;
    s->vertex[v][1] *= 1e-3;
  }
  assert_int_equal(report_of(s).defect, PACKING_MESH_SOUND);
  packing_domain *domain = shape_domain(s, 1);
  const packing_vec3 p = {1.05e7, 0.5e-3, 0.5};
  packing_vec3 n;
  assert_near(packing_domain_signed_distance(domain, &p, &n), 0.5e-3, 1e-18);
  assert_true(fabs(n.y) == 1);
  packing_domain_destroy(domain);
  free(s);
}

/* The same findings for any number of threads. */
static void test_threads(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_TORUS);
  for (size_t v = 0; v < s->vertices; v += 7)
    s->vertex[v][v % 3] += 0.9 + 0.001 * (double)v;
  packing_mesh *mesh = shape_mesh(s);
  packing_mesh_report first;
  for (int threads = 1; threads <= 4; threads++) {
    packing_context *context = test_context(threads, PACKING_ISA_AUTO);
    packing_mesh_report r;
    packing_mesh_report_init(&r);
    assert_ok(packing_mesh_check(context, mesh, &r));
    if (threads == 1)
      first = r;
    assert_in_range(first.defect, PACKING_MESH_ZERO_THICKNESS,
                    PACKING_MESH_SELF_INTERSECTING);
    assert_memory_equal(&r, &first, sizeof r);
    packing_context_destroy(context);
  }
  packing_mesh_destroy(mesh);
  free(s);
}

static void test_strings(void **state)
{
  (void)state;
  for (int i = PACKING_MESH_SOUND; i <= PACKING_MESH_INVERTED; i++)
    for (int j = PACKING_MESH_SOUND; j < i; j++)
      assert_string_not_equal(packing_mesh_defect_string((packing_mesh_defect)i),
                              packing_mesh_defect_string((packing_mesh_defect)j));
  assert_string_equal(packing_mesh_defect_string((packing_mesh_defect)99),
                      "an unknown defect");
}

/* ---- vertices ---- */

/* A cube as 36 vertices comes to 8 and 12; with noise it needs a tolerance. */
static void test_merging(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  double soup[36][3];
  uint64_t random = 3;
  packing_mesh_def def;
  packing_mesh_view view;
  packing_mesh *mesh = NULL;
  for (int noisy = 0; noisy < 3; noisy++) {
    for (size_t i = 0; i < 36; i++)
      for (int k = 0; k < 3; k++)
        soup[i][k] = s->vertex[s->triangle[i / 3][i % 3]][k] +
                     (noisy ? 1e-7 * shape_random(&random) : 0);
    packing_mesh_def_init(&def);
    def.vertex_count = 36;
    def.vertices = &soup[0][0];
    def.triangle_count = 12;
    def.merge = noisy == 2 ? 1e-6 : 0;
    assert_ok(packing_mesh_create(NULL, &def, &mesh));
    packing_mesh_view_init(&view);
    assert_ok(packing_mesh_arrays(NULL, mesh, &view));
    assert_int_equal(view.vertex_count, noisy == 1 ? 36 : 8);
    assert_int_equal(view.triangle_count, 12);
    assert_true((uintptr_t)view.vertices % 64 == 0 &&
                (uintptr_t)view.triangles % 64 == 0);
    packing_mesh_report r;
    packing_mesh_report_init(&r);
    assert_ok(packing_mesh_check(NULL, mesh, &r));
    assert_int_equal(r.defect, noisy == 1 ? PACKING_MESH_OPEN : PACKING_MESH_SOUND);
    assert_near(packing_mesh_volume(mesh), 1, 1e-6);
    packing_mesh_destroy(mesh);
  }
  free(s);
}

/* A tolerance that takes a triangle's edge leaves the triangle out; 0 and -0 are one place. */
static void test_merging_leaves_out(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_TETRAHEDRON);
  const uint32_t twin = shape_vertex(s, 1, 1, 1 + 1e-9);
  packing_mesh *mesh = NULL;
  packing_mesh_def def;
  packing_mesh_view view;
  s->triangle[2][0] = twin; /* a slit, closed by a sliver */
  shape_triangle(s, 0, 2, twin);
  shape_triangle(s, 0, twin, 3);
  packing_mesh_def_init(&def);
  def.vertex_count = s->vertices;
  def.vertices = &s->vertex[0][0];
  def.triangle_count = s->triangles;
  def.triangles = &s->triangle[0][0];
  for (int merged = 0; merged < 2; merged++) {
    def.merge = merged ? 1e-8 : 0;
    assert_ok(packing_mesh_create(NULL, &def, &mesh));
    packing_mesh_view_init(&view);
    assert_ok(packing_mesh_arrays(NULL, mesh, &view));
    assert_int_equal(view.triangle_count, merged ? 4 : 6);
    assert_int_equal(view.vertex_count, merged ? 4 : 5);
    packing_mesh_destroy(mesh);
  }
  free(s);
  static const double more[18] = {0.0,  0, 0, 1, -0.0, 0, 0, 1, 0,
                                  -0.0, 0, 0, 0, 1,    0, 1, 0, 0};
  packing_mesh_def_init(&def);
  def.vertex_count = 6;
  def.vertices = more;
  def.triangle_count = 2;
  assert_ok(packing_mesh_create(NULL, &def, &mesh));
  packing_mesh_view_init(&view);
  assert_ok(packing_mesh_arrays(NULL, mesh, &view));
  assert_int_equal(view.vertex_count, 3);
  packing_mesh_destroy(mesh);
}

static void test_scale_and_shift(void **state)
{
  (void)state;
  shape *s = shape_of(SHAPE_CUBE);
  packing_mesh *mesh = NULL;
  packing_mesh_def def;
  packing_bounds b;
  packing_mesh_def_init(&def);
  def.vertex_count = s->vertices;
  def.vertices = &s->vertex[0][0];
  def.triangle_count = s->triangles;
  def.triangles = &s->triangle[0][0];
  def.scale = 2.5;
  def.shift = (packing_vec3){-1, 2, 7};
  assert_ok(packing_mesh_create(NULL, &def, &mesh));
  packing_mesh_bounds(mesh, &b);
  assert_true(b.lo.x == -1 && b.lo.y == 2 && b.lo.z == 7);
  assert_true(b.hi.x == 1.5 && b.hi.y == 4.5 && b.hi.z == 9.5);
  assert_close(packing_mesh_volume(mesh), 2.5 * 2.5 * 2.5, 1e-15);
  packing_mesh_destroy(mesh);
  free(s);
}

/* What was made from a mesh keeps it. */
static void test_holds_of_a_mesh(void **state)
{
  (void)state;
  test_allocator allocator = {0};
  packing_context *context = test_allocator_context(&allocator);
  shape *s = shape_of(SHAPE_CUBE);
  packing_mesh *mesh = NULL;
  packing_domain *domain = NULL, *inset = NULL;
  const packing_vec3 p = {0.5, 0.5, 0.5};
  assert_ok(shape_try(context, s, 1, &mesh));
  assert_ok(shape_domain_of(context, mesh, &domain));
  assert_ptr_equal(packing_mesh_retain(mesh), mesh);
  packing_mesh_destroy(mesh);
  packing_mesh_destroy(mesh);
  packing_context_destroy(context);
  assert_ok(packing_domain_create_inset(NULL, domain, 0.25, &inset));
  packing_domain_destroy(domain);
  assert_true(packing_domain_signed_distance(inset, &p, NULL) == 0.25);
  packing_domain_destroy(inset);
  assert_int_equal(allocator.live, 0);
  packing_mesh_destroy(NULL);
  assert_null(packing_mesh_retain(NULL));
  free(s);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_contents),
      cmocka_unit_test(test_contents_of_a_torus),
      cmocka_unit_test(test_contents_of_spheres),
      cmocka_unit_test(test_distances),
      cmocka_unit_test(test_normals_on_the_surface),
      cmocka_unit_test(test_points_far_off),
      cmocka_unit_test(test_degenerate),
      cmocka_unit_test(test_open),
      cmocka_unit_test(test_non_manifold),
      cmocka_unit_test(test_orientation),
      cmocka_unit_test(test_pinched),
      cmocka_unit_test(test_zero_thickness),
      cmocka_unit_test(test_self_intersecting),
      cmocka_unit_test(test_inverted),
      cmocka_unit_test(test_needles_are_sound),
      cmocka_unit_test(test_threads),
      cmocka_unit_test(test_strings),
      cmocka_unit_test(test_merging),
      cmocka_unit_test(test_merging_leaves_out),
      cmocka_unit_test(test_scale_and_shift),
      cmocka_unit_test(test_holds_of_a_mesh),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
