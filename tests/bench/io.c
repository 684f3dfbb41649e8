/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading and writing 1e6 spheres, on one thread: seconds and MB/s, the least of five runs.
 * "file" is a file in TMPDIR (or /tmp), sync and rename included; "memory" is a buffer. */
#define _XOPEN_SOURCE 700
#include "bench.h"
#include <string.h>
#include <unistd.h>

enum { COUNT = 1000000, RUNS = 5 };

typedef struct memory {
  char *data;
  size_t size, capacity, read_at;
} memory;

typedef struct bench {
  packing_context *context;
  packing_view view;
  memory memory;
  char path[512];
  size_t bytes;
} bench;

static void check(packing_status status, const bench *b)
{
  if (status == PACKING_OK)
    return;
  fprintf(stderr, "%s: %s\n", packing_status_string(status),
          packing_context_message(b->context));
  exit(1);
}

static packing_status memory_write(void *user, const void *data, size_t count)
{
  memory *m = user;
  if (m->capacity - m->size < count)
    return PACKING_ERR_IO;
  memcpy(m->data + m->size, data, count);
  m->size += count;
  return PACKING_OK;
}

static packing_status memory_read(void *user, void *buffer, size_t capacity,
                                  size_t *count)
{
  memory *m = user;
  *count = m->size - m->read_at < capacity ? m->size - m->read_at : capacity;
  memcpy(buffer, m->data + m->read_at, *count);
  m->read_at += *count;
  return PACKING_OK;
}

static packing_status csv(bench *b, const packing_stream *stream)
{
  return packing_write_csv(b->context, NULL, &b->view, stream);
}

static packing_status vtp(bench *b, const packing_stream *stream)
{
  return packing_write_vtp(b->context, NULL, &b->view, stream);
}

static packing_status vtp_zlib(bench *b, const packing_stream *stream)
{
  packing_vtp_def def;
  packing_vtp_def_init(&def);
  def.compression = 1;
  return packing_write_vtp(b->context, &def, &b->view, stream);
}

static packing_status lammps(bench *b, const packing_stream *stream)
{
  return packing_write_lammps(b->context, NULL, &b->view, stream);
}

static packing_status read_csv(bench *b, const packing_stream *stream)
{
  packing_particles *particles = NULL;
  check(packing_particles_create(b->context, NULL, &particles), b);
  const packing_status status = packing_read_csv(b->context, stream, particles);
  if (status == PACKING_OK && packing_particles_count(particles) != COUNT)
    exit(1);
  packing_particles_destroy(particles);
  return status;
}

typedef packing_status (*work)(bench *b, const packing_stream *stream);

static void to_memory(bench *b, work run)
{
  const packing_stream stream = {NULL, memory_write, &b->memory};
  b->memory.size = 0;
  check(run(b, &stream), b);
  b->bytes = b->memory.size;
}

static void from_memory(bench *b, work run)
{
  const packing_stream stream = {memory_read, NULL, &b->memory};
  b->memory.read_at = 0;
  check(run(b, &stream), b);
  b->bytes = b->memory.size;
}

static void to_file(bench *b, work run)
{
  packing_file *file = NULL;
  check(packing_file_create(b->context, b->path, &file), b);
  check(run(b, packing_file_stream(file)), b);
  check(packing_file_commit(file), b);
}

static void from_file(bench *b, work run)
{
  packing_file *file = NULL;
  check(packing_file_open(b->context, b->path, &file), b);
  check(run(b, packing_file_stream(file)), b);
  packing_file_close(file);
}

static void measure(bench *b, const char *name, void (*through)(bench *, work), work run)
{
  double least = 1e300;
  for (int i = 0; i < RUNS; i++) {
    const double start = now();
    through(b, run);
    const double seconds = now() - start;
    least = seconds < least ? seconds : least;
  }
  printf("%-24s %8.3f s %8.1f MB %8.1f MB/s\n", name, least, (double)b->bytes / 1e6,
         (double)b->bytes / 1e6 / least);
  fflush(stdout);
}

static double *numbers(double scale, uint64_t state)
{
  double *a = malloc(COUNT * sizeof *a);
  if (a == NULL)
    exit(1);
  for (size_t i = 0; i < COUNT; i++) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    a[i] = scale * ((double)(state >> 11) + 1) / 9007199254740992.0;
  }
  return a;
}

int main(void)
{
  bench b = {0};
  packing_context_def def;
  const char *base = getenv("TMPDIR");
  double *x = numbers(1, 1), *y = numbers(1, 2), *z = numbers(1, 3),
         *r = numbers(0.01, 4);
  packing_context_def_init(&def);
  def.threads = 1;
  check(packing_context_create(&def, &b.context), &b);
  packing_view_init_arrays(&b.view, COUNT, x, y, z, r);
  b.memory.capacity = (size_t)COUNT * 256;
  b.memory.data = malloc(b.memory.capacity);
  if (b.memory.data == NULL)
    return 1;
  memset(b.memory.data, 1, b.memory.capacity);
  snprintf(b.path, sizeof b.path, "%s/packing-bench-%ld",
           base != NULL && strlen(base) < 400 ? base : "/tmp", (long)getpid());
  printf("%d spheres, one thread, least of %d runs\n", COUNT, RUNS);
  measure(&b, "csv write, memory", to_memory, csv);
  measure(&b, "csv write, file", to_file, csv);
  measure(&b, "csv read, memory", from_memory, read_csv);
  measure(&b, "csv read, file", from_file, read_csv);
  measure(&b, "vtp write, memory", to_memory, vtp);
  measure(&b, "vtp write, file", to_file, vtp);
  measure(&b, "vtp zlib 1, memory", to_memory, vtp_zlib);
  measure(&b, "lammps write, memory", to_memory, lammps);
  measure(&b, "lammps write, file", to_file, lammps);
  unlink(b.path);
  free(b.memory.data);
  free(x);
  free(y);
  free(z);
  free(r);
  packing_context_destroy(b.context);
  return 0;
}
