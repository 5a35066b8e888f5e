// SPDX-License-Identifier: BSD-3-Clause
// The information of a submap factor, with both triangles.
#pragma once

#include <vector>

#include "map/join/sparse/submap_factor.hpp"

namespace cairn::test {

template <class Pose>
Eigen::MatrixXd whole_hessian(const SubmapFactor<Pose>& factor, const FactorValues<Pose>& values,
                              const std::vector<typename Pose::Rotation>& axes) {
  return factor.hessian(values, axes).template selfadjointView<Eigen::Lower>();
}
// The errors are in the axes of the map.
template <class Pose>
Eigen::MatrixXd whole_hessian(const SubmapFactor<Pose>& factor, const FactorValues<Pose>& values) {
  return whole_hessian(factor, values, std::vector<typename Pose::Rotation>(2 + factor.shared().size()));
}

}  // namespace cairn::test
