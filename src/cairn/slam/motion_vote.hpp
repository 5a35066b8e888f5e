// SPDX-License-Identifier: BSD-3-Clause
// The rigid motion of the vehicle on which most of several observations agree (docs/update.md, "Finding back").
#pragma once

#include <array>
#include <cstdint>

#include "linear/small_algebra.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

// What one observation says about the error e = [dp; dtheta] of the pose at `position`: r = J e + noise, whitened, so
// that the noise has unit covariance. Rows beyond rows() are zero.
template <class Pose>
struct Witness {
  using Rows = Eigen::Matrix<double, kMostRows, 1>;
  using ByPose = Eigen::Matrix<double, kMostRows, Pose::kDof>;

  int rows;
  std::uint64_t frame, source;  // source: of the landmark, or of the fix
  typename Pose::Point position;
  Rows r;
  ByPose J;

  // Whitens a residual and its Jacobian by the covariance S (lower triangle, leading dimension `ld`) of the residual.
  // Returns false if S is not positive definite.
  bool whiten(const double* residual, const ByPose& J_pose, const double* S, Index ld);
  // The same observation as a function of the pose's error at another position.
  void move_to(const typename Pose::Point& where);
  double distance(const typename Pose::Tangent& motion) const { return (r - J * motion).squaredNorm(); }
};

template <class Pose>
struct MotionVote {
  typename Pose::Tangent motion = Pose::Tangent::Zero();
  Index agreeing = 0;  // witnesses; 0: there is no motion on which they agree
};

using BoundsByRows = std::array<double, kMostRows + 1>;

// The motion that brings the largest number of witnesses within the bound of their number of rows. Hypotheses come from
// single witnesses and from pairs; the best one is refined over the witnesses that agree with it. O(count).
template <class Pose>
MotionVote<Pose> vote_motion(const Witness<Pose>* witnesses, Index count, const BoundsByRows& bounds);

}  // namespace cairn
