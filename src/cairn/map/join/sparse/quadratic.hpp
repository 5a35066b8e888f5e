// SPDX-License-Identifier: BSD-3-Clause
// The cost of a factor, taken as quadratic about some values of its variables.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "linear/small_algebra.hpp"

namespace cairn {

// constant + gradient^T e + e^T information e / 2, for errors e of the values.
struct Quadratic {
  Eigen::MatrixXd information;  // symmetric, both triangles
  Eigen::VectorXd gradient;
  double constant = 0.0;
};

// From the Hessian's lower triangle and a gradient whose errors are in map axes to errors in these axes, in which the
// Hessian already is. The first `poses` errors are those of poses, the others of points.
template <class Pose>
Quadratic in_axes(Eigen::MatrixXd hessian, Eigen::VectorXd gradient, double cost, Index poses,
                  const typename Pose::Rotation& axes);

// Adds the cost of some of its errors, `from`, to errors `to` of the sum; all others are zero.
void add_part(const Quadratic& cost, const std::vector<Index>& from, const std::vector<Index>& to, Quadratic& sum);

// The cost of the errors `kept`, in this order, if those that are `gone` always are where it is least (docs/submaps.md,
// eq. F2).
Quadratic without(const Quadratic& cost, const std::vector<Index>& gone, const std::vector<Index>& kept);

}  // namespace cairn
