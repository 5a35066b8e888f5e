// SPDX-License-Identifier: BSD-3-Clause
// Solutions and covariances out of the elimination tree. Included by elimination_tree.cpp alone.
#pragma once

#include <algorithm>

#include "map/join/sparse/elimination_front.hpp"
#include "map/join/sparse/packed.hpp"

namespace cairn {
namespace {

using Front = TreeFront;
using FrontPointer = std::shared_ptr<const Front>;
using Touch = TreeTouch;
using Matrix = Eigen::MatrixXd;
using Factor = Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>;
using TouchIterator = std::vector<Touch>::const_iterator;

Factor eliminated_block(const Front& front) {
  return Factor(front.factor.data(), front.e, front.e, Eigen::OuterStride<>(front.e + front.b));
}
Factor boundary_block(const Front& front) {
  return Factor(front.factor.data() + front.e, front.b, front.e, Eigen::OuterStride<>(front.e + front.b));
}

// The touches of each child of a front, out of those of the front, sorted by key. A key that no leaf has yet leaves the
// tree somewhere: from there on it touches nothing.
struct Halves {
  Halves(const Front& front, TouchIterator begin, TouchIterator end) : bounds{begin, end, end} {
    const auto elsewhere = [&](const Touch& touch) { return touch.key.split(front.key) < front.bit; };
    while (bounds[0] != end && elsewhere(*bounds[0])) ++bounds[0];
    while (bounds[2] != bounds[0] && elsewhere(*(bounds[2] - 1))) --bounds[2];
    bounds[1] = bounds[2];
    if (front.bit != Front::kCrown)
      bounds[1] = std::find_if(bounds[0], bounds[2], [&](const Touch& touch) { return touch.key.bit(front.bit); });
  }
  bool touch(const Front& child, int side) const {
    return std::any_of(bounds[side], bounds[side + 1], [&](const Touch& touch) {
      return touch.bit >= child.bit && touch.key.split(child.key) >= child.bit;
    });
  }
  TouchIterator bounds[3];
};

// What the forward pass leaves at a front that was touched.
struct Pass {
  Matrix y;      // L_EE^-1 b
  Matrix above;  // what goes up to the boundary
  bool stirs = false;
  std::unique_ptr<Pass> child[2];

  // Takes in what the child on a side hands up, to these rows.
  template <class Columns>
  void add_child(int side, const std::vector<Index>& map, Columns& b) const {
    const Matrix& up = child[side]->above;
    for (Index c = 0; c < b.cols(); ++c)
      for (std::size_t i = 0; i < map.size(); ++i) b(map[i], c) += up(static_cast<Index>(i), c);
  }
  template <class Columns>
  void eliminate(const Front& front, const Columns& b) {
    y = eliminated_block(front).triangularView<Eigen::Lower>().solve(b.topRows(front.e));
    above = b.bottomRows(front.b);
    above.noalias() -= boundary_block(front) * y;
  }
};

// From y to the solution of what a front eliminates, by that of its boundary.
template <class Columns, class Boundary>
void substitute(const Front& front, const Boundary& boundary, Columns& y) {
  y.noalias() -= boundary_block(front).transpose() * boundary;
  eliminated_block(front).transpose().triangularView<Eigen::Upper>().solveInPlace(y);
}

template <class Pose>
class Solver {
 public:
  using System = typename EliminationTree<Pose>::System;

  Solver(Index columns, System& system) : columns_(columns), system_(system) {}

  std::unique_ptr<Pass> forward(const Front& front, TouchIterator begin, TouchIterator end) const {
    auto pass = std::make_unique<Pass>();
    Matrix b = Matrix::Zero(front.e + front.b, columns_);
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
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

  // `x` holds the solution of the boundary in its lower rows; `active` tells by the front's variables which of them
  // make it worth to go on below.
  void backward(const Front& front, const Pass* pass, Matrix& x, std::vector<char>& active) {
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
      const Front& child = *front.child[side];
      if (child.leaf()) continue;
      const Pass* below = pass != nullptr ? pass->child[side].get() : nullptr;
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

 private:
  // Flags of a child's variables: the eliminated ones unset, the boundary's as the parent has them.
  static std::vector<char> boundary_flags(const Front& front, const Front& child, const std::vector<char>& active) {
    std::vector<char> flags(child.eliminated.size(), 0);
    std::size_t j = 0;
    for (const Variable v : child.boundary) {
      const auto found = front.bit == Front::kCrown
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
  System& system_;
};

Matrix chosen(const Matrix& covariance, const std::vector<Index>& map) {
  const auto n = static_cast<Index>(map.size());
  Matrix part(n, n);
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < n; ++r) part(r, c) = covariance(map[r], map[c]);
  return part;
}

// With K = L_BE L_EE^-1:  Sigma_BE = -Sigma_BB K,  Sigma_EE = (L_EE L_EE^T)^-1 + K^T Sigma_BB K.
template <class Pose>
void invert(const Front& front, const Matrix& boundary, TouchIterator begin, TouchIterator end,
            typename EliminationTree<Pose>::Covariances& visitor) {
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
    invert<Pose>(child, chosen(covariance, state_map<Pose>(child.boundary, front)), halves.bounds[side],
                 halves.bounds[side + 1], visitor);
  }
}

// b^T H^-1 b / 2, front by front.
double fall(const Pass& pass) {
  double sum = 0.5 * pass.y.squaredNorm();
  for (const auto& child : pass.child)
    if (child != nullptr) sum += fall(*child);
  return sum;
}

bool by_key(const Touch& a, const Touch& b) {
  return a.key < b.key;
}

}  // namespace

template <class Pose>
class EliminationTree<Pose>::Relaxer {
 public:
  using Vector = Eigen::VectorXd;

  // How much of what may rest may remain of a motion that is carried on: nearly all parts of a map have such remainders
  // then, and what they do to second order adds up.
  static constexpr double kStraight = 0.1;

  Relaxer(EliminationTree& tree, Relaxation& system) : tree_(tree), system_(system) {}

  // Forces that rest at fronts which are touched are counted anew.
  void forget(const Front& front, TouchIterator begin, TouchIterator end) {
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const FrontPointer& child = front.child[side];
      if (child->leaf() || !halves.touch(*child, side)) continue;
      Rest rest = tree_.take_rest(*child);
      tree_.keep_rest(child, std::move(rest.motion), Vector());
      forget(*child, halves.bounds[side], halves.bounds[side + 1]);
    }
  }

  // What all that rests exerts on its fronts' boundaries. It may reach far above, so it is counted by variable.
  void gather_rests() {
    slots_.assign(tree_.degree_.size(), -1);
    for (const auto& [place, rest] : tree_.rests_) {
      Index at = 0;
      for (const Variable v : rest->front->boundary) {
        std::int32_t& slot = slots_[v];
        if (slot < 0) {
          slot = static_cast<std::int32_t>(forces_.size());
          forces_.push_back(Pose::Tangent::Zero());
        }
        forces_[slot].head(dimension<Pose>(v)) += rest->force.segment(at, dimension<Pose>(v));
        at += dimension<Pose>(v);
      }
    }
  }

  std::unique_ptr<Pass> forward(const Front& front, TouchIterator begin, TouchIterator end) const {
    auto pass = std::make_unique<Pass>();
    Vector b = Vector::Zero(front.e + front.b);
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const Front& child = *front.child[side];
      if (child.leaf() || !halves.touch(child, side)) continue;
      pass->child[side] = forward(child, halves.bounds[side], halves.bounds[side + 1]);
      pass->stirs = pass->stirs || pass->child[side]->stirs;
      pass->add_child(side, state_map<Pose>(child.boundary, front), b);
    }
    Index at = 0;
    for (const Variable v : front.eliminated) {
      system_.right_hand_side(v, b.data() + at, front.e + front.b);
      if (slots_[v] >= 0) b.segment(at, dimension<Pose>(v)) += forces_[slots_[v]].head(dimension<Pose>(v));
      at += dimension<Pose>(v);
    }
    pass->eliminate(front, b);
    if (!pass->stirs) {  // by the motion that the forces would cause here, were the boundary held
      const Vector x = eliminated_block(front).transpose().triangularView<Eigen::Upper>().solve(Vector(pass->y));
      pass->stirs = matters(front.eliminated, x);
    }
    return pass;
  }

  // Moves a front and what hangs on it: `boundary` is how its boundary moves; `forces` (a y) and `pass` are empty where
  // nothing pulls. With `far`, whatever the motion matters to is visited; without, as settle() asks for, what is
  // touched.
  void backward(const Front& front, const Vector& forces, const Pass* pass, TouchIterator begin, TouchIterator end,
                const Vector& boundary, bool far) {
    Vector x = Vector::Zero(front.e + front.b);
    const bool moves = forces.size() > 0 || !boundary.isZero(0.0);
    if (moves) {
      Vector y = forces.size() > 0 ? forces : Vector(Vector::Zero(front.e));
      substitute(front, boundary, y);
      x << y, boundary;
      Index at = 0;
      for (const Variable v : front.eliminated) {
        system_.solution(v, x.data() + at, front.e + front.b);
        at += dimension<Pose>(v);
      }
    }
    const Halves halves(front, begin, end);
    for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
      const FrontPointer& child = front.child[side];
      const bool touched = halves.touch(*child, side);
      if (!moves && !touched) continue;
      const std::vector<Index> map = state_map<Pose>(child->boundary, front);
      Vector motion(child->b);
      for (std::size_t i = 0; i < map.size(); ++i) motion(static_cast<Index>(i)) = x(map[i]);
      if (child->leaf()) {
        if (!motion.isZero(0.0)) system_.visit(child->key.leaf);
        continue;
      }
      Rest rest = tree_.take_rest(*child);
      if (rest.motion.size() > 0) motion += rest.motion;
      const Pass* below = pass != nullptr ? pass->child[side].get() : nullptr;
      if (below != nullptr) rest.y = below->y;
      const bool stirs = below != nullptr && below->stirs;
      bool down = far ? stirs || matters(child->boundary, motion) : touched;
      if (far && down && !stirs && !child->absolute) {
        Vector remainder = motion;
        const RigidMotion rigid = system_.take_rigid(child->boundary, remainder);
        if (!matters(child->boundary, remainder / kStraight)) {
          carry(*child, rigid);
          tree_.carried_.push_back({front.key, front.bit});
          motion.swap(remainder);
          down = false;
        }
      }
      if (down) {
        backward(*child, far ? rest.y : Vector(), below, halves.bounds[side], halves.bounds[side + 1], motion, far);
      } else {
        tree_.keep_rest(child, std::move(motion), std::move(rest.y));
        if (below != nullptr) keep_below(*child, *below);
      }
    }
  }

 private:
  void carry(const Front& front, const RigidMotion& motion) {
    if (front.leaf()) return system_.carry_leaf(front.key.leaf, motion);
    for (const Variable v : front.eliminated) system_.carry(v, motion);
    for (const FrontPointer& child : front.child) carry(*child, motion);
  }
  void keep_below(const Front& front, const Pass& pass) {
    for (int side = 0; side < 2; ++side) {
      if (pass.child[side] == nullptr) continue;
      Rest rest = tree_.take_rest(*front.child[side]);
      tree_.keep_rest(front.child[side], std::move(rest.motion), pass.child[side]->y);
      keep_below(*front.child[side], *pass.child[side]);
    }
  }
  bool matters(const std::vector<Variable>& variables, const Vector& motion) const {
    Index at = 0;
    for (const Variable v : variables) {
      if (system_.matters(v, motion.data() + at)) return true;
      at += dimension<Pose>(v);
    }
    return false;
  }

  EliminationTree& tree_;
  Relaxation& system_;
  std::vector<std::int32_t> slots_;  // by variable: where in forces_, -1: none
  std::vector<typename Pose::Tangent> forces_;
};

template <class Pose>
void EliminationTree<Pose>::keep_rest(const FrontPointer& front, Eigen::VectorXd motion, Eigen::VectorXd y) {
  if (motion.isZero(0.0)) motion.resize(0);
  if (y.isZero(0.0)) y.resize(0);
  if (motion.size() == 0 && y.size() == 0) return;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(front->b);
  if (motion.size() > 0) add_packed_product(front->complement.data(), front->b, -1.0, motion.data(), force.data());
  if (y.size() > 0) force.noalias() -= boundary_block(*front) * y;
  rests_[{front->key, front->bit}] =
      std::make_shared<const Rest>(Rest{front, std::move(motion), std::move(y), std::move(force)});
}

template <class Pose>
typename EliminationTree<Pose>::Rest EliminationTree<Pose>::take_rest(const Front& front) {
  const auto found = rests_.find({front.key, front.bit});
  if (found == rests_.end()) return Rest();
  Rest rest = *found->second;
  rests_.erase(found);
  return rest;
}

template <class Pose>
double EliminationTree<Pose>::relax(std::vector<Touch> touches, Relaxation& system) {
  if (crown_ == nullptr) return 0.0;
  touches.insert(touches.end(), carried_.begin(), carried_.end());
  carried_.clear();
  std::stable_sort(touches.begin(), touches.end(), by_key);
  Relaxer relaxer(*this, system);
  relaxer.forget(*crown_, touches.begin(), touches.end());
  relaxer.gather_rests();
  const auto pass = relaxer.forward(*crown_, touches.begin(), touches.end());
  relaxer.backward(*crown_, pass->y, pass.get(), touches.begin(), touches.end(), Eigen::VectorXd(0), true);
  return fall(*pass);
}

template <class Pose>
void EliminationTree<Pose>::settle(const Changes& changes, Relaxation& system) {
  if (crown_ == nullptr || rests_.empty()) return;
  std::vector<Touch> touches;
  for (const TreeKey& key : changes.leaves) touches.push_back(touch(key));
  for (const auto& [v, key] : changes.variables) touches.push_back(touch(v, key));
  std::stable_sort(touches.begin(), touches.end(), by_key);
  Relaxer(*this, system)
      .backward(*crown_, Eigen::VectorXd(0), nullptr, touches.begin(), touches.end(), Eigen::VectorXd(0), false);
}

template <class Pose>
void EliminationTree<Pose>::solve(std::vector<Touch> touches, Index columns, System& system) const {
  if (crown_ == nullptr) return;
  std::stable_sort(touches.begin(), touches.end(), by_key);
  Solver<Pose> solver(columns, system);
  const auto pass = solver.forward(*crown_, touches.begin(), touches.end());
  Matrix x(crown_->e, columns);
  std::vector<char> active(crown_->eliminated.size(), 0);
  solver.backward(*crown_, pass.get(), x, active);
}

template <class Pose>
void EliminationTree<Pose>::covariances(std::vector<TreeKey> leaves, Covariances& visitor) const {
  if (crown_ == nullptr) return;
  std::vector<Touch> touches;
  for (const TreeKey& key : leaves) touches.push_back(touch(key));
  std::stable_sort(touches.begin(), touches.end(), by_key);
  invert<Pose>(*crown_, Matrix(0, 0), touches.begin(), touches.end(), visitor);
}

}  // namespace cairn
