/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mesh from its arrays to its end. Linear but for the tree. */
#include "mesh_internal.h"
#include "delaunay/expansion.h"
#include <string.h>

enum { MOST_EXPONENT = 320 /* cubes of lengths are doubles */ };
static const double MOST_MERGE = 0.01;

void packing_mesh_destroy(packing_mesh *mesh)
{
  if (mesh == NULL ||
      atomic_fetch_sub_explicit(&mesh->holds, 1, memory_order_acq_rel) != 1)
    return;
  const packing_allocator allocator = mesh->allocator;
  packing_i_free(&allocator, mesh->vertex);
  packing_i_free(&allocator, mesh->triangle);
  packing_i_free(&allocator, mesh->node);
  packing_i_free(&allocator, mesh->order);
  packing_i_free(&allocator, mesh);
}

packing_mesh *packing_mesh_retain(packing_mesh *mesh)
{
  if (mesh != NULL)
    atomic_fetch_add_explicit(&mesh->holds, 1, memory_order_relaxed);
  return mesh;
}

void packing_mesh_def_fill(packing_mesh_def *def, size_t size)
{
  packing_mesh_def defaults = {.scale = 1};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static packing_status check_counts(packing_context *context, const packing_mesh_def *d)
{
  if (d->vertex_count < 3 || d->vertex_count > PACKING_I_MESH_MOST)
    return packing_i_fail(context, PACKING_ERR_RANGE, "vertex_count", PACKING_NO_INDEX,
                          "%zu is not in 3 .. %d", d->vertex_count, PACKING_I_MESH_MOST);
  if (d->triangle_count < 1 || d->triangle_count > PACKING_I_MESH_MOST)
    return packing_i_fail(context, PACKING_ERR_RANGE, "triangle_count", PACKING_NO_INDEX,
                          "%zu is not in 1 .. %d", d->triangle_count,
                          PACKING_I_MESH_MOST);
  if (d->triangles == NULL && 3 * d->triangle_count != d->vertex_count)
    return packing_i_fail(context, PACKING_ERR_RANGE, "triangle_count", PACKING_NO_INDEX,
                          "%zu triangles of their own three vertices, but %zu vertices",
                          d->triangle_count, d->vertex_count);
  return PACKING_OK;
}

static packing_status check(packing_context *context, const packing_mesh_def *d)
{
  static const char *const shift[] = {"shift.x", "shift.y", "shift.z"};
  PACKING_I_TRY(packing_i_check_given(context, "vertices", d->vertices));
  PACKING_I_TRY(check_counts(context, d));
  PACKING_I_TRY(packing_i_check_not_negative(context, "merge", d->merge));
  if (d->merge > MOST_MERGE)
    return packing_i_fail(context, PACKING_ERR_RANGE, "merge", PACKING_NO_INDEX,
                          "%g must be at most %g", d->merge, MOST_MERGE);
  PACKING_I_TRY(packing_i_check_positive(context, "scale", d->scale));
  return packing_i_check_point(context, shift, &d->shift);
}

/* Scaled and moved; no -0. */
static packing_status copy_vertices(packing_context *context, packing_mesh *mesh,
                                    const packing_mesh_def *d)
{
  const double shift[] = {d->shift.x, d->shift.y, d->shift.z};
  for (size_t i = 0; i < 3 * d->vertex_count; i++) {
    if (!isfinite(d->vertices[i]))
      return packing_i_fail(context, PACKING_ERR_INVALID, "vertices", i / 3,
                            "%c of vertex %zu is no finite number", (int)('x' + i % 3),
                            i / 3);
    mesh->vertex[i] = d->vertices[i] * d->scale + (shift[i % 3] + 0.0);
  }
  mesh->vertices = d->vertex_count;
  return PACKING_OK;
}

static packing_status copy_triangles(packing_context *context, packing_mesh *mesh,
                                     const packing_mesh_def *d)
{
  for (size_t i = 0; i < 3 * d->triangle_count; i++) {
    const uint32_t v = d->triangles == NULL ? (uint32_t)i : d->triangles[i];
    if (v >= d->vertex_count)
      return packing_i_fail(context, PACKING_ERR_RANGE, "triangles", i / 3,
                            "vertex %lu of triangle %zu: there are %zu vertices",
                            (unsigned long)v, i / 3, d->vertex_count);
    mesh->triangle[i] = v;
  }
  mesh->triangles = d->triangle_count;
  return PACKING_OK;
}

/* The largest coordinate, and with it the scale of the exact questions. */
static packing_status find_unit(packing_context *context, packing_mesh *mesh)
{
  double most = 0;
  int exponent;
  for (size_t i = 0; i < 3 * mesh->vertices; i++)
    most = fmax(most, fabs(mesh->vertex[i]));
  (void)frexp(most, &exponent);
  if (!isfinite(most) || exponent > MOST_EXPONENT || exponent < -MOST_EXPONENT)
    return packing_i_fail(context, PACKING_ERR_RANGE, "vertices", PACKING_NO_INDEX,
                          "the largest coordinate, %g, is not in 2^-%d .. 2^%d", most,
                          MOST_EXPONENT, MOST_EXPONENT);
  mesh->unit = ldexp(1.0, -exponent - 2);
  mesh->pad = ldexp(most, -48);
  for (size_t i = 0; i < 3 * mesh->vertices; i++)
    if (fabs(mesh->vertex[i]) * mesh->unit < 0x1p-147)
      mesh->vertex[i] = 0;
  return PACKING_OK;
}

static void find_bounds(packing_mesh *mesh)
{
  double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL},
         hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < 3 * mesh->vertices; i++) {
    lo[i % 3] = fmin(lo[i % 3], mesh->vertex[i]);
    hi[i % 3] = fmax(hi[i % 3], mesh->vertex[i]);
  }
  mesh->bounds.lo = packing_i_mesh_vec(lo);
  mesh->bounds.hi = packing_i_mesh_vec(hi);
}

/* Tetrahedra with their tips in the middle of the bounds; sums of twice the length. */
static void find_contents(packing_mesh *mesh)
{
  const packing_vec3 middle =
      packing_i_scale(packing_i_add(mesh->bounds.lo, mesh->bounds.hi), 0.5);
  packing_i_two area = {0, 0}, volume = {0, 0};
  for (size_t t = 0; t < mesh->triangles; t++) {
    double size;
    const packing_vec3 n = packing_i_mesh_normal(mesh, t, &size);
    const packing_vec3 a = packing_i_mesh_vec(packing_i_mesh_corner(mesh, t, 0));
    const packing_i_two pyramid = {packing_i_dot(n, packing_i_sub(a, middle)) * size / 3,
                                   0};
    area = packing_i_double_add(area, (packing_i_two){size, 0});
    volume = packing_i_double_add(volume, pyramid);
  }
  mesh->area = area.hi;
  mesh->volume = volume.hi;
}

static packing_status fill(packing_context *context, packing_mesh *mesh,
                           const packing_mesh_def *d)
{
  PACKING_I_TRY(copy_vertices(context, mesh, d));
  PACKING_I_TRY(copy_triangles(context, mesh, d));
  PACKING_I_TRY(find_unit(context, mesh));
  find_bounds(mesh);
  const packing_vec3 size = packing_i_sub(mesh->bounds.hi, mesh->bounds.lo);
  PACKING_I_TRY(
      packing_i_mesh_merge(context, mesh, d->merge * packing_i_norm(size), d->merge > 0));
  find_bounds(mesh);
  find_contents(mesh);
  return packing_i_mesh_grow_tree(context, mesh);
}

packing_status packing_mesh_create(packing_context *context, const packing_mesh_def *def,
                                   packing_mesh **mesh)
{
  packing_mesh_def d;
  PACKING_I_TRY(packing_i_check_given(context, "def", def));
  PACKING_I_TRY(packing_i_check_given(context, "mesh", mesh));
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_mesh, shift, def, &d));
  PACKING_I_TRY(check(context, &d));
  packing_status status = PACKING_ERR_NOMEM;
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_mesh *m = packing_i_calloc(allocator, 1, sizeof *m);
  if (m == NULL)
    return packing_i_nomem(context);
  atomic_init(&m->holds, 1);
  m->allocator = *allocator;
  m->vertex = packing_i_alloc(allocator, d.vertex_count, 3 * sizeof *m->vertex);
  m->triangle = packing_i_alloc(allocator, d.triangle_count, 3 * sizeof *m->triangle);
  status = m->vertex == NULL || m->triangle == NULL ? packing_i_nomem(context)
                                                    : fill(context, m, &d);
  if (status == PACKING_OK)
    *mesh = m;
  else
    packing_mesh_destroy(m);
  return status;
}

packing_status packing_mesh_arrays(packing_context *context, const packing_mesh *mesh,
                                   packing_mesh_view *view)
{
  PACKING_I_TRY(packing_i_check_given(context, "mesh", mesh));
  const packing_mesh_view v = {.vertex_count = mesh->vertices,
                               .vertices = mesh->vertex,
                               .triangle_count = mesh->triangles,
                               .triangles = mesh->triangle};
  return packing_i_report_write(context, view, &v, sizeof v);
}

void packing_mesh_bounds(const packing_mesh *mesh, packing_bounds *bounds)
{
  *bounds = mesh->bounds;
}

double packing_mesh_area(const packing_mesh *mesh)
{
  return mesh->area;
}

double packing_mesh_volume(const packing_mesh *mesh)
{
  return mesh->volume;
}
