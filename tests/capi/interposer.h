/* SPDX-License-Identifier: BSD-3-Clause */
/* Replaces the allocator of the C library (glibc) in a test program: it counts requests and can refuse them. Include it
 * in only one file of a program. */
#ifndef CAIRN_TESTS_CAPI_INTERPOSER_H
#define CAIRN_TESTS_CAPI_INTERPOSER_H

#include <errno.h>
#include <malloc.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* block, size_t size);
extern void* __libc_memalign(size_t alignment, size_t size);
extern void __libc_free(void* block);

#define VISIBLE __attribute__((visibility("default"), noinline))

static struct {
  bool armed, follow; /* follow: track the blocks, so that `live` and `peak` are right */
  size_t calls;       /* calls that allocated or freed memory */
  size_t fail_at;     /* number of the request that fails; 0: none fails */
  bool for_good;      /* all later requests fail too */
  bool failed;
  size_t live, peak; /* bytes allocated and not freed */
  size_t count;
  struct {
    void* block;
    size_t size;
  } blocks[4096];
} counter;

static inline void arm(void) {
  memset(&counter, 0, sizeof counter);
  counter.follow = true;
  counter.armed = true;
}

/* Lets request number `at` fail, counted from 1, and with `for_good` also all later ones. */
static inline void arm_to_fail(size_t at, bool for_good) {
  memset(&counter, 0, offsetof(__typeof__(counter), blocks));
  counter.fail_at = at;
  counter.for_good = for_good;
  counter.armed = true;
}

static void* taken(void* block, size_t size) {
  if (!counter.armed || block == NULL) return block;
  ++counter.calls;
  if (!counter.follow) return block;
  if (counter.count == sizeof counter.blocks / sizeof counter.blocks[0]) abort();
  counter.blocks[counter.count].block = block, counter.blocks[counter.count++].size = size;
  counter.live += size;
  if (counter.live > counter.peak) counter.peak = counter.live;
  return block;
}

static void given(void* block) {
  if (!counter.armed || block == NULL) return;
  ++counter.calls;
  for (size_t i = 0; counter.follow && i < counter.count; ++i)
    if (counter.blocks[i].block == block) {
      counter.live -= counter.blocks[i].size;
      counter.blocks[i] = counter.blocks[--counter.count];
      return;
    }
}

static bool refused(void) {
  if (!counter.armed || counter.fail_at == 0) return false;
  if (counter.fail_at > 1) {
    --counter.fail_at;
    return false;
  }
  counter.failed = true;
  if (!counter.for_good) counter.fail_at = 0;
  return true;
}

/* operator new(std::size_t, std::nothrow_t const &): its callers (std::stable_sort) can work without memory. While
 * requests may fail it always returns null, and this does not count as a refusal. */
VISIBLE void* _ZnwmRKSt9nothrow_t(size_t size, const void* nothrow);
VISIBLE void* _ZnwmRKSt9nothrow_t(size_t size, const void* nothrow) {
  (void)nothrow;
  if (counter.armed && !counter.follow && counter.fail_at != 0) return NULL;
  return taken(__libc_malloc(size), size);
}

VISIBLE void* malloc(size_t size) {
  return refused() ? NULL : taken(__libc_malloc(size), size);
}
VISIBLE void* calloc(size_t count, size_t size) {
  return refused() ? NULL : taken(__libc_calloc(count, size), count * size);
}
VISIBLE void* realloc(void* block, size_t size) {
  if (refused()) return NULL;
  given(block);
  return taken(__libc_realloc(block, size), size);
}
VISIBLE void* memalign(size_t alignment, size_t size) {
  return refused() ? NULL : taken(__libc_memalign(alignment, size), size);
}
VISIBLE void* aligned_alloc(size_t alignment, size_t size) {
  return memalign(alignment, size);
}
VISIBLE int posix_memalign(void** block, size_t alignment, size_t size) {
  *block = memalign(alignment, size);
  return *block == NULL ? ENOMEM : 0;
}
VISIBLE void free(void* block) {
  given(block);
  __libc_free(block);
}

#endif
