// SPDX-License-Identifier: BSD-3-Clause
// Points that are known in two frames, with their covariances.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"

namespace cairn {

// Covariance of k points: a 3x3 block for each point if the points are independent, otherwise the full 3k x 3k matrix,
// which is symmetric. `full` is used if it is not empty.
struct PointsCovariance {
  std::vector<Matrix3> blocks;
  std::vector<double> full;
  // `full` as a matrix of `count` points.
  Eigen::Map<const Eigen::MatrixXd> matrix(std::size_t count) const;
};

// Point i of frame a is point i of frame b; the errors of a and of b are independent.
struct PairedPoints {
  std::vector<Vector3> a, b;
  PointsCovariance covariance_a, covariance_b;
  std::size_t size() const { return a.size(); }
};

// The first row of point i in a vector or matrix of all points.
inline Eigen::Index row_of_point(std::size_t i) {
  return 3 * static_cast<Eigen::Index>(i);
}

// The pairs with these numbers, and their part of the covariances.
PairedPoints select_pairs(const PairedPoints& pairs, const std::vector<std::size_t>& which);

}  // namespace cairn
