// SPDX-License-Identifier: BSD-3-Clause
// Whether the corrections of the pose have a mean: motion with a constant error is corrected the same way each time
// (docs/trust.md, eq. 9).
#pragma once

#include <algorithm>
#include <cmath>

#include "health/correction.hpp"

namespace cairn {

template <class Pose>
class DriftTest {
 public:
  void add(const Correction<Pose>& correction) {
    const typename Pose::Tangent rounding = correction.rounding();
    for (int i = 0; i < Pose::kDof; ++i) {
      const double variance = std::max(0.0, correction.covariance(i, i)) + rounding(i);
      if (!std::isfinite(correction.value(i)) || !std::isfinite(variance)) continue;
      sum_(i) = kKeep * sum_(i) + correction.value(i);
      variance_(i) = kKeep * kKeep * variance_(i) + variance;
    }
  }
  // The largest mean of an axis, in its standard deviations.
  double sigmas() const {
    double most = 0.0;
    for (int i = 0; i < Pose::kDof; ++i)
      if (variance_(i) > 0.0) most = std::max(most, std::abs(sum_(i)) / std::sqrt(variance_(i)));
    return most;
  }

 private:
  static constexpr double kKeep = 0.95;  // about twenty updates count

  typename Pose::Tangent sum_ = Pose::Tangent::Zero(), variance_ = Pose::Tangent::Zero();
};

}  // namespace cairn
