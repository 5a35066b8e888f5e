// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_step.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cfloat>

namespace cairn {
namespace {

// The leaves that hold a variable.
template <class Pose, class Visit>
void for_leaves_of(const SparseState<Pose>& state, Variable v, Visit&& visit) {
  const auto number = static_cast<std::uint32_t>(v >> 1);
  if (is_landmark(v)) {
    for (const std::uint32_t leaf : state.landmarks[number].submaps) visit(leaf);
    return;
  }
  for (const std::uint32_t leaf : state.bases[number].leaves)
    if (leaf != SparseState<Pose>::kNone) visit(leaf);
}

}  // namespace

// The descent, in the variable's axes.
template <class Pose>
void SparseStep<Pose>::right_hand_side(Variable v, double* b) const {
  const Rotation own = state_.axes(v).inverse();
  for_leaves_of(state_, v, [&](Number number) {
    const typename State::Leaf& leaf = state_.leaves[number];
    const auto at = std::lower_bound(leaf.variables.begin(), leaf.variables.end(), v) - leaf.variables.begin();
    const Rotation turn = state_.is_error(v) ? own : own * leaf.turned;
    const double* pull = leaf.gradient.data() + leaf.states[at];
    Eigen::Map<Point> force(b);
    force -= turn * Point(Eigen::Map<const Point>(pull));
    if (is_landmark(v)) return;
    Eigen::Map<Tangent> moment(b + kDim);
    moment -= turn.adjoint(Tangent(Eigen::Map<const Tangent>(pull + kDim)));
  });
}

template <class Pose>
void SparseStep<Pose>::solution(Variable v, const double* x) {
  Entry entry{v, {}};
  const Rotation& R = state_.axes(v);
  Eigen::Map<Point>(entry.value) = R * Point(Eigen::Map<const Point>(x));
  if (!is_landmark(v))
    Eigen::Map<Tangent>(entry.value + kDim) = R.adjoint(Tangent(Eigen::Map<const Tangent>(x + kDim)));
  largest_ = std::max(largest_, size(v, x));
  entries_.push_back(entry);
}

template <class Pose>
void SparseStep<Pose>::carry(Variable v, const RigidMotion<Pose>& motion) {
  if (state_.is_error(v)) return;
  Entry entry{v, {}};
  Eigen::Map<Point>(entry.value) = motion.move + Rotation::swing(motion.turn, state_.place_of(v) - motion.centre);
  if (!is_landmark(v)) Eigen::Map<Tangent>(entry.value + kDim) = motion.turn;
  entries_.push_back(entry);
}

template <class Pose>
void SparseStep<Pose>::carry_leaf(std::uint32_t number, const RigidMotion<Pose>& motion) {
  carried_.emplace_back(number, motion.turn);
  for (const Number landmark : state_.leaves[number].landmarks)
    if (landmark != State::kNone && !state_.shared(landmark)) carry(landmark_variable(landmark), motion);
}

// Least squares by the map's scales.
template <class Pose>
RigidMotion<Pose> SparseStep<Pose>::take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const {
  const double by_length = 1.0 / (state_.solution.length_scale * state_.solution.length_scale);
  const double by_turn = 1.0 / (state_.solution.turn_scale * state_.solution.turn_scale);
  RigidMotion<Pose> rigid{Point::Zero(), Point::Zero(), Tangent::Zero()};
  std::vector<PointSquare> axes;
  Index at = 0;
  std::size_t turning = 0;
  for (const Variable v : variables) {
    axes.push_back(state_.axes(v).matrix());
    if (!state_.is_error(v)) {  // a systematic error moves with nothing
      rigid.centre += state_.place_of(v);
      rigid.move += axes.back() * motion.segment<kDim>(at);
      ++turning;
    }
    at += State::dimension(v);
  }
  if (turning == 0) return rigid;
  const auto count = static_cast<double>(turning);
  rigid.centre /= count;
  rigid.move /= count;
  Jacobian A = Jacobian::Zero();
  Tangent b = Tangent::Zero();
  at = 0;
  for (std::size_t i = 0; i < variables.size(); at += State::dimension(variables[i++])) {
    if (state_.is_error(variables[i])) continue;
    const Point arm = state_.place_of(variables[i]) - rigid.centre;
    A += by_length * Rotation::inertia(arm);
    b += by_length * Rotation::moment(arm, axes[i] * motion.segment<kDim>(at) - rigid.move);
    if (is_landmark(variables[i])) continue;
    A += by_turn * Jacobian::Identity();
    b += by_turn * state_.axes(variables[i]).adjoint() * motion.segment<kTurn>(at + kDim);
  }
  A.diagonal().array() += 1e-9 * A.trace() + DBL_MIN;  // points on a line leave one turn of space open
  rigid.turn = A.ldlt().solve(b);
  at = 0;
  for (std::size_t i = 0; i < variables.size(); at += State::dimension(variables[i++])) {
    if (state_.is_error(variables[i])) continue;
    const Point arm = state_.place_of(variables[i]) - rigid.centre;
    motion.segment<kDim>(at) -= axes[i].transpose() * (rigid.move + Rotation::swing(rigid.turn, arm));
    if (!is_landmark(variables[i]))
      motion.segment<kTurn>(at + kDim) -= state_.axes(variables[i]).adjoint().transpose() * rigid.turn;
  }
  return rigid;
}

template class SparseStep<SE2>;
template class SparseStep<SE3>;

}  // namespace cairn
