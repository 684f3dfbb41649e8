/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK XML PolyData: points, one vertex each, point data. Arrays follow the XML as raw bytes in
 * the machine's order, 64-bit sizes before each; or as zlib blocks. Read back with VTK 9.1.
 * 48 bytes a particle and what the optional columns take; linear, in constant memory. */
#include "vtp_internal.h"
#include "view.h"

const packing_i_format packing_i_format_vtp = {
    "vtp", ".vtp", "VTK XML PolyData 1.0, appended raw data; VTK file formats, vtk.org",
    "centre, radius, id, type, component, velocity, spin, orientation"};

/* Points, connectivity, offsets, and six of point data. */
enum { MOST_ARRAYS = 10 };

typedef struct layout {
  packing_i_vtp_array arrays[MOST_ARRAYS];
  uint64_t bytes[MOST_ARRAYS]; /* in the file, header included */
  size_t count, point_data;    /* point data first, then points, connectivity, offsets */
} layout;

void packing_vtp_def_fill(packing_vtp_def *def, size_t size)
{
  packing_vtp_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

size_t packing_i_vtp_tuple_size(const packing_i_vtp_array *array)
{
  return (size_t)array->components * (array->kind == PACKING_I_VTP_INT32 ? 4U : 8U);
}

static void gather_doubles(const packing_i_vtp_array *a, size_t first, size_t count,
                           double *out)
{
  for (unsigned k = 0; k < a->components; k++)
    for (size_t i = 0; i < count; i++)
      out[i * a->components + k] = packing_i_view_number(&a->columns[k], first + i);
}

void packing_i_vtp_gather(const packing_i_vtp_array *a, size_t first, size_t count,
                          void *out)
{
  const packing_column *c = &a->columns[0];
  const size_t size = packing_i_vtp_tuple_size(a);
  if (a->kind == PACKING_I_VTP_FLOAT64) {
    gather_doubles(a, first, count, out);
  } else if (a->kind == PACKING_I_VTP_INDEX) {
    int64_t *index = out;
    for (size_t i = 0; i < count; i++)
      index[i] = a->first + (int64_t)(first + i);
  } else {
    for (size_t i = 0; i < count; i++)
      memcpy((char *)out + i * size, (const char *)c->data + (first + i) * c->stride,
             size);
  }
}

static void add(layout *l, const char *name, packing_i_vtp_kind kind, size_t tuples,
                unsigned components, const packing_column *const *columns)
{
  packing_i_vtp_array *a = &l->arrays[l->count++];
  memset(a, 0, sizeof *a);
  a->name = name;
  a->kind = kind;
  a->tuples = tuples;
  a->components = components;
  for (unsigned k = 0; columns != NULL && k < components; k++)
    a->columns[k] = *columns[k];
}

static void lay_out(layout *l, const packing_view *v)
{
  const packing_column *const centre[] = {&v->x, &v->y, &v->z};
  const packing_column *const velocity[] = {&v->vx, &v->vy, &v->vz};
  const packing_column *const spin[] = {&v->wx, &v->wy, &v->wz};
  const packing_column *const orientation[] = {&v->qw, &v->qx, &v->qy, &v->qz};
  const packing_column *const r = &v->r, *const id = &v->id, *const type = &v->type,
                              *const component = &v->component;
  const size_t n = v->count;
  l->count = 0;
  add(l, "radius", PACKING_I_VTP_FLOAT64, n, 1, &r);
  if (v->id.data != NULL)
    add(l, "id", PACKING_I_VTP_INT64, n, 1, &id);
  if (v->type.data != NULL)
    add(l, "type", PACKING_I_VTP_INT32, n, 1, &type);
  if (v->component.data != NULL)
    add(l, "component", PACKING_I_VTP_INT32, n, 1, &component);
  if (packing_i_view_has_velocity(v))
    add(l, "velocity", PACKING_I_VTP_FLOAT64, n, 3, velocity);
  if (packing_i_view_has_spin(v))
    add(l, "spin", PACKING_I_VTP_FLOAT64, n, 3, spin);
  if (packing_i_view_has_orientation(v))
    add(l, "orientation", PACKING_I_VTP_FLOAT64, n, 4, orientation);
  l->point_data = l->count;
  add(l, "Points", PACKING_I_VTP_FLOAT64, n, 3, centre);
  add(l, "connectivity", PACKING_I_VTP_INDEX, n, 1, NULL);
  add(l, "offsets", PACKING_I_VTP_INDEX, n, 1, NULL);
  l->arrays[l->count - 1].first = 1;
}

static packing_status measure(layout *l, packing_i_deflater *deflater)
{
  for (size_t a = 0; a < l->count; a++) {
    const packing_i_vtp_array *array = &l->arrays[a];
    if (deflater != NULL)
      PACKING_I_TRY(deflater->measure(deflater, array, &l->bytes[a]));
    else
      l->bytes[a] = sizeof(uint64_t) + array->tuples * packing_i_vtp_tuple_size(array);
  }
  return PACKING_OK;
}

static void put_array(packing_i_writer *w, const layout *l, size_t which)
{
  const packing_i_vtp_array *a = &l->arrays[which];
  uint64_t offset = 0;
  for (size_t i = 0; i < which; i++)
    offset += l->bytes[i];
  packing_i_put_text(w, "<DataArray type=\"");
  packing_i_put_text(w, a->kind == PACKING_I_VTP_FLOAT64 ? "Float64"
                        : a->kind == PACKING_I_VTP_INT32 ? "Int32"
                                                         : "Int64");
  packing_i_put_text(w, "\" Name=\"");
  packing_i_put_text(w, a->name);
  packing_i_put_text(w, "\" NumberOfComponents=\"");
  packing_i_put_int(w, (int64_t)a->components);
  packing_i_put_text(w, "\" format=\"appended\" offset=\"");
  packing_i_put_int(w, (int64_t)offset);
  packing_i_put_text(w, "\"/>\n");
}

static int is_little_endian(void)
{
  const uint16_t one = 1;
  unsigned char first;
  memcpy(&first, &one, 1);
  return first == 1;
}

static void put_opening(packing_i_writer *w, size_t points, int compressed)
{
  packing_i_put_text(w, "<?xml version=\"1.0\"?>\n"
                        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"");
  packing_i_put_text(w, is_little_endian() ? "LittleEndian" : "BigEndian");
  packing_i_put_text(w, "\" header_type=\"UInt64\"");
  packing_i_put_text(w, compressed ? " compressor=\"vtkZLibDataCompressor\"" : "");
  packing_i_put_text(w, ">\n<PolyData>\n<Piece NumberOfPoints=\"");
  packing_i_put_int(w, (int64_t)points);
  packing_i_put_text(w, "\" NumberOfVerts=\"");
  packing_i_put_int(w, (int64_t)points);
  packing_i_put_text(w, "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                        "NumberOfPolys=\"0\">\n<PointData Scalars=\"radius\">\n");
}

static void put_xml(packing_i_writer *w, const layout *l, size_t points, int compressed)
{
  put_opening(w, points, compressed);
  for (size_t a = 0; a < l->point_data; a++)
    put_array(w, l, a);
  packing_i_put_text(w, "</PointData>\n<Points>\n");
  put_array(w, l, l->point_data);
  packing_i_put_text(w, "</Points>\n<Verts>\n");
  put_array(w, l, l->point_data + 1);
  put_array(w, l, l->point_data + 2);
  packing_i_put_text(w, "</Verts>\n</Piece>\n</PolyData>\n<AppendedData "
                        "encoding=\"raw\">\n_");
}

static void put_raw(packing_i_writer *w, const packing_i_vtp_array *a)
{
  const size_t size = packing_i_vtp_tuple_size(a);
  const size_t most = 2048; /* tuples of at most 32 bytes: 64 KiB */
  const uint64_t bytes = a->tuples * size;
  packing_i_put_bytes(w, &bytes, sizeof bytes);
  for (size_t i = 0; i < a->tuples && w->status == PACKING_OK; i += most) {
    const size_t n = a->tuples - i < most ? a->tuples - i : most;
    unsigned char block[65536];
    packing_i_vtp_gather(a, i, n, block);
    packing_i_put_bytes(w, block, n * size);
  }
}

static packing_status put_data(packing_i_writer *w, const layout *l,
                               packing_i_deflater *deflater)
{
  for (size_t a = 0; a < l->count; a++)
    if (deflater == NULL)
      put_raw(w, &l->arrays[a]);
    else
      PACKING_I_TRY(deflater->write(deflater, &l->arrays[a], w));
  packing_i_put_text(w, "\n</AppendedData>\n</VTKFile>\n");
  return PACKING_OK;
}

static packing_status write_vtp(packing_context *context, const packing_view *v,
                                packing_i_deflater *deflater,
                                const packing_stream *stream)
{
  layout l;
  packing_i_writer w;
  lay_out(&l, v);
  PACKING_I_TRY(measure(&l, deflater));
  PACKING_I_TRY(packing_i_writer_begin(&w, context, &packing_i_format_vtp, stream));
  put_xml(&w, &l, v->count, deflater != NULL);
  const packing_status compressed = put_data(&w, &l, deflater);
  const packing_status written = packing_i_writer_end(&w);
  return compressed != PACKING_OK ? compressed : written;
}

packing_status packing_write_vtp(packing_context *context, const packing_vtp_def *def,
                                 const packing_view *view, const packing_stream *stream)
{
  packing_vtp_def d;
  packing_view v;
  packing_i_deflater *deflater = NULL;
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_vtp, compression, def, &d));
  if (d.compression < 0 || d.compression > 9)
    return packing_i_fail(context, PACKING_ERR_INVALID, "compression", PACKING_NO_INDEX,
                          "%d is not in 0 .. 9", d.compression);
  PACKING_I_TRY(packing_i_io_view(context, view, 0, &v));
  if (d.compression > 0)
    PACKING_I_TRY(packing_i_deflater_create(context, d.compression, MOST_ARRAYS, v.count,
                                            &deflater));
  const packing_status status = write_vtp(context, &v, deflater, stream);
  if (deflater != NULL)
    deflater->destroy(deflater);
  return status;
}
