// SPDX-License-Identifier: BSD-3-Clause
// Whether the observations of one landmark contradict the rest: a cumulative sum of its squared distances
// (docs/trust.md, eq. 8). A landmark that has moved, or that bears the name of another one, is refused at each
// sighting.
#pragma once

#include <algorithm>

#include "health/cumulative_sum.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

class Contradiction {
 public:
  // `distance`: squared Mahalanobis distance of an observation of `rows` values. Negative or NaN: as bad as can be.
  void add(double distance, Index rows) {
    sum_.add((distance >= 0.0 ? std::min(distance, kMost) : kMost) - kHonest * static_cast<double>(rows), kBound);
  }
  bool found() const { return sum_.found(kBound); }

 private:
  // With E[exp(t (d^2 - kHonest rows))] = 1 for t = 0.4 the sum of an honest landmark exceeds kBound with a probability
  // of about exp(-0.4 kBound) = 1e-7 at a sighting.
  static constexpr double kHonest = 2.0, kBound = 40.0;
  static constexpr double kMost = 25.0;  // three sightings are the least that convict a landmark

  CumulativeSum sum_;
};

}  // namespace cairn
