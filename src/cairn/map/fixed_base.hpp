// SPDX-License-Identifier: BSD-3-Clause
// Absolute fixes in a submap: what they tell about its base, and how the submap's estimates depend on the error of the
// base (docs/submaps.md, "Fixes"). The error is the ordinary one, [dp; dtheta] in the axes of the map, against the pose
// that the map had for the base when the submap began.
#pragma once

#include <vector>

#include "map/shared_errors.hpp"
#include "map/submap.hpp"

namespace cairn {

template <class Pose>
struct FixedBase {
  using Tangent = typename Pose::Tangent;

  // From the last kDof of a submap's shared errors; the others stay uncertain.
  FixedBase(const Pose& base, const SubmapErrors& errors);

  Tangent error(const Pose& base) const { return pose_error(base, at); }
  // Corrects the base, points, and their joint covariance P of [base; points; anything else], by what the fixes told.
  // Points are those of the map that stand first.
  void correct(Pose& base, std::vector<typename Pose::Point>& points, Eigen::MatrixXd& P) const;
  // Rows of estimates whose covariance with the base's error is `cross`: they move by K (error - value).
  Eigen::MatrixXd gain(const Eigen::MatrixXd& cross) const;

  Pose at;
  Tangent value;  // estimate of the error
  typename Pose::Square covariance;
  ErrorRows found;
};

extern template struct FixedBase<SE2>;
extern template struct FixedBase<SE3>;

}  // namespace cairn
