// SPDX-License-Identifier: BSD-3-Clause
// The limits of a submap.
#include "slam/submap_policy.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace cairn {

template <class Pose>
ClosedBy SubmapPolicy<Pose>::limit() const {
  using PointSquare = typename State<Pose>::PointSquare;
  constexpr int kDim = Pose::kDim;
  const State<Pose>& state = map_.state();
  const Index counting = map_.table().counting();
  if (counting >= options_.submap_landmarks) return ClosedBy::landmarks;
  if (counting == 0) return ClosedBy::none;
  // Contested landmarks do not count, but they take room.
  if (options_.deferred_sightings <= 1 && map_.table().landmarks() >= options_.local_landmarks())
    return ClosedBy::landmarks;
  if (options_.submap_distance > 0.0 && driven_ >= options_.submap_distance) return ClosedBy::distance;
  if (options_.submap_extent > 0.0)
    for (Index slot = 0; slot < state.size(); ++slot)
      if (state.landmark(slot).norm() >= options_.submap_extent) return ClosedBy::extent;
  if (options_.submap_sigma > 0.0) {
    const PointSquare P = state.pose_covariance().template topLeftCorner<kDim, kDim>();
    Eigen::SelfAdjointEigenSolver<PointSquare> solver;
    solver.computeDirect(P, Eigen::EigenvaluesOnly);
    if (solver.eigenvalues().maxCoeff() >= options_.submap_sigma * options_.submap_sigma) return ClosedBy::sigma;
  }
  return ClosedBy::none;
}

template <class Pose>
bool SubmapPolicy<Pose>::wait() {
  if (frames_to_wait_ == 0) return false;
  --frames_to_wait_;
  return true;
}

template <class Pose>
void SubmapPolicy<Pose>::put_off() {
  constexpr std::size_t kLongest = 64;
  frames_to_wait_ = next_wait_;
  next_wait_ = std::min<std::size_t>(2 * next_wait_, kLongest);
}

template <class Pose>
void SubmapPolicy<Pose>::restart() {
  driven_ = 0.0;
  frames_to_wait_ = 0;
  next_wait_ = 1;
}

template class SubmapPolicy<SE2>;
template class SubmapPolicy<SE3>;

}  // namespace cairn
