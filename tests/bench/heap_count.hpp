// SPDX-License-Identifier: BSD-3-Clause
// Counts the heap allocations of a program: heap_count.cpp replaces the allocator of the C library.
#pragma once

#include <cstddef>

namespace bench {

// Number of allocations since the program started, by any library in it.
std::size_t heap_allocations();

}  // namespace bench
