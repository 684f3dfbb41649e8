/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What keeps a mesh from bounding a region: looks for one kind of defect after the other and stops
 * with the first that is there, since later questions take for granted what the earlier ones have
 * found. */
#include "mesh_internal.h"
#include <string.h>

const char *packing_mesh_defect_string(packing_mesh_defect defect)
{
  static const char *const names[] = {
      [PACKING_MESH_SOUND] = "no defect",
      [PACKING_MESH_DEGENERATE] = "a triangle without area",
      [PACKING_MESH_OPEN] = "an open edge",
      [PACKING_MESH_NON_MANIFOLD] = "an edge of more than two triangles",
      [PACKING_MESH_ORIENTATION] = "neighbours of opposite orientation",
      [PACKING_MESH_PINCHED] = "a vertex where several sheets meet",
      [PACKING_MESH_ZERO_THICKNESS] = "triangles that lie on each other",
      [PACKING_MESH_SELF_INTERSECTING] = "triangles that cut each other",
      [PACKING_MESH_INVERTED] = "a closed part that faces the wrong way"};
  const size_t i = (size_t)defect;
  return i < sizeof names / sizeof *names ? names[i] : "an unknown defect";
}

void packing_i_mesh_find(packing_i_mesh_finding *finding, size_t triangle, size_t other,
                         packing_vec3 point)
{
  if (finding->count++ > 0 && finding->triangle <= triangle)
    return;
  finding->triangle = triangle;
  finding->other = other;
  finding->point = point;
}

packing_vec3 packing_i_mesh_middle(const packing_mesh *mesh, size_t t)
{
  packing_vec3 sum = {0, 0, 0};
  for (int i = 0; i < 3; i++)
    sum = packing_i_add(
        sum,
        packing_i_scale(packing_i_mesh_vec(packing_i_mesh_corner(mesh, t, i)), 1.0 / 3));
  return sum;
}

static packing_i_mesh_finding find_degenerate(const packing_mesh *mesh)
{
  packing_i_mesh_finding found = packing_i_mesh_nothing();
  for (size_t t = 0; t < mesh->triangles; t++)
    if (packing_i_mesh_is_flat(mesh, t))
      packing_i_mesh_find(&found, t, PACKING_NO_INDEX, packing_i_mesh_middle(mesh, t));
  return found;
}

static packing_vec3 middle_of_edge(const packing_mesh *mesh, uint32_t half)
{
  const double *a = &mesh->vertex[3 * (size_t)packing_i_mesh_from(mesh, half)];
  const double *b = &mesh->vertex[3 * (size_t)packing_i_mesh_to(mesh, half)];
  return packing_i_scale(packing_i_add(packing_i_mesh_vec(a), packing_i_mesh_vec(b)),
                         0.5);
}

/* Of edges: open, of many triangles, of two that disagree. */
typedef struct edge_findings {
  packing_i_mesh_finding open, many, turned;
} edge_findings;

static edge_findings find_edges(const packing_mesh *mesh, const uint32_t *half)
{
  edge_findings f = {packing_i_mesh_nothing(), packing_i_mesh_nothing(),
                     packing_i_mesh_nothing()};
  size_t size;
  for (size_t i = 0; i < 3 * mesh->triangles; i += size) {
    size = packing_i_mesh_edge_size(mesh, half, i);
    const packing_vec3 at = middle_of_edge(mesh, half[i]);
    if (size == 1)
      packing_i_mesh_find(&f.open, half[i] / 3, PACKING_NO_INDEX, at);
    else if (size > 2)
      packing_i_mesh_find(&f.many, half[i] / 3, half[i + 1] / 3, at);
    else if (!packing_i_mesh_agree(mesh, half[i], half[i + 1]))
      packing_i_mesh_find(&f.turned, half[i] / 3, half[i + 1] / 3, at);
  }
  return f;
}

/* Walks round each vertex once: triangles left over hang on another sheet. `seen` has room for
 * all half edges and is clear. */
static packing_i_mesh_finding find_pinched(const packing_mesh *mesh, const uint32_t *twin,
                                           uint8_t *seen, uint8_t *visited)
{
  packing_i_mesh_finding found = packing_i_mesh_nothing();
  for (size_t h = 0; h < 3 * mesh->triangles; h++) {
    const uint32_t v = packing_i_mesh_from(mesh, (uint32_t)h);
    if (seen[h])
      continue;
    if (visited[v])
      packing_i_mesh_find(&found, h / 3, PACKING_NO_INDEX,
                          packing_i_mesh_vec(&mesh->vertex[3 * (size_t)v]));
    visited[v] = 1;
    uint32_t at = (uint32_t)h;
    do {
      seen[at] = 1;
      at = packing_i_mesh_next(twin[at]);
    } while (at != h);
  }
  return found;
}

static packing_status look_for_pinched(packing_context *context, const packing_mesh *mesh,
                                       const uint32_t *twin,
                                       packing_i_mesh_finding *found)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  uint8_t *seen = packing_i_calloc(allocator, mesh->triangles, 3);
  uint8_t *visited = packing_i_calloc(allocator, mesh->vertices, 1);
  packing_status status = PACKING_OK;
  if (seen == NULL || visited == NULL)
    status = packing_i_nomem(context);
  else
    *found = find_pinched(mesh, twin, seen, visited);
  packing_i_free(allocator, seen);
  packing_i_free(allocator, visited);
  return status;
}

/* Whether there is one; then the report has it. */
static int reported(packing_mesh_report *r, packing_mesh_defect defect,
                    const packing_i_mesh_finding *f)
{
  if (f->count == 0)
    return 0;
  r->defect = defect;
  r->count = f->count;
  r->triangle = f->triangle;
  r->other = f->other;
  r->point = f->point;
  return 1;
}

/* What needs neighbours: the surface is closed and oriented. */
static packing_status look_at_surface(packing_context *context, const packing_mesh *mesh,
                                      const uint32_t *twin, packing_mesh_report *r)
{
  packing_i_mesh_finding pinched = packing_i_mesh_nothing(), on = pinched,
                         crossing = pinched, inverted = pinched;
  PACKING_I_TRY(look_for_pinched(context, mesh, twin, &pinched));
  if (reported(r, PACKING_MESH_PINCHED, &pinched))
    return PACKING_OK;
  PACKING_I_TRY(packing_i_mesh_check_pairs(context, mesh, &on, &crossing));
  if (reported(r, PACKING_MESH_ZERO_THICKNESS, &on) ||
      reported(r, PACKING_MESH_SELF_INTERSECTING, &crossing))
    return PACKING_OK;
  PACKING_I_TRY(packing_i_mesh_check_parts(context, mesh, twin, &inverted, &r->parts));
  (void)reported(r, PACKING_MESH_INVERTED, &inverted);
  return PACKING_OK;
}

static packing_status look(packing_context *context, const packing_mesh *mesh,
                           packing_mesh_report *r)
{
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_status status = PACKING_OK;
  const packing_i_mesh_finding degenerate = find_degenerate(mesh);
  if (reported(r, PACKING_MESH_DEGENERATE, &degenerate))
    return PACKING_OK;
  uint32_t *half = packing_i_mesh_sort_edges(context, mesh);
  uint32_t *twin = packing_i_alloc(allocator, mesh->triangles, 3 * sizeof *twin);
  if (half == NULL || twin == NULL) {
    status = packing_i_nomem(context);
    goto out;
  }
  const edge_findings edges = find_edges(mesh, half);
  if (reported(r, PACKING_MESH_OPEN, &edges.open) ||
      reported(r, PACKING_MESH_NON_MANIFOLD, &edges.many) ||
      reported(r, PACKING_MESH_ORIENTATION, &edges.turned))
    goto out;
  packing_i_mesh_twins(mesh, half, twin);
  status = look_at_surface(context, mesh, twin, r);
out:
  packing_i_free(allocator, half);
  packing_i_free(allocator, twin);
  return status;
}

packing_status packing_mesh_check(packing_context *context, const packing_mesh *mesh,
                                  packing_mesh_report *report)
{
  packing_mesh_report r;
  packing_mesh_report_init(&r);
  PACKING_I_TRY(packing_i_check_given(context, "mesh", mesh));
  PACKING_I_TRY(packing_i_report_check(context, report));
  r.triangle = r.other = PACKING_NO_INDEX;
  PACKING_I_TRY(look(context, mesh, &r));
  return packing_i_report_write(context, report, &r, sizeof r);
}
