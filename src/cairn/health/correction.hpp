// SPDX-License-Identifier: BSD-3-Clause
// How an update corrected the pose, in the axes of the body. If the filter is consistent, corrections are independent,
// and each has the covariance that the update took off (docs/trust.md, eq. 9 and 10).
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

template <class Pose>
struct Correction {
  using Square = typename Pose::Square;
  using Tangent = typename Pose::Tangent;

  Correction() = default;
  // The pose and the covariance of its ordinary error before an update and after it.
  Correction(const Pose& before, const Square& P_before, const Pose& after, const Square& P_after);
  // Independent numbers of unit variance: L^-1 value with L L^T = covariance. Returns false if there are none. A
  // direction that the update did not correct gets zero.
  bool whiten(Tangent& white) const;
  // Variance that rounding may leave in the covariance, and that nothing is known about.
  Tangent rounding() const { return 1e-9 * prior; }

  Tangent value = Tangent::Zero();
  Square covariance = Square::Zero();
  Tangent prior = Tangent::Zero();  // the size of the variances whose difference the covariance is
};

extern template struct Correction<SE2>;
extern template struct Correction<SE3>;

}  // namespace cairn
