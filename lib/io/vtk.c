/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK's XML files, whatever the data set: point data, points, cells. Arrays follow the XML as raw
 * bytes in the machine's order, 64-bit sizes before each; or as zlib blocks. Read back with VTK
 * 9.1. Linear, in constant memory. */
#include "vtk_internal.h"
#include "view.h"

enum { VERTEX = 1, LINE = 3 }; /* VTK_VERTEX, VTK_LINE */

size_t packing_i_vtk_tuple_size(const packing_i_vtk_array *array)
{
  switch (array->kind) {
  case PACKING_I_VTK_CELL_TYPES:
    return 1;
  case PACKING_I_VTK_INT32:
  case PACKING_I_VTK_BOND_TYPES:
    return 4;
  default:
    return (size_t)array->components * 8U;
  }
}

static void gather_doubles(const packing_i_vtk_array *a, size_t first, size_t count,
                           double *out)
{
  for (unsigned k = 0; k < a->components; k++)
    for (size_t i = 0; i < count; i++)
      out[i * a->components + k] = packing_i_view_number(&a->columns[k], first + i);
}

static void gather_column(const packing_i_vtk_array *a, size_t first, size_t count,
                          char *out)
{
  const packing_column *c = &a->columns[0];
  const size_t size = packing_i_vtk_tuple_size(a);
  for (size_t i = 0; i < count; i++)
    memcpy(out + i * size, (const char *)c->data + (first + i) * c->stride, size);
}

static int64_t point_of_cells(const packing_i_vtk_cells *c, size_t t)
{
  if (t < c->vertices)
    return (int64_t)t;
  const packing_bond *b = &c->bonds[(t - c->vertices) / 2];
  return (int64_t)((t - c->vertices) % 2 == 0 ? b->i : b->j);
}

static int64_t end_of_cell(const packing_i_vtk_cells *c, size_t t)
{
  return (int64_t)(t < c->vertices ? t + 1 : c->vertices + 2 * (t - c->vertices + 1));
}

static void gather_indices(const packing_i_vtk_array *a, size_t first, size_t count,
                           int64_t *out)
{
  const int ends = a->kind == PACKING_I_VTK_OFFSETS;
  for (size_t i = 0; i < count; i++)
    out[i] =
        ends ? end_of_cell(&a->cells, first + i) : point_of_cells(&a->cells, first + i);
}

static void gather_cell_types(const packing_i_vtk_array *a, size_t first, size_t count,
                              unsigned char *out)
{
  for (size_t i = 0; i < count; i++)
    out[i] = first + i < a->cells.vertices ? VERTEX : LINE;
}

static void gather_bond_types(const packing_i_vtk_array *a, size_t first, size_t count,
                              int32_t *out)
{
  const size_t vertices = a->cells.vertices;
  for (size_t i = 0; i < count; i++)
    out[i] = first + i < vertices ? 0 : a->cells.bonds[first + i - vertices].type;
}

void packing_i_vtk_gather(const packing_i_vtk_array *a, size_t first, size_t count,
                          void *out)
{
  switch (a->kind) {
  case PACKING_I_VTK_FLOAT64:
    gather_doubles(a, first, count, out);
    break;
  case PACKING_I_VTK_INT64:
  case PACKING_I_VTK_INT32:
    gather_column(a, first, count, out);
    break;
  case PACKING_I_VTK_CONNECTIVITY:
  case PACKING_I_VTK_OFFSETS:
    gather_indices(a, first, count, out);
    break;
  case PACKING_I_VTK_CELL_TYPES:
    gather_cell_types(a, first, count, out);
    break;
  case PACKING_I_VTK_BOND_TYPES:
    gather_bond_types(a, first, count, out);
    break;
  }
}

static packing_i_vtk_array *add(packing_i_vtk_file *file, const char *name,
                                packing_i_vtk_kind kind, size_t tuples)
{
  packing_i_vtk_array *a = &file->arrays[file->count++];
  memset(a, 0, sizeof *a);
  a->name = name;
  a->kind = kind;
  a->tuples = tuples;
  a->components = 1;
  return a;
}

static void add_columns(packing_i_vtk_file *file, const char *name,
                        packing_i_vtk_kind kind, size_t tuples, unsigned components,
                        const packing_column *const *columns)
{
  packing_i_vtk_array *a = add(file, name, kind, tuples);
  a->components = components;
  for (unsigned k = 0; k < components; k++)
    a->columns[k] = *columns[k];
}

void packing_i_vtk_add_cells(packing_i_vtk_file *file, const char *name,
                             packing_i_vtk_kind kind, packing_i_vtk_cells cells)
{
  const size_t ends = kind == PACKING_I_VTK_CONNECTIVITY ? 2 : 1;
  add(file, name, kind, cells.vertices + ends * cells.bond_count)->cells = cells;
}

static void lay_out_points(packing_i_vtk_file *f, const packing_view *v)
{
  const packing_column *const centre[] = {&v->x, &v->y, &v->z};
  const packing_column *const velocity[] = {&v->vx, &v->vy, &v->vz};
  const packing_column *const spin[] = {&v->wx, &v->wy, &v->wz};
  const packing_column *const orientation[] = {&v->qw, &v->qx, &v->qy, &v->qz};
  const packing_column *const r = &v->r, *const id = &v->id, *const type = &v->type,
                              *const component = &v->component;
  const size_t n = v->count;
  add_columns(f, "radius", PACKING_I_VTK_FLOAT64, n, 1, &r);
  if (v->id.data != NULL)
    add_columns(f, "id", PACKING_I_VTK_INT64, n, 1, &id);
  if (v->type.data != NULL)
    add_columns(f, "type", PACKING_I_VTK_INT32, n, 1, &type);
  if (v->component.data != NULL)
    add_columns(f, "component", PACKING_I_VTK_INT32, n, 1, &component);
  if (packing_i_view_has_velocity(v))
    add_columns(f, "velocity", PACKING_I_VTK_FLOAT64, n, 3, velocity);
  if (packing_i_view_has_spin(v))
    add_columns(f, "spin", PACKING_I_VTK_FLOAT64, n, 3, spin);
  if (packing_i_view_has_orientation(v))
    add_columns(f, "orientation", PACKING_I_VTK_FLOAT64, n, 4, orientation);
  f->points_at = f->count;
  add_columns(f, "Points", PACKING_I_VTK_FLOAT64, n, 3, centre);
}

static packing_status measure(packing_i_vtk_file *f, packing_i_deflater *deflater)
{
  for (size_t a = 0; a < f->count; a++) {
    const packing_i_vtk_array *array = &f->arrays[a];
    if (deflater != NULL)
      PACKING_I_TRY(deflater->measure(deflater, array, &f->bytes[a]));
    else
      f->bytes[a] = sizeof(uint64_t) + array->tuples * packing_i_vtk_tuple_size(array);
  }
  return PACKING_OK;
}

static const char *type_of(const packing_i_vtk_array *a)
{
  switch (a->kind) {
  case PACKING_I_VTK_FLOAT64:
    return "Float64";
  case PACKING_I_VTK_INT32:
  case PACKING_I_VTK_BOND_TYPES:
    return "Int32";
  case PACKING_I_VTK_CELL_TYPES:
    return "UInt8";
  default:
    return "Int64";
  }
}

static void put_array(packing_i_writer *w, const packing_i_vtk_file *f, size_t which)
{
  const packing_i_vtk_array *a = &f->arrays[which];
  uint64_t offset = 0;
  for (size_t i = 0; i < which; i++)
    offset += f->bytes[i];
  packing_i_put_text(w, "<DataArray type=\"");
  packing_i_put_text(w, type_of(a));
  packing_i_put_text(w, "\" Name=\"");
  packing_i_put_text(w, a->name);
  packing_i_put_text(w, "\" NumberOfComponents=\"");
  packing_i_put_int(w, (int64_t)a->components);
  packing_i_put_text(w, "\" format=\"appended\" offset=\"");
  packing_i_put_int(w, (int64_t)offset);
  packing_i_put_text(w, "\"/>\n");
}

void packing_i_vtk_put_arrays(packing_i_writer *w, const packing_i_vtk_file *file,
                              const char *open, size_t begin, size_t end,
                              const char *close)
{
  packing_i_put_text(w, open);
  for (size_t a = begin; a < end; a++)
    put_array(w, file, a);
  packing_i_put_text(w, close);
}

static int is_little_endian(void)
{
  const uint16_t one = 1;
  unsigned char first;
  memcpy(&first, &one, 1);
  return first == 1;
}

static void put_opening(packing_i_writer *w, const packing_i_vtk_dialect *dialect,
                        packing_i_vtk_cells cells, int compressed)
{
  packing_i_put_text(w, "<?xml version=\"1.0\"?>\n<VTKFile type=\"");
  packing_i_put_text(w, dialect->element);
  packing_i_put_text(w, "\" version=\"1.0\" byte_order=\"");
  packing_i_put_text(w, is_little_endian() ? "LittleEndian" : "BigEndian");
  packing_i_put_text(w, "\" header_type=\"UInt64\"");
  packing_i_put_text(w, compressed ? " compressor=\"vtkZLibDataCompressor\"" : "");
  packing_i_put_text(w, ">\n<");
  packing_i_put_text(w, dialect->element);
  packing_i_put_text(w, ">\n<Piece NumberOfPoints=\"");
  packing_i_put_int(w, (int64_t)cells.vertices);
  packing_i_put_char(w, '"');
  dialect->put_counts(w, cells);
  packing_i_put_text(w, ">\n");
}

static void put_xml(packing_i_writer *w, const packing_i_vtk_dialect *dialect,
                    const packing_i_vtk_file *f, packing_i_vtk_cells cells,
                    int compressed)
{
  put_opening(w, dialect, cells, compressed);
  packing_i_vtk_put_arrays(w, f, "<PointData Scalars=\"radius\">\n", 0, f->points_at,
                           "</PointData>\n");
  packing_i_vtk_put_arrays(w, f, "<Points>\n", f->points_at, f->points_at + 1,
                           "</Points>\n");
  dialect->put_cells(w, f);
  packing_i_put_text(w, "</Piece>\n</");
  packing_i_put_text(w, dialect->element);
  packing_i_put_text(w, ">\n<AppendedData encoding=\"raw\">\n_");
}

static void put_raw(packing_i_writer *w, const packing_i_vtk_array *a)
{
  const size_t size = packing_i_vtk_tuple_size(a);
  const size_t most = 2048; /* tuples of at most 32 bytes: 64 KiB */
  const uint64_t bytes = a->tuples * size;
  packing_i_put_bytes(w, &bytes, sizeof bytes);
  for (size_t i = 0; i < a->tuples && w->status == PACKING_OK; i += most) {
    const size_t n = a->tuples - i < most ? a->tuples - i : most;
    unsigned char block[65536];
    packing_i_vtk_gather(a, i, n, block);
    packing_i_put_bytes(w, block, n * size);
  }
}

static packing_status put_data(packing_i_writer *w, const packing_i_vtk_file *f,
                               packing_i_deflater *deflater)
{
  for (size_t a = 0; a < f->count; a++)
    if (deflater == NULL)
      put_raw(w, &f->arrays[a]);
    else
      PACKING_I_TRY(deflater->write(deflater, &f->arrays[a], w));
  packing_i_put_text(w, "\n</AppendedData>\n</VTKFile>\n");
  return PACKING_OK;
}

static packing_status write_file(packing_context *context,
                                 const packing_i_vtk_dialect *dialect,
                                 const packing_view *view, packing_i_vtk_cells cells,
                                 packing_i_deflater *deflater,
                                 const packing_stream *stream)
{
  packing_i_vtk_file file = {.count = 0};
  packing_i_writer w;
  lay_out_points(&file, view);
  dialect->lay_out(&file, cells);
  PACKING_I_TRY(measure(&file, deflater));
  PACKING_I_TRY(packing_i_writer_open(&w, context, dialect->name, stream));
  put_xml(&w, dialect, &file, cells, deflater != NULL);
  const packing_status compressed = put_data(&w, &file, deflater);
  const packing_status written = packing_i_writer_end(&w);
  return compressed != PACKING_OK ? compressed : written;
}

packing_status packing_i_vtk_write(packing_context *context,
                                   const packing_i_vtk_dialect *dialect, int compression,
                                   const packing_view *view, const packing_bond *bonds,
                                   size_t bond_count, const packing_stream *stream)
{
  const packing_i_vtk_cells cells = {view->count, bonds, bond_count};
  packing_i_deflater *deflater = NULL;
  if (compression < 0 || compression > 9)
    return packing_i_fail(context, PACKING_ERR_INVALID, "compression", PACKING_NO_INDEX,
                          "%d is not in 0 .. 9", compression);
  if (compression > 0)
    PACKING_I_TRY(packing_i_deflater_create(context, compression, PACKING_I_VTK_ARRAYS,
                                            view->count + 2 * bond_count, &deflater));
  const packing_status status =
      write_file(context, dialect, view, cells, deflater, stream);
  if (deflater != NULL)
    deflater->destroy(deflater);
  return status;
}
