// SPDX-License-Identifier: BSD-3-Clause
// Names of the small fixed-size matrices that every layer uses.
#pragma once

#include <Eigen/Core>

namespace cairn {

using Vector1 = Eigen::Matrix<double, 1, 1>;
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix32 = Eigen::Matrix<double, 3, 2>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;

}  // namespace cairn
