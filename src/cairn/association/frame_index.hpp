// SPDX-License-Identifier: BSD-3-Clause
// The observations of a frame, sorted by one of their values. The observations near a predicted value are found without
// a pass over all observations.
#pragma once

#include <algorithm>

#include "core/arena.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

class FrameIndex {
 public:
  FrameIndex(Arena& arena, Index capacity) : entries_(arena.take<Entry>(static_cast<std::size_t>(capacity))) {}

  // Sorts by value(observation), which must be finite. O(m log m) for m observations.
  template <class Value>
  void build(Index count, Value&& value) {
    count_ = count;
    for (Index i = 0; i < count; ++i) entries_[i] = {value(i), i};
    std::sort(entries_, entries_ + count, [](const Entry& a, const Entry& b) { return a.value < b.value; });
  }

  // Visits the observations whose value lies in [centre - reach, centre + reach]; all of them if the reach is infinite.
  // O(log m) plus the number of visited observations.
  template <class Visit>
  void near(double centre, double reach, Visit&& visit) const {
    const Entry *const begin = entries_, *const end = begin + count_;
    const Entry* entry =
        std::lower_bound(begin, end, centre - reach, [](const Entry& e, double least) { return e.value < least; });
    for (; entry != end && entry->value <= centre + reach; ++entry) visit(entry->observation);
  }

 private:
  struct Entry {
    double value;
    Index observation;
  };
  Entry* entries_;
  Index count_ = 0;
};

}  // namespace cairn
