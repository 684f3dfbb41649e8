/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A ParaView collection: the files of a time series. */
#include "writers_internal.h"

static packing_status check_entry(packing_context *context, const packing_pvd_entry *e)
{
  PACKING_I_TRY(packing_i_check_given(context, "file", e->file));
  if (*e->file == '\0')
    return packing_i_fail(context, PACKING_ERR_INVALID, "file", PACKING_NO_INDEX,
                          "a name is missing");
  PACKING_I_TRY(packing_i_check_line(context, "file", e->file));
  PACKING_I_TRY(packing_i_check_finite(context, "time", e->time));
  if (e->part < 0)
    return packing_i_fail(context, PACKING_ERR_INVALID, "part", PACKING_NO_INDEX,
                          "%d is below 0", e->part);
  return PACKING_OK;
}

/* Text of an attribute. */
static void put_escaped(packing_i_writer *w, const char *text)
{
  for (; *text != '\0'; text++)
    switch (*text) {
    case '&':
      packing_i_put_text(w, "&amp;");
      break;
    case '<':
      packing_i_put_text(w, "&lt;");
      break;
    case '>':
      packing_i_put_text(w, "&gt;");
      break;
    case '"':
      packing_i_put_text(w, "&quot;");
      break;
    default:
      packing_i_put_char(w, *text);
    }
}

static void put_entry(packing_i_writer *w, const packing_pvd_entry *e)
{
  packing_i_put_text(w, "<DataSet timestep=\"");
  packing_i_put_double(w, e->time);
  packing_i_put_text(w, "\" part=\"");
  packing_i_put_int(w, e->part);
  packing_i_put_text(w, "\" file=\"");
  put_escaped(w, e->file);
  packing_i_put_text(w, "\"/>\n");
}

packing_status packing_write_pvd(packing_context *context,
                                 const packing_pvd_entry *entries, size_t count,
                                 const packing_stream *stream)
{
  packing_i_writer w;
  if (count > 0)
    PACKING_I_TRY(packing_i_check_given(context, "entries", entries));
  for (size_t i = 0; i < count; i++)
    PACKING_I_TRY(check_entry(context, &entries[i]));
  PACKING_I_TRY(packing_i_writer_open(&w, context, "pvd", stream));
  packing_i_put_text(&w, "<?xml version=\"1.0\"?>\n"
                         "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n");
  for (size_t i = 0; i < count && w.status == PACKING_OK; i++)
    put_entry(&w, &entries[i]);
  packing_i_put_text(&w, "</Collection>\n</VTKFile>\n");
  return packing_i_writer_end(&w);
}
