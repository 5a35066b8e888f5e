// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.hpp"
#include "map/join/sparse/leaf_information.hpp"

namespace cairn {

// A rigid motion of many variables must stay rigid, even if it is large. With the turn theta of its own base (the base
// that saw it first) a point moves by V(theta) delta, because (Exp(theta) - I) (p - c) = V(theta) (theta x (p - c)).
template <class Pose>
void SparseSolver<Pose>::place(const Step& step, double factor, const Before& from) {
  std::unordered_map<Number, PointSquare> turned;  // V by base
  std::size_t base = 0, position = 0;
  for (const typename Step::Entry& entry : step.entries()) {
    if (is_landmark(entry.variable)) continue;
    const auto number = static_cast<Number>(entry.variable >> 1);
    const Point move = factor * Eigen::Map<const Point>(entry.value);
    const Tangent turn = factor * Eigen::Map<const Tangent>(entry.value + kDim);
    const PointSquare V = Rotation::translation_jacobian(turn);
    const Pose& before = from.bases[base++];
    state_.bases[number].pose = Pose(Rotation::exp(turn) * before.rotation(), before.translation() + V * move);
    turned.emplace(number, V);
  }
  for (const typename Step::Entry& entry : step.entries()) {
    if (!is_landmark(entry.variable)) continue;
    typename State::Landmark& landmark = state_.landmarks[static_cast<Number>(entry.variable >> 1)];
    const Point move = factor * Eigen::Map<const Point>(entry.value);
    const auto first = landmark.error ? turned.end() : turned.find(state_.leaves[landmark.submaps[0]].base());
    landmark.position = from.positions[position++] + (first != turned.end() ? Point(first->second * move) : move);
  }
  for (std::size_t i = 0; i < step.carried().size(); ++i)
    state_.leaves[step.carried()[i].first].turned = Rotation::exp(factor * step.carried()[i].second) * from.turned[i];
}

// Moves the step's variables and evaluates the leaves that the step visits; returns their cost.
template <class Pose>
double SparseSolver<Pose>::take_step(const Step& step, double factor, const Before& from) {
  place(step, factor, from);
  double cost = 0.0;
  for (const Number leaf : step.visited()) {
    state_.evaluate(leaf);
    cost += state_.leaves[leaf].cost;
  }
  return cost;
}

// Takes the step back. The leaves get back their earlier evaluations. These may belong to other values of the
// variables: if the tree keeps motions of other variables, it includes their effect on the leaves.
template <class Pose>
void SparseSolver<Pose>::take_back(const Step& step, Before& from) {
  place(step, 0.0, from);
  for (std::size_t i = 0; i < step.visited().size(); ++i) {
    typename State::Leaf& leaf = state_.leaves[step.visited()[i]];
    leaf.cost = from.evaluations[i].cost;
    leaf.gradient.swap(from.evaluations[i].gradient);
    leaf.turned = from.evaluations[i].turned;
  }
}

template <class Pose>
void SparseSolver<Pose>::settle(const TreeChanges& changes) {
  Step step(state_, 0.0);
  state_.solution.tree.settle(changes, step);
  take_step(step, 1.0, save(step));
  std::vector<Number>& pending = state_.solution.pending;
  pending.insert(pending.end(), step.visited().begin(), step.visited().end());
}

// The newest of the stale leaves come first; those beyond kAtOnce wait for the next time.
template <class Pose>
void SparseSolver<Pose>::refactor(TreeChanges changes, JoinReport& report) {
  typename State::Solution& solution = state_.solution;
  constexpr std::size_t kAtOnce = 256;
  const std::size_t taken = std::min(solution.stale.size(), kAtOnce);
  for (std::size_t i = solution.stale.size() - taken; i < solution.stale.size(); ++i)
    changes.leaves.push_back(state_.leaves[solution.stale[i]].key);
  solution.stale.resize(solution.stale.size() - taken);
  report.relinearised += taken;
  remake(changes, report);
}

template <class Pose>
void SparseSolver<Pose>::remake(const TreeChanges& changes, JoinReport& report) {
  typename State::Solution& solution = state_.solution;
  settle(changes);
  std::size_t refactored = 0;
  std::vector<std::uint32_t> assembled;
  if (!solution.tree.update(LeafInformation<Pose>(state_), changes, refactored, assembled))
    throw Error(ErrorCode::numerical, "submap: the map's information is not positive definite; nothing was changed");
  report.refactored += refactored;
  for (const TreeKey& key : changes.leaves) solution.pending.push_back(key.leaf);
  for (const auto& [v, key] : changes.variables) solution.pending.push_back(key.leaf);
  for (const Number leaf : assembled) {
    change_.save_leaf(leaf);
    state_.note_linearisation(leaf);
  }
}

// Saves what the step moves, and returns it.
template <class Pose>
typename SparseSolver<Pose>::Before SparseSolver<Pose>::save(const Step& step) {
  Before before;
  for (const Number leaf : step.visited()) {
    change_.save_leaf(leaf);
    before.evaluations.push_back({state_.leaves[leaf].cost, state_.leaves[leaf].gradient, state_.leaves[leaf].turned});
  }
  for (const auto& [leaf, turn] : step.carried()) {
    before.turned.push_back(state_.leaves[leaf].turned);
    change_.save_turn(leaf);
  }
  for (const typename Step::Entry& entry : step.entries()) {
    const auto number = static_cast<Number>(entry.variable >> 1);
    if (is_landmark(entry.variable)) {
      change_.save_landmark(number);
      before.positions.push_back(state_.landmarks[number].position);
    } else {
      change_.save_base(number);
      before.bases.push_back(state_.bases[number].pose);
    }
  }
  return before;
}

// Each step starts from the leaves that were evaluated since the tree took their forces.
template <class Pose>
void SparseSolver<Pose>::optimise(JoinReport& report) {
  typename State::Solution& solution = state_.solution;
  constexpr int kHalvings = 6;
  // The flexibility of a chain grows with the cube of its length, and so does the effect of a stiffness that belongs to
  // another shape.
  const double borne = std::clamp(10.0 * std::pow(static_cast<double>(state_.leaf_count()), -1.5), 5e-5, 0.3);
  constexpr double kSlack = 0.01;  // of the cost: leaves that were not visited lately have an older cost
  solution.settled = false;
  double tolerance = state_.options.step_tolerance;
  for (int i = 0; i < state_.options.most_iterations && !solution.settled; ++i) {
    if (!solution.stale.empty()) refactor({}, report);
    std::vector<TreeTouch> touches;
    for (const Number leaf : solution.pending) touches.push_back(solution.tree.touch(state_.leaves[leaf].key));
    Step step(state_, tolerance);
    const EliminationTree<Pose> before_step = solution.tree;
    const double foreseen = solution.tree.relax(touches, step);
    ++report.iterations;
    Before from = save(step);
    report.carried += step.carried().size();
    // If the tree keeps motions, the leaves' costs belong to other values than those from which the step starts. For a
    // small step the difference is small; a step that hands everything down is compared with the cost at its start.
    double before = 0.0;
    for (const typename Before::Evaluation& evaluation : from.evaluations) before += evaluation.cost;
    if (tolerance == 0.0) before = take_step(step, 0.0, from);
    double after = take_step(step, 1.0, from);
    if (!(after <= before + kSlack) && tolerance > 0.0) {
      // The step is too large for the linear model. In the next try all moving parts are visited, and the step, a
      // direction of descent, is halved.
      take_back(step, from);
      solution.tree = before_step;
      tolerance = 0.0;
      continue;
    }
    double factor = 1.0;
    for (int halving = 0; !(after <= before + kSlack) && halving < kHalvings; ++halving) {
      factor *= 0.5;
      after = take_step(step, factor, from);
    }
    if (!(after <= before + kSlack)) {  // no smaller step lowers the cost
      take_back(step, from);
      solution.tree = before_step;
      break;
    }
    solution.pending = step.visited();
    // A submap whose shape has changed is linearised anew before the next step.
    for (const Number leaf : solution.pending)
      if (state_.strain(leaf) > borne) solution.stale.push_back(leaf);
    std::sort(solution.stale.begin(), solution.stale.end());
    solution.stale.erase(std::unique(solution.stale.begin(), solution.stale.end()), solution.stale.end());
    // The error of the quadratic model is of third order in the step: m = k x^3, if the model predicted D = h x^2 / 2.
    // The next step, caused by the force 3 k x^2, would lower the cost by 9 m^2 / (4 D). If this is negligible, the
    // force waits for the next closing: its leaves are among the pending ones.
    const double miss = before - after - foreseen;
    const bool foretold = 2.25 * miss * miss <= state_.options.cost_tolerance * foreseen;
    solution.settled = (factor == 1.0 && (foretold || step.largest() < state_.options.convergence_tolerance)) ||
                       (i > 0 && std::abs(before - after) < state_.options.cost_tolerance);
  }
}

template class SparseSolver<SE2>;
template class SparseSolver<SE3>;

}  // namespace cairn
