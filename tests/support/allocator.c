/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"

typedef struct header {
  void *base;
  size_t size;
} header;

static void *allocate(void *user, size_t size, size_t alignment)
{
  test_allocator *a = user;
  a->requests++;
  if (a->requests == a->fail_at)
    return NULL;
  char *base = malloc(size + alignment + sizeof(header));
  if (base == NULL)
    return NULL;
  uintptr_t at =
      ((uintptr_t)base + sizeof(header) + alignment - 1) / alignment * alignment;
  header h = {base, size};
  memcpy((void *)(at - sizeof h), &h, sizeof h);
  a->live++;
  a->bytes += size;
  if (a->bytes > a->peak)
    a->peak = a->bytes;
  return (void *)at;
}

static void release(void *user, void *block)
{
  test_allocator *a = user;
  header h;
  memcpy(&h, (char *)block - sizeof h, sizeof h);
  a->live--;
  a->bytes -= h.size;
  free(h.base);
}

packing_context *test_allocator_context(test_allocator *allocator)
{
  packing_context_def def;
  packing_context *context = NULL;
  packing_context_def_init(&def);
  def.threads = 1;
  def.allocator.allocate = allocate;
  def.allocator.release = release;
  def.allocator.user = allocator;
  assert_ok(packing_context_create(&def, &context));
  return context;
}

size_t test_every_allocation(test_scenario scenario)
{
  uint64_t undisturbed = 0;
  {
    test_allocator a = {0};
    packing_context *context = test_allocator_context(&a);
    assert_ok(scenario(context, &undisturbed));
    packing_context_destroy(context);
    assert_int_equal(a.live, 0);
  }
  for (size_t k = 1;; k++) {
    test_allocator a = {0};
    packing_context *context = test_allocator_context(&a);
    uint64_t hash = 0;
    const size_t live = a.live;
    a.fail_at = a.requests + k;
    const packing_status status = scenario(context, &hash);
    assert_int_equal(a.live, live);
    if (status == PACKING_OK) {
      assert_true(a.requests < a.fail_at); /* the failure was not swallowed */
      assert_true(hash == undisturbed);
      packing_context_destroy(context);
      return k - 1;
    }
    assert_int_equal(status, PACKING_ERR_NOMEM);
    assert_string_equal(packing_context_message(context), "out of memory");
    assert_ok(scenario(context, &hash)); /* the retry */
    assert_true(hash == undisturbed);
    packing_context_destroy(context);
    assert_int_equal(a.live, 0);
  }
}
