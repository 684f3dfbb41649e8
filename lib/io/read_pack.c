/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All readers of packs: one line each. */
#include "read_internal.h"
#include <string.h>

static const packing_i_reader *const readers[] = {
    &packing_i_reader_csv,    &packing_i_reader_vtp,       &packing_i_reader_vtu,
    &packing_i_reader_lammps, &packing_i_reader_dump,      &packing_i_reader_liggghts,
    &packing_i_reader_yade,   &packing_i_reader_yade_pack, &packing_i_reader_geo,
    &packing_i_reader_xyz,    &packing_i_reader_xyzd,
};

enum { READERS = sizeof readers / sizeof readers[0] };

void packing_read_def_fill(packing_read_def *def, size_t size)
{
  packing_read_def defaults = {0};
  defaults.frame = PACKING_FRAME_LAST;
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

static const packing_i_reader *find(const char *name)
{
  for (size_t i = 0; name != NULL && i < READERS; i++)
    if (strcmp(readers[i]->format.name, name) == 0)
      return readers[i];
  return NULL;
}

const char *packing_read_format(size_t index)
{
  return index < READERS ? readers[index]->format.name : NULL;
}

const char *packing_read_format_about(const char *format)
{
  const packing_i_reader *reader = find(format);
  return reader == NULL ? NULL : reader->format.reference;
}

/* Whether the `length` bytes at `extension` stand in a list with blanks between. */
static int is_listed(const char *list, const char *extension, size_t length)
{
  while (*list != '\0') {
    const size_t entry = strcspn(list, " ");
    if (entry == length && memcmp(list, extension, length) == 0)
      return 1;
    list += entry;
    list += *list == ' ';
  }
  return 0;
}

const char *packing_read_format_of(const char *path)
{
  if (path == NULL)
    return NULL;
  const char *slash = strrchr(path, '/'), *name = slash == NULL ? path : slash + 1;
  size_t length = strlen(name);
  const int compressed = length > 3 && strcmp(name + length - 3, ".gz") == 0;
  if (compressed)
    length -= 3;
  size_t dot = length;
  while (dot > 0 && name[dot - 1] != '.')
    dot--;
  if (dot < 2) /* no extension, or nothing before it */
    return NULL;
  for (size_t i = 0; i < READERS; i++)
    if (is_listed(readers[i]->format.extensions, name + dot - 1, length - dot + 1) &&
        !(compressed && readers[i]->what == PACKING_I_READS_BYTES))
      return readers[i]->format.name;
  return NULL;
}

static packing_status check_def(packing_context *context, const packing_read_def *d)
{
  if (d->frame < PACKING_FRAME_LAST)
    return packing_i_fail(context, PACKING_ERR_RANGE, "frame", PACKING_NO_INDEX,
                          "%lld is below 0 and not the last", (long long)d->frame);
  PACKING_I_TRY(packing_i_check_switch(context, "sort", d->sort));
  if (d->radius_name != NULL && d->diameter_name != NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "diameter_name", PACKING_NO_INDEX,
                          "an array of radii is named too");
  return PACKING_OK;
}

static packing_status check_arguments(packing_context *context, const char *format,
                                      const packing_stream *stream,
                                      const packing_particles *particles)
{
  char quote[PACKING_I_QUOTE_SIZE];
  PACKING_I_TRY(packing_i_check_given(context, "format", format));
  if (find(format) == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "format", PACKING_NO_INDEX,
                          "%s is not one that is read",
                          packing_i_quote(format, format + strlen(format), quote));
  if (stream == NULL || stream->read == NULL)
    return packing_i_fail(context, PACKING_ERR_INVALID, "stream", PACKING_NO_INDEX,
                          "it cannot be read from");
  PACKING_I_TRY(packing_i_check_given(context, "particles", particles));
  if (packing_particles_count(particles) != 0)
    return packing_i_fail(context, PACKING_ERR_RANGE, "particles", PACKING_NO_INDEX,
                          "the store holds %zu particles, an empty one is needed",
                          packing_particles_count(particles));
  return PACKING_OK;
}

/* What the reader did not say. */
static packing_status finish(packing_i_read *r)
{
  packing_read_info *info = &r->info;
  const size_t count = packing_particles_count(r->particles);
  if (info->frames == 0)
    info->frames = 1;
  if (r->def.frame > 0 && (uint64_t)r->def.frame >= info->frames)
    return packing_i_fail(r->context, PACKING_ERR_RANGE, "frame", PACKING_NO_INDEX,
                          "%lld, the file has %zu", (long long)r->def.frame,
                          info->frames);
  info->frame = r->def.frame < 0 ? info->frames - 1 : (size_t)r->def.frame;
  info->particles = count;
  int flat = count > 0;
  for (size_t i = 0; i < count && flat; i++)
    flat = r->particles->z[i] == 0;
  if (flat || info->dim == 0)
    info->dim = flat ? 2 : 3;
  return r->def.sort ? packing_i_read_sort(r) : PACKING_OK;
}

static packing_status read_lines(packing_i_read *r)
{
  PACKING_I_TRY(
      packing_i_lines_begin(&r->lines, r->context, &r->reader->format, r->stream));
  const packing_status status = r->reader->read(r);
  packing_i_lines_end(&r->lines);
  return status;
}

static packing_status read_stream(packing_i_read *r)
{
  const packing_allocator *allocator = packing_i_allocator(r->context);
  packing_status status = PACKING_ERR_NOMEM;
  packing_i_gunzip *gunzip = NULL;
  r->rows = packing_i_alloc(allocator, PACKING_I_READ_BATCH, sizeof *r->rows);
  if (r->rows == NULL) {
    status = packing_i_nomem(r->context);
    goto out;
  }
  if (r->reader->what != PACKING_I_READS_BYTES) {
    status = packing_i_gunzip_create(r->context, &r->reader->format, r->stream, &gunzip);
    if (status != PACKING_OK)
      goto out;
    r->stream = packing_i_gunzip_stream(gunzip);
  }
  status = r->reader->what == PACKING_I_READS_LINES ? read_lines(r) : r->reader->read(r);
  if (status == PACKING_OK)
    status = finish(r);
out:
  packing_i_gunzip_destroy(gunzip);
  packing_i_free(allocator, r->rows);
  return status;
}

packing_status packing_read_pack(packing_context *context, const packing_read_def *def,
                                 const char *format, const packing_stream *stream,
                                 packing_particles *particles, packing_read_info *info)
{
  packing_i_read r = {0};
  PACKING_I_TRY(PACKING_I_DEF_READ(context, packing_read, bonds, def, &r.def));
  PACKING_I_TRY(check_def(context, &r.def));
  PACKING_I_TRY(check_arguments(context, format, stream, particles));
  r.context = context;
  r.reader = find(format);
  r.stream = stream;
  r.particles = particles;
  if (r.def.bonds != NULL)
    r.def.bonds->count = 0;
  packing_status status = read_stream(&r);
  if (status == PACKING_OK && info != NULL)
    status = packing_i_report_write(context, info, &r.info, sizeof r.info);
  if (status == PACKING_OK)
    return PACKING_OK;
  packing_particles_truncate(particles, 0);
  if (r.def.bonds != NULL)
    r.def.bonds->count = 0;
  return status;
}
