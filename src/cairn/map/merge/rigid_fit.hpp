// SPDX-License-Identifier: BSD-3-Clause
// The closed-form rigid transform between two sets of points. The iterations of align() begin there.
#pragma once

#include <vector>

#include "geometry/se3.hpp"

namespace cairn {

// Weighted least squares (Horn 1987, by the singular vectors of Umeyama 1991): a rotation, never a reflection.
// Returns false for fewer than three points, and for points that lie exactly on a line.
bool align_by_weights(const std::vector<Vector3>& a, const std::vector<Vector3>& b, const std::vector<double>& weights,
                      SE3& T_a_b);

}  // namespace cairn
