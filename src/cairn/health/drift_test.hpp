// SPDX-License-Identifier: BSD-3-Clause
// Whether the corrections of the pose have a mean: motion with a constant error is corrected the same way each time
// (docs/trust.md, eq. 9).
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

template <class Pose>
class DriftTest {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Square = typename Pose::Square;

  // An update: the pose and the covariance of its ordinary error before it and after it.
  void add(const Pose& before, const Square& P_before, const Pose& after, const Square& P_after) {
    const typename Pose::Rotation to_body = after.rotation().inverse();
    const typename Pose::Rotation::Matrix R = to_body.matrix();
    const typename Pose::Rotation::Jacobian A = to_body.adjoint();
    const typename Pose::Tangent error = pose_error(after, before);
    typename Pose::Tangent correction, learned;  // the latter: the diagonal of the covariance of the former
    correction << R * error.template head<kDim>(), A * error.template tail<kTurn>();
    const Square reduction = P_before - P_after;
    learned << diagonal(R, reduction.template topLeftCorner<kDim, kDim>()),
        diagonal(A, reduction.template bottomRightCorner<kTurn, kTurn>());
    for (int i = 0; i < kDof; ++i) {
      const double variance = std::max(0.0, learned(i));
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
  // Of R P R^T.
  template <class Turn, class Block>
  static auto diagonal(const Turn& R, const Block& P) {
    return R.lazyProduct(P).cwiseProduct(R).rowwise().sum().eval();
  }

  static constexpr double kKeep = 0.95;  // about twenty updates count

  typename Pose::Tangent sum_ = Pose::Tangent::Zero(), variance_ = Pose::Tangent::Zero();
};

}  // namespace cairn
