// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_solver.hpp"

#include <algorithm>

namespace cairn {
namespace {

using Matrix = Eigen::MatrixXd;

std::vector<char> boundary_flags(const TreeFront& front, const TreeFront& child, const std::vector<char>& active) {
  std::vector<char> flags(child.eliminated.size(), 0);
  std::size_t j = 0;
  for (const Variable v : child.boundary) {
    const auto found = front.bit == TreeFront::kCrown
                           ? std::find(front.eliminated.begin(), front.eliminated.end(), v)
                           : std::lower_bound(front.eliminated.begin(), front.eliminated.end(), v);
    if (found != front.eliminated.end() && *found == v) {
      flags.push_back(active[static_cast<std::size_t>(found - front.eliminated.begin())]);
      continue;
    }
    while (front.boundary[j] != v) ++j;
    flags.push_back(active[front.eliminated.size() + j]);
  }
  return flags;
}

Matrix chosen(const Matrix& covariance, const std::vector<Index>& map) {
  const auto n = static_cast<Index>(map.size());
  Matrix part(n, n);
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < n; ++r) part(r, c) = covariance(map[r], map[c]);
  return part;
}

}  // namespace

template <class Pose>
void EliminationSolver<Pose>::solve(const TreeFront& crown, const std::vector<TreeTouch>& touches) {
  const auto pass = forward(crown, touches.begin(), touches.end());
  Matrix x(crown.e, columns_);
  std::vector<char> active(crown.eliminated.size(), 0);
  backward(crown, pass.get(), x, active);
}

template <class Pose>
std::unique_ptr<TreePass> EliminationSolver<Pose>::forward(const TreeFront& front, TouchIterator begin,
                                                           TouchIterator end) const {
  auto pass = std::make_unique<TreePass>();
  Matrix b = Matrix::Zero(front.e + front.b, columns_);
  const TouchHalves halves(front, begin, end);
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const TreeFront& child = *front.child[side];
    if (child.leaf() || !halves.touch(child, side)) continue;
    pass->child[side] = forward(child, halves.bounds[side], halves.bounds[side + 1]);
    pass->add_child(side, state_map<Pose>(child.boundary, front), b);
  }
  Index at = 0;
  for (const Variable v : front.eliminated) {
    system_.right_hand_side(v, b.data() + at, front.e + front.b);
    at += dimension<Pose>(v);
  }
  pass->eliminate(front, b);
  return pass;
}

// `x` holds the solution of the boundary in its lower rows; `active` tells for each of the front's variables whether it
// is a reason to go on below.
template <class Pose>
void EliminationSolver<Pose>::backward(const TreeFront& front, const TreePass* pass, Matrix& x,
                                       std::vector<char>& active) {
  Matrix y = pass != nullptr ? pass->y : Matrix(Matrix::Zero(front.e, columns_));
  substitute(front, x.bottomRows(front.b), y);
  x.topRows(front.e) = y;
  Index at = 0;
  for (std::size_t i = 0; i < front.eliminated.size(); ++i) {
    const Variable v = front.eliminated[i];
    active[i] = system_.solution(v, x.data() + at, front.e + front.b);
    at += dimension<Pose>(v);
  }
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const TreeFront& child = *front.child[side];
    if (child.leaf()) continue;
    const TreePass* below = pass != nullptr ? pass->child[side].get() : nullptr;
    std::vector<char> child_active = boundary_flags(front, child, active);
    if (below == nullptr && std::none_of(child_active.begin(), child_active.end(), [](char a) { return a != 0; }))
      continue;
    const std::vector<Index> map = state_map<Pose>(child.boundary, front);
    Matrix x_child(child.e + child.b, columns_);
    for (Index c = 0; c < columns_; ++c)
      for (std::size_t i = 0; i < map.size(); ++i) x_child(child.e + static_cast<Index>(i), c) = x(map[i], c);
    backward(child, below, x_child, child_active);
  }
}

// With K = L_BE L_EE^-1:  Sigma_BE = -Sigma_BB K,  Sigma_EE = (L_EE L_EE^T)^-1 + K^T Sigma_BB K.
template <class Pose>
void invert_selected(const TreeFront& front, const Matrix& boundary, TouchIterator begin, TouchIterator end,
                     TreeCovariances& visitor) {
  if (front.leaf()) {
    visitor.leaf(front.key.leaf, boundary);
    return;
  }
  Matrix covariance(front.e + front.b, front.e + front.b);
  const auto L = front.eliminated_block().triangularView<Eigen::Lower>();
  Matrix inverse = L.solve(Matrix::Identity(front.e, front.e));
  const Matrix K = front.boundary_block() * inverse;
  const Matrix SK = boundary * K;
  covariance.topLeftCorner(front.e, front.e).noalias() = inverse.transpose() * inverse;
  covariance.topLeftCorner(front.e, front.e).noalias() += K.transpose() * SK;
  covariance.bottomLeftCorner(front.b, front.e) = -SK;
  covariance.topRightCorner(front.e, front.b) = -SK.transpose();
  covariance.bottomRightCorner(front.b, front.b) = boundary;
  const TouchHalves halves(front, begin, end);
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const TreeFront& child = *front.child[side];
    if (halves.bounds[side] == halves.bounds[side + 1]) continue;
    invert_selected<Pose>(child, chosen(covariance, state_map<Pose>(child.boundary, front)), halves.bounds[side],
                          halves.bounds[side + 1], visitor);
  }
}

template class EliminationSolver<SE2>;
template class EliminationSolver<SE3>;
template void invert_selected<SE2>(const TreeFront&, const Matrix&, TouchIterator, TouchIterator, TreeCovariances&);
template void invert_selected<SE3>(const TreeFront&, const Matrix&, TouchIterator, TouchIterator, TreeCovariances&);

}  // namespace cairn
