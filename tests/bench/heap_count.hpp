// SPDX-License-Identifier: BSD-3-Clause
// Counts what a program takes from the heap: heap_count.cpp stands in for the C library's allocator.
#pragma once

#include <cstddef>

namespace bench {

// Allocations of this program since it started, by any library in it.
std::size_t heap_allocations();

}  // namespace bench
