/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_READING_H
#define PACKING_TEST_READING_H

/* A store, bonds and a report around packing_read_pack(). */

#include "test.h"

typedef struct reading {
  packing_context *context;
  packing_particles *particles;
  packing_bonds *bonds;
  packing_read_def def;
  packing_read_info info;
} reading;

static inline reading reading_begin(packing_context *context, int dim)
{
  reading r = {0};
  packing_particles_def def;
  packing_particles_def_init(&def);
  def.dim = dim;
  r.context = context;
  assert_ok(packing_particles_create(context, &def, &r.particles));
  assert_ok(packing_bonds_create(context, &r.bonds));
  packing_read_def_init(&r.def);
  packing_read_info_init(&r.info);
  r.def.bonds = r.bonds;
  return r;
}

static inline void reading_end(reading *r)
{
  packing_bonds_destroy(r->bonds);
  packing_particles_destroy(r->particles);
}

/* Reads `size` bytes, handed out in pieces of `chunk` (0: as asked). */
static inline packing_status reading_bytes(reading *r, const char *format,
                                           const void *data, size_t size, size_t chunk)
{
  test_buffer buffer = {0};
  buffer.data = malloc(size + 1);
  assert_non_null(buffer.data);
  if (size > 0)
    memcpy(buffer.data, data, size);
  buffer.size = size;
  buffer.chunk = chunk;
  const packing_stream stream = test_buffer_stream(&buffer);
  const packing_status status =
      packing_read_pack(r->context, &r->def, format, &stream, r->particles, &r->info);
  test_buffer_free(&buffer);
  return status;
}

static inline packing_status reading_text(reading *r, const char *format,
                                          const char *text)
{
  return reading_bytes(r, format, text, strlen(text), 0);
}

/* Entry i of a column of doubles; 0 where it is absent. */
static inline double reading_at(const packing_column *c, size_t i)
{
  double v = 0;
  if (c->data != NULL)
    memcpy(&v, (const char *)c->data + i * c->stride, sizeof v);
  return v;
}

static inline int64_t reading_id(const reading *r, size_t i)
{
  packing_view v;
  int64_t id = -1;
  packing_particles_view(r->particles, &v);
  if (v.id.data != NULL)
    memcpy(&id, (const char *)v.id.data + i * v.id.stride, sizeof id);
  return id;
}

static inline int32_t reading_type(const reading *r, size_t i)
{
  packing_view v;
  int32_t type = -1;
  packing_particles_view(r->particles, &v);
  if (v.type.data != NULL)
    memcpy(&type, (const char *)v.type.data + i * v.type.stride, sizeof type);
  return type;
}

/* Asserts particle i, to the last bit. */
static inline void reading_is(const reading *r, size_t i, double x, double y, double z,
                              double radius)
{
  packing_view v;
  packing_particles_view(r->particles, &v);
  assert_true(i < v.count);
  if (!(reading_at(&v.x, i) == x && reading_at(&v.y, i) == y &&
        reading_at(&v.z, i) == z && reading_at(&v.r, i) == radius))
    fail_msg("particle %zu is %.17g %.17g %.17g r %.17g, not %.17g %.17g %.17g r %.17g",
             i, reading_at(&v.x, i), reading_at(&v.y, i), reading_at(&v.z, i),
             reading_at(&v.r, i), x, y, z, radius);
}

/* A whole file; *size is told. The caller frees. */
static inline unsigned char *reading_file(const char *directory, const char *name,
                                          size_t *size)
{
  char path[1024];
  const int length = snprintf(path, sizeof path, "%s/%s", directory, name);
  assert_true(length > 0 && (size_t)length < sizeof path);
  FILE *file = fopen(path, "rb");
  if (file == NULL)
    fail_msg("cannot open %s", path);
  unsigned char *data = malloc(1 << 20);
  assert_non_null(data);
  *size = fread(data, 1, 1 << 20, file);
  fclose(file);
  assert_true(*size > 0 && *size < 1 << 20);
  return data;
}

#endif
