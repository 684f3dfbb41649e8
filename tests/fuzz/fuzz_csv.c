/* SPDX-License-Identifier: GPL-3.0-or-later */
/* packing_read_csv(): what it takes must be written and read back as the same bytes; what it
 * refuses must leave the store empty and say why. */
#include "fuzz.h"
#include <stdlib.h>

typedef struct text {
  char *data;
  size_t size, capacity;
} text;

static packing_status text_write(void *user, const void *data, size_t count)
{
  text *t = user;
  if (t->capacity - t->size < count) {
    t->capacity = 2 * t->capacity + count;
    char *grown = realloc(t->data, t->capacity);
    fuzz_require(grown != NULL);
    t->data = grown;
  }
  memcpy(t->data + t->size, data, count);
  t->size += count;
  return PACKING_OK;
}

static packing_particles *store(packing_context *context, int dim)
{
  packing_particles_def def;
  packing_particles *particles = NULL;
  packing_particles_def_init(&def);
  def.dim = dim;
  fuzz_require(packing_particles_create(context, &def, &particles) == PACKING_OK);
  return particles;
}

static text as_text(packing_context *context, const packing_particles *particles)
{
  text t = {NULL, 0, 0};
  const packing_stream stream = {NULL, text_write, &t};
  packing_csv_def def;
  packing_view view;
  packing_csv_def_init(&def);
  def.dim = packing_particles_dim(particles);
  packing_particles_view(particles, &view);
  fuzz_require(packing_write_csv(context, &def, &view, &stream) == PACKING_OK);
  return t;
}

static void check_round_trip(packing_context *context, const packing_particles *particles)
{
  packing_particles *again = store(context, packing_particles_dim(particles));
  fuzz_input in;
  text first = as_text(context, particles);
  const packing_stream stream = fuzz_stream(&in, (const uint8_t *)first.data, first.size);
  fuzz_require(packing_read_csv(context, &stream, again) == PACKING_OK);
  text second = as_text(context, again);
  fuzz_require(first.size == second.size &&
               memcmp(first.data, second.data, first.size) == 0);
  free(first.data);
  free(second.data);
  packing_particles_destroy(again);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  packing_context *context = fuzz_context();
  for (int dim = 2; dim <= 3; dim++) {
    packing_particles *particles = store(context, dim);
    fuzz_input in;
    const packing_stream stream = fuzz_stream(&in, data, size);
    const packing_status status = packing_read_csv(context, &stream, particles);
    if (status == PACKING_OK) {
      check_round_trip(context, particles);
    } else {
      fuzz_require(status == PACKING_ERR_FORMAT || status == PACKING_ERR_RANGE);
      fuzz_require(packing_particles_count(particles) == 0);
      fuzz_require(packing_context_message(context)[0] != '\0');
      fuzz_require(strchr(packing_context_message(context), '\n') == NULL);
    }
    packing_particles_destroy(particles);
  }
  packing_context_destroy(context);
  return 0;
}
