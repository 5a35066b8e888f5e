// SPDX-License-Identifier: BSD-3-Clause
// A closed submap: what its filter knows of the vehicle's end pose and of its landmarks, in the frame of its base, the
// pose at which it began. The base is the origin, known exactly: nothing in here is shared with any other submap.
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
  std::vector<std::uint64_t> ids;  // in the order of their placing
  std::vector<std::uint64_t> counts;
  std::vector<typename Pose::Point> landmarks;
  Eigen::MatrixXd covariance;  // of [end pose; landmarks], in the filter's own error coordinates

  Eigen::Index size() const { return static_cast<Eigen::Index>(ids.size()); }
};

// The landmarks `i` of a submap whose coordinates of the error shall be ordinary ones: e_l = xi_l + G(l) xi_R. Its rows
// and columns of the covariance are turned; the others stay in the filter's own coordinates.
template <class Pose>
void to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& covariance);

}  // namespace cairn
