/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of vertices and triangles that grow with what is read. */
#include "mesh_file_internal.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 1 << 28, FIRST_ROOM = 64 };

packing_status packing_i_mesh_file_fail(const packing_i_mesh_file *file,
                                        const char *format, ...)
{
  char text[320];
  va_list arguments;
  va_start(arguments, format);
  if (vsnprintf(text, sizeof text, format, arguments) < 0)
    text[0] = '\0';
  va_end(arguments);
  return packing_i_read_fail(&file->read, PACKING_ERR_FORMAT, "%s", text);
}

/* Room for one more of three entries each. */
static packing_status make_room(packing_i_mesh_file *file, void **list, size_t count,
                                size_t *room, size_t size, const char *what)
{
  if (count < *room)
    return PACKING_OK;
  if (count >= MOST)
    return packing_i_read_fail(&file->read, PACKING_ERR_RANGE, "more than %d %s", MOST,
                               what);
  const size_t more = count == 0 ? FIRST_ROOM : 2 * count;
  void *grown = packing_i_regrow(packing_i_allocator(file->read.context), *list, count,
                                 more, 3 * size);
  if (grown == NULL)
    return packing_i_nomem(file->read.context);
  *list = grown;
  *room = more;
  return PACKING_OK;
}

packing_status packing_i_mesh_file_vertex(packing_i_mesh_file *file, const double x[3])
{
  void *list = file->vertex;
  if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
    return packing_i_mesh_file_fail(file, "the vertex (%g, %g, %g) is not finite", x[0],
                                    x[1], x[2]);
  PACKING_I_TRY(
      make_room(file, &list, file->vertices, &file->vertex_room, sizeof *x, "vertices"));
  file->vertex = list;
  memcpy(&file->vertex[3 * file->vertices++], x, 3 * sizeof *x);
  return PACKING_OK;
}

packing_status packing_i_mesh_file_triangle(packing_i_mesh_file *file,
                                            const uint32_t v[3])
{
  void *list = file->triangle;
  PACKING_I_TRY(make_room(file, &list, file->triangles, &file->triangle_room, sizeof *v,
                          "triangles"));
  file->triangle = list;
  memcpy(&file->triangle[3 * file->triangles++], v, 3 * sizeof *v);
  return PACKING_OK;
}

packing_status packing_i_mesh_file_bytes(packing_i_mesh_file *file, void *out,
                                         size_t count, const char *what)
{
  size_t taken;
  PACKING_I_TRY(packing_i_lines_bytes(&file->read.lines, out, count, &taken));
  if (taken < count)
    return packing_i_mesh_file_fail(file, "the file ends within %s", what);
  file->read.byte += count;
  return PACKING_OK;
}
