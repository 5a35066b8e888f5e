// SPDX-License-Identifier: BSD-3-Clause
// A closed submap: the estimate of the vehicle's end pose and of the submap's landmarks, with their covariance, in the
// frame of its base. The base is the pose at which the submap began. It is the origin and known exactly: the errors of
// a submap are independent of all other submaps.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ekf/error_model.hpp"

namespace cairn {

template <class Pose>
struct Submap {
  ErrorKind error = ErrorKind::invariant;
  Pose T_base_end;
  std::vector<std::uint64_t> ids;  // in the order in which they were placed
  std::vector<std::uint64_t> counts;
  std::vector<typename Pose::Point> landmarks;
  Eigen::MatrixXd covariance;  // of [end pose; landmarks], in the filter's own error coordinates

  Eigen::Index size() const { return static_cast<Eigen::Index>(ids.size()); }
};

// Converts the errors of the given landmarks of a submap to ordinary errors: e_l = xi_l + G(l) xi_R. Their rows and
// columns of the covariance change; the others stay in the filter's own error coordinates.
template <class Pose>
void to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& covariance);

}  // namespace cairn
