/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "network.h"
#include <stdlib.h>
#include "network_lists.h"
#include "table.h"

static const char *limit_name(packing_pore_limit limit)
{
  static const char *const names[] = {"free", "particle", "wall", "open"};
  return names[limit];
}

packing_status network_write_pores(const packing_pores *pores,
                                   const packing_stream *stream)
{
  network n = {0};
  packing_status status = network_take(pores, &n);
  if (status == PACKING_OK) {
    table t;
    table_open(&t, stream);
    table_print(&t, "pore,x,y,z,radius,coordination,cells,limit\n");
    for (size_t i = 0; i < n.pores; i++) {
      const packing_pore *p = &n.pore[i];
      table_print(&t, "%zu,%.17g,%.17g,%.17g,%.17g,%zu,%zu,%s\n", i, p->centre.x,
                  p->centre.y, p->centre.z, p->radius, p->coordination, p->cells,
                  limit_name(p->limit));
    }
    status = table_close(&t);
  }
  network_drop(&n);
  return status;
}

packing_status network_write_constrictions(const packing_pores *pores,
                                           const packing_stream *stream)
{
  network n = {0};
  packing_status status = network_take(pores, &n);
  if (status == PACKING_OK) {
    table t;
    table_open(&t, stream);
    table_print(&t, "constriction,a,b,image_x,image_y,image_z,x,y,z,radius,limit\n");
    for (size_t i = 0; i < n.ways; i++) {
      const packing_constriction *c = &n.way[i];
      table_print(&t, "%zu,%zu,%zu,%d,%d,%d,%.17g,%.17g,%.17g,%.17g,%s\n", i, c->a, c->b,
                  c->image[0], c->image[1], c->image[2], c->centre.x, c->centre.y,
                  c->centre.z, c->radius, limit_name(c->limit));
    }
    status = table_close(&t);
  }
  network_drop(&n);
  return status;
}

/* A point of the picture: a pore, or the end of a way that leaves the cell. */
typedef struct point {
  const packing_pore *pore;
  size_t index;
  packing_vec3 at;
  int image;
} point;

static packing_vec3 image_of(const packing_constriction *c, packing_vec3 p,
                             const packing_domain *domain)
{
  packing_bounds b = {{0, 0, 0}, {0, 0, 0}};
  if (domain != NULL)
    packing_domain_bounds(domain, &b);
  p.x += c->image[0] * (b.hi.x - b.lo.x);
  p.y += c->image[1] * (b.hi.y - b.lo.y);
  p.z += c->image[2] * (b.hi.z - b.lo.z);
  return p;
}

static point *make_points(const network *n, const packing_domain *domain, size_t *count)
{
  point *points = calloc(n->pores + n->ways + 1, sizeof *points);
  *count = 0;
  if (!points)
    return NULL;
  for (size_t i = 0; i < n->pores; i++)
    points[i] = (point){&n->pore[i], i, n->pore[i].centre, 0};
  *count = n->pores;
  for (size_t i = 0; i < n->ways; i++)
    if (network_leaves(&n->way[i])) {
      const packing_pore *b = &n->pore[n->way[i].b];
      points[(*count)++] =
          (point){b, n->way[i].b, image_of(&n->way[i], b->centre, domain), 1};
    }
  return points;
}

static void put_array(table *t, const char *type, const char *name, int components)
{
  table_print(
      t,
      "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n",
      type, name, components);
}

static void put_point_data(table *t, const point *p, size_t count)
{
  table_print(t, "<PointData Scalars=\"radius\">\n");
  put_array(t, "Float64", "radius", 1);
  for (size_t i = 0; i < count; i++)
    table_print(t, "%.17g\n", p[i].pore->radius);
  table_print(t, "</DataArray>\n");
  static const char *const names[] = {"pore", "coordination", "cells", "limit", "image"};
  for (int k = 0; k < 5; k++) {
    put_array(t, "Int64", names[k], 1);
    for (size_t i = 0; i < count; i++) {
      const size_t values[] = {p[i].index, p[i].pore->coordination, p[i].pore->cells,
                               (size_t)p[i].pore->limit, (size_t)p[i].image};
      table_print(t, "%zu\n", values[k]);
    }
    table_print(t, "</DataArray>\n");
  }
  table_print(t, "</PointData>\n");
}

/* VTK counts cells of all kinds: first the vertices, then the lines. */
static void put_cell_data(table *t, const network *n, size_t points)
{
  table_print(t, "<CellData>\n");
  put_array(t, "Float64", "width", 1);
  for (size_t i = 0; i < points; i++)
    table_print(t, "0\n");
  for (size_t i = 0; i < n->ways; i++)
    table_print(t, "%.17g\n", n->way[i].radius);
  table_print(t, "</DataArray>\n");
  static const char *const names[] = {"constriction", "way_limit"};
  for (int k = 0; k < 2; k++) {
    put_array(t, "Int64", names[k], 1);
    for (size_t i = 0; i < points; i++)
      table_print(t, "-1\n");
    for (size_t i = 0; i < n->ways; i++)
      table_print(t, "%zu\n", k == 0 ? i : (size_t)n->way[i].limit);
    table_print(t, "</DataArray>\n");
  }
  table_print(t, "</CellData>\n");
}

static void put_points(table *t, const point *p, size_t count)
{
  table_print(t, "<Points>\n");
  put_array(t, "Float64", "Points", 3);
  for (size_t i = 0; i < count; i++)
    table_print(t, "%.17g %.17g %.17g\n", p[i].at.x, p[i].at.y, p[i].at.z);
  table_print(t, "</DataArray>\n</Points>\n<Verts>\n");
  for (int k = 0; k < 2; k++) {
    put_array(t, "Int64", k == 0 ? "connectivity" : "offsets", 1);
    for (size_t i = 0; i < count; i++)
      table_print(t, "%zu\n", i + (size_t)k);
    table_print(t, "</DataArray>\n");
  }
  table_print(t, "</Verts>\n");
}

static void put_lines(table *t, const network *n)
{
  size_t end_point = n->pores;
  table_print(t, "<Lines>\n");
  put_array(t, "Int64", "connectivity", 1);
  for (size_t i = 0; i < n->ways; i++)
    table_print(t, "%zu %zu\n", n->way[i].a,
                network_leaves(&n->way[i]) ? end_point++ : n->way[i].b);
  table_print(t, "</DataArray>\n");
  put_array(t, "Int64", "offsets", 1);
  for (size_t i = 0; i < n->ways; i++)
    table_print(t, "%zu\n", 2 * (i + 1));
  table_print(t, "</DataArray>\n</Lines>\n");
}

static void put_all(table *t, const network *n, const point *points, size_t count)
{
  table_print(t, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                 "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n");
  table_print(t,
              "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" NumberOfLines=\"%zu\" "
              "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
              count, count, n->ways);
  put_point_data(t, points, count);
  put_cell_data(t, n, count);
  put_points(t, points, count);
  put_lines(t, n);
  table_print(t, "</Piece>\n</PolyData>\n</VTKFile>\n");
}

packing_status network_write_vtp(const packing_pores *pores, const packing_domain *domain,
                                 const packing_stream *stream)
{
  network n = {0};
  table t;
  size_t count = 0;
  point *points = NULL;
  packing_status status = network_take(pores, &n);
  if (status == PACKING_OK) {
    points = make_points(&n, domain, &count);
    status = points ? PACKING_OK : PACKING_ERR_NOMEM;
  }
  if (status == PACKING_OK) {
    table_open(&t, stream);
    put_all(&t, &n, points, count);
    status = table_close(&t);
  }
  free(points);
  network_drop(&n);
  return status;
}
