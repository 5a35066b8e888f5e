// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_relaxer.hpp"

#include <algorithm>

namespace cairn {
namespace {

// b^T H^-1 b / 2, front by front.
double fall(const TreePass& pass) {
  double sum = 0.5 * pass.y.squaredNorm();
  for (const auto& child : pass.child)
    if (child != nullptr) sum += fall(*child);
  return sum;
}

}  // namespace

template <class Pose>
double EliminationRelaxer<Pose>::relax(const TreeFront& crown, const std::vector<TreeTouch>& touches) {
  forget(crown, touches.begin(), touches.end());
  gather_rests();
  const auto pass = forward(crown, touches.begin(), touches.end());
  backward(crown, pass->y, pass.get(), touches.begin(), touches.end(), Eigen::VectorXd(0), true);
  return fall(*pass);
}

template <class Pose>
void EliminationRelaxer<Pose>::settle(const TreeFront& crown, const std::vector<TreeTouch>& touches) {
  backward(crown, Eigen::VectorXd(0), nullptr, touches.begin(), touches.end(), Eigen::VectorXd(0), false);
}

// Forces that are kept at touched fronts are computed anew.
template <class Pose>
void EliminationRelaxer<Pose>::forget(const TreeFront& front, TouchIterator begin, TouchIterator end) {
  const TouchHalves halves(front, begin, end);
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const FrontPointer& child = front.child[side];
    if (child->leaf() || !halves.touch(*child, side)) continue;
    TreeRests::Rest rest = rests_.take(*child);
    rests_.keep(child, std::move(rest.motion), Vector());
    forget(*child, halves.bounds[side], halves.bounds[side + 1]);
  }
}

// Adds up the forces of all kept motions and kept forces on their fronts' boundaries. A boundary variable may be
// eliminated far above, so the forces are added up by variable.
template <class Pose>
void EliminationRelaxer<Pose>::gather_rests() {
  slots_.assign(variables_, -1);
  for (const auto& [place, rest] : rests_.all()) {
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

template <class Pose>
std::unique_ptr<TreePass> EliminationRelaxer<Pose>::forward(const TreeFront& front, TouchIterator begin,
                                                            TouchIterator end) const {
  auto pass = std::make_unique<TreePass>();
  Vector b = Vector::Zero(front.e + front.b);
  const TouchHalves halves(front, begin, end);
  for (int side = 0; side < 2 && front.child[side] != nullptr; ++side) {
    const TreeFront& child = *front.child[side];
    if (child.leaf() || !halves.touch(child, side)) continue;
    pass->child[side] = forward(child, halves.bounds[side], halves.bounds[side + 1]);
    pass->stirs = pass->stirs || pass->child[side]->stirs;
    pass->add_child(side, state_map<Pose>(child.boundary, front), b);
  }
  Index at = 0;
  for (const Variable v : front.eliminated) {
    system_.right_hand_side(v, b.data() + at);
    if (slots_[v] >= 0) b.segment(at, dimension<Pose>(v)) += forces_[slots_[v]].head(dimension<Pose>(v));
    at += dimension<Pose>(v);
  }
  pass->eliminate(front, b);
  if (!pass->stirs) {  // by the motion that the forces would cause here if the boundary were fixed
    const Vector x = front.eliminated_block().transpose().triangularView<Eigen::Upper>().solve(Vector(pass->y));
    pass->stirs = matters(front.eliminated, x);
  }
  return pass;
}

// Moves a front and the fronts below it. `boundary` is the motion of its boundary; `forces` (a y) and `pass` are empty
// if there is no force. With `far`, all fronts are visited to which the motion matters; without it (for settle()), only
// the touched ones.
template <class Pose>
void EliminationRelaxer<Pose>::backward(const TreeFront& front, const Vector& forces, const TreePass* pass,
                                        TouchIterator begin, TouchIterator end, const Vector& boundary, bool far) {
  Vector x = Vector::Zero(front.e + front.b);
  const bool moves = forces.size() > 0 || !boundary.isZero(0.0);
  if (moves) {
    Vector y = forces.size() > 0 ? forces : Vector(Vector::Zero(front.e));
    substitute(front, boundary, y);
    x << y, boundary;
    Index at = 0;
    for (const Variable v : front.eliminated) {
      system_.solution(v, x.data() + at);
      at += dimension<Pose>(v);
    }
  }
  const TouchHalves halves(front, begin, end);
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
    TreeRests::Rest rest = rests_.take(*child);
    if (rest.motion.size() > 0) motion += rest.motion;
    const TreePass* below = pass != nullptr ? pass->child[side].get() : nullptr;
    if (below != nullptr) rest.y = below->y;
    const bool stirs = below != nullptr && below->stirs;
    bool down = far ? stirs || matters(child->boundary, motion) : touched;
    if (far && down && !stirs && !child->absolute) {
      Vector remainder = motion;
      const RigidMotion<Pose> rigid = system_.take_rigid(child->boundary, remainder);
      if (!matters(child->boundary, remainder / kStraight)) {
        carry(*child, rigid);
        rests_.note_carried(front);
        motion.swap(remainder);
        down = false;
      }
    }
    if (down) {
      backward(*child, far ? rest.y : Vector(), below, halves.bounds[side], halves.bounds[side + 1], motion, far);
    } else {
      rests_.keep(child, std::move(motion), std::move(rest.y));
      if (below != nullptr) keep_below(*child, *below);
    }
  }
}

template <class Pose>
void EliminationRelaxer<Pose>::carry(const TreeFront& front, const RigidMotion<Pose>& motion) {
  if (front.leaf()) return system_.carry_leaf(front.key.leaf, motion);
  for (const Variable v : front.eliminated) system_.carry(v, motion);
  for (const FrontPointer& child : front.child) carry(*child, motion);
}

template <class Pose>
void EliminationRelaxer<Pose>::keep_below(const TreeFront& front, const TreePass& pass) {
  for (int side = 0; side < 2; ++side) {
    if (pass.child[side] == nullptr) continue;
    TreeRests::Rest rest = rests_.take(*front.child[side]);
    rests_.keep(front.child[side], std::move(rest.motion), pass.child[side]->y);
    keep_below(*front.child[side], *pass.child[side]);
  }
}

template <class Pose>
bool EliminationRelaxer<Pose>::matters(const std::vector<Variable>& variables, const Vector& motion) const {
  Index at = 0;
  for (const Variable v : variables) {
    if (system_.matters(v, motion.data() + at)) return true;
    at += dimension<Pose>(v);
  }
  return false;
}

template class EliminationRelaxer<SE2>;
template class EliminationRelaxer<SE3>;

}  // namespace cairn
