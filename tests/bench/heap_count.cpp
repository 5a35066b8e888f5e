// SPDX-License-Identifier: BSD-3-Clause
// glibc lets a program replace the functions of the allocator, for itself and for all libraries that it loads. The
// original functions stay reachable by these names. operator new calls malloc and is counted there.
#include "heap_count.hpp"

#include <atomic>
#include <cerrno>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {
std::atomic<std::size_t> count{0};
void counted() {
  count.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

namespace bench {
std::size_t heap_allocations() {
  return count.load(std::memory_order_relaxed);
}
}  // namespace bench

#pragma GCC visibility push(default)
extern "C" {

void* malloc(std::size_t size) {
  counted();
  return __libc_malloc(size);
}

void* calloc(std::size_t number, std::size_t size) {
  counted();
  return __libc_calloc(number, size);
}

void* realloc(void* block, std::size_t size) {
  counted();
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  counted();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  counted();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  counted();
  void* const memory = __libc_memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *block = memory;
  return 0;
}

}  // extern "C"
#pragma GCC visibility pop
