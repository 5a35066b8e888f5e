// SPDX-License-Identifier: BSD-3-Clause
// Whether the corrections of the pose have a mean: motion with a constant error is corrected the same way each time
// (docs/trust.md, eq. 9).
#pragma once

#include <cmath>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

template <class Pose>
class DriftTest {
 public:
  static constexpr int kDof = Pose::kDof;
  using Square = typename Pose::Square;

  // An update: the pose and the covariance of its ordinary error before it and after it.
  void add(const Pose& before, const Square& P_before, const Pose& after, const Square& P_after) {
    const Square to_body = Pose::turn_axes(after.rotation().inverse());
    const typename Pose::Tangent correction = to_body * pose_error(after, before);
    const Square learned = to_body * (P_before - P_after) * to_body.transpose();
    for (int i = 0; i < kDof; ++i) {
      const double variance = std::max(0.0, learned(i, i));
      if (!std::isfinite(correction(i)) || !std::isfinite(variance)) continue;
      sum_(i) = kKeep * sum_(i) + correction(i);
      variance_(i) = kKeep * kKeep * variance_(i) + variance;
    }
  }
  // The largest mean of an axis, in its standard deviations.
  double sigmas() const {
    double most = 0.0;
    for (int i = 0; i < kDof; ++i)
      if (variance_(i) > 0.0) most = std::max(most, std::abs(sum_(i)) / std::sqrt(variance_(i)));
    return most;
  }

 private:
  static constexpr double kKeep = 0.95;  // about twenty updates count

  typename Pose::Tangent sum_ = Pose::Tangent::Zero(), variance_ = Pose::Tangent::Zero();
};

}  // namespace cairn
