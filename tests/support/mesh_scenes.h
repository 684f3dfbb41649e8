/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_MESH_SCENES_H
#define PACKING_TEST_MESH_SCENES_H

/* Meshes with known answers, built corner by corner. Header only: several test programs share it. */
#include "test.h"

#define MESH_PI 3.14159265358979323846

enum { SHAPE_VERTICES = 3000, SHAPE_TRIANGLES = 6000 };

/* A mesh in the making. */
typedef struct shape {
  size_t vertices, triangles;
  double vertex[SHAPE_VERTICES][3];
  uint32_t triangle[SHAPE_TRIANGLES][3];
} shape;

static inline shape *shape_new(void)
{
  shape *s = calloc(1, sizeof *s);
  assert_non_null(s);
  return s;
}

static inline uint32_t shape_vertex(shape *s, double x, double y, double z)
{
  assert_true(s->vertices < SHAPE_VERTICES);
  s->vertex[s->vertices][0] = x;
  s->vertex[s->vertices][1] = y;
  s->vertex[s->vertices][2] = z;
  return (uint32_t)s->vertices++;
}

static inline void shape_triangle(shape *s, size_t a, size_t b, size_t c)
{
  assert_true(s->triangles < SHAPE_TRIANGLES);
  s->triangle[s->triangles][0] = (uint32_t)a;
  s->triangle[s->triangles][1] = (uint32_t)b;
  s->triangle[s->triangles++][2] = (uint32_t)c;
}

/* A box from lo to hi; turned: inside out. */
static inline void shape_box(shape *s, packing_vec3 lo, packing_vec3 hi, int turned)
{
  static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  const size_t first = s->vertices;
  for (int i = 0; i < 8; i++)
    shape_vertex(s, i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
  for (int f = 0; f < 6; f++)
    for (int k = 1; k < 3; k++) {
      const size_t b = first + (size_t)face[f][k], c = first + (size_t)face[f][k + 1];
      shape_triangle(s, first + (size_t)face[f][0], turned ? c : b, turned ? b : c);
    }
}

static inline void shape_cube(shape *s)
{
  shape_box(s, (packing_vec3){0, 0, 0}, (packing_vec3){1, 1, 1}, 0);
}

/* Corners at alternating corners of the cube [-1, 1]^3: edge sqrt 8. */
static inline void shape_tetrahedron(shape *s)
{
  shape_vertex(s, 1, 1, 1);
  shape_vertex(s, 1, -1, -1);
  shape_vertex(s, -1, 1, -1);
  shape_vertex(s, -1, -1, 1);
  shape_triangle(s, 0, 1, 2);
  shape_triangle(s, 0, 3, 1);
  shape_triangle(s, 0, 2, 3);
  shape_triangle(s, 1, 3, 2);
}

/* Corners at +-1 on the axes. */
static inline void shape_octahedron(shape *s)
{
  for (int i = 0; i < 6; i++)
    shape_vertex(s, i / 2 == 0 ? (i & 1 ? -1 : 1) : 0, i / 2 == 1 ? (i & 1 ? -1 : 1) : 0,
                 i / 2 == 2 ? (i & 1 ? -1 : 1) : 0);
  for (size_t i = 0; i < 8; i++) {
    const size_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2 & 1);
    const int odd = (int)((i & 1) ^ (i >> 1 & 1) ^ (i >> 2 & 1));
    shape_triangle(s, x, odd ? z : y, odd ? y : z);
  }
}

static inline size_t shape_between(shape *s, size_t a, size_t b)
{
  double x[3], sum = 0;
  for (int k = 0; k < 3; k++) {
    x[k] = s->vertex[a][k] + s->vertex[b][k];
    sum += x[k] * x[k];
  }
  for (size_t v = 0; v < s->vertices; v++)
    if (s->vertex[v][0] == x[0] / sqrt(sum) && s->vertex[v][1] == x[1] / sqrt(sum) &&
        s->vertex[v][2] == x[2] / sqrt(sum))
      return v;
  return shape_vertex(s, x[0] / sqrt(sum), x[1] / sqrt(sum), x[2] / sqrt(sum));
}

/* The octahedron, each triangle cut into four `level` times, corners on the unit sphere. */
static inline void shape_sphere(shape *s, int level)
{
  shape_octahedron(s);
  for (int l = 0; l < level; l++) {
    const size_t count = s->triangles;
    for (size_t t = 0; t < count; t++) {
      const size_t a = s->triangle[t][0], b = s->triangle[t][1], c = s->triangle[t][2];
      const size_t ab = shape_between(s, a, b), bc = shape_between(s, b, c),
                   ca = shape_between(s, c, a);
      shape_triangle(s, ab, b, bc);
      shape_triangle(s, ca, bc, c);
      shape_triangle(s, ab, bc, ca);
      s->triangle[t][1] = (uint32_t)ab;
      s->triangle[t][2] = (uint32_t)ca;
    }
  }
}

static inline void shape_torus(shape *s, double outer, double inner, size_t n, size_t m)
{
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < m; j++) {
      const double u = 2 * MESH_PI * (double)i / (double)n,
                   v = 2 * MESH_PI * (double)j / (double)m;
      const double rho = outer + inner * cos(v);
      shape_vertex(s, rho * cos(u), rho * sin(u), inner * sin(v));
    }
  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < m; j++) {
      const size_t a = i * m + j, b = (i + 1) % n * m + j,
                   c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      shape_triangle(s, a, b, c);
      shape_triangle(s, a, c, d);
    }
}

/* An upright prism over a counter-clockwise polygon that its point `centre` sees whole. */
static inline void shape_prism(shape *s, const double (*xy)[2], size_t n,
                               const double centre[2], double height)
{
  for (int top = 0; top < 2; top++)
    for (size_t i = 0; i < n; i++)
      shape_vertex(s, xy[i][0], xy[i][1], top ? height : 0);
  const size_t low = shape_vertex(s, centre[0], centre[1], 0);
  const size_t high = shape_vertex(s, centre[0], centre[1], height);
  for (size_t i = 0; i < n; i++) {
    const size_t j = (i + 1) % n;
    shape_triangle(s, i, j, n + j);
    shape_triangle(s, i, n + j, n + i);
    shape_triangle(s, low, j, i);
    shape_triangle(s, high, n + i, n + j);
  }
}

/* [0, 2] x [0, 1] and [0, 1] x [0, 2], of height 1: volume 3. */
static inline void shape_angle(shape *s)
{
  static const double xy[][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  static const double centre[2] = {0.5, 0.5};
  shape_prism(s, xy, 6, centre, 1);
}

/* A star of `points` thin arms, of height 0.4. */
static inline void shape_star(shape *s, size_t points)
{
  double xy[64][2];
  static const double centre[2] = {0, 0};
  for (size_t i = 0; i < 2 * points; i++) {
    const double a = MESH_PI * (double)i / (double)points, r = i % 2 ? 0.15 : 1;
    xy[i][0] = r * cos(a);
    xy[i][1] = r * sin(a);
  }
  shape_prism(s, (const double(*)[2])xy, 2 * points, centre, 0.4);
}

/* A wedge whose edge has an angle of some 0.002 rad. */
static inline void shape_wedge(shape *s)
{
  static const double xy[][2] = {{0, 0}, {1, -0.001}, {1, 0.001}};
  static const double centre[2] = {0.7, 0};
  shape_prism(s, xy, 3, centre, 1);
}

/* Spikes on an octahedron, in and out: corners of all kinds. */
static inline void shape_spikes(shape *s)
{
  shape_octahedron(s);
  for (size_t t = 0; t < 8; t++) {
    const size_t a = s->triangle[t][0], b = s->triangle[t][1], c = s->triangle[t][2];
    const double by = t % 2 ? 0.1 : 1.7;
    double x[3];
    for (int k = 0; k < 3; k++)
      x[k] = by / 3 * (s->vertex[a][k] + s->vertex[b][k] + s->vertex[c][k]);
    const size_t tip = shape_vertex(s, x[0], x[1], x[2]);
    shape_triangle(s, b, c, tip);
    shape_triangle(s, c, a, tip);
    s->triangle[t][2] = (uint32_t)tip;
  }
}

enum {
  SHAPE_CUBE,
  SHAPE_TETRAHEDRON,
  SHAPE_OCTAHEDRON,
  SHAPE_SPHERE,
  SHAPE_TORUS,
  SHAPE_ANGLE,
  SHAPE_STAR,
  SHAPE_WEDGE,
  SHAPE_SPIKES,
  SHAPE_HOLLOW, /* a box within a box */
  SHAPE_END
};

static inline shape *shape_of(int kind)
{
  shape *s = shape_new();
  switch (kind) {
  case SHAPE_CUBE:
    shape_cube(s);
    break;
  case SHAPE_TETRAHEDRON:
    shape_tetrahedron(s);
    break;
  case SHAPE_OCTAHEDRON:
    shape_octahedron(s);
    break;
  case SHAPE_SPHERE:
    shape_sphere(s, 3);
    break;
  case SHAPE_TORUS:
    shape_torus(s, 1, 0.37, 24, 13);
    break;
  case SHAPE_ANGLE:
    shape_angle(s);
    break;
  case SHAPE_STAR:
    shape_star(s, 7);
    break;
  case SHAPE_WEDGE:
    shape_wedge(s);
    break;
  case SHAPE_SPIKES:
    shape_spikes(s);
    break;
  default:
    shape_box(s, (packing_vec3){-1.1, -1.3, -0.9}, (packing_vec3){1.2, 1, 1.4}, 0);
    shape_box(s, (packing_vec3){-0.4, -0.3, -0.5}, (packing_vec3){0.1, 0.6, 0.3}, 1);
  }
  return s;
}

/* Not freed: the caller has the shape. */
static inline packing_status shape_try(packing_context *context, const shape *s,
                                       double scale, packing_mesh **mesh)
{
  packing_mesh_def def;
  packing_mesh_def_init(&def);
  def.vertex_count = s->vertices;
  def.vertices = &s->vertex[0][0];
  def.triangle_count = s->triangles;
  def.triangles = &s->triangle[0][0];
  def.scale = scale;
  return packing_mesh_create(context, &def, mesh);
}

static inline packing_mesh *shape_mesh(const shape *s)
{
  packing_mesh *mesh = NULL;
  assert_ok(shape_try(NULL, s, 1, &mesh));
  return mesh;
}

static inline packing_status shape_domain_of(packing_context *context, packing_mesh *mesh,
                                             packing_domain **domain)
{
  packing_domain_mesh_def def;
  packing_domain_mesh_def_init(&def);
  def.mesh = mesh;
  return packing_domain_create_mesh(context, &def, domain);
}

static inline packing_domain *shape_domain(const shape *s, double scale)
{
  packing_mesh *mesh = NULL;
  packing_domain *domain = NULL;
  assert_ok(shape_try(NULL, s, scale, &mesh));
  assert_ok(shape_domain_of(NULL, mesh, &domain));
  packing_mesh_destroy(mesh);
  return domain;
}

/* ---- the slow obvious way ---- */

static inline packing_vec3 shape_vec(const double x[3])
{
  return (packing_vec3){x[0], x[1], x[2]};
}

static inline packing_vec3 shape_minus(packing_vec3 a, packing_vec3 b)
{
  return (packing_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline packing_vec3 shape_plus(packing_vec3 a, packing_vec3 b, double by)
{
  return (packing_vec3){a.x + by * b.x, a.y + by * b.y, a.z + by * b.z};
}

static inline double shape_dot(packing_vec3 a, packing_vec3 b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline packing_vec3 shape_cross(packing_vec3 a, packing_vec3 b)
{
  return (packing_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                        a.x * b.y - a.y * b.x};
}

static inline double shape_norm(packing_vec3 a)
{
  return sqrt(shape_dot(a, a));
}

static inline packing_vec3 shape_corner(const shape *s, size_t t, int i)
{
  return shape_vec(s->vertex[s->triangle[t][i]]);
}

static inline packing_vec3 shape_on_segment(packing_vec3 a, packing_vec3 b,
                                            packing_vec3 p)
{
  const packing_vec3 e = shape_minus(b, a);
  const double t = shape_dot(shape_minus(p, a), e) / shape_dot(e, e);
  return shape_plus(a, e, t < 0 ? 0 : t > 1 ? 1 : t);
}

/* The nearest point of a triangle: the foot if its three barycentric coordinates are positive,
 * else the best of three segments. */
static inline packing_vec3 shape_nearest(const shape *s, size_t t, packing_vec3 p)
{
  const packing_vec3 a = shape_corner(s, t, 0), b = shape_corner(s, t, 1),
                     c = shape_corner(s, t, 2);
  const packing_vec3 n = shape_cross(shape_minus(b, a), shape_minus(c, a));
  const double height = shape_dot(shape_minus(p, a), n) / shape_dot(n, n);
  const packing_vec3 foot = shape_plus(p, n, -height);
  const packing_vec3 pa = shape_minus(a, foot), pb = shape_minus(b, foot),
                     pc = shape_minus(c, foot);
  if (shape_dot(n, shape_cross(pa, pb)) >= 0 && shape_dot(n, shape_cross(pb, pc)) >= 0 &&
      shape_dot(n, shape_cross(pc, pa)) >= 0)
    return foot;
  packing_vec3 best = shape_on_segment(a, b, p);
  const packing_vec3 other[2] = {shape_on_segment(b, c, p), shape_on_segment(c, a, p)};
  for (int i = 0; i < 2; i++)
    if (shape_norm(shape_minus(other[i], p)) < shape_norm(shape_minus(best, p)))
      best = other[i];
  return best;
}

/* Sum of the solid angles over 4 pi (A. van Oosterom, J. Strackee 1983): 1 inside, 0 outside. */
static inline double shape_winding(const shape *s, packing_vec3 p)
{
  double sum = 0;
  for (size_t t = 0; t < s->triangles; t++) {
    const packing_vec3 a = shape_minus(shape_corner(s, t, 0), p),
                       b = shape_minus(shape_corner(s, t, 1), p),
                       c = shape_minus(shape_corner(s, t, 2), p);
    const double la = shape_norm(a), lb = shape_norm(b), lc = shape_norm(c);
    sum += 2 * atan2(shape_dot(a, shape_cross(b, c)),
                     la * lb * lc + shape_dot(a, b) * lc + shape_dot(b, c) * la +
                         shape_dot(c, a) * lb);
  }
  return sum / (4 * MESH_PI);
}

static inline double shape_distance(const shape *s, packing_vec3 p)
{
  double best = HUGE_VAL;
  for (size_t t = 0; t < s->triangles; t++)
    best = fmin(best, shape_norm(shape_minus(shape_nearest(s, t, p), p)));
  return shape_winding(s, p) > 0.5 ? best : -best;
}

static inline double shape_random(uint64_t *state)
{
  uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* In the bounds, or a little outside. */
static inline packing_vec3 shape_point(uint64_t *state, const packing_domain *domain)
{
  packing_bounds b;
  packing_domain_bounds(domain, &b);
  return (packing_vec3){b.lo.x + (1.4 * shape_random(state) - 0.2) * (b.hi.x - b.lo.x),
                        b.lo.y + (1.4 * shape_random(state) - 0.2) * (b.hi.y - b.lo.y),
                        b.lo.z + (1.4 * shape_random(state) - 0.2) * (b.hi.z - b.lo.z)};
}

/* Near a random feature of the surface, on both sides. */
static inline packing_vec3 shape_close_point(uint64_t *state, const shape *s, double off)
{
  const size_t t = (size_t)(shape_random(state) * (double)s->triangles);
  double w[3] = {shape_random(state), shape_random(state), shape_random(state)};
  const int keep = (int)(shape_random(state) * 7) + 1; /* face, edge or corner */
  double sum = 0;
  for (int i = 0; i < 3; i++) {
    w[i] = keep >> i & 1 ? w[i] + 1e-3 : 0;
    sum += w[i];
  }
  packing_vec3 p = {0, 0, 0};
  for (int i = 0; i < 3; i++)
    p = shape_plus(p, shape_corner(s, t, i), w[i] / sum);
  for (int k = 0; k < 3; k++)
    *(k == 0 ? &p.x : k == 1 ? &p.y : &p.z) += off * (2 * shape_random(state) - 1);
  return p;
}

#endif
