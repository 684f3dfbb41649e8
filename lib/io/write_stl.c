/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walls of a container as STL. Binary: 80 bytes of text, the number of triangles, 50 bytes
 * each, all little-endian; text: the same with 17 digits. Two passes over the triangles, constant
 * memory. Reference: StereoLithography Interface Specification, 3D Systems, 1989. */
#include "vec.h"
#include "writers_internal.h"
#include <float.h>
#include <math.h>

enum { HEADER = 80, DEFAULT_FACETS = 64 };

void packing_stl_def_fill(packing_stl_def *def, size_t size)
{
  packing_stl_def defaults = {.facets = DEFAULT_FACETS};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

/* Triangles, and whether there are some that single or double precision cannot tell from a line
 * or a point. */
typedef struct survey {
  uint32_t count;
  int lost, flat;
} survey;

static int is_single(packing_vec3 v)
{
  return fabs(v.x) <= (double)FLT_MAX && fabs(v.y) <= (double)FLT_MAX &&
         fabs(v.z) <= (double)FLT_MAX;
}

static int same_single(packing_vec3 a, packing_vec3 b)
{
  return (float)a.x == (float)b.x && (float)a.y == (float)b.y && (float)a.z == (float)b.z;
}

/* Not a number where the triangle has no area. */
static packing_vec3 normal_of(const packing_vec3 corner[3])
{
  const packing_vec3 a = packing_i_sub(corner[1], corner[0]);
  const packing_vec3 b = packing_i_sub(corner[2], corner[0]);
  const double scale = fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z));
  const packing_vec3 u = packing_i_vec(a.x / scale, a.y / scale, a.z / scale);
  const double other = fmax(fmax(fabs(b.x), fabs(b.y)), fabs(b.z));
  const packing_vec3 v = packing_i_vec(b.x / other, b.y / other, b.z / other);
  const packing_vec3 n =
      packing_i_vec(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
  const double norm = packing_i_norm(n);
  return packing_i_vec(n.x / norm, n.y / norm, n.z / norm);
}

static void look(void *user, const packing_vec3 corner[3])
{
  survey *s = user;
  s->count++;
  s->flat |= !isfinite(normal_of(corner).x);
  for (int i = 0; i < 3 && !s->lost; i++)
    s->lost = !is_single(corner[i]) || same_single(corner[i], corner[(i + 1) % 3]);
}

static void put_word(packing_i_writer *w, uint32_t v)
{
  for (int i = 0; i < 4; i++, v >>= 8)
    packing_i_put_char(w, (char)(v & 0xff));
}

static void put_single(packing_i_writer *w, packing_vec3 v)
{
  const float single[] = {(float)v.x, (float)v.y, (float)v.z};
  for (int k = 0; k < 3; k++) {
    uint32_t bits;
    memcpy(&bits, &single[k], sizeof bits);
    put_word(w, bits);
  }
}

static void put_binary(void *user, const packing_vec3 corner[3])
{
  static const char no_attributes[2] = {0, 0};
  put_single(user, normal_of(corner));
  for (int i = 0; i < 3; i++)
    put_single(user, corner[i]);
  packing_i_put_bytes(user, no_attributes, sizeof no_attributes);
}

static void put_text(void *user, const packing_vec3 corner[3])
{
  packing_i_writer *w = user;
  packing_i_put_text(w, "facet normal ");
  packing_i_put_vec(w, ' ', normal_of(corner));
  packing_i_put_text(w, "\nouter loop\n");
  for (int i = 0; i < 3; i++) {
    packing_i_put_text(w, "vertex ");
    packing_i_put_vec(w, ' ', corner[i]);
    packing_i_put_char(w, '\n');
  }
  packing_i_put_text(w, "endloop\nendfacet\n");
}

/* A header that begins with "solid" would be taken for a text. */
static void put_header(packing_i_writer *w, const char *title, uint32_t count)
{
  char header[HEADER] = "STL: ";
  const size_t used = strlen(header), length = strlen(title);
  memcpy(header + used, title, length < HEADER - used ? length : HEADER - used);
  packing_i_put_bytes(w, header, HEADER);
  put_word(w, count);
}

static void put_line(packing_i_writer *w, const char *word, const char *title)
{
  packing_i_put_text(w, word);
  packing_i_put_text(w, title);
  packing_i_put_char(w, '\n');
}

static packing_status write_mesh(packing_context *context, const packing_stl_def *d,
                                 const packing_domain *domain, uint32_t count,
                                 const packing_stream *stream)
{
  const char *title = d->title == NULL ? "container" : d->title;
  packing_i_writer w;
  PACKING_I_TRY(packing_i_writer_open(&w, context, "stl", stream));
  if (d->ascii)
    put_line(&w, "solid ", title);
  else
    put_header(&w, title, count);
  packing_i_mesh_visit(domain, d->facets, d->ascii ? put_text : put_binary, &w);
  if (d->ascii)
    put_line(&w, "endsolid ", title);
  return packing_i_writer_end(&w);
}

packing_status packing_write_stl(packing_context *context, const packing_stl_def *def,
                                 const packing_domain *domain,
                                 const packing_stream *stream)
{
  packing_stl_def d;
  survey s = {0, 0, 0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_stl, title, def, &d));
  PACKING_I_TRY(packing_i_check_switch(context, "ascii", d.ascii));
  PACKING_I_TRY(packing_i_check_line(context, "title", d.title));
  PACKING_I_TRY(packing_i_mesh_check(context, domain, d.facets));
  packing_i_mesh_visit(domain, d.facets, look, &s);
  if (s.flat)
    return packing_i_fail(context, PACKING_ERR_RANGE, "domain", PACKING_NO_INDEX,
                          "too far off for its size, or too large: walls without area");
  if (!d.ascii && s.lost)
    return packing_i_fail(
        context, PACKING_ERR_RANGE, "domain", PACKING_NO_INDEX,
        "too large, small or far off for single precision; text holds it");
  return write_mesh(context, &d, domain, s.count, stream);
}
