/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes from files: tells the format from how a file begins, reads, makes the mesh. Binary is what
 * has bytes in its first kilobyte that no text has; a binary STL may call itself "solid". */
#include "mesh_file_internal.h"
#include <string.h>

enum { LOOK = 1024 };

typedef struct mesh_format {
  packing_i_reader reader;
  packing_status (*read)(packing_i_mesh_file *file);
} mesh_format;

static const mesh_format formats[] = {
    [PACKING_MESH_FORMAT_STL_TEXT] =
        {{{"stl", ".stl", "StereoLithography Interface Specification, 1989", "triangles"},
          PACKING_I_READS_LINES,
          NULL},
         packing_i_read_stl_text},
    [PACKING_MESH_FORMAT_STL_BINARY] =
        {{{"stl", ".stl", "StereoLithography Interface Specification, 1989", "triangles"},
          PACKING_I_READS_BYTES,
          NULL},
         packing_i_read_stl_binary},
    [PACKING_MESH_FORMAT_OBJ] = {{{"obj", ".obj", "Wavefront Advanced Visualizer, B1",
                                   "vertices and faces"},
                                  PACKING_I_READS_LINES,
                                  NULL},
                                 packing_i_read_obj},
    [PACKING_MESH_FORMAT_PLY] = {
        {{"ply", ".ply", "G. Turk, The PLY polygon file format", "vertices and faces"},
         PACKING_I_READS_LINES,
         NULL},
        packing_i_read_ply}};

void packing_read_mesh_def_fill(packing_read_mesh_def *def, size_t size)
{
  packing_read_mesh_def defaults = {.scale = 1};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static int begins(const char *at, size_t count, const char *with)
{
  const size_t length = strlen(with);
  return count >= length && memcmp(at, with, length) == 0;
}

static int is_text(const char *at, size_t count)
{
  for (size_t i = 0; i < count; i++) {
    const unsigned char c = (unsigned char)at[i];
    if (c == 127 || (c < 32 && c != '\t' && c != '\n' && c != '\r' && c != '\f'))
      return 0;
  }
  return 1;
}

static packing_mesh_format look_at(const char *at, size_t count)
{
  size_t blank = 0;
  if (begins(at, count, "\xEF\xBB\xBF"))
    blank = 3;
  if (begins(at, count, "ply\n") || begins(at, count, "ply\r"))
    return PACKING_MESH_FORMAT_PLY;
  if (!is_text(at, count))
    return PACKING_MESH_FORMAT_STL_BINARY;
  while (blank < count && strchr(" \t\r\n", at[blank]) != NULL)
    blank++;
  return begins(at + blank, count - blank, "solid") ? PACKING_MESH_FORMAT_STL_TEXT
                                                    : PACKING_MESH_FORMAT_OBJ;
}

static packing_status choose(packing_i_mesh_file *file, packing_mesh_format *format)
{
  const char *at;
  size_t count;
  PACKING_I_TRY(packing_i_lines_peek(&file->read.lines, LOOK, &at, &count));
  if (*format == PACKING_MESH_FORMAT_AUTO)
    *format = look_at(at, count < LOOK ? count : LOOK);
  file->read.reader = &formats[*format].reader;
  return PACKING_OK;
}

static packing_status make(const packing_i_mesh_file *file,
                           const packing_read_mesh_def *d, packing_mesh **mesh)
{
  packing_mesh_def def;
  packing_mesh_def_init(&def);
  def.vertex_count = file->vertices;
  def.vertices = file->vertex;
  def.triangle_count = file->soup ? file->vertices / 3 : file->triangles;
  def.triangles = file->soup ? NULL : file->triangle;
  def.merge = d->merge;
  def.scale = d->scale;
  def.shift = d->shift;
  if (def.triangle_count == 0)
    return packing_i_mesh_file_fail(file,
                                    "the file ends, and no triangle has stood in it");
  return packing_mesh_create(file->read.context, &def, mesh);
}

static packing_status read_file(packing_i_mesh_file *file, const packing_read_mesh_def *d,
                                packing_mesh **mesh)
{
  packing_mesh_format format = d->format;
  PACKING_I_TRY(choose(file, &format));
  PACKING_I_TRY(formats[format].read(file));
  return make(file, d, mesh);
}

packing_status packing_read_mesh(packing_context *context,
                                 const packing_read_mesh_def *def,
                                 const packing_stream *stream, packing_mesh **mesh)
{
  packing_read_mesh_def d;
  packing_i_mesh_file file = {.soup = 0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_read_mesh, shift, def, &d));
  PACKING_I_TRY(packing_i_check_given(context, "mesh", mesh));
  if ((int)d.format < PACKING_MESH_FORMAT_AUTO || d.format > PACKING_MESH_FORMAT_PLY)
    return packing_i_fail(context, PACKING_ERR_INVALID, "format", PACKING_NO_INDEX,
                          "%d is none of packing_mesh_format", (int)d.format);
  file.read.context = context;
  file.read.stream = stream;
  file.read.reader = &formats[PACKING_MESH_FORMAT_STL_TEXT].reader;
  packing_status status =
      packing_i_lines_begin(&file.read.lines, context, &file.read.reader->format, stream);
  if (status == PACKING_OK)
    status = read_file(&file, &d, mesh);
  const packing_allocator *allocator = packing_i_allocator(context);
  packing_i_free(allocator, file.read.lines.buffer);
  packing_i_free(allocator, file.vertex);
  packing_i_free(allocator, file.triangle);
  return status;
}

packing_status packing_read_mesh_file(packing_context *context,
                                      const packing_read_mesh_def *def, const char *path,
                                      packing_mesh **mesh)
{
  packing_file *file = NULL;
  PACKING_I_TRY(packing_file_open(context, path, &file));
  const packing_status status =
      packing_read_mesh(context, def, packing_file_stream(file), mesh);
  packing_file_close(file);
  return status;
}
