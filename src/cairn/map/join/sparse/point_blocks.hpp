// SPDX-License-Identifier: BSD-3-Clause
// Blocks of points in the Hessian of a factor.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "linear/small_algebra.hpp"

namespace cairn {

// Puts D_i^T Lambda_ij D_j into H for all points i >= j, where D_i is the derivative of the rows of point i by its
// error. The points' rows begin at `first` in the information Lambda, whose blocks on the diagonal are complete, and at
// `column` in H.
template <class PointSquare>
void put_point_blocks(const Eigen::MatrixXd& information, Index first, const std::vector<PointSquare>& D, Index column,
                      Eigen::MatrixXd& H) {
  constexpr int kDim = PointSquare::RowsAtCompileTime;
  const auto points = static_cast<Index>(D.size());
  Eigen::MatrixXd strip(kDim * points, kDim);
  for (Index j = 0; j < points; ++j) {
    const Index row = first + kDim * j, below = kDim * (points - j);
    strip.topRows(below).noalias() =
        information.block(row, row, below, kDim).lazyProduct(D[static_cast<std::size_t>(j)]);
    for (Index i = j; i < points; ++i)
      H.template block<kDim, kDim>(column + kDim * i, column + kDim * j).noalias() =
          D[static_cast<std::size_t>(i)].transpose() * strip.template middleRows<kDim>(kDim * (i - j));
  }
}

}  // namespace cairn
