/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The .xyzd of packing-generation (V. Baranau, github.com/VasiliBaranov/packing-generation):
 * rows of four doubles, x y z and the DIAMETER, least byte first, and nothing else, so neither
 * the cell (in generation.conf) nor how far the last contraction went (packing.nfo: where the
 * theoretical porosity is not the final one, diameters are to be scaled by the cube root of
 * (1 - final) / (1 - theoretical)). Linear, in constant memory. */
#include "read_internal.h"

enum { ROW = 4 * sizeof(double), ROWS = 1024 };

/* Fills `block` as far as the stream goes. */
static packing_status read_block(packing_i_read *read, unsigned char *block, size_t *size)
{
  const packing_stream *stream = read->stream;
  size_t count = 1;
  for (*size = 0; *size < (size_t)ROWS * ROW && count > 0; *size += count) {
    const size_t room = (size_t)ROWS * ROW - *size;
    const packing_status status = stream->read(stream->user, block + *size, room, &count);
    if (status != PACKING_OK)
      return packing_i_stream_failed(read->context, stream, &read->reader->format,
                                     status);
    if (count > room)
      return packing_i_stream_overran(read->context);
  }
  return PACKING_OK;
}

static double number(const unsigned char *bytes)
{
  uint64_t bits = 0;
  double v;
  for (unsigned k = 8; k-- > 0;)
    bits = bits << 8 | bytes[k];
  memcpy(&v, &bits, sizeof v);
  return v;
}

static packing_status take_row(packing_i_read *read, const unsigned char *bytes)
{
  packing_i_row *row = packing_i_read_row(read);
  row->x = number(bytes);
  row->y = number(bytes + 8);
  row->z = number(bytes + 16);
  row->r = number(bytes + 24) / 2;
  PACKING_I_TRY(packing_i_read_take(read));
  read->byte += ROW;
  return PACKING_OK;
}

static packing_status read_rows(packing_i_read *read)
{
  unsigned char block[ROWS * ROW];
  size_t size;
  do {
    PACKING_I_TRY(read_block(read, block, &size));
    for (size_t at = 0; at + ROW <= size; at += ROW)
      PACKING_I_TRY(take_row(read, block + at));
    if (size % ROW != 0)
      return packing_i_read_fail(read, PACKING_ERR_FORMAT,
                                 "the file ends within a row of four doubles");
  } while (size == sizeof block);
  return packing_i_read_flush(read);
}

const packing_i_reader packing_i_reader_xyzd = {
    {"xyzd", ".xyzd", "packing-generation, packing.xyzd", "centre and diameter"},
    PACKING_I_READS_BYTES,
    read_rows};
