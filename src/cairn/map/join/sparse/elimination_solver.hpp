// SPDX-License-Identifier: BSD-3-Clause
// Covariances from the fronts of an elimination tree.
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "map/join/sparse/elimination_pass.hpp"
#include "map/join/sparse/elimination_visitors.hpp"

namespace cairn {

// The covariance of some combinations a^T e of the errors e of the variables. With H = L L^T it is Y^T Y, where
// L Y = A (docs/submaps.md, eq. P3), and only the fronts between the variables and the crown hold a part of Y: there is
// no way down. As a product of Y with itself it is never negative.
template <class Pose>
class CombinationSolver {
 public:
  using Matrix = Eigen::MatrixXd;

  // `eliminated_at`: by variable, the bit of the front that eliminates it.
  CombinationSolver(const std::vector<TreeCombinations>& combinations, const std::vector<std::int16_t>& eliminated_at);

  // Of all combinations, in the order in which they are given.
  Matrix covariance(const TreeFront& crown);

 private:
  Matrix forward(const TreeFront& front, TouchIterator begin, TouchIterator end);
  std::size_t position(TouchIterator touch) const {
    return static_cast<std::size_t>(touch - TouchIterator(touches_.begin()));
  }

  const std::vector<TreeCombinations>& combinations_;
  const std::vector<std::int16_t>& eliminated_at_;
  std::vector<TreeTouch> touches_;  // sorted by key, so that the columns of a subtree are neighbours
  std::vector<std::size_t> order_;  // of `combinations_`, in the order of the touches
  std::vector<Index> first_;        // column of each touch, and the number of all columns
  Matrix products_;                 // Y^T Y, lower triangle
};

// Covariances of the leaves that are touched, by selected inversion. `boundary` is the covariance of the front's
// boundary.
template <class Pose>
void invert_selected(const TreeFront& front, const Eigen::MatrixXd& boundary, TouchIterator begin, TouchIterator end,
                     TreeCovariances& visitor);

extern template class CombinationSolver<SE2>;
extern template class CombinationSolver<SE3>;

}  // namespace cairn
