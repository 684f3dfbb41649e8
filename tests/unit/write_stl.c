/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Containers as triangles: closed, the right way out, around the container, of the volume that
 * polygons in place of circles give. */
#include "domain_scenes.h"

enum { FACETS = 16 };

typedef struct mesh {
  size_t count;
  double (*corner)[3][3];
  double (*normal)[3];
} mesh;

static packing_domain *make(const scene *s)
{
  return scene_make(s);
}

static test_buffer written(const packing_domain *domain, int ascii, unsigned facets)
{
  test_buffer b = {0};
  packing_stl_def def;
  packing_stl_def_init(&def);
  def.ascii = ascii;
  def.facets = facets;
  const packing_stream stream = test_buffer_stream(&b);
  assert_ok(packing_write_stl(NULL, &def, domain, &stream));
  return b;
}

static const char *number(const char *at, double *v)
{
  char *end;
  *v = strtod(at, &end);
  assert_ptr_not_equal(at, end);
  return end;
}

/* Reads the text as strictly as it is written. */
static mesh parsed(const test_buffer *b)
{
  mesh m = {0, NULL, NULL};
  const char *at = b->data;
  assert_memory_equal(at, "solid container\n", 16);
  at += 16;
  m.corner = calloc(b->size, sizeof *m.corner / 64);
  m.normal = calloc(b->size, sizeof *m.normal / 64 + 1);
  assert_true(m.corner != NULL && m.normal != NULL);
  for (; memcmp(at, "facet normal ", 13) == 0; m.count++) {
    at += 13;
    for (int k = 0; k < 3; k++)
      at = number(at, &m.normal[m.count][k]);
    assert_memory_equal(at, "\nouter loop\n", 12);
    at += 12;
    for (int i = 0; i < 3; i++) {
      assert_memory_equal(at, "vertex ", 7);
      at += 7;
      for (int k = 0; k < 3; k++)
        at = number(at, &m.corner[m.count][i][k]);
      assert_int_equal(*at++, '\n');
    }
    assert_memory_equal(at, "endloop\nendfacet\n", 17);
    at += 17;
  }
  assert_string_equal(at, "endsolid container\n");
  return m;
}

static mesh mesh_of(const packing_domain *domain, unsigned facets)
{
  test_buffer b = written(domain, 1, facets);
  const mesh m = parsed(&b);
  test_buffer_free(&b);
  return m;
}

static void mesh_free(mesh *m)
{
  free(m->corner);
  free(m->normal);
}

static int same(const double a[3], const double b[3])
{
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* How often the edge from a to b stands in the mesh. */
static int edges(const mesh *m, const double a[3], const double b[3])
{
  int count = 0;
  for (size_t t = 0; t < m->count; t++)
    for (int i = 0; i < 3; i++)
      count += same(m->corner[t][i], a) && same(m->corner[t][(i + 1) % 3], b);
  return count;
}

/* Edges that have no neighbour running the other way; each edge stands once. */
static size_t border(const mesh *m)
{
  size_t count = 0;
  for (size_t t = 0; t < m->count; t++)
    for (int i = 0; i < 3; i++) {
      const double *a = m->corner[t][i], *b = m->corner[t][(i + 1) % 3];
      assert_int_equal(edges(m, a, b), 1);
      const int back = edges(m, b, a);
      assert_true(back <= 1);
      count += back == 0;
    }
  return count;
}

static void cross(const double p[3], const double q[3], double out[3])
{
  out[0] = p[1] * q[2] - p[2] * q[1];
  out[1] = p[2] * q[0] - p[0] * q[2];
  out[2] = p[0] * q[1] - p[1] * q[0];
}

static double dot(const double p[3], const double q[3])
{
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

static double volume(const mesh *m)
{
  double sum = 0, n[3];
  for (size_t t = 0; t < m->count; t++) {
    cross(m->corner[t][1], m->corner[t][2], n);
    sum += dot(m->corner[t][0], n) / 6;
  }
  return sum;
}

/* Unit normals, as the corners turn, out of the container; no point of a triangle inside it. */
static void assert_stands_around(const mesh *m, const packing_domain *domain)
{
  for (size_t t = 0; t < m->count; t++) {
    double u[3], w[3], n[3];
    packing_vec3 middle = {0, 0, 0}, inward;
    for (int k = 0; k < 3; k++) {
      u[k] = m->corner[t][1][k] - m->corner[t][0][k];
      w[k] = m->corner[t][2][k] - m->corner[t][0][k];
    }
    cross(u, w, n);
    const double length = sqrt(dot(n, n));
    assert_true(length > 0);
    for (int k = 0; k < 3; k++)
      assert_near(m->normal[t][k], n[k] / length, 1e-12);
    for (int i = 0; i < 3; i++) {
      middle.x += m->corner[t][i][0] / 3;
      middle.y += m->corner[t][i][1] / 3;
      middle.z += m->corner[t][i][2] / 3;
    }
    assert_true(packing_domain_signed_distance(domain, &middle, &inward) <= 1e-12);
    for (int i = 0; i < 3; i++) {
      const packing_vec3 p = {m->corner[t][i][0], m->corner[t][i][1], m->corner[t][i][2]};
      assert_true(packing_domain_signed_distance(domain, &p, NULL) <= 1e-12);
    }
    const double against[] = {inward.x, inward.y, inward.z};
    assert_true(dot(m->normal[t], against) < -0.7);
  }
}

static const packing_vec3 base = {1, -2, 0.5};

/* A regular polygon around the unit circle has the area n tan(pi / n), in it n sin(2 pi / n) / 2. */
static double around(void)
{
  return FACETS * tan(TEST_PI / FACETS);
}

static double within(void)
{
  return FACETS * sin(2 * TEST_PI / FACETS) / 2;
}

static void closed_meshes(void **state)
{
  (void)state;
  const struct {
    scene s;
    double volume;
  } cases[] = {
      {{SCENE_BOX, 2, 3, 0.7, 0, base, 2, 0, 0}, 4.2},
      {{SCENE_CYLINDER, 1.5, 2, 0, 0, base, 0, 0, 0}, around() * 2.25 * 2},
      {{SCENE_TUBE, 0.5, 1.5, 2, 0, base, 1, 0, 0},
       (around() * 2.25 - within() * 0.25) * 2},
      {{SCENE_CONE, 2, 1, 3, 0, base, 2, 0, 0}, around() * 7},
      {{SCENE_CONE, 0, 1, 3, 0, base, 2, 0, 0}, around()},
      {{SCENE_SILO, 2, 5, 0.5, 2, base, 0, 0, 0}, around() * (12 + 2 * 5.25 / 3)},
      {{SCENE_SILO, 2, 5, 0, 2, base, 1, 0, 0}, around() * (12 + 2 * 4.0 / 3)},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    packing_domain *domain = make(&cases[i].s);
    mesh m = mesh_of(domain, FACETS);
    assert_int_equal(border(&m), 0);
    assert_close(volume(&m), cases[i].volume, 1e-12);
    assert_stands_around(&m, domain);
    mesh_free(&m);
    packing_domain_destroy(domain);
  }
}

/* Every face of the sphere's mesh touches it from outside. */
static void a_sphere_lies_within_its_mesh(void **state)
{
  (void)state;
  const scene s = {SCENE_SPHERE, 1.5, 0, 0, 0, base, 2, 0, 0};
  packing_domain *domain = make(&s);
  for (unsigned facets = 3; facets < 40; facets += 9) {
    mesh m = mesh_of(domain, facets);
    assert_int_equal(border(&m), 0);
    for (size_t t = 0; t < m.count; t++) {
      const double from[] = {m.corner[t][0][0] - base.x, m.corner[t][0][1] - base.y,
                             m.corner[t][0][2] - base.z};
      assert_close(dot(from, m.normal[t]), 1.5, 1e-12);
    }
    mesh_free(&m);
  }
  mesh m = mesh_of(domain, 48);
  assert_true(volume(&m) > packing_domain_volume(domain));
  assert_close(volume(&m), packing_domain_volume(domain), 6e-3);
  mesh_free(&m);
  packing_domain_destroy(domain);
}

static void open_tops_and_periodic_sides_are_left_out(void **state)
{
  (void)state;
  const struct {
    scene s;
    size_t triangles, border;
  } cases[] = {
      {{SCENE_BOX, 1, 1, 1, 0, base, 2, 1, 0}, 10, 4},
      {{SCENE_BOX, 1, 1, 1, 0, base, 2, 0, PACKING_PERIODIC_Y}, 8, 8},
      {{SCENE_CYLINDER, 1, 2, 0, 0, base, 2, 1, 0}, 3 * FACETS, FACETS},
      {{SCENE_TUBE, 1, 2, 2, 0, base, 2, 1, 0}, 6 * FACETS, 2 * FACETS},
      {{SCENE_CONE, 1, 2, 2, 0, base, 2, 1, 0}, 3 * FACETS, FACETS},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    packing_domain *domain = make(&cases[i].s);
    mesh m = mesh_of(domain, FACETS);
    assert_int_equal(m.count, cases[i].triangles);
    assert_int_equal(border(&m), cases[i].border);
    mesh_free(&m);
    packing_domain_destroy(domain);
  }
}

/* A needle of a cylinder is cut, so that no triangle is longer than some 32 of its widths. */
static void long_walls_are_cut(void **state)
{
  (void)state;
  const scene s = {SCENE_CYLINDER, 0.01, 5, 0, 0, base, 2, 0, 0};
  packing_domain *domain = make(&s);
  mesh m = mesh_of(domain, FACETS);
  const double width = 2 * 0.01 * tan(TEST_PI / FACETS);
  assert_int_equal(border(&m), 0);
  assert_close(volume(&m), around() * 5e-4, 1e-11);
  for (size_t t = 0; t < m.count; t++)
    for (int i = 0; i < 3; i++)
      assert_true(fabs(m.corner[t][i][2] - m.corner[t][(i + 1) % 3][2]) < 33 * width);
  mesh_free(&m);
  packing_domain_destroy(domain);
}

static float single(const char *at)
{
  uint32_t bits = 0;
  float v;
  for (int i = 3; i >= 0; i--)
    bits = bits << 8 | (unsigned char)at[i];
  memcpy(&v, &bits, sizeof v);
  return v;
}

static void binary_is_text_rounded(void **state)
{
  (void)state;
  const scene s = {SCENE_SILO, 2, 5, 0.5, 2, base, 0, 1, 0};
  packing_domain *domain = make(&s);
  mesh m = mesh_of(domain, FACETS);
  test_buffer b = written(domain, 0, FACETS);
  char header[80] = "STL: container";
  assert_memory_equal(b.data, header, sizeof header);
  assert_int_equal(b.size, 84 + 50 * m.count);
  assert_int_equal((unsigned char)b.data[80] + 256 * (unsigned char)b.data[81], m.count);
  for (size_t t = 0; t < m.count; t++) {
    const char *at = b.data + 84 + 50 * t;
    for (int k = 0; k < 3; k++)
      assert_true(single(at + 4 * k) == (float)m.normal[t][k]);
    for (int i = 0; i < 3; i++)
      for (int k = 0; k < 3; k++)
        assert_true(single(at + 12 + 12 * i + 4 * k) == (float)m.corner[t][i][k]);
    assert_true(at[48] == 0 && at[49] == 0);
  }
  test_buffer_free(&b);
  mesh_free(&m);
  packing_domain_destroy(domain);
}

/* All lengths times a power of two: all corners too, bit for bit. */
static void meshes_scale(void **state)
{
  (void)state;
  const double f = 0x1p-20;
  const scene cases[][2] = {
      {{SCENE_SILO, 2, 5, 0.3, 2, base, 0, 0, 0},
       {SCENE_SILO, 2 * f, 5 * f, 0.3 * f, 2 * f, {f, -2 * f, 0.5 * f}, 0, 0, 0}},
      {{SCENE_SPHERE, 0.7, 0, 0, 0, base, 2, 0, 0},
       {SCENE_SPHERE, 0.7 * f, 0, 0, 0, {f, -2 * f, 0.5 * f}, 2, 0, 0}}};
  for (size_t c = 0; c < 2; c++) {
    packing_domain *one = make(&cases[c][0]), *other = make(&cases[c][1]);
    mesh a = mesh_of(one, FACETS), b = mesh_of(other, FACETS);
    assert_int_equal(a.count, b.count);
    for (size_t t = 0; t < a.count; t++)
      for (int i = 0; i < 3; i++) {
        assert_true(a.normal[t][i] == b.normal[t][i]);
        for (int k = 0; k < 3; k++)
          assert_true(a.corner[t][i][k] * f == b.corner[t][i][k]);
      }
    mesh_free(&a);
    mesh_free(&b);
    packing_domain_destroy(one);
    packing_domain_destroy(other);
  }
}

/* Behind the dispatcher: the same bytes. */
static void formats_stl_are_the_same(void **state)
{
  (void)state;
  const scene s = {SCENE_CYLINDER, 1, 2, 0, 0, base, 2, 1, 0};
  packing_domain *domain = make(&s);
  static const double at = 0, r = 0.5;
  packing_view view;
  packing_write_def def;
  packing_view_init_arrays(&view, 1, &at, &at, &at, &r);
  packing_write_def_init(&def);
  def.domain = domain;
  def.facets = FACETS;
  for (int ascii = 0; ascii < 2; ascii++) {
    test_buffer want = written(domain, ascii, FACETS), got = {0};
    const packing_stream stream = test_buffer_stream(&got);
    assert_ok(
        packing_write_pack(NULL, &def, ascii ? "stl-ascii" : "stl", &view, &stream));
    assert_int_equal(want.size, got.size);
    assert_memory_equal(want.data, got.data, got.size);
    test_buffer_free(&want);
    test_buffer_free(&got);
  }
  packing_domain_destroy(domain);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(closed_meshes),
      cmocka_unit_test(a_sphere_lies_within_its_mesh),
      cmocka_unit_test(open_tops_and_periodic_sides_are_left_out),
      cmocka_unit_test(long_walls_are_cut),
      cmocka_unit_test(binary_is_text_rounded),
      cmocka_unit_test(meshes_scale),
      cmocka_unit_test(formats_stl_are_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
