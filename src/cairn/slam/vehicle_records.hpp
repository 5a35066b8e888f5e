// SPDX-License-Identifier: BSD-3-Clause
// Records that a class keeps for each vehicle of a filter. A record has the members `vehicle` and `used`.
#pragma once

#include <cstdint>

#include "linear/small_algebra.hpp"

namespace cairn {

template <class Record>
bool belongs(const Record& record, std::uint64_t vehicle) {
  return record.used && record.vehicle == vehicle;
}

// The record of the vehicle among `count`. If it has none, the first unused one, else the last one: the caller sets it
// anew. O(count).
template <class Record>
Record& record_of(Record* records, Index count, std::uint64_t vehicle) {
  Index k = 0;
  while (k < count - 1 && records[k].used && records[k].vehicle != vehicle) ++k;
  return records[k];
}

}  // namespace cairn
