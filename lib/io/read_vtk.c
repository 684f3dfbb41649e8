/* SPDX-License-Identifier: GPL-3.0-or-later */
/* VTK XML PolyData and UnstructuredGrid (vtk.org, file formats; tried with the writers of VTK
 * 9.1): the points of all pieces, with point data by name. The file is read whole, since arrays
 * stand in any order behind what tells of them: its size, and what is inflated, beside the store.
 * Linear in the bytes. */
#include "read_vtk_internal.h"

typedef enum role {
  POINTS,
  RADIUS,
  DIAMETER,
  ID,
  TYPE,
  COMPONENT,
  VELOCITY,
  SPIN,
  ORIENTATION,
  ROLES
} role;

static const struct {
  const char *names[2]; /* of the point array; the second is YADE's */
  uint64_t components;
  unsigned column;
} roles[ROLES] = {
    [POINTS] = {{NULL, NULL}, 3, 0},
    [RADIUS] = {{"radius", "radii"}, 1, 0},
    [DIAMETER] = {{"diameter", NULL}, 1, 0},
    [ID] = {{"id", NULL}, 1, PACKING_COLUMN_ID},
    [TYPE] = {{"type", NULL}, 1, PACKING_COLUMN_TYPE},
    [COMPONENT] = {{"component", NULL}, 1, PACKING_COLUMN_COMPONENT},
    [VELOCITY] = {{"velocity", "linVelVec"}, 3, PACKING_COLUMN_VELOCITY},
    [SPIN] = {{"spin", "angVelVec"}, 3, PACKING_COLUMN_SPIN},
    [ORIENTATION] = {{"orientation", NULL}, 4, PACKING_COLUMN_ORIENTATION},
};

/* One Piece. */
typedef struct piece {
  uint64_t points;
  packing_i_read_vtk_array arrays[ROLES];
} piece;

typedef struct vtk {
  packing_i_read_vtk_file file;
  packing_i_xml xml;
  int began; /* the root was met */
  unsigned char *data;
  size_t size, capacity;
  piece *pieces;
  size_t piece_count, piece_capacity;
  packing_i_read_vtk_values values[ROLES]; /* of one piece */
  size_t appended[ROLES];                  /* bytes that all pieces so far took */
} vtk;

static packing_i_read *reading(const vtk *v)
{
  return v->file.read;
}

/* Room for more, and a zero byte behind. */
static packing_status grow(vtk *v)
{
  packing_context *context = reading(v)->context;
  const size_t capacity = v->capacity + v->capacity / 2 + (1 << 16);
  unsigned char *grown =
      packing_i_regrow(packing_i_allocator(context), v->data, v->size, capacity + 1, 1);
  if (grown == NULL)
    return packing_i_nomem(context);
  v->data = grown;
  v->capacity = capacity;
  return PACKING_OK;
}

static packing_status slurp(vtk *v)
{
  const packing_stream *stream = reading(v)->stream;
  size_t count = 1;
  while (count > 0) {
    if (v->size == v->capacity)
      PACKING_I_TRY(grow(v));
    const size_t room = v->capacity - v->size;
    const packing_status status =
        stream->read(stream->user, v->data + v->size, room, &count);
    if (status != PACKING_OK)
      return packing_i_stream_failed(reading(v)->context, stream,
                                     &reading(v)->reader->format, status);
    if (count > room)
      return packing_i_stream_overran(reading(v)->context);
    v->size += count;
  }
  v->data[v->size] = '\0';
  v->file.data = v->data;
  v->file.size = v->size;
  v->xml.first = v->xml.at = (const char *)v->data;
  v->xml.end = v->xml.first + v->size;
  v->xml.read = reading(v);
  return PACKING_OK;
}

/* An attribute that must be one of `choices`; which, or `absent` where there is none. */
static packing_status choose(const vtk *v, const char *name, const char *const *choices,
                             int absent, int *which)
{
  char quote[PACKING_I_QUOTE_SIZE];
  const packing_i_words text = packing_i_xml_attribute(&v->xml, name);
  *which = absent;
  if (text.at == NULL && absent >= 0)
    return PACKING_OK;
  for (int k = 0; text.at != NULL && choices[k] != NULL; k++)
    if (packing_i_word_is(text, choices[k])) {
      *which = k;
      return PACKING_OK;
    }
  reading(v)->byte = (uint64_t)(v->xml.attributes.at - v->xml.first);
  if (text.at == NULL)
    return packing_i_read_fail(reading(v), PACKING_ERR_FORMAT, "no %s", name);
  return packing_i_read_fail(reading(v), PACKING_ERR_FORMAT, "%s: %s is not read", name,
                             packing_i_quote(text.at, text.end, quote));
}

static packing_status start_file(vtk *v)
{
  static const char *const types[] = {"PolyData", "UnstructuredGrid", NULL};
  static const char *const orders[] = {"LittleEndian", "BigEndian", NULL};
  static const char *const headers[] = {"UInt32", "UInt64", NULL};
  static const char *const compressors[] = {"", "vtkZLibDataCompressor", NULL};
  int type;
  PACKING_I_TRY(choose(v, "type", types, -1, &type));
  PACKING_I_TRY(choose(v, "byte_order", orders, 0, &v->file.big_endian));
  PACKING_I_TRY(choose(v, "header_type", headers, 0, &v->file.wide_header));
  return choose(v, "compressor", compressors, 0, &v->file.compressed);
}

static packing_status start_piece(vtk *v)
{
  packing_context *context = reading(v)->context;
  piece fresh = {0};
  PACKING_I_TRY(packing_i_xml_count(&v->xml, "NumberOfPoints", 0, &fresh.points));
  if (v->piece_count == v->piece_capacity) {
    const size_t capacity = 2 * v->piece_capacity + 1;
    piece *grown = packing_i_regrow(packing_i_allocator(context), v->pieces,
                                    v->piece_count, capacity, sizeof *grown);
    if (grown == NULL)
      return packing_i_nomem(context);
    v->pieces = grown;
    v->piece_capacity = capacity;
  }
  v->pieces[v->piece_count++] = fresh;
  return PACKING_OK;
}

/* Whether point data `name` is what the caller calls `asked`, or one of the usual names. */
static int is_called(packing_i_words name, const char *asked, const char *const usual[2])
{
  if (asked != NULL)
    return packing_i_word_is(name, asked);
  for (int k = 0; k < 2; k++)
    if (usual[k] != NULL && packing_i_word_is(name, usual[k]))
      return 1;
  return 0;
}

/* What point data of this name are; ROLES: nothing of ours. */
static role role_of(const vtk *v, packing_i_words name)
{
  const packing_read_def *d = &reading(v)->def;
  role r = RADIUS;
  for (; r < ROLES; r++) {
    if ((r == RADIUS && d->diameter_name != NULL) ||
        (r == DIAMETER && d->radius_name != NULL))
      continue;
    if (is_called(name,
                  r == RADIUS     ? d->radius_name
                  : r == DIAMETER ? d->diameter_name
                                  : NULL,
                  roles[r].names))
      break;
  }
  return r;
}

static packing_status describe(const vtk *v, packing_i_read_vtk_array *a)
{
  static const char *const kinds[] = {"Int8",    "UInt8",   "Int16", "UInt16",
                                      "Int32",   "UInt32",  "Int64", "UInt64",
                                      "Float32", "Float64", NULL};
  static const char *const forms[] = {"ascii", "binary", "appended", NULL};
  int kind, form;
  a->tag = v->xml.attributes.at;
  PACKING_I_TRY(choose(v, "type", kinds, -1, &kind));
  PACKING_I_TRY(choose(v, "format", forms, PACKING_I_READ_VTK_ASCII, &form));
  PACKING_I_TRY(packing_i_xml_count(&v->xml, "NumberOfComponents", 1, &a->components));
  PACKING_I_TRY(packing_i_xml_count(&v->xml, "offset", 0, &a->offset));
  a->kind = (packing_i_read_vtk_kind)kind;
  a->form = (packing_i_read_vtk_form)form;
  a->content.at = a->content.end = v->xml.at;
  if (v->xml.empty)
    return PACKING_OK;
  a->content.end = memchr(v->xml.at, '<', (size_t)(v->xml.end - v->xml.at));
  return a->content.end != NULL
             ? PACKING_OK
             : packing_i_read_vtk_fail(&v->file, a->tag, PACKING_ERR_FORMAT,
                                       "an array without an end");
}

static packing_status start_array(vtk *v, role r)
{
  packing_i_read_vtk_array found = {0};
  packing_i_read_vtk_array *a = &v->pieces[v->piece_count - 1].arrays[r];
  PACKING_I_TRY(describe(v, &found));
  if (a->tag != NULL)
    return packing_i_read_vtk_fail(&v->file, found.tag, PACKING_ERR_FORMAT,
                                   "a second array for the same");
  if (found.components != roles[r].components) {
    reading(v)->byte = (uint64_t)(found.tag - v->xml.first);
    return packing_i_read_fail(
        reading(v), PACKING_ERR_FORMAT, "%s: %llu components, not %llu",
        r == POINTS ? "Points" : roles[r].names[0], (unsigned long long)found.components,
        (unsigned long long)roles[r].components);
  }
  *a = found;
  return PACKING_OK;
}

/* The bytes behind the first _. */
static packing_status find_appended(vtk *v)
{
  static const char *const encodings[] = {"raw", "base64", NULL};
  const char *p = v->xml.at;
  PACKING_I_TRY(choose(v, "encoding", encodings, -1, &v->file.appended_base64));
  while (*p == ' ' || *p == '\t' || *p == '\n' || *p == '\r')
    p++;
  if (*p != '_')
    return packing_i_read_vtk_fail(&v->file, p, PACKING_ERR_FORMAT,
                                   "appended data do not begin with _");
  p++;
  const char *end = v->xml.end;
  if (v->file.appended_base64) {
    end = memchr(p, '<', (size_t)(end - p));
    if (end == NULL)
      return packing_i_read_vtk_fail(&v->file, p, PACKING_ERR_FORMAT,
                                     "appended data without an end");
  }
  v->file.appended = (const unsigned char *)p;
  v->file.appended_size = (size_t)(end - p);
  return PACKING_OK;
}

/* Acts on a start tag; *ended: what follows is no XML. */
static packing_status start_element(vtk *v, int *ended)
{
  const packing_i_xml *x = &v->xml;
  if (x->depth == 1) {
    const int first = !v->began;
    v->began = 1;
    if (first && packing_i_xml_is(x, 0, "VTKFile"))
      return start_file(v);
    return packing_i_read_vtk_fail(&v->file, x->attributes.at, PACKING_ERR_FORMAT,
                                   first ? "no VTKFile" : "something else follows");
  }
  if (x->depth == 2 && packing_i_xml_is(x, 0, "AppendedData")) {
    *ended = 1;
    return find_appended(v);
  }
  if (x->depth == 3 && packing_i_xml_is(x, 0, "Piece"))
    return start_piece(v);
  if (x->depth != 5 || !packing_i_xml_is(x, 2, "Piece") ||
      !packing_i_xml_is(x, 0, "DataArray"))
    return PACKING_OK;
  if (packing_i_xml_is(x, 1, "Points"))
    return start_array(v, POINTS);
  const packing_i_words name = packing_i_xml_attribute(x, "Name");
  const role r =
      packing_i_xml_is(x, 1, "PointData") && name.at != NULL ? role_of(v, name) : ROLES;
  return r == ROLES ? PACKING_OK : start_array(v, r);
}

static packing_status walk(vtk *v)
{
  packing_i_xml_event event = PACKING_I_XML_START;
  int ended = 0;
  while (!ended) {
    PACKING_I_TRY(packing_i_xml_next(&v->xml, &event));
    if (event == PACKING_I_XML_START)
      PACKING_I_TRY(start_element(v, &ended));
    ended |= event == PACKING_I_XML_LAST;
  }
  return v->began ? PACKING_OK
                  : packing_i_read_vtk_fail(&v->file, v->data, PACKING_ERR_FORMAT,
                                            "no VTKFile");
}

/* The columns of a piece; all that are not empty must have the same. */
static packing_status check_piece(const vtk *v, const piece *p, const piece *first,
                                  unsigned *columns)
{
  const void *place = p->arrays[POINTS].tag;
  if (place == NULL)
    return packing_i_read_vtk_fail(&v->file, v->data + v->size, PACKING_ERR_FORMAT,
                                   "a piece without Points");
  if (p->arrays[RADIUS].tag == NULL && p->arrays[DIAMETER].tag == NULL)
    return packing_i_read_vtk_fail(&v->file, place, PACKING_ERR_FORMAT,
                                   "no point data of radii or diameters");
  *columns = 0;
  for (role r = POINTS; r < ROLES; r++) {
    if ((p->arrays[r].tag == NULL) != (first->arrays[r].tag == NULL))
      return packing_i_read_vtk_fail(&v->file, place, PACKING_ERR_FORMAT,
                                     "a piece with other point data than the first");
    *columns |= p->arrays[r].tag == NULL ? 0 : roles[r].column;
  }
  return PACKING_OK;
}

static void take_vector(const vtk *v, role r, size_t i, double *out)
{
  const size_t components = (size_t)roles[r].components;
  if (v->values[r].bytes == NULL)
    return;
  for (size_t k = 0; k < components; k++)
    out[k] = packing_i_read_vtk_double(&v->values[r], i * components + k);
}

/* A whole number between the two, where there is such an array. */
static packing_status take_whole(const vtk *v, const piece *p, role r, size_t i,
                                 int64_t least, int64_t most, int64_t *out)
{
  if (v->values[r].bytes == NULL)
    return PACKING_OK;
  if (packing_i_read_vtk_int(&v->values[r], i, out) && *out >= least && *out <= most)
    return PACKING_OK;
  reading(v)->byte = (uint64_t)(p->arrays[r].tag - v->xml.first);
  return packing_i_read_fail(reading(v), PACKING_ERR_FORMAT,
                             "%s: entry %zu is no whole number in range",
                             roles[r].names[0], i);
}

static packing_status take_point(const vtk *v, const piece *p, size_t i)
{
  packing_i_row *row = packing_i_read_row(reading(v));
  int64_t type = 1, component = 0;
  double centre[3] = {0, 0, 0};
  take_vector(v, POINTS, i, centre);
  row->x = centre[0];
  row->y = centre[1];
  row->z = centre[2];
  if (v->values[RADIUS].bytes != NULL)
    row->r = packing_i_read_vtk_double(&v->values[RADIUS], i);
  else
    row->r = packing_i_read_vtk_double(&v->values[DIAMETER], i) / 2;
  take_vector(v, VELOCITY, i, row->v);
  take_vector(v, SPIN, i, row->w);
  take_vector(v, ORIENTATION, i, row->q);
  PACKING_I_TRY(take_whole(v, p, ID, i, INT64_MIN, INT64_MAX, &row->id));
  PACKING_I_TRY(take_whole(v, p, TYPE, i, INT32_MIN, INT32_MAX, &type));
  PACKING_I_TRY(take_whole(v, p, COMPONENT, i, INT32_MIN, INT32_MAX, &component));
  row->type = (int32_t)type;
  row->component = (int32_t)component;
  reading(v)->byte = (uint64_t)(p->arrays[POINTS].tag - v->xml.first);
  return packing_i_read_take(reading(v));
}

/* Pieces that told of the same bytes would make of a small file a pack of any size. */
static packing_status take_array(vtk *v, const piece *p, role r)
{
  const packing_i_read_vtk_array *array = &p->arrays[r];
  PACKING_I_TRY(packing_i_read_vtk_decode(&v->file, array, p->points, &v->values[r]));
  v->appended[r] += v->values[r].appended;
  return v->appended[r] <= v->file.appended_size
             ? PACKING_OK
             : packing_i_read_vtk_fail(&v->file, array->tag, PACKING_ERR_FORMAT,
                                       "pieces share their appended data");
}

static packing_status take_points(vtk *v, const piece *p)
{
  packing_status status = PACKING_OK;
  for (role r = POINTS; r < ROLES && status == PACKING_OK; r++)
    if (p->arrays[r].tag != NULL)
      status = take_array(v, p, r);
  for (uint64_t i = 0; i < p->points && status == PACKING_OK; i++)
    status = take_point(v, p, (size_t)i);
  for (role r = POINTS; r < ROLES; r++) {
    packing_i_read_vtk_release(&v->file, &v->values[r]);
    v->values[r].bytes = NULL;
  }
  return status;
}

static packing_status take_pieces(vtk *v)
{
  const piece *first = NULL;
  unsigned columns = 0;
  for (size_t k = 0; k < v->piece_count; k++) {
    const piece *p = &v->pieces[k];
    if (p->points == 0)
      continue;
    first = first == NULL ? p : first;
    PACKING_I_TRY(check_piece(v, p, first, &columns));
    PACKING_I_TRY(packing_i_read_columns(reading(v), columns));
    PACKING_I_TRY(take_points(v, p));
  }
  return packing_i_read_flush(reading(v));
}

static packing_status read_vtk(packing_i_read *read)
{
  const packing_allocator *allocator = packing_i_allocator(read->context);
  vtk v;
  memset(&v, 0, sizeof v);
  v.file.read = read;
  packing_status status = slurp(&v);
  if (status == PACKING_OK)
    status = walk(&v);
  if (status == PACKING_OK)
    status = take_pieces(&v);
  packing_i_free(allocator, v.pieces);
  packing_i_free(allocator, v.data);
  return status;
}

#define HOLDS                                                                            \
  "centre, radius or diameter, id, type, component, velocity, spin, orientation"

const packing_i_reader packing_i_reader_vtp = {
    {"vtp", ".vtp", "VTK XML PolyData; vtk.org, file formats", HOLDS},
    PACKING_I_READS_BYTES,
    read_vtk};

const packing_i_reader packing_i_reader_vtu = {
    {"vtu", ".vtu", "VTK XML UnstructuredGrid; vtk.org, file formats", HOLDS},
    PACKING_I_READS_BYTES,
    read_vtk};
