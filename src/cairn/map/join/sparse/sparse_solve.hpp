// SPDX-License-Identifier: BSD-3-Clause
// Damped Gauss-Newton on the sparse map's factor. The factor may be of older linearisation points; the gradient never
// is, so that what the steps converge to is the minimum. Included by sparse_map.cpp alone.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "map/join/sparse/sparse_undo.hpp"

namespace cairn {

template <class Pose>
template <class Visit>
void SparseMap<Pose>::for_leaves_of(Variable v, Visit&& visit) const {
  const auto number = static_cast<Number>(v >> 1);
  if (is_landmark(v)) {
    for (const Number leaf : landmarks_[number].submaps) visit(leaf);
    return;
  }
  if (number > 0) visit(number - 1);
  if (number < leaves_.size()) visit(number);
}

// Adds the descent in the variable's axes.
template <class Pose>
void SparseMap<Pose>::gradient_of(Variable v, double* b) const {
  const Rotation own = axes(v).inverse();
  for_leaves_of(v, [&](Number number) {
    const Leaf& leaf = leaves_[number];
    const auto at = std::lower_bound(leaf.variables.begin(), leaf.variables.end(), v) - leaf.variables.begin();
    const Rotation turn = own * leaf.turned;
    const double* pull = leaf.gradient.data() + leaf.states[at];
    Eigen::Map<Point> force(b);
    force -= turn * Point(Eigen::Map<const Point>(pull));
    if (is_landmark(v)) return;
    Eigen::Map<Tangent> moment(b + kDim);
    moment -= turn.adjoint(Tangent(Eigen::Map<const Tangent>(pull + kDim)));
  });
}

// One linear solution. Lengths and turns are measured by one scale of the whole map.
template <class Pose>
class SparseMap<Pose>::Step final : public EliminationTree<Pose>::Relaxation {
 public:
  using RigidMotion = typename Tree::RigidMotion;

  Step(const SparseMap& map, double tolerance) : map_(map), tolerance_(tolerance) {}

  void right_hand_side(Variable v, double* b, Index) const override { map_.gradient_of(v, b); }
  bool solution(Variable v, const double* x, Index) override {
    StepEntry entry{v, {}};
    const Rotation& R = map_.axes(v);
    Eigen::Map<Point>(entry.value) = R * Point(Eigen::Map<const Point>(x));
    if (!is_landmark(v))
      Eigen::Map<Tangent>(entry.value + kDim) = R.adjoint(Tangent(Eigen::Map<const Tangent>(x + kDim)));
    largest = std::max(largest, size(v, x));
    entries.push_back(entry);
    return true;
  }
  bool matters(Variable v, const double* x) const override { return !(size(v, x) < tolerance_); }
  RigidMotion take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const override;
  void carry(Variable v, const RigidMotion& motion) override {
    StepEntry entry{v, {}};
    Eigen::Map<Point>(entry.value) = motion.move + Rotation::swing(motion.turn, map_.place_of(v) - motion.centre);
    if (!is_landmark(v)) Eigen::Map<Tangent>(entry.value + kDim) = motion.turn;
    entries.push_back(entry);
  }
  void carry_leaf(std::uint32_t number, const RigidMotion& motion) override {
    carried.emplace_back(number, motion.turn);
    for (const Number landmark : map_.leaves_[number].landmarks)
      if (landmark != kNone && !map_.shared(landmark)) carry(landmark_variable(landmark), motion);
  }
  void visit(std::uint32_t leaf) override { visited.push_back(leaf); }

  std::vector<StepEntry> entries;
  std::vector<Number> visited;
  std::vector<std::pair<Number, Tangent>> carried;  // leaves, and by what they turn
  double largest = 0.0;

 private:
  double size(Variable v, const double* x) const {
    const double way = Eigen::Map<const Point>(x).norm() / map_.length_scale_;
    return is_landmark(v) ? way : std::max(way, Eigen::Map<const Tangent>(x + kDim).norm() / map_.turn_scale_);
  }

  const SparseMap& map_;
  double tolerance_;
};

// Least squares by the map's scales.
template <class Pose>
typename EliminationTree<Pose>::RigidMotion SparseMap<Pose>::Step::take_rigid(const std::vector<Variable>& variables,
                                                                              Eigen::VectorXd& motion) const {
  const double by_length = 1.0 / (map_.length_scale_ * map_.length_scale_);
  const double by_turn = 1.0 / (map_.turn_scale_ * map_.turn_scale_);
  RigidMotion rigid{Point::Zero(), Point::Zero(), Tangent::Zero()};
  std::vector<PointSquare> axes;
  Index at = 0;
  for (const Variable v : variables) {
    axes.push_back(map_.axes(v).matrix());
    rigid.centre += map_.place_of(v);
    rigid.move += axes.back() * motion.segment<kDim>(at);
    at += dimension(v);
  }
  const auto count = static_cast<double>(variables.size());
  rigid.centre /= count;
  rigid.move /= count;
  Jacobian A = Jacobian::Zero();
  Tangent b = Tangent::Zero();
  at = 0;
  for (std::size_t i = 0; i < variables.size(); at += dimension(variables[i++])) {
    const Point arm = map_.place_of(variables[i]) - rigid.centre;
    A += by_length * Rotation::inertia(arm);
    b += by_length * Rotation::moment(arm, axes[i] * motion.segment<kDim>(at) - rigid.move);
    if (is_landmark(variables[i])) continue;
    A += by_turn * Jacobian::Identity();
    b += by_turn * map_.axes(variables[i]).adjoint() * motion.segment<kTurn>(at + kDim);
  }
  A.diagonal().array() += 1e-9 * A.trace() + DBL_MIN;  // points on a line leave one turn of space open
  rigid.turn = A.ldlt().solve(b);
  at = 0;
  for (std::size_t i = 0; i < variables.size(); at += dimension(variables[i++])) {
    const Point arm = map_.place_of(variables[i]) - rigid.centre;
    motion.segment<kDim>(at) -= axes[i].transpose() * (rigid.move + Rotation::swing(rigid.turn, arm));
    if (!is_landmark(variables[i]))
      motion.segment<kTurn>(at + kDim) -= map_.axes(variables[i]).adjoint().transpose() * rigid.turn;
  }
  return rigid;
}

// What a step is taken from.
template <class Pose>
struct SparseMap<Pose>::Before {
  std::vector<Pose> bases;
  std::vector<Point> positions;
  std::vector<Rotation> turned;  // of the leaves that it carries
  struct Evaluation {
    double cost;
    Eigen::VectorXd gradient;
    Rotation turned;
  };
  std::vector<Evaluation> evaluations;  // of the leaves that it visits
};

// A rigid motion of many must stay one, whatever its size: with the turn theta of its own base, of that which saw it
// first, a point goes by V(theta) delta, as (Exp(theta) - I) (p - c) = V(theta) (theta x (p - c)).
template <class Pose>
void SparseMap<Pose>::place(const Step& step, double factor, const Before& from) {
  std::unordered_map<Number, PointSquare> turned;  // V by base
  std::size_t base = 0, position = 0;
  for (const StepEntry& entry : step.entries) {
    if (is_landmark(entry.variable)) continue;
    const auto number = static_cast<Number>(entry.variable >> 1);
    const Point move = factor * Eigen::Map<const Point>(entry.value);
    const Tangent turn = factor * Eigen::Map<const Tangent>(entry.value + kDim);
    const PointSquare V = Rotation::translation_jacobian(turn);
    const Pose& before = from.bases[base++];
    bases_[number] = Pose(Rotation::exp(turn) * before.rotation(), before.translation() + V * move);
    turned.emplace(number, V);
  }
  for (const StepEntry& entry : step.entries) {
    if (!is_landmark(entry.variable)) continue;
    Landmark& landmark = landmarks_[static_cast<Number>(entry.variable >> 1)];
    const Point move = factor * Eigen::Map<const Point>(entry.value);
    const auto first = turned.find(landmark.submaps[0]);
    landmark.position = from.positions[position++] + (first != turned.end() ? Point(first->second * move) : move);
  }
  for (std::size_t i = 0; i < step.carried.size(); ++i)
    leaves_[step.carried[i].first].turned = Rotation::exp(factor * step.carried[i].second) * from.turned[i];
}

// Puts the step's variables where it takes them, and evaluates the leaves that it visits; returns their cost.
template <class Pose>
double SparseMap<Pose>::take_step(const Step& step, double factor, const Before& from) {
  place(step, factor, from);
  double cost = 0.0;
  for (const Number leaf : step.visited) {
    evaluate(leaf);
    cost += leaves_[leaf].cost;
  }
  return cost;
}

// As if it had not been taken. The leaves get back what they were evaluated to, which may have been elsewhere: where
// motions of other variables rest, the tree counts what these do to them.
template <class Pose>
void SparseMap<Pose>::take_back(const Step& step, Before& from) {
  place(step, 0.0, from);
  for (std::size_t i = 0; i < step.visited.size(); ++i) {
    Leaf& leaf = leaves_[step.visited[i]];
    leaf.cost = from.evaluations[i].cost;
    leaf.gradient.swap(from.evaluations[i].gradient);
    leaf.turned = from.evaluations[i].turned;
  }
}

// Makes the tree anew where `changes` reach, and where leaves are stale: the newest of these first, and what is too
// much for once waits for the next time. What was kept above all that is handed down before.
template <class Pose>
void SparseMap<Pose>::refactor(TreeChanges changes, Undo& undo, JoinReport& report) {
  constexpr std::size_t kAtOnce = 256;
  const std::size_t taken = std::min(stale_.size(), kAtOnce);
  for (std::size_t i = stale_.size() - taken; i < stale_.size(); ++i) changes.leaves.push_back(leaves_[stale_[i]].key);
  stale_.resize(stale_.size() - taken);
  report.relinearised += taken;
  Step step(*this, 0.0);
  tree_.settle(changes, step);
  take_step(step, 1.0, save_step(step, undo));

  std::size_t refactored = 0;
  std::vector<std::uint32_t> assembled;
  if (!tree_.update(*this, changes, refactored, assembled))
    throw Error(ErrorCode::numerical, "submap: the map's information is not positive definite; nothing was changed");
  report.refactored += refactored;
  for (const TreeKey& key : changes.leaves) pending_.push_back(key.leaf);
  for (const auto& [v, key] : changes.variables) pending_.push_back(key.leaf);
  pending_.insert(pending_.end(), step.visited.begin(), step.visited.end());
  for (const Number leaf : assembled) {
    save_leaf(undo, leaf);
    note_linearisation(leaf);
  }
}

// Saves what the step moves, and hands it out besides.
template <class Pose>
typename SparseMap<Pose>::Before SparseMap<Pose>::save_step(const Step& step, Undo& undo) {
  Before before;
  for (const Number leaf : step.visited) {
    save_leaf(undo, leaf);
    before.evaluations.push_back({leaves_[leaf].cost, leaves_[leaf].gradient, leaves_[leaf].turned});
  }
  for (const auto& [leaf, turn] : step.carried) {
    before.turned.push_back(leaves_[leaf].turned);
    if (leaves_[leaf].saved != undo.change) undo.turned.emplace_back(leaf, before.turned.back());
  }
  for (const StepEntry& entry : step.entries) {
    const auto number = static_cast<Number>(entry.variable >> 1);
    if (is_landmark(entry.variable)) {
      save_landmark(undo, number);
      before.positions.push_back(landmarks_[number].position);
    } else {
      save_base(undo, number);
      before.bases.push_back(bases_[number]);
    }
  }
  return before;
}

// Iterates from where the leaves pull that were evaluated since the tree took their forces in.
template <class Pose>
void SparseMap<Pose>::optimise(Undo& undo, JoinReport& report) {
  constexpr int kHalvings = 6;
  // A chain's slackness grows by the cube of its length, and so does what stiffness of another shape does to it.
  const double borne = std::clamp(10.0 * std::pow(static_cast<double>(leaves_.size()), -1.5), 5e-5, 0.3);
  constexpr double kSlack = 0.01;  // of the cost: leaves that were not visited lately tell that of a while ago
  settled_ = false;
  double tolerance = options_.step_tolerance;
  for (int i = 0; i < options_.most_iterations && !settled_; ++i) {
    if (!stale_.empty()) refactor({}, undo, report);
    std::vector<TreeTouch> touches;
    for (const Number leaf : pending_) touches.push_back(tree_.touch(leaves_[leaf].key));
    Step step(*this, tolerance);
    const Tree before_step = tree_;
    const double foreseen = tree_.relax(touches, step);
    ++report.iterations;
    Before from = save_step(step, undo);
    report.carried += step.carried.size();
    // Where motions rest, the costs are of other places than those that the step is taken from. A small step's hardly
    // are; one that hands everything down is compared with what it comes from.
    double before = 0.0;
    for (const typename Before::Evaluation& evaluation : from.evaluations) before += evaluation.cost;
    if (tolerance == 0.0) before = take_step(step, 0.0, from);
    double after = take_step(step, 1.0, from);
    if (!(after <= before + kSlack) && tolerance > 0.0) {
      // Too far for a linear step. All that moves is visited then, and the step, a direction of descent, is halved.
      take_back(step, from);
      tree_ = before_step;
      tolerance = 0.0;
      continue;
    }
    double factor = 1.0;
    for (int halving = 0; !(after <= before + kSlack) && halving < kHalvings; ++halving) {
      factor *= 0.5;
      after = take_step(step, factor, from);
    }
    if (!(after <= before + kSlack)) {  // nowhere to go from here
      take_back(step, from);
      tree_ = before_step;
      break;
    }
    pending_ = step.visited;
    // A submap that has been bent is linearised anew, before the next step.
    for (const Number leaf : pending_)
      if (strain(leaf) > borne) stale_.push_back(leaf);
    std::sort(stale_.begin(), stale_.end());
    stale_.erase(std::unique(stale_.begin(), stale_.end()), stale_.end());
    // What the quadratic model missed is of third order in the step, m = k x^3 where it foresaw D = h x^2 / 2. The next
    // step, which the force 3 k x^2 would take, then lowers the cost by 9 m^2 / (4 D). Where that is nothing, the
    // force waits for the next closing: it is counted among those that are pending.
    const double miss = before - after - foreseen;
    const bool foretold = 2.25 * miss * miss <= options_.cost_tolerance * foreseen;
    settled_ = (factor == 1.0 && (foretold || step.largest < options_.convergence_tolerance)) ||
               (i > 0 && std::abs(before - after) < options_.cost_tolerance);
  }
}

// A fix of the newest base, within a change.
template <class Pose>
FixReport SparseMap<Pose>::fix_base(const AbsoluteFix<Pose>& fix, double threshold, Undo& undo) {
  FixReport report;
  const int rows = fix.rows();
  const Pose T = bases_.back();
  if (!fix.defined(T)) return report;
  const Eigen::MatrixXd J = fix.jacobian(T).topRows(rows);
  const Eigen::VectorXd r = fix.residual(T).head(rows);
  const Eigen::MatrixXd S = J * base_covariance_ * J.transpose() + fix.covariance().topLeftCorner(rows, rows);
  report.distance = r.dot(S.ldlt().solve(r));
  report.accepted = report.distance <= threshold;
  if (!report.accepted) return report;
  if (leaves_.empty()) {  // nothing but the prior, in one linearisation
    const Eigen::MatrixXd PJ = base_covariance_ * J.transpose();
    const typename Pose::Tangent e = PJ * S.ldlt().solve(r);
    const Square lower = base_covariance_ - PJ * S.ldlt().solve(PJ.transpose());
    save_base(undo, 0);
    bases_[0] = prior_ = retract(T, e);
    base_covariance_ = prior_covariance_ = lower.template selfadjointView<Eigen::Lower>();
    report.iterations = 1;
    return report;
  }
  JoinReport joined;
  const auto leaf = static_cast<Number>(leaves_.size() - 1);
  save_leaf(undo, leaf);
  fixes_[leaf + 1].push_back(fix);
  evaluate(leaf);
  TreeChanges changes;
  changes.leaves.push_back(leaves_[leaf].key);
  refactor(std::move(changes), undo, joined);
  optimise(undo, joined);
  report.iterations = joined.iterations;
  return report;
}

}  // namespace cairn
