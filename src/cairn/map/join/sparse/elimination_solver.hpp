// SPDX-License-Identifier: BSD-3-Clause
// Solutions of H x = b, and covariances, from the fronts of an elimination tree.
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "map/join/sparse/elimination_pass.hpp"
#include "map/join/sparse/elimination_visitors.hpp"

namespace cairn {

template <class Pose>
class EliminationSolver {
 public:
  using Matrix = Eigen::MatrixXd;

  EliminationSolver(Index columns, TreeSystem& system) : columns_(columns), system_(system) {}

  // Solves with a whole tree; `touches` are sorted by key.
  void solve(const TreeFront& crown, const std::vector<TreeTouch>& touches);

 private:
  std::unique_ptr<TreePass> forward(const TreeFront& front, TouchIterator begin, TouchIterator end) const;
  void backward(const TreeFront& front, const TreePass* pass, Matrix& x, std::vector<char>& active);

  Index columns_;
  TreeSystem& system_;
};

// Covariances of the leaves that are touched, by selected inversion. `boundary` is the covariance of the front's
// boundary.
template <class Pose>
void invert_selected(const TreeFront& front, const Eigen::MatrixXd& boundary, TouchIterator begin, TouchIterator end,
                     TreeCovariances& visitor);

extern template class EliminationSolver<SE2>;
extern template class EliminationSolver<SE3>;

}  // namespace cairn
