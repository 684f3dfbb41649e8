/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_TEST_H
#define PACKING_TEST_H

/* What every test starts with. CMocka's own float comparison works in single precision, so
 * doubles are compared here. */

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <packing/packing.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* |a - b| <= tolerance. */
#define assert_near(a, b, tolerance)                                                     \
  test_near((a), (b), (tolerance), #a, __FILE__, __LINE__)

/* |a - b| <= tolerance * |b|. */
#define assert_close(a, b, tolerance)                                                    \
  test_near((a), (b), (tolerance)*fabs(b), #a, __FILE__, __LINE__)

#define assert_status(call, status)                                                      \
  test_status((call), (status), NULL, #call, __FILE__, __LINE__)

#define assert_ok(call) assert_status((call), PACKING_OK)

/* The status, and a message in `context` that names `field`. */
#define assert_fails(context, call, status, field)                                       \
  (test_status((call), (status), NULL, #call, __FILE__, __LINE__),                       \
   test_names((context), (field), #call, __FILE__, __LINE__))

void test_near(double a, double b, double tolerance, const char *what, const char *file,
               int line);
void test_status(packing_status got, packing_status want, packing_context *context,
                 const char *what, const char *file, int line);
void test_names(packing_context *context, const char *field, const char *what,
                const char *file, int line);

/* A context of `threads` threads and an instruction set. */
packing_context *test_context(int threads, packing_isa isa);

/* Workers that must all make the same: 1, 2, 3, 4 and 8 threads, and with 2 every instruction set;
 * for a set that the machine lacks comes the next it has. */
enum { TEST_TEAMS = 7 };
packing_context *test_team(size_t team);

/* An allocator that counts, and fails from the k-th request on (once) when asked. */
typedef struct test_allocator {
  size_t live;     /* blocks held */
  size_t requests; /* so far */
  size_t fail_at;  /* 1-based number of the request that fails; 0: never */
  size_t peak;     /* most bytes held at once */
  size_t bytes;    /* held now */
} test_allocator;

/* A context (one thread) over the allocator, itself made before any failure. */
packing_context *test_allocator_context(test_allocator *allocator);

/* Runs `scenario` with the 1st, 2nd, ... request failing until it passes without a failure.
 * The scenario makes what it needs with the context, destroys it all, and returns its status;
 * each failing run must return PACKING_ERR_NOMEM with nothing left held. On PACKING_OK it
 * writes a hash of its result to *hash. Asserts that a run straight after a failure gives the
 * hash of an undisturbed run. Returns how many failures were injected. */
typedef packing_status (*test_scenario)(packing_context *context, uint64_t *hash);
size_t test_every_allocation(test_scenario scenario);

/* FNV-1a over bytes; start with TEST_HASH_START. */
#define TEST_HASH_START UINT64_C(14695981039346656037)
uint64_t test_hash(uint64_t hash, const void *data, size_t size);

/* Hash of x, y, z, r of all particles. */
uint64_t test_hash_particles(const packing_particles *particles);

/* A stream over memory. Writing grows `data` (free it with test_buffer_free); reading starts
 * at `read_at` and hands out at most `chunk` bytes a call (0: as many as asked). Writing past
 * `limit` bytes (0: none) fails with PACKING_ERR_IO. */
typedef struct test_buffer {
  char *data;
  size_t size;
  size_t read_at;
  size_t chunk;
  size_t limit;
} test_buffer;

packing_stream test_buffer_stream(test_buffer *buffer);
void test_buffer_text(test_buffer *buffer, const char *text);
void test_buffer_free(test_buffer *buffer);

/* Short constructors with default options; they assert success. */
packing_domain *test_box(double lx, double ly, double lz, unsigned periodic);
packing_domain *test_rectangle(double lx, double ly, unsigned periodic);
packing_psd *test_mono(double r);
packing_psd *test_uniform(double min_r, double max_r);
packing_particles *test_store(int dim);

/* Steps a placer to its end. */
packing_placer_report test_run(packing_placer *placer);

/* Largest overlap relative to the smaller radius over all pairs, the slow obvious way (nearest
 * image along periodic directions of the domain; NULL: none). */
double test_brute_overlap(const packing_domain *domain, const packing_view *view);

#endif
