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
//
// If the observation places a point, r may be the whitened difference between a known point and the point that it
// places `arm` beside the vehicle. Then r = J_p (dp + Exp(dtheta) arm - arm) + noise holds for errors of any size.
template <class Pose>
struct Witness {
  using Rows = Eigen::Matrix<double, kMostRows, 1>;
  using ByPose = Eigen::Matrix<double, kMostRows, Pose::kDof>;

  int rows;
  std::uint64_t frame, source;  // source: of the landmark, or of the fix
  typename Pose::Point position;
  Rows r;
  ByPose J;
  bool placed;  // the second form
  typename Pose::Point arm;

  // Whitens a residual and its Jacobian by the covariance S (lower triangle, leading dimension `ld`) of the residual.
  // Returns false if S is not positive definite.
  bool whiten(const double* residual, const ByPose& J_pose, const double* S, Index ld);
  // The same observation as a function of the pose's error at another position.
  void move_to(const typename Pose::Point& where);
  Rows residual(const typename Pose::Tangent& motion) const;
  ByPose jacobian(const typename Pose::Tangent& motion) const;
  double distance(const typename Pose::Tangent& motion) const { return residual(motion).squaredNorm(); }
  // A witness of the second form, from the covariance of `difference`.
  bool place(const typename Pose::Point& difference, const typename Pose::Point& from_vehicle,
             const Eigen::Matrix<double, Pose::kDim, Pose::kDim>& covariance);
};

template <class Pose>
struct MotionVote {
  typename Pose::Tangent motion = Pose::Tangent::Zero();
  Index agreeing = 0;  // witnesses; 0: there is no motion on which they agree
};

// The weakest knowledge that makes a motion unique: a variance for each freedom, scaled by what the witnesses know. A
// freedom that they do not see gets no motion.
template <class Pose>
typename Pose::Tangent weak_prior(const Witness<Pose>* witnesses, Index count);

// The least-squares motion of the witnesses for which chosen(number) holds.
template <class Pose, class Chosen>
typename Pose::Tangent fit_motion(const Witness<Pose>* witnesses, Index count, const typename Pose::Tangent& prior,
                                  Chosen&& chosen) {
  constexpr int kSteps = 12;         // Gauss and Newton; one step, if all witnesses are linear
  constexpr double kSettled = 1e-6;  // standard deviations, squared
  typename Pose::Tangent motion = Pose::Tangent::Zero();
  for (int step = 0; step < kSteps; ++step) {
    typename Pose::Square A = prior.asDiagonal();
    typename Pose::Tangent b = -prior.cwiseProduct(motion);
    bool linear = true;
    for (Index a = 0; a < count; ++a) {
      if (!chosen(a)) continue;
      const typename Witness<Pose>::ByPose J = witnesses[a].jacobian(motion);
      A += J.transpose() * J;
      b += J.transpose() * witnesses[a].residual(motion);
      linear = linear && !witnesses[a].placed;
    }
    const typename Pose::Tangent change = A.ldlt().solve(b);
    if (linear) return change;
    const typename Pose::Rotation turn = Pose::Rotation::exp(change.template tail<Pose::kTurn>()) *
                                         Pose::Rotation::exp(motion.template tail<Pose::kTurn>());
    motion += change;
    motion.template tail<Pose::kTurn>() = turn.log();
    if (change.dot(A * change) < kSettled) break;
  }
  return motion;
}

using BoundsByRows = std::array<double, kMostRows + 1>;

// The motion that brings the largest number of witnesses within the bound of their number of rows. Hypotheses come from
// single witnesses and from pairs; the best one is refined over the witnesses that agree with it. O(count).
template <class Pose>
MotionVote<Pose> vote_motion(const Witness<Pose>* witnesses, Index count, const BoundsByRows& bounds);

}  // namespace cairn
