// SPDX-License-Identifier: BSD-3-Clause
// The points of one map, as the search for a correspondence sees them.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "geometry/se3.hpp"

namespace cairn {

struct PointSet {
  std::vector<Vector3> points;
  std::vector<Matrix3> covariances;  // of each point
  // Joint covariance of `count` of the points, 3 count x 3 count, symmetric. It may be absent. Then the points count as
  // independent, although the points of a map are not. With it, a map whose frame is uncertain is still as sharp as its
  // points are relative to each other.
  std::function<void(const std::size_t* indices, std::size_t count, double* matrix)> joint;
};

}  // namespace cairn
