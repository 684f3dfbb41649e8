/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The values of a DataArray: text; or a header with the bytes of the array, then those; or
 * compressed (read_vtk_inflate.c). In base64 header and data may be runs of their own, each
 * padded, so that padding ends a group and no more. What a header claims is held against the
 * bytes that are there before anything is allocated. Bytes that stand in the file as they are,
 * stay there. */
#include "read_vtk_internal.h"
#include <math.h>

packing_status packing_i_read_vtk_fail(const packing_i_read_vtk_file *file,
                                       const void *at, packing_status status,
                                       const char *what)
{
  file->read->byte = (uint64_t)((const unsigned char *)at - file->data);
  return packing_i_read_fail(file->read, status, "%s", what);
}

static size_t kind_size(packing_i_read_vtk_kind kind)
{
  static const unsigned char sizes[PACKING_I_READ_VTK_KINDS] = {1, 1, 2, 2, 4,
                                                                4, 8, 8, 4, 8};
  return sizes[kind];
}

static int is_space(char c)
{
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/* The value of a letter of base64; 64: padding; 65: none. */
static unsigned letter(unsigned char c)
{
  if (c >= 'A' && c <= 'Z')
    return c - (unsigned)'A';
  if (c >= 'a' && c <= 'z')
    return c - (unsigned)'a' + 26;
  if (c >= '0' && c <= '9')
    return c - (unsigned)'0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : c == '=' ? 64 : 65;
}

/* The next four letters, as one to three bytes. */
static packing_status take_group(packing_i_read_vtk_source *s)
{
  unsigned v[4], count = 0, bits = 0;
  while (count < 4 && s->at < s->end) {
    const unsigned char c = *s->at;
    if (!is_space((char)c))
      v[count++] = letter(c);
    s->at++;
  }
  const int pads = count < 4 ? 4 : (v[3] == 64) + (v[3] == 64 && v[2] == 64);
  for (unsigned k = 0; k + (unsigned)pads < 4; k++)
    if (v[k] > 63)
      return packing_i_read_vtk_fail(s->file, s->at, PACKING_ERR_FORMAT, "no base64");
  if (pads > 2)
    return packing_i_read_vtk_fail(s->file, s->at, PACKING_ERR_FORMAT,
                                   "the array ends too early");
  for (unsigned k = 0; k < 4; k++)
    bits = bits << 6 | (v[k] & 63);
  s->group[0] = (unsigned char)(bits >> 16);
  s->group[1] = (unsigned char)(bits >> 8);
  s->group[2] = (unsigned char)bits;
  s->used = 0;
  s->held = 3 - (unsigned)pads;
  return PACKING_OK;
}

uint64_t packing_i_read_vtk_left(const packing_i_read_vtk_source *s)
{
  const uint64_t left = (uint64_t)(s->end - s->at);
  return s->base64 ? left / 4 * 3 + (s->held - s->used) : left;
}

packing_status packing_i_read_vtk_take(packing_i_read_vtk_source *s, unsigned char *out,
                                       size_t count)
{
  if (packing_i_read_vtk_left(s) < count)
    return packing_i_read_vtk_fail(s->file, s->end, PACKING_ERR_FORMAT,
                                   "the array ends too early");
  if (!s->base64) {
    if (count > 0)
      memcpy(out, s->at, count);
    s->at += count;
    return PACKING_OK;
  }
  for (size_t i = 0; i < count; i++) {
    if (s->used == s->held)
      PACKING_I_TRY(take_group(s));
    out[i] = s->group[s->used++];
  }
  return PACKING_OK;
}

/* `size` bytes as a whole number. */
static uint64_t whole(const unsigned char *bytes, size_t size, int big_endian)
{
  uint64_t bits = 0;
  for (size_t k = 0; k < size; k++)
    bits = bits << 8 | bytes[big_endian ? k : size - 1 - k];
  return bits;
}

packing_status packing_i_read_vtk_take_size(packing_i_read_vtk_source *s, uint64_t *v)
{
  unsigned char bytes[8];
  const size_t size = s->file->wide_header ? 8 : 4;
  PACKING_I_TRY(packing_i_read_vtk_take(s, bytes, size));
  *v = whole(bytes, size, s->file->big_endian);
  return PACKING_OK;
}

static packing_status find_source(const packing_i_read_vtk_file *file,
                                  const packing_i_read_vtk_array *array,
                                  packing_i_read_vtk_source *s)
{
  memset(s, 0, sizeof *s);
  s->file = file;
  if (array->form == PACKING_I_READ_VTK_BINARY) {
    s->base64 = 1;
    s->at = (const unsigned char *)array->content.at;
    s->end = (const unsigned char *)array->content.end;
    return PACKING_OK;
  }
  if (file->appended == NULL || array->offset > file->appended_size)
    return packing_i_read_vtk_fail(file, array->tag, PACKING_ERR_FORMAT,
                                   "no appended data at the offset of the array");
  s->base64 = file->appended_base64;
  s->at = file->appended + array->offset;
  s->end = file->appended + file->appended_size;
  return PACKING_OK;
}

static packing_status hold(const packing_i_read_vtk_file *file, uint64_t bytes,
                           packing_i_read_vtk_values *values)
{
  values->held =
      packing_i_alloc(packing_i_allocator(file->read->context), (size_t)bytes, 1);
  values->bytes = values->held;
  return values->held == NULL ? packing_i_nomem(file->read->context) : PACKING_OK;
}

static packing_status take_plain(packing_i_read_vtk_source *s, uint64_t bytes,
                                 packing_i_read_vtk_values *values)
{
  uint64_t claimed;
  PACKING_I_TRY(packing_i_read_vtk_take_size(s, &claimed));
  if (claimed != bytes)
    return packing_i_read_vtk_fail(
        s->file, s->at, PACKING_ERR_FORMAT,
        "the array has another length than its piece asks for");
  if (packing_i_read_vtk_left(s) < bytes)
    return packing_i_read_vtk_fail(s->file, s->end, PACKING_ERR_FORMAT,
                                   "the array ends too early");
  if (!s->base64) {
    values->bytes = s->at;
    s->at += bytes;
    return PACKING_OK;
  }
  PACKING_I_TRY(hold(s->file, bytes, values));
  return packing_i_read_vtk_take(s, values->held, (size_t)bytes);
}

static int is_real(packing_i_read_vtk_kind kind)
{
  return kind >= PACKING_I_READ_VTK_FLOAT32;
}

/* One number of a text, as the bytes of a double or of an int64_t. */
static packing_i_number take_word(const char **p, int real, unsigned char *out)
{
  double v;
  int64_t n;
  const packing_i_number found =
      real ? packing_i_parse_double(p, &v) : packing_i_parse_int(p, &n);
  if (found == PACKING_I_NUMBER_OK && real)
    memcpy(out, &v, sizeof v);
  else if (found == PACKING_I_NUMBER_OK)
    memcpy(out, &n, sizeof n);
  return found;
}

static int is_machine_big_endian(void)
{
  const uint16_t one = 1;
  unsigned char first;
  memcpy(&first, &one, 1);
  return first == 0;
}

/* A < stands behind the text, so that no number runs over its end. */
static packing_status take_text(const packing_i_read_vtk_file *file,
                                const packing_i_read_vtk_array *array, uint64_t count,
                                packing_i_read_vtk_values *values)
{
  const char *p = array->content.at, *end = array->content.end;
  const int real = is_real(array->kind);
  values->kind = real ? PACKING_I_READ_VTK_FLOAT64 : PACKING_I_READ_VTK_INT64;
  values->big_endian = is_machine_big_endian();
  if (count > (uint64_t)(end - p) / 2 + 1) /* a digit and a blank each */
    return packing_i_read_vtk_fail(file, end, PACKING_ERR_FORMAT,
                                   "the array ends too early");
  PACKING_I_TRY(hold(file, count * 8, values));
  for (uint64_t i = 0; i <= count; i++) {
    while (p < end && is_space(*p))
      p++;
    if (i == count)
      break;
    if (p == end)
      return packing_i_read_vtk_fail(file, p, PACKING_ERR_FORMAT,
                                     "the array ends too early");
    const char *word = p;
    if (take_word(&p, real, values->held + i * 8) != PACKING_I_NUMBER_OK ||
        (p < end && !is_space(*p)))
      return packing_i_read_vtk_fail(file, word, PACKING_ERR_FORMAT,
                                     "no number that fits the array");
  }
  return p == end
             ? PACKING_OK
             : packing_i_read_vtk_fail(file, p, PACKING_ERR_FORMAT,
                                       "the array is longer than its piece asks for");
}

packing_status packing_i_read_vtk_decode(const packing_i_read_vtk_file *file,
                                         const packing_i_read_vtk_array *array,
                                         uint64_t tuples,
                                         packing_i_read_vtk_values *values)
{
  packing_i_read_vtk_source source;
  const size_t size = kind_size(array->kind);
  /* a file of n bytes inflates to less than 2^11 n, and n is less than 2^52 */
  const uint64_t most = UINT64_C(1) << 62;
  memset(values, 0, sizeof *values);
  values->kind = array->kind;
  values->big_endian = file->big_endian;
  if (tuples == 0)
    return PACKING_OK;
  if (tuples > most / array->components / size)
    return packing_i_read_vtk_fail(file, array->tag, PACKING_ERR_FORMAT,
                                   "the array ends too early");
  packing_status status;
  if (array->form == PACKING_I_READ_VTK_ASCII) {
    status = take_text(file, array, tuples * array->components, values);
  } else {
    const uint64_t bytes = tuples * array->components * size;
    status = find_source(file, array, &source);
    const unsigned char *start = source.at;
    if (status == PACKING_OK)
      status = file->compressed ? packing_i_read_vtk_inflate(&source, bytes, values)
                                : take_plain(&source, bytes, values);
    if (status == PACKING_OK && array->form == PACKING_I_READ_VTK_APPENDED)
      values->appended = (size_t)(source.at - start);
  }
  if (status != PACKING_OK)
    packing_i_read_vtk_release(file, values);
  return status;
}

void packing_i_read_vtk_release(const packing_i_read_vtk_file *file,
                                packing_i_read_vtk_values *values)
{
  packing_i_free(packing_i_allocator(file->read->context), values->held);
  values->held = NULL;
}

/* Sign bits spread to 64. */
static int64_t extended(uint64_t bits, size_t size)
{
  const uint64_t sign = UINT64_C(1) << (8 * size - 1);
  return (int64_t)((bits ^ sign) - sign);
}

static double real(const packing_i_read_vtk_values *values, uint64_t bits)
{
  double v;
  float narrow;
  const uint32_t low = (uint32_t)bits;
  if (values->kind == PACKING_I_READ_VTK_FLOAT32) {
    memcpy(&narrow, &low, sizeof narrow);
    return (double)narrow;
  }
  memcpy(&v, &bits, sizeof v);
  return v;
}

static uint64_t bits_of(const packing_i_read_vtk_values *values, size_t i)
{
  const size_t size = kind_size(values->kind);
  return whole(values->bytes + i * size, size, values->big_endian);
}

static int is_unsigned(packing_i_read_vtk_kind kind)
{
  return kind % 2 == 1; /* each stands behind its signed one */
}

double packing_i_read_vtk_double(const packing_i_read_vtk_values *values, size_t i)
{
  const uint64_t bits = bits_of(values, i);
  if (is_real(values->kind))
    return real(values, bits);
  return is_unsigned(values->kind) ? (double)bits
                                   : (double)extended(bits, kind_size(values->kind));
}

int packing_i_read_vtk_int(const packing_i_read_vtk_values *values, size_t i, int64_t *v)
{
  const uint64_t bits = bits_of(values, i);
  if (is_real(values->kind)) {
    const double x = real(values, bits);
    if (!(fabs(x) <= 0x1p53 && x == floor(x)))
      return 0;
    *v = (int64_t)x;
    return 1;
  }
  *v =
      is_unsigned(values->kind) ? (int64_t)bits : extended(bits, kind_size(values->kind));
  return !is_unsigned(values->kind) || bits <= INT64_MAX;
}
