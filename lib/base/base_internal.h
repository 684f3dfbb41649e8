/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_BASE_INTERNAL_H
#define PACKING_BASE_INTERNAL_H

/* What every file of the library leans on: memory, errors, defs, parallel blocks. */

#include <packing/types.h>
#include <stddef.h>

/* The allocator of a context; that of malloc for NULL. Immutable handles keep a copy. */
const packing_allocator *packing_i_allocator(const packing_context *context);

/* `count` entries of `size` bytes, 64-byte aligned, not cleared; NULL when the product
 * overflows or memory is out. count 0 gives a block of one entry. */
void *packing_i_alloc(const packing_allocator *allocator, size_t count, size_t size);

/* The same, cleared. */
void *packing_i_calloc(const packing_allocator *allocator, size_t count, size_t size);

/* A block of `new_count` entries with the first `old_count` copied over; the old block is
 * released on success and untouched on failure (NULL). */
void *packing_i_regrow(const packing_allocator *allocator, void *old, size_t old_count,
                       size_t new_count, size_t size);

/* NULL is fine. */
void packing_i_free(const packing_allocator *allocator, void *block);

/* Handles that need a context for as long as they live hold it. NULL is fine. */
packing_context *packing_i_context_hold(packing_context *context);

/* Notes a failure in the context (if any), logs it and returns `status`. `field` may be
 * NULL, `index` PACKING_NO_INDEX. The message is one line, and begins with the field's name
 * where there is one: "count: 0 rows, at least 2 are needed". */
#if defined(__GNUC__)
__attribute__((format(printf, 5, 6)))
#endif
packing_status
packing_i_fail(packing_context *context, packing_status status, const char *field,
               size_t index, const char *format, ...);

/* The same for memory. */
packing_status packing_i_nomem(packing_context *context);

#if defined(__clang_analyzer__)
/* Shows the analyzer, which sees one file at a time, that a failure is not PACKING_OK. */
#define packing_i_fail(context, status, ...) (status)
#define packing_i_nomem(context) PACKING_ERR_NOMEM
#endif

/* Logs a warning; it is no failure and leaves packing_context_message() alone. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void packing_i_warn(packing_context *context, const char *field, const char *format, ...);

/* Checks of def fields: a failure names the field. */
packing_status packing_i_check_finite(packing_context *context, const char *field,
                                      double v);
packing_status packing_i_check_positive(packing_context *context, const char *field,
                                        double v);
packing_status packing_i_check_not_negative(packing_context *context, const char *field,
                                            double v);
/* For arguments, switches (0 or 1) and vectors. */
packing_status packing_i_check_given(packing_context *context, const char *field,
                                     const void *pointer);
packing_status packing_i_check_switch(packing_context *context, const char *field,
                                      int value);
packing_status packing_i_check_point(packing_context *context,
                                     const char *const fields[3],
                                     const packing_vec3 *point);

/* Leaves a function early with the status of a call. For calls that own nothing yet. */
#define PACKING_I_TRY(call)                                                              \
  do {                                                                                   \
    packing_status packing_i_status_ = (call);                                           \
    if (packing_i_status_ != PACKING_OK)                                                 \
      return packing_i_status_;                                                          \
  } while (0)

/* Copies a caller's def, of any age, over `copy`, which holds the defaults. `known` is the
 * size today, `first` the size in the first release that had the struct. NULL def: defaults. */
packing_status packing_i_def_read(packing_context *context, const void *def, void *copy,
                                  size_t known, size_t first);

/* Reads `def` into the local `copy` (of type `noun_def`), defaults first. */
#define PACKING_I_DEF_READ(context, noun, last_field_of_first_release, def, copy)        \
  (noun##_def_fill((copy), sizeof *(copy)),                                              \
   packing_i_def_read((context), (def), (copy), sizeof *(copy),                          \
                      offsetof(noun##_def, last_field_of_first_release) +                \
                          sizeof((copy)->last_field_of_first_release)))

/* The body of every packing_<noun>_def_fill(): copies as much of `defaults` (whose
 * struct_size is set here) as the caller's struct has room for. */
void packing_i_def_fill(void *def, size_t size, void *defaults, size_t known);

/* Fills a caller's report of any age: as much of `report` as it has room for, its struct_size
 * kept. PACKING_ERR_ABI when it is not initialised. */
packing_status packing_i_report_write(packing_context *context, void *out,
                                      const void *report, size_t known);

/* Whether packing_i_report_write() will be able to: for calls that write arrays beside. */
packing_status packing_i_report_check(packing_context *context, const void *out);

/* Runs fn(arg, b) for b in [0, blocks) on the context's threads. The borders of blocks must
 * come from the input only. Memory may not be allocated inside. */
void packing_i_parallel(packing_context *context, size_t blocks,
                        packing_block_function fn, void *arg);

#endif
