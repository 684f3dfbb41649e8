/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preloaded, it refuses request FAIL_AT (from 1) for memory, whoever makes it. The allocator is
 * the C library's, by the names under which it keeps the functions that are hidden here. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static atomic_long requests;
static long fail_at;

__attribute__((constructor)) static void begin(void)
{
  const char *text = getenv("FAIL_AT");
  fail_at = text != NULL ? atol(text) : 0;
  atomic_store(&requests, 0);
}

static int refused(void)
{
  if (atomic_fetch_add(&requests, 1) + 1 != fail_at)
    return 0;
  errno = ENOMEM;
  return 1;
}

void *malloc(size_t size)
{
  return refused() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
  return refused() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *block, size_t size)
{
  return refused() ? NULL : __libc_realloc(block, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
  void *made = refused() ? NULL : __libc_memalign(alignment, size);
  if (made == NULL)
    return ENOMEM;
  *block = made;
  return 0;
}
