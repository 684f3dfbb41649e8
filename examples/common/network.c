/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "network.h"
#include <stdlib.h>
#include <string.h>
#include "network_text.h"
#include "program.h"

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
    network_text *t = network_text_begin(stream);
    network_put(t, "pore,x,y,z,radius,coordination,cells,limit\n");
    for (size_t i = 0; i < n.pores; i++) {
      const packing_pore *p = &n.pore[i];
      network_put(t, "%zu,%.17g,%.17g,%.17g,%.17g,%zu,%zu,%s\n", i, p->centre.x,
                  p->centre.y, p->centre.z, p->radius, p->coordination, p->cells,
                  limit_name(p->limit));
    }
    status = network_text_end(t);
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
    network_text *t = network_text_begin(stream);
    network_put(t, "constriction,a,b,image_x,image_y,image_z,x,y,z,radius,limit\n");
    for (size_t i = 0; i < n.ways; i++) {
      const packing_constriction *c = &n.way[i];
      network_put(t, "%zu,%zu,%zu,%d,%d,%d,%.17g,%.17g,%.17g,%.17g,%s\n", i, c->a, c->b,
                  c->image[0], c->image[1], c->image[2], c->centre.x, c->centre.y,
                  c->centre.z, c->radius, limit_name(c->limit));
    }
    status = network_text_end(t);
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
  point *points = program_take(n->pores + n->ways + 1, sizeof *points);
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

static void put_array(network_text *t, const char *type, const char *name, int components)
{
  network_put(
      t,
      "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n",
      type, name, components);
}

static void put_point_data(network_text *t, const point *p, size_t count)
{
  network_put(t, "<PointData Scalars=\"radius\">\n");
  put_array(t, "Float64", "radius", 1);
  for (size_t i = 0; i < count; i++)
    network_put(t, "%.17g\n", p[i].pore->radius);
  network_put(t, "</DataArray>\n");
  static const char *const names[] = {"pore", "coordination", "cells", "limit", "image"};
  for (int k = 0; k < 5; k++) {
    put_array(t, "Int64", names[k], 1);
    for (size_t i = 0; i < count; i++) {
      const size_t values[] = {p[i].index, p[i].pore->coordination, p[i].pore->cells,
                               (size_t)p[i].pore->limit, (size_t)p[i].image};
      network_put(t, "%zu\n", values[k]);
    }
    network_put(t, "</DataArray>\n");
  }
  network_put(t, "</PointData>\n");
}

/* VTK counts cells of all kinds: first the vertices, then the lines. */
static void put_cell_data(network_text *t, const network *n, size_t points)
{
  network_put(t, "<CellData>\n");
  put_array(t, "Float64", "width", 1);
  for (size_t i = 0; i < points; i++)
    network_put(t, "0\n");
  for (size_t i = 0; i < n->ways; i++)
    network_put(t, "%.17g\n", n->way[i].radius);
  network_put(t, "</DataArray>\n");
  static const char *const names[] = {"constriction", "way_limit"};
  for (int k = 0; k < 2; k++) {
    put_array(t, "Int64", names[k], 1);
    for (size_t i = 0; i < points; i++)
      network_put(t, "-1\n");
    for (size_t i = 0; i < n->ways; i++)
      network_put(t, "%zu\n", k == 0 ? i : (size_t)n->way[i].limit);
    network_put(t, "</DataArray>\n");
  }
  network_put(t, "</CellData>\n");
}

static void put_points(network_text *t, const point *p, size_t count)
{
  network_put(t, "<Points>\n");
  put_array(t, "Float64", "Points", 3);
  for (size_t i = 0; i < count; i++)
    network_put(t, "%.17g %.17g %.17g\n", p[i].at.x, p[i].at.y, p[i].at.z);
  network_put(t, "</DataArray>\n</Points>\n<Verts>\n");
  for (int k = 0; k < 2; k++) {
    put_array(t, "Int64", k == 0 ? "connectivity" : "offsets", 1);
    for (size_t i = 0; i < count; i++)
      network_put(t, "%zu\n", i + (size_t)k);
    network_put(t, "</DataArray>\n");
  }
  network_put(t, "</Verts>\n");
}

static void put_lines(network_text *t, const network *n)
{
  size_t end_point = n->pores;
  network_put(t, "<Lines>\n");
  put_array(t, "Int64", "connectivity", 1);
  for (size_t i = 0; i < n->ways; i++)
    network_put(t, "%zu %zu\n", n->way[i].a,
                network_leaves(&n->way[i]) ? end_point++ : n->way[i].b);
  network_put(t, "</DataArray>\n");
  put_array(t, "Int64", "offsets", 1);
  for (size_t i = 0; i < n->ways; i++)
    network_put(t, "%zu\n", 2 * (i + 1));
  network_put(t, "</DataArray>\n</Lines>\n");
}

packing_status network_write_vtp(const packing_pores *pores, const packing_domain *domain,
                                 const packing_stream *stream)
{
  network n = {0};
  packing_status status = network_take(pores, &n);
  if (status == PACKING_OK) {
    size_t count;
    network_text *t = network_text_begin(stream);
    point *points = make_points(&n, domain, &count);
    network_put(t, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
                   "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n");
    network_put(
        t,
        "<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" NumberOfLines=\"%zu\" "
        "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
        count, count, n.ways);
    put_point_data(t, points, count);
    put_cell_data(t, &n, count);
    put_points(t, points, count);
    put_lines(t, &n);
    network_put(t, "</Piece>\n</PolyData>\n</VTKFile>\n");
    free(points);
    status = network_text_end(t);
  }
  network_drop(&n);
  return status;
}

/* What one file is written from. */
typedef struct job {
  const packing_pores *pores;
  const packing_domain *domain;
  const packing_bounds *box;
  double reach;
} job;

typedef packing_status (*part_writer)(const job *j, const packing_stream *stream);

static packing_status part_vtp(const job *j, const packing_stream *stream)
{
  return network_write_vtp(j->pores, j->domain, stream);
}

static packing_status part_pores(const job *j, const packing_stream *stream)
{
  return network_write_pores(j->pores, stream);
}

static packing_status part_constrictions(const job *j, const packing_stream *stream)
{
  return network_write_constrictions(j->pores, stream);
}

#define STATOIL_PART(name, part)                                                         \
  static packing_status name(const job *j, const packing_stream *stream)                 \
  {                                                                                      \
    return network_write_statoil(j->pores, j->box, j->reach, part, stream);              \
  }
STATOIL_PART(part_node1, NETWORK_NODE1)
STATOIL_PART(part_node2, NETWORK_NODE2)
STATOIL_PART(part_link1, NETWORK_LINK1)
STATOIL_PART(part_link2, NETWORK_LINK2)

static int write_part(packing_context *context, const char *prefix, const char *suffix,
                      part_writer writer, const job *j)
{
  packing_file *file = NULL;
  const size_t length = strlen(prefix), more = strlen(suffix);
  char *path = program_take(length + more + 1, 1);
  memcpy(path, prefix, length);
  memcpy(path + length, suffix, more + 1);
  packing_status status = packing_file_create(context, path, &file);
  if (status == PACKING_OK) {
    status = writer(j, packing_file_stream(file));
    if (status == PACKING_OK)
      status = packing_file_commit(file);
    else
      packing_file_close(file);
  }
  const int code = status == PACKING_OK ? 0 : program_status(context, status, path);
  free(path);
  return code;
}

int network_write_files(packing_context *context, const char *prefix,
                        const packing_pores *pores, const packing_domain *domain,
                        const packing_bounds *box, double reach)
{
  static const struct {
    const char *suffix;
    part_writer writer;
  } parts[] = {{".vtp", part_vtp},
               {"-pores.csv", part_pores},
               {"-constrictions.csv", part_constrictions},
               {"_node1.dat", part_node1},
               {"_node2.dat", part_node2},
               {"_link1.dat", part_link1},
               {"_link2.dat", part_link2}};
  const job j = {pores, domain, box, reach};
  for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
    const int code = write_part(context, prefix, parts[i].suffix, parts[i].writer, &j);
    if (code != 0)
      return code;
  }
  return 0;
}
