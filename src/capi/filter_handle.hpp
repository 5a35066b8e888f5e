// SPDX-License-Identifier: BSD-3-Clause
// What the files behind cairn/filter.h share.
#pragma once

#include <vector>

#include "capi/guard.hpp"

namespace cairn {
namespace capi {

inline Filter& read_filter(cairn_filter* filter) {
  check_pointer(filter, "filter");
  return filter->filter;
}
inline const Filter& read_filter(const cairn_filter* filter) {
  check_pointer(filter, "filter");
  return filter->filter;
}

// Indices of landmarks by their ids; an unknown one or one that comes twice is refused.
std::vector<std::size_t> read_ids(const Landmarks& map, const std::uint64_t* ids, std::size_t count);

}  // namespace capi
}  // namespace cairn
