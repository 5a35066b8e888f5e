// SPDX-License-Identifier: BSD-3-Clause
// A submap factor's information with both triangles.
#pragma once

#include <Eigen/Geometry>

#include "map/submap_factor.hpp"

namespace cairn::test {

inline Eigen::MatrixXd whole_hessian(const SubmapFactor& factor, const FactorValues& values,
                                     const std::vector<Matrix3>& axes) {
  return factor.hessian(values, axes).selfadjointView<Eigen::Lower>();
}
// By errors in the axes of the map.
inline Eigen::MatrixXd whole_hessian(const SubmapFactor& factor, const FactorValues& values) {
  return whole_hessian(factor, values, std::vector<Matrix3>(2 + factor.shared().size(), Matrix3::Identity()));
}

}  // namespace cairn::test
