/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The context: allocator, log, threads, instruction set, the last failure's line. */
#define _DEFAULT_SOURCE /* posix_memalign */
#include "base_internal.h"
#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

/* What the analyzer sees in their place (base_internal.h). */
#undef packing_i_fail
#undef packing_i_nomem

enum { MESSAGE_SIZE = 512, MOST_THREADS = 1024 };

struct packing_context {
  atomic_size_t holds; /* the user's and one for each handle that needs it */
  packing_allocator allocator;
  packing_log_function log;
  void *log_user;
  int threads;
  packing_isa isa;
  packing_parallel_function parallel;
  void *parallel_user;
  pid_t pid; /* OpenMP's threads do not survive a fork */
  char message[MESSAGE_SIZE];
};

static void *malloc_allocate(void *user, size_t size, size_t alignment)
{
  (void)user;
  void *block = NULL;
  if (posix_memalign(&block, alignment < sizeof(void *) ? sizeof(void *) : alignment,
                     size))
    return NULL;
  return block;
}

static void malloc_release(void *user, void *block)
{
  (void)user;
  free(block);
}

static const packing_allocator malloc_allocator = {malloc_allocate, malloc_release, NULL};

const packing_allocator *packing_i_allocator(const packing_context *context)
{
  return context == NULL ? &malloc_allocator : &context->allocator;
}

static packing_isa best_isa(void)
{
  if (packing_isa_available(PACKING_ISA_AVX512))
    return PACKING_ISA_AVX512;
  if (packing_isa_available(PACKING_ISA_AVX2))
    return PACKING_ISA_AVX2;
  return PACKING_ISA_BASELINE;
}

static int all_cores(void)
{
#ifdef _OPENMP
  int cores = omp_get_num_procs();
  return cores < 1 ? 1 : cores > MOST_THREADS ? MOST_THREADS : cores;
#else
  return 1;
#endif
}

void packing_context_def_fill(packing_context_def *def, size_t size)
{
  packing_context_def defaults = {0};
  packing_i_def_fill(def, size, &defaults, sizeof defaults);
}

packing_status packing_context_create(const packing_context_def *def,
                                      packing_context **context)
{
  packing_context_def d;
  if (context == NULL)
    return PACKING_ERR_INVALID;
  PACKING_I_TRY(PACKING_I_DEF_READ(NULL, packing_context, parallel_user, def, &d));
  if ((d.allocator.allocate == NULL) != (d.allocator.release == NULL))
    return PACKING_ERR_INVALID;
  if (d.threads < 0 || d.threads > MOST_THREADS)
    return PACKING_ERR_RANGE;
  if (d.isa < PACKING_ISA_AUTO || d.isa >= PACKING_ISA_END)
    return PACKING_ERR_RANGE;
  if (!packing_isa_available(d.isa))
    return PACKING_ERR_UNSUPPORTED;
  if (d.allocator.allocate == NULL)
    d.allocator = malloc_allocator;
  packing_context *c = packing_i_calloc(&d.allocator, 1, sizeof *c);
  if (c == NULL)
    return PACKING_ERR_NOMEM;
  atomic_init(&c->holds, 1);
  c->allocator = d.allocator;
  c->log = d.log;
  c->log_user = d.log_user;
  c->threads = d.threads == 0 ? all_cores() : d.threads;
  c->isa = d.isa == PACKING_ISA_AUTO ? best_isa() : d.isa;
  c->parallel = d.parallel;
  c->parallel_user = d.parallel_user;
  c->pid = getpid();
  *context = c;
  return PACKING_OK;
}

packing_context *packing_i_context_hold(packing_context *context)
{
  if (context != NULL)
    atomic_fetch_add_explicit(&context->holds, 1, memory_order_relaxed);
  return context;
}

void packing_context_destroy(packing_context *context)
{
  if (context == NULL ||
      atomic_fetch_sub_explicit(&context->holds, 1, memory_order_acq_rel) != 1)
    return;
  const packing_allocator allocator = context->allocator;
  packing_i_free(&allocator, context);
}

const char *packing_context_message(const packing_context *context)
{
  return context == NULL ? "" : context->message;
}

int packing_context_threads(const packing_context *context)
{
  return context == NULL ? 1 : context->threads;
}

packing_isa packing_context_isa(const packing_context *context)
{
  return context == NULL ? best_isa() : context->isa;
}

static void emit(const packing_context *context, packing_log_level level,
                 packing_status status, const char *field, size_t index,
                 const char *message)
{
  if (context->log == NULL)
    return;
  const packing_log_record record = {sizeof record, level, status, field, index, message};
  context->log(context->log_user, &record);
}

/* "field: text", cut to `size`. */
static void compose(char *line, size_t size, const char *field, const char *format,
                    va_list arguments)
{
  size_t used = 0;
  line[0] = '\0';
  if (field != NULL) {
    int n = snprintf(line, size, "%s: ", field);
    used = n < 0 ? 0 : (size_t)n < size ? (size_t)n : size - 1;
  }
  if (vsnprintf(line + used, size - used, format, arguments) < 0)
    line[used] = '\0';
}

packing_status packing_i_fail(packing_context *context, packing_status status,
                              const char *field, size_t index, const char *format, ...)
{
  if (context == NULL)
    return status;
  va_list arguments;
  va_start(arguments, format);
  compose(context->message, sizeof context->message, field, format, arguments);
  va_end(arguments);
  emit(context, PACKING_LOG_ERROR, status, field, index, context->message);
  return status;
}

packing_status packing_i_nomem(packing_context *context)
{
  return packing_i_fail(context, PACKING_ERR_NOMEM, NULL, PACKING_NO_INDEX,
                        "out of memory");
}

void packing_i_warn(packing_context *context, const char *field, const char *format, ...)
{
  if (context == NULL || context->log == NULL)
    return;
  char line[MESSAGE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  compose(line, sizeof line, field, format, arguments);
  va_end(arguments);
  emit(context, PACKING_LOG_WARNING, PACKING_OK, field, PACKING_NO_INDEX, line);
}

packing_status packing_i_check_finite(packing_context *context, const char *field,
                                      double v)
{
  if (isfinite(v))
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX,
                        "%g is not a finite number", v);
}

packing_status packing_i_check_positive(packing_context *context, const char *field,
                                        double v)
{
  PACKING_I_TRY(packing_i_check_finite(context, field, v));
  if (v > 0)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%g must be above 0", v);
}

packing_status packing_i_check_not_negative(packing_context *context, const char *field,
                                            double v)
{
  PACKING_I_TRY(packing_i_check_finite(context, field, v));
  if (v >= 0)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%g must not be negative", v);
}

packing_status packing_i_check_given(packing_context *context, const char *field,
                                     const void *pointer)
{
  if (pointer != NULL)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_INVALID, field, PACKING_NO_INDEX, "NULL");
}

packing_status packing_i_check_switch(packing_context *context, const char *field,
                                      int value)
{
  if (value == 0 || value == 1)
    return PACKING_OK;
  return packing_i_fail(context, PACKING_ERR_RANGE, field, PACKING_NO_INDEX,
                        "%d must be 0 or 1", value);
}

packing_status packing_i_check_point(packing_context *context,
                                     const char *const fields[3],
                                     const packing_vec3 *point)
{
  const double part[3] = {point->x, point->y, point->z};
  for (int k = 0; k < 3; k++)
    PACKING_I_TRY(packing_i_check_finite(context, fields[k], part[k]));
  return PACKING_OK;
}

static void run_here(size_t blocks, packing_block_function fn, void *arg)
{
  for (size_t b = 0; b < blocks; b++)
    fn(arg, b);
}

void packing_i_parallel(packing_context *context, size_t blocks,
                        packing_block_function fn, void *arg)
{
  if (context == NULL || blocks < 2) {
    run_here(blocks, fn, arg);
    return;
  }
  if (context->parallel != NULL) {
    context->parallel(context->parallel_user, blocks, fn, arg);
    return;
  }
#ifdef _OPENMP
  if (context->threads > 1 && !omp_in_parallel() && getpid() == context->pid) {
    const int threads = context->threads;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (size_t b = 0; b < blocks; b++)
      fn(arg, b);
    return;
  }
#endif
  run_here(blocks, fn, arg);
}
