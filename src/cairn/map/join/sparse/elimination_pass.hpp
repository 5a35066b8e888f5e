// SPDX-License-Identifier: BSD-3-Clause
// Shared by the passes through the elimination tree: which fronts are touched, and the elimination of one front.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "map/join/sparse/elimination_front.hpp"

namespace cairn {

using TouchIterator = std::vector<TreeTouch>::const_iterator;

inline void sort_by_key(std::vector<TreeTouch>& touches) {
  std::stable_sort(touches.begin(), touches.end(),
                   [](const TreeTouch& a, const TreeTouch& b) { return a.key < b.key; });
}

// Divides the touches of a front, sorted by key, among its children. A key that no leaf has yet leaves the tree at some
// front and touches nothing below it.
struct TouchHalves {
  TouchHalves(const TreeFront& front, TouchIterator begin, TouchIterator end) : bounds{begin, end, end} {
    const auto elsewhere = [&](const TreeTouch& touch) { return touch.key.split(front.key) < front.bit; };
    while (bounds[0] != end && elsewhere(*bounds[0])) ++bounds[0];
    while (bounds[2] != bounds[0] && elsewhere(*(bounds[2] - 1))) --bounds[2];
    bounds[1] = bounds[2];
    if (front.bit != TreeFront::kCrown)
      bounds[1] = std::find_if(bounds[0], bounds[2], [&](const TreeTouch& touch) { return touch.key.bit(front.bit); });
  }
  bool touch(const TreeFront& child, int side) const {
    return std::any_of(bounds[side], bounds[side + 1], [&](const TreeTouch& touch) {
      return touch.bit >= child.bit && touch.key.split(child.key) >= child.bit;
    });
  }
  TouchIterator bounds[3];
};

// The result of the forward pass at a front that was touched.
struct TreePass {
  Eigen::MatrixXd y;      // L_EE^-1 b
  Eigen::MatrixXd above;  // contribution to the boundary
  bool stirs = false;
  std::unique_ptr<TreePass> child[2];

  // Adds the contribution of the child on a side to these rows.
  template <class Columns>
  void add_child(int side, const std::vector<Index>& map, Columns& b) const {
    const Eigen::MatrixXd& up = child[side]->above;
    for (Index c = 0; c < b.cols(); ++c)
      for (std::size_t i = 0; i < map.size(); ++i) b(map[i], c) += up(static_cast<Index>(i), c);
  }
  template <class Columns>
  void eliminate(const TreeFront& front, const Columns& b) {
    y = front.eliminated_block().triangularView<Eigen::Lower>().solve(b.topRows(front.e));
    above = b.bottomRows(front.b);
    above.noalias() -= front.boundary_block() * y;
  }
};

// Computes the solution of a front's eliminated variables from y and the solution of its boundary.
template <class Columns, class Boundary>
void substitute(const TreeFront& front, const Boundary& boundary, Columns& y) {
  y.noalias() -= front.boundary_block().transpose() * boundary;
  front.eliminated_block().transpose().triangularView<Eigen::Upper>().solveInPlace(y);
}

}  // namespace cairn
