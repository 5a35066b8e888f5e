// SPDX-License-Identifier: BSD-3-Clause
// A cumulative sum that does not fall below zero: steps that have a negative mean while all is well, and a positive one
// once it is not (docs/trust.md, eq. 8 and 12).
#pragma once

#include <algorithm>

namespace cairn {

class CumulativeSum {
 public:
  void add(double step, double bound) { sum_ = std::min(kCeiling * bound, std::max(0.0, sum_ + step)); }
  bool found(double bound) const { return sum_ > bound; }
  bool at_zero() const { return sum_ == 0.0; }

 private:
  static constexpr double kCeiling = 1.25;  // of the bound: the sum falls below it soon after the fault has ended

  double sum_ = 0.0;
};

}  // namespace cairn
