// SPDX-License-Identifier: BSD-3-Clause
// Solutions and covariances out of the elimination tree.
#include <algorithm>

#include "map/elimination_front.hpp"

namespace cairn {
namespace {

using Front = EliminationTree::Front;
using Touch = EliminationTree::Touch;
using Matrix = Eigen::MatrixXd;
using Factor = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;
using TouchIterator = std::vector<Touch>::const_iterator;

Factor eliminated_block(const Front& front) {
  return Factor(front.factor.data(), front.e, front.e, Eigen::OuterStride<>(front.e + front.b));
}
Factor boundary_block(const Front& front) {
  return Factor(front.factor.data() + front.e, front.b, front.e, Eigen::OuterStride<>(front.e + front.b));
}

// The touches of each child of a front, out of those of the front, sorted by key.
struct Halves {
  Halves(const Front& front, TouchIterator begin, TouchIterator end) : bounds{begin, begin, end} {
    if (front.bit == EliminationTree::kCrown)
      bounds[1] = end;
    else
      bounds[1] = std::find_if(begin, end, [&](const Touch& touch) { return touch.key.bit(front.bit); });
  }
  bool touches(const Front& child, int side) const {
    return !child.leaf() &&
           std::any_of(bounds[side], bounds[side + 1], [&](const Touch& touch) { return touch.bit >= child.bit; });
  }
  TouchIterator bounds[3];
};

// What the forward pass leaves at a front that was touched.
struct Pass {
  Matrix y;      // L_EE^-1 b
  Matrix above;  // what goes up to the boundary
  std::unique_ptr<Pass> child[2];
};

class Solver {
 public:
  Solver(Index columns, EliminationTree::System& system) : columns_(columns), system_(system) {}

  std::unique_ptr<Pass> forward(const Front& front, TouchIterator begin, TouchIterator end) const {
    auto pass = std::make_unique<Pass>();
    Matrix b = Matrix::Zero(front.e + front.b, columns_);
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
      if (!halves.touches(child, side)) continue;
      pass->child[side] = forward(child, halves.bounds[side], halves.bounds[side + 1]);
      const std::vector<Index> map = state_map(child.boundary, front);
      for (Index c = 0; c < columns_; ++c)
        for (std::size_t i = 0; i < map.size(); ++i) b(map[i], c) += pass->child[side]->above(static_cast<Index>(i), c);
    }
    Index at = 0;
    for (const Variable v : front.eliminated) {
      system_.right_hand_side(v, b.data() + at, front.e + front.b);
      at += dimension(v);
    }
    pass->y = eliminated_block(front).triangularView<Eigen::Lower>().solve(b.topRows(front.e));
    pass->above = b.bottomRows(front.b);
    pass->above.noalias() -= boundary_block(front) * pass->y;
    return pass;
  }

  // `x` holds the solution of the boundary in its lower rows; `active` tells by the front's variables which of them
  // make it worth to go on below.
  void backward(const Front& front, const Pass* pass, Matrix& x, std::vector<char>& active) {
    Matrix y = pass != nullptr ? pass->y : Matrix(Matrix::Zero(front.e, columns_));
    y.noalias() -= boundary_block(front).transpose() * x.bottomRows(front.b);
    eliminated_block(front).transpose().triangularView<Eigen::Upper>().solveInPlace(y);
    x.topRows(front.e) = y;
    Index at = 0;
    for (std::size_t i = 0; i < front.eliminated.size(); ++i) {
      const Variable v = front.eliminated[i];
      active[i] = system_.solution(v, x.data() + at, front.e + front.b);
      at += dimension(v);
    }
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
      if (child.leaf()) continue;
      const Pass* below = pass != nullptr ? pass->child[side].get() : nullptr;
      std::vector<char> child_active = boundary_flags(front, child, active);
      if (below == nullptr && std::none_of(child_active.begin(), child_active.end(), [](char a) { return a != 0; }))
        continue;
      const std::vector<Index> map = state_map(child.boundary, front);
      Matrix x_child(child.e + child.b, columns_);
      for (Index c = 0; c < columns_; ++c)
        for (std::size_t i = 0; i < map.size(); ++i) x_child(child.e + static_cast<Index>(i), c) = x(map[i], c);
      backward(child, below, x_child, child_active);
    }
  }

 private:
  // Flags of a child's variables: the eliminated ones unset, the boundary's as the parent has them.
  static std::vector<char> boundary_flags(const Front& front, const Front& child, const std::vector<char>& active) {
    std::vector<char> flags(child.eliminated.size(), 0);
    std::size_t j = 0;
    for (const Variable v : child.boundary) {
      const auto found = front.bit == EliminationTree::kCrown
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

  Index columns_;
  EliminationTree::System& system_;
};

// y -= U d, for the packed lower triangle U.
void subtract_product(const std::vector<double>& U, const Eigen::VectorXd& d, Eigen::VectorXd& y) {
  const double* column = U.data();
  const Index n = d.size();
  for (Index c = 0; c < n; column += n - c, ++c) {
    double sum = column[0] * d(c);
    for (Index r = c + 1; r < n; ++r) {
      y(r) -= column[r - c] * d(c);
      sum += column[r - c] * d(r);
    }
    y(c) -= sum;
  }
}

Matrix chosen(const Matrix& covariance, const std::vector<Index>& map) {
  const auto n = static_cast<Index>(map.size());
  Matrix part(n, n);
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < n; ++r) part(r, c) = covariance(map[r], map[c]);
  return part;
}

// With K = L_BE L_EE^-1:  Sigma_BE = -Sigma_BB K,  Sigma_EE = (L_EE L_EE^T)^-1 + K^T Sigma_BB K.
void invert(const Front& front, const Matrix& boundary, TouchIterator begin, TouchIterator end,
            EliminationTree::Covariances& visitor) {
  if (front.leaf()) {
    visitor.leaf(front.key.leaf, boundary);
    return;
  }
  Matrix covariance(front.e + front.b, front.e + front.b);
  const auto L = eliminated_block(front).triangularView<Eigen::Lower>();
  Matrix inverse = L.solve(Matrix::Identity(front.e, front.e));
  const Matrix K = boundary_block(front) * inverse;
  const Matrix SK = boundary * K;
  covariance.topLeftCorner(front.e, front.e).noalias() = inverse.transpose() * inverse;
  covariance.topLeftCorner(front.e, front.e).noalias() += K.transpose() * SK;
  covariance.bottomLeftCorner(front.b, front.e) = -SK;
  covariance.topRightCorner(front.e, front.b) = -SK.transpose();
  covariance.bottomRightCorner(front.b, front.b) = boundary;
  const Halves halves(front, begin, end);
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const Front& child = *front.child[side];
    if (halves.bounds[side] == halves.bounds[side + 1]) continue;
    invert(child, chosen(covariance, state_map(child.boundary, front)), halves.bounds[side], halves.bounds[side + 1],
           visitor);
  }
}

bool by_key(const Touch& a, const Touch& b) {
  return a.key < b.key;
}

}  // namespace

class EliminationTree::Relaxer {
 public:
  using Vector = Eigen::VectorXd;

  Relaxer(EliminationTree& tree, const LeafSource& source, Relaxation& system)
      : tree_(tree), source_(source), system_(system) {}

  // The front's forces, its subtree's unknowns eliminated; null where nothing below was touched.
  std::unique_ptr<Pass> forward(const Front& front, TouchIterator begin, TouchIterator end) const {
    auto pass = std::make_unique<Pass>();
    Vector b = Vector::Zero(front.e + front.b);
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
      Vector above = Vector::Zero(child.b);
      bool any = false;
      if (halves.touches(child, side)) {
        pass->child[side] = forward(child, halves.bounds[side], halves.bounds[side + 1]);
        above = pass->child[side]->above;
        any = true;
      }
      if (const Vector* kept = tree_.kept(child)) {
        if (child.leaf()) {
          Matrix H = Matrix::Zero(child.b, child.b);
          source_.information(child.key.leaf, H.data(), child.b);
          above -= H.selfadjointView<Eigen::Lower>() * *kept;
        } else {
          subtract_product(child.complement, *kept, above);
        }
        any = true;
      }
      if (!any) continue;
      const std::vector<Index> map = state_map(child.boundary, front);
      for (std::size_t i = 0; i < map.size(); ++i) b(map[i]) += above(static_cast<Index>(i));
    }
    Index at = 0;
    for (const Variable v : front.eliminated) {
      system_.right_hand_side(v, b.data() + at, front.e + front.b);
      at += dimension(v);
    }
    pass->y = eliminated_block(front).triangularView<Eigen::Lower>().solve(b.head(front.e));
    pass->above = b.tail(front.b);
    pass->above.noalias() -= boundary_block(front) * pass->y;
    return pass;
  }

  // `x` holds the motion of the boundary in its lower rows.
  void backward(const Front& front, const Pass* pass, TouchIterator begin, TouchIterator end, Vector& x) {
    Vector y = pass != nullptr ? Vector(pass->y) : Vector(Vector::Zero(front.e));
    y.noalias() -= boundary_block(front).transpose() * x.tail(front.b);
    eliminated_block(front).transpose().triangularView<Eigen::Upper>().solveInPlace(y);
    x.head(front.e) = y;
    Index at = 0;
    for (const Variable v : front.eliminated) {
      system_.solution(v, x.data() + at, front.e + front.b);
      at += dimension(v);
    }
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
      const std::vector<Index> map = state_map(child.boundary, front);
      Vector below(child.e + child.b);
      for (std::size_t i = 0; i < map.size(); ++i) below(child.e + static_cast<Index>(i)) = x(map[i]);
      if (const Vector* kept = tree_.kept(child)) below.tail(child.b) += *kept;
      const bool touched = std::any_of(halves.bounds[side], halves.bounds[side + 1],
                                       [&](const Touch& touch) { return touch.bit >= child.bit; });
      bool matters = touched;
      Index state = child.e;
      for (std::size_t i = 0; !matters && i < child.boundary.size(); ++i) {
        matters = system_.matters(child.boundary[i], below.data() + state);
        state += dimension(child.boundary[i]);
      }
      if (!matters) {
        tree_.kept_[&child] = std::make_shared<const Vector>(below.tail(child.b));
        continue;
      }
      tree_.kept_.erase(&child);
      if (child.leaf())
        system_.visit(child.key.leaf);
      else
        backward(child, pass != nullptr ? pass->child[side].get() : nullptr, halves.bounds[side],
                 halves.bounds[side + 1], below);
    }
  }

  // As backward() without forces, on touched paths alone.
  void settle(const Front& front, TouchIterator begin, TouchIterator end, const Vector& boundary) {
    Vector x = Vector::Zero(front.e + front.b);
    const bool moves = boundary.size() > 0 && !boundary.isZero(0.0);
    if (moves) {
      x.tail(front.b) = boundary;
      Vector y = -(boundary_block(front).transpose() * boundary);
      eliminated_block(front).transpose().triangularView<Eigen::Upper>().solveInPlace(y);
      x.head(front.e) = y;
      Index at = 0;
      for (const Variable v : front.eliminated) {
        system_.solution(v, x.data() + at, front.e + front.b);
        at += dimension(v);
      }
    }
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
      const bool touched = std::any_of(halves.bounds[side], halves.bounds[side + 1],
                                       [&](const Touch& touch) { return touch.bit >= child.bit; });
      if (!touched && !moves) continue;
      Vector below = Vector::Zero(child.b);
      if (moves) {
        const std::vector<Index> map = state_map(child.boundary, front);
        for (std::size_t i = 0; i < map.size(); ++i) below(static_cast<Index>(i)) = x(map[i]);
      }
      if (const Vector* kept = tree_.kept(child)) below += *kept;
      if (!touched) {
        tree_.kept_[&child] = std::make_shared<const Vector>(std::move(below));
        continue;
      }
      tree_.kept_.erase(&child);
      if (child.leaf()) {
        if (!below.isZero(0.0)) system_.visit(child.key.leaf);
      } else {
        settle(child, halves.bounds[side], halves.bounds[side + 1], below);
      }
    }
  }

 private:
  EliminationTree& tree_;
  const LeafSource& source_;
  Relaxation& system_;
};

const Eigen::VectorXd* EliminationTree::kept(const Front& front) const {
  const auto found = kept_.find(&front);
  return found != kept_.end() ? found->second.get() : nullptr;
}

void EliminationTree::relax(const LeafSource& source, std::vector<Touch> touches, Relaxation& system) {
  if (crown_ == nullptr) return;
  std::stable_sort(touches.begin(), touches.end(), by_key);
  Relaxer relaxer(*this, source, system);
  const auto pass = relaxer.forward(*crown_, touches.begin(), touches.end());
  Eigen::VectorXd x(crown_->e);
  relaxer.backward(*crown_, pass.get(), touches.begin(), touches.end(), x);
}

void EliminationTree::settle(const LeafSource& source, const Changes& changes, Relaxation& system) {
  if (crown_ == nullptr || kept_.empty()) return;
  std::vector<Touch> touches;
  for (const TreeKey& key : changes.leaves) touches.push_back(touch(key));
  for (const auto& [v, key] : changes.variables) touches.push_back(touch(v, key));
  std::stable_sort(touches.begin(), touches.end(), by_key);
  Relaxer(*this, source, system).settle(*crown_, touches.begin(), touches.end(), Eigen::VectorXd());
}

void EliminationTree::solve(std::vector<Touch> touches, Index columns, System& system) const {
  if (crown_ == nullptr) return;
  std::stable_sort(touches.begin(), touches.end(), by_key);
  Solver solver(columns, system);
  const auto pass = solver.forward(*crown_, touches.begin(), touches.end());
  Matrix x(crown_->e, columns);
  std::vector<char> active(crown_->eliminated.size(), 0);
  solver.backward(*crown_, pass.get(), x, active);
}

void EliminationTree::covariances(std::vector<TreeKey> leaves, Covariances& visitor) const {
  if (crown_ == nullptr) return;
  std::vector<Touch> touches;
  for (const TreeKey& key : leaves) touches.push_back(touch(key));
  std::stable_sort(touches.begin(), touches.end(), by_key);
  invert(*crown_, Matrix(0, 0), touches.begin(), touches.end(), visitor);
}

}  // namespace cairn
