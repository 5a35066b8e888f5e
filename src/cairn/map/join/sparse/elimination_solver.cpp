// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_solver.hpp"

#include <algorithm>
#include <numeric>

namespace cairn {
namespace {

using Matrix = Eigen::MatrixXd;

Matrix chosen(const Matrix& covariance, const std::vector<Index>& map) {
  const auto n = static_cast<Index>(map.size());
  Matrix part(n, n);
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < n; ++r) part(r, c) = covariance(map[r], map[c]);
  return part;
}

}  // namespace

template <class Pose>
CombinationSolver<Pose>::CombinationSolver(const std::vector<TreeCombinations>& combinations,
                                           const std::vector<std::int16_t>& eliminated_at)
    : combinations_(combinations), eliminated_at_(eliminated_at), order_(combinations.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    return combinations[a].touch.key < combinations[b].touch.key;
  });
  Index columns = 0;
  for (const std::size_t i : order_) {
    touches_.push_back(combinations[i].touch);
    first_.push_back(columns);
    columns += combinations[i].weights.cols();
  }
  first_.push_back(columns);
}

template <class Pose>
typename CombinationSolver<Pose>::Matrix CombinationSolver<Pose>::covariance(const TreeFront& crown) {
  products_.setZero(first_.back(), first_.back());
  forward(crown, touches_.begin(), touches_.end());
  std::vector<Index> given;  // column in `products_`, by the order in which the combinations are given
  std::vector<std::size_t> sorted(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) sorted[order_[i]] = i;
  for (const std::size_t i : sorted)
    for (Index c = first_[i]; c < first_[i + 1]; ++c) given.push_back(c);
  Matrix covariance(products_.rows(), products_.cols());
  for (Index c = 0; c < covariance.cols(); ++c)
    for (Index r = 0; r < covariance.rows(); ++r)
      covariance(r, c) = products_(std::max(given[r], given[c]), std::min(given[r], given[c]));
  return covariance;
}

// Adds the products of the columns that touch the front or fronts below it. Returns what they leave at the boundary.
template <class Pose>
typename CombinationSolver<Pose>::Matrix CombinationSolver<Pose>::forward(const TreeFront& front, TouchIterator begin,
                                                                          TouchIterator end) {
  const Index first = first_[position(begin)], columns = first_[position(end)] - first;
  Matrix b = Matrix::Zero(front.e + front.b, columns);
  const TouchHalves halves(front, begin, end);
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const TreeFront& child = *front.child[side];
    if (child.leaf() || !halves.touch(child, side)) continue;
    const Matrix up = forward(child, halves.bounds[side], halves.bounds[side + 1]);
    const std::vector<Index> map = state_map<Pose>(child.boundary, front);
    const Index to = first_[position(halves.bounds[side])] - first;
    for (Index c = 0; c < up.cols(); ++c)
      for (Index i = 0; i < up.rows(); ++i) b(map[i], to + c) += up(i, c);
  }
  for (TouchIterator touch = begin; touch != end; ++touch) {
    const TreeCombinations& own = combinations_[order_[position(touch)]];
    const Index to = first_[position(touch)] - first;
    Index row = 0;
    for (const Variable v : own.variables) {
      const Index d = dimension<Pose>(v);
      if (eliminated_at_[v] == front.bit)
        b.block(state_map<Pose>({v}, front)[0], to, d, own.weights.cols()) += own.weights.middleRows(row, d);
      row += d;
    }
  }
  Matrix above = b.bottomRows(front.b);
  if (front.e == 0 || columns == 0) return above;  // Eigen's blocked products divide by the size
  const Matrix y = front.eliminated_block().template triangularView<Eigen::Lower>().solve(b.topRows(front.e));
  products_.block(first, first, columns, columns).template selfadjointView<Eigen::Lower>().rankUpdate(y.transpose());
  above.noalias() -= front.boundary_block() * y;
  return above;
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

template class CombinationSolver<SE2>;
template class CombinationSolver<SE3>;
template void invert_selected<SE2>(const TreeFront&, const Matrix&, TouchIterator, TouchIterator, TreeCovariances&);
template void invert_selected<SE3>(const TreeFront&, const Matrix&, TouchIterator, TouchIterator, TreeCovariances&);

}  // namespace cairn
