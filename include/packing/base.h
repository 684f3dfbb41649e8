/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef PACKING_BASE_H
#define PACKING_BASE_H

/** \file packing/base.h
 *  Status codes, version, and the context: allocator, log, threads, instruction set.
 *
 *  Rules that hold for the whole library:
 *  - Every call that can fail returns a ::packing_status; results come back through the
 *    last parameters and are written only on ::PACKING_OK, unless the call says otherwise.
 *  - Nothing aborts, exits, prints, or touches the locale, signals, `rand`, the working
 *    directory, the floating-point environment or GSL's error handler.
 *  - There is no process-wide state: all of it lives in handles.
 *  - Options travel in a `packing_<noun>_def`. Call `packing_<noun>_def_init` first, then
 *    set fields: a program built against an older header keeps working when the struct
 *    has grown.
 *  - Dimensions are written in brackets: `[L]` length, `[M]` mass, `[T]` time, `[1]` pure
 *    number. The library has no units of its own.
 */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define PACKING_BEGIN_DECLS extern "C" {
#define PACKING_END_DECLS }
#else
#define PACKING_BEGIN_DECLS
#define PACKING_END_DECLS
#endif

#if defined(__GNUC__)
/** Marks what the shared library exports. */
#define PACKING_API __attribute__((visibility("default")))
/** Marks calls whose status must be looked at. */
#define PACKING_WARN_UNUSED __attribute__((warn_unused_result))
#else
#define PACKING_API
#define PACKING_WARN_UNUSED
#endif

/** Drops the status of a call on purpose. */
#define PACKING_IGNORE(call)                                                             \
  do {                                                                                   \
    packing_status packing_ignored_status_ = (call);                                     \
    (void)packing_ignored_status_;                                                       \
  } while (0)

/** Version of the headers; packing_version() tells that of the library. */
#define PACKING_VERSION_MAJOR 0
#define PACKING_VERSION_MINOR 1 /**< see #PACKING_VERSION_MAJOR */
#define PACKING_VERSION_PATCH 0 /**< see #PACKING_VERSION_MAJOR */

PACKING_BEGIN_DECLS

/** What a call came to. Values are never renumbered. */
typedef enum packing_status {
  PACKING_OK = 0,        /**< done */
  PACKING_ERR_NOMEM = 1, /**< the allocator returned NULL; the call can be repeated */
  PACKING_ERR_INVALID =
      2,                 /**< an argument is NaN, infinite, NULL or contradicts another */
  PACKING_ERR_RANGE = 3, /**< a finite value lies outside what the field allows */
  PACKING_ERR_FORMAT = 4, /**< a file's text is malformed; the message names the line */
  PACKING_ERR_IO = 5,     /**< reading or writing failed */
  PACKING_ERR_GEOMETRY =
      6, /**< a container is empty or degenerate, or nothing fits in it */
  PACKING_ERR_UNSTABLE = 7,    /**< a time step that cannot be stable */
  PACKING_ERR_UNSUPPORTED = 8, /**< not in this build, or not for this combination */
  PACKING_ERR_ABI = 9,         /**< a def of a size that this library does not know */
  PACKING_ERR_INTERNAL = 10,   /**< a broken invariant: please report it */
  PACKING_STATUS_END = 11      /**< one past the last code */
} packing_status;

/** Says a status in a few words.
 *  \param status any value
 *  \return a constant string, never NULL, distinct for each code. Thread-safe. */
PACKING_API const char *packing_status_string(packing_status status);

/** The version of the library in use, "MAJOR.MINOR.PATCH".
 *  \return a constant string. Thread-safe. */
PACKING_API const char *packing_version(void);

/** Instruction sets of the vector kernels. Results are the same bytes for each. */
typedef enum packing_isa {
  PACKING_ISA_AUTO = 0,     /**< the best that the machine has */
  PACKING_ISA_BASELINE = 1, /**< plain C */
  PACKING_ISA_AVX2 = 2,     /**< x86-64 with AVX2 */
  PACKING_ISA_AVX512 = 3,   /**< x86-64 with AVX-512 F, BW, DQ and VL */
  PACKING_ISA_END = 4       /**< one past the last set */
} packing_isa;

/** Whether this machine can run an instruction set.
 *  \param isa any value
 *  \return 1 or 0. Thread-safe. */
PACKING_API int packing_isa_available(packing_isa isa);

/** The name of an instruction set ("auto", "baseline", "avx2", "avx512").
 *  \param isa any value
 *  \return a constant string, "unknown" for other values. Thread-safe. */
PACKING_API const char *packing_isa_name(packing_isa isa);

/** Where the library takes memory from. Both functions are called by the thread that uses
 *  the handle, never inside a parallel block. */
typedef struct packing_allocator {
  /** Returns `size` bytes (`size` > 0) aligned to `alignment` (a power of two), or NULL. */
  void *(*allocate)(void *user, size_t size, size_t alignment);
  /** Takes back what `allocate` gave; `block` is never NULL. */
  void (*release)(void *user, void *block);
  void *user; /**< passed through */
} packing_allocator;

/** How much a log record matters. */
typedef enum packing_log_level {
  PACKING_LOG_ERROR = 0,   /**< a call failed; its status says how */
  PACKING_LOG_WARNING = 1, /**< done, but worth a look */
  PACKING_LOG_INFO = 2     /**< what happened */
} packing_log_level;

/** "No index" in a log record. */
#define PACKING_NO_INDEX SIZE_MAX

/** One message. Strings are valid during the callback only. */
typedef struct packing_log_record {
  size_t struct_size;      /**< bytes that the library filled */
  packing_log_level level; /**< how much it matters */
  packing_status status;   /**< ::PACKING_OK for warnings and notes */
  const char *field;       /**< the field or argument at fault, or NULL */
  size_t index;            /**< entry, particle or line number, or #PACKING_NO_INDEX */
  const char *message;     /**< one line without a newline, in English */
} packing_log_record;

/** Receives log records, on the thread that made the call. */
typedef void (*packing_log_function)(void *user, const packing_log_record *record);

/** One block of parallel work. */
typedef void (*packing_block_function)(void *arg, size_t block);

/** Runs `fn(arg, b)` once for each b in [0, blocks), in any order and on any threads, and
 *  returns when all are done. */
typedef void (*packing_parallel_function)(void *user, size_t blocks,
                                          packing_block_function fn, void *arg);

/** Allocator, log, threads and instruction set of the handles made with it. A context is
 *  used by one thread at a time. Wherever a context is taken, NULL means: malloc, silence,
 *  one thread, the best instruction set. */
typedef struct packing_context packing_context;

/** Options of a context. */
typedef struct packing_context_def {
  size_t struct_size;                 /**< set by packing_context_def_init() */
  packing_allocator allocator;        /**< both functions NULL: malloc */
  packing_log_function log;           /**< NULL: silence */
  void *log_user;                     /**< passed to `log` */
  int threads;                        /**< 0: all cores; else 1 .. 1024 */
  packing_isa isa;                    /**< a set the machine lacks is refused */
  packing_parallel_function parallel; /**< the host's own threads; NULL: OpenMP */
  void *parallel_user;                /**< passed to `parallel` */
} packing_context_def;

/** Writes the defaults; called through packing_context_def_init().
 *  \param[out] def the options
 *  \param size `sizeof *def` as the caller knows it */
PACKING_API void packing_context_def_fill(packing_context_def *def, size_t size);

/** Sets every option to its default.
 *  \param[out] def the options */
static inline void packing_context_def_init(packing_context_def *def)
{
  packing_context_def_fill(def, sizeof *def);
}

/** Makes a context.
 *
 *  Work is cut into blocks whose borders depend on the input only, so results are the same
 *  bytes for any number of threads. Inside a parallel region of the host, and in a process
 *  forked after the context was made, one thread is used. (GNU's OpenMP cannot start
 *  threads in a child whose parent had used them: there, make the context with threads = 1.)
 *  \param def options, or NULL for the defaults
 *  \param[out] context the new context
 *  \return PACKING_OK; PACKING_ERR_NOMEM; PACKING_ERR_INVALID (half an allocator);
 *          PACKING_ERR_RANGE (threads); PACKING_ERR_UNSUPPORTED (instruction set);
 *          PACKING_ERR_ABI. There is no context yet to hold a message. */
PACKING_API PACKING_WARN_UNUSED packing_status
packing_context_create(const packing_context_def *def, packing_context **context);

/** Lets go of a context. Its memory goes with the last handle made from it, so the order
 *  of destruction does not matter.
 *  \param context NULL is fine */
PACKING_API void packing_context_destroy(packing_context *context);

/** The line of the last failure.
 *  \param context NULL is fine
 *  \return a string valid until the next call with this context; "" where none failed */
PACKING_API const char *packing_context_message(const packing_context *context);

/** The number of threads in use.
 *  \param context NULL is fine
 *  \return at least 1 */
PACKING_API int packing_context_threads(const packing_context *context);

/** The instruction set in use, never ::PACKING_ISA_AUTO.
 *  \param context NULL is fine
 *  \return one that packing_isa_available() confirms */
PACKING_API packing_isa packing_context_isa(const packing_context *context);

PACKING_END_DECLS

#endif
