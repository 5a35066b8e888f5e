// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_fuser.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

namespace cairn {
namespace {

template <class T>
bool contains(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}
template <class T>
void erase(std::vector<T>& list, const T& value) {
  list.erase(std::remove(list.begin(), list.end(), value), list.end());
}

}  // namespace

template <class Pose>
void SparseFuser<Pose>::run() {
  typename State::Solution& solution = state_.solution;
  if (solution.recent.size() < kNewest + kTogether) return;
  SparseChange<Pose> change(state_, index_);
  SparseSolver<Pose> solver(state_, change);
  const std::vector<Pair> pairs = plan();
  if (pairs.empty()) return change.keep();
  TreeChanges paths, changes;
  for (const Pair& pair : pairs)
    for (const Number leaf : {pair.older, pair.younger}) paths.leaves.push_back(state_.leaves[leaf].key);
  solver.settle(paths);
  for (const Pair& pair : pairs)
    if (fits(pair))  // the older one may have grown in between
      fuse(change, pair, changes);
    else
      solution.grown.push_back(pair.younger);
  const auto left = [&](const TreeKey& key) { return !state_.leaves[key.leaf].used(); };
  changes.leaves.erase(std::remove_if(changes.leaves.begin(), changes.leaves.end(), left), changes.leaves.end());
  JoinReport report;
  solver.refactor(std::move(changes), report);
  solver.optimise(report);
  change.prepare(report);
  change.keep();
}

// Of the submaps that are old enough, and of the places that have grown. A leaf either leaves or grows.
template <class Pose>
std::vector<typename SparseFuser<Pose>::Pair> SparseFuser<Pose>::plan() {
  typename State::Solution& solution = state_.solution;
  Numbers candidates;
  candidates.swap(solution.grown);
  candidates.insert(candidates.end(), solution.recent.begin(), solution.recent.end() - kNewest);
  solution.recent.erase(solution.recent.begin(), solution.recent.end() - kNewest);
  std::vector<Pair> pairs;
  Numbers leaving, growing;
  for (const Number leaf : candidates) {
    if (!fusible(leaf) || contains(leaving, leaf)) continue;
    const Number partner = partner_of(leaf, leaving);
    if (partner == State::kNone) continue;
    const bool older = state_.leaves[leaf].submap < state_.leaves[partner].submap;
    const Pair pair = older ? Pair{leaf, partner} : Pair{partner, leaf};
    if (contains(growing, pair.younger)) {
      solution.grown.push_back(leaf);
      continue;
    }
    pairs.push_back(pair);
    leaving.push_back(pair.younger);
    growing.push_back(pair.older);
  }
  return pairs;
}

template <class Pose>
bool SparseFuser<Pose>::fusible(Number leaf) const {
  return state_.leaves[leaf].used() && state_.solution.anchors.fixes_of(leaf) == nullptr;
}

// The leaf of the same place: the one with most landmarks in common.
template <class Pose>
typename SparseFuser<Pose>::Number SparseFuser<Pose>::partner_of(Number leaf, const Numbers& leaving) const {
  std::map<Number, std::size_t> common;
  for (const Index i : held(state_.leaves[leaf]))
    for (const Number other : state_.landmarks[state_.leaves[leaf].landmarks[i]].submaps)
      if (other != leaf && !contains(state_.solution.recent, other) && !contains(leaving, other) && fusible(other))
        ++common[other];
  Number best = State::kNone;
  for (const auto& [other, count] : common)
    if (fits({leaf, other}) && (best == State::kNone || count > common[best])) best = other;
  return best;
}

// Whether two leaves are of one place, and not too large together. A submap belongs to a place if they have half of the
// smaller one's landmarks in common; two places have been visited again and again, and need only touch.
template <class Pose>
bool SparseFuser<Pose>::fits(const Pair& pair) const {
  const Leaf &a = state_.leaves[pair.older], &b = state_.leaves[pair.younger];
  const std::size_t in_a = held(a).size(), in_b = held(b).size();
  std::size_t common = 0;
  for (const Index i : held(b)) common += contains(state_.landmarks[b.landmarks[i]].submaps, pair.older) ? 1 : 0;
  const bool places = a.place != nullptr && b.place != nullptr;
  return common > 0 && (places || 2 * common >= std::min(in_a, in_b)) &&
         in_a + in_b - common <= std::max(kFew, kLargest * state_.solution.largest);
}

// Whether the leaf knows its place without the poses that it has in common with others: most of its landmarks are
// shared, and they are enough for a pose.
template <class Pose>
bool SparseFuser<Pose>::stands_by_itself(Number leaf) const {
  std::size_t all = 0, shared = 0;
  for (const Index i : held(state_.leaves[leaf])) {
    ++all;
    if (state_.landmarks[state_.leaves[leaf].landmarks[i]].submaps.size() > 1) ++shared;
  }
  return shared >= static_cast<std::size_t>(kDof) && 2 * shared >= all;
}

template <class Pose>
typename SparseFuser<Pose>::Errors SparseFuser<Pose>::held(const Leaf& leaf) const {
  Errors held;
  for (std::size_t i = 0; i < leaf.landmarks.size(); ++i)
    if (leaf.landmarks[i] != State::kNone) held.push_back(static_cast<Index>(i));
  return held;
}

template <class Pose>
typename SparseFuser<Pose>::Union SparseFuser<Pose>::unite(const Pair& pair) const {
  Union both;
  const Leaf &older = state_.leaves[pair.older], &younger = state_.leaves[pair.younger];
  for (const Leaf* leaf : {&older, &younger}) {
    for (const Number pose : leaf->poses)
      if (pose != older.base() && !contains(both.poses, pose)) both.poses.push_back(pose);
    for (const Index i : held(*leaf)) {
      const Number landmark = leaf->landmarks[i];
      const bool known = leaf == &younger && contains(state_.landmarks[landmark].submaps, pair.older);
      if (!known) both.landmarks.push_back(landmark);
    }
  }
  const auto elsewhere = [&](Number leaf) {
    return leaf != State::kNone && leaf != pair.older && leaf != pair.younger;
  };
  const auto sort = [&](bool keep, Index first, int size) {
    for (int d = 0; d < size; ++d) (keep ? both.kept : both.gone).push_back(first + d);
  };
  Numbers held_elsewhere;
  for (const Number pose : both.poses) {
    const Number* leaves = state_.bases[pose].leaves;
    if (pose == state_.solution.newest || elsewhere(leaves[0]) || elsewhere(leaves[1])) held_elsewhere.push_back(pose);
  }
  const Numbers cut = poses_to_cut(pair, held_elsewhere);
  for (std::size_t i = 0; i < both.poses.size(); ++i) {
    const bool keep = contains(held_elsewhere, both.poses[i]) && !contains(cut, both.poses[i]);
    if (keep) both.kept_poses.push_back(both.poses[i]);
    sort(keep, both.error_of_pose(i), kDof);
  }
  for (std::size_t i = 0; i < both.landmarks.size(); ++i) {
    const typename State::Landmark& landmark = state_.landmarks[both.landmarks[i]];
    const bool keep =
        landmark.slot != State::kNone || std::any_of(landmark.submaps.begin(), landmark.submaps.end(), elsewhere);
    if (keep) both.kept_landmarks.push_back(both.landmarks[i]);
    sort(keep, both.error_of_landmark(i), kDim);
  }
  return both;
}

// The oldest of these poses, until few enough are left; not those that another leaf needs.
template <class Pose>
typename SparseFuser<Pose>::Numbers SparseFuser<Pose>::poses_to_cut(const Pair& pair, const Numbers& poses) const {
  Numbers cut;
  for (const Number pose : poses) {
    if (poses.size() - cut.size() <= kPoses) break;
    const auto needs = [&](Number leaf) {
      return leaf != State::kNone && leaf != pair.older && leaf != pair.younger && !stands_by_itself(leaf);
    };
    const Number* leaves = state_.bases[pose].leaves;
    if (pose != state_.solution.newest && !needs(leaves[0]) && !needs(leaves[1])) cut.push_back(pose);
  }
  return cut;
}

// Of all poses and landmarks that the leaf holds, by ordinary errors in these axes.
template <class Pose>
Quadratic SparseFuser<Pose>::cost_of(const Leaf& leaf, const typename Pose::Rotation& axes) const {
  const auto poses = static_cast<Index>(leaf.poses.size());
  const auto about = [&](const auto& factor, const auto& values, std::size_t landmarks) {
    const std::vector<typename Pose::Rotation> all(leaf.poses.size() + landmarks, axes);
    const auto at = factor.evaluate(values);
    return in_axes<Pose>(factor.hessian(values, all), at.gradient, at.cost, poses, axes);
  };
  if (leaf.place != nullptr) return about(*leaf.place, state_.place_values(leaf), leaf.landmarks.size());
  const Errors all = held(leaf);
  if (leaf.factor->shared() == all) return about(*leaf.factor, state_.values(leaf, *leaf.factor), all.size());
  const SubmapFactor<Pose> factor(leaf.data, all);
  return about(factor, state_.values(leaf, factor), all.size());
}

// An error in the axes of the older leaf's base, while this base stays, is an error in its frame. A leaf's cost does
// not change if all of its variables move together, so that the base may stay for every leaf (docs/submaps.md, eq. F1).
template <class Pose>
void SparseFuser<Pose>::add_cost(const Leaf& leaf, const Leaf& older, const Union& both, Quadratic& sum) const {
  std::map<Number, Index> of_pose, of_landmark;  // errors of the union
  for (std::size_t i = 0; i < both.poses.size(); ++i) of_pose[both.poses[i]] = both.error_of_pose(i);
  for (std::size_t i = 0; i < both.landmarks.size(); ++i) of_landmark[both.landmarks[i]] = both.error_of_landmark(i);
  Errors own, all;
  Index next = 0;
  const auto add = [&](Index first, int size) {
    for (int d = 0; d < size; ++d) own.push_back(next + d), all.push_back(first + d);
  };
  for (const Number pose : leaf.poses) {
    if (pose != older.base()) add(of_pose.at(pose), kDof);
    next += kDof;
  }
  for (const Index i : held(leaf)) {
    add(of_landmark.at(leaf.landmarks[i]), kDim);
    next += kDim;
  }
  const Quadratic part = part_of(cost_of(leaf, state_.bases[older.base()].pose.rotation()), own);
  sum.information(all, all) += part.information;
  for (std::size_t i = 0; i < all.size(); ++i) sum.gradient(all[i]) += part.gradient(static_cast<Index>(i));
  sum.constant += part.constant;
}

template <class Pose>
void SparseFuser<Pose>::fuse(SparseChange<Pose>& change, const Pair& pair, TreeChanges& changes) {
  const Union both = unite(pair);
  Leaf& leaf = state_.leaves[pair.older];
  const Index n = both.error_of_landmark(both.landmarks.size());
  Quadratic sum{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n), 0.0};
  for (const Number part : {pair.older, pair.younger}) add_cost(state_.leaves[part], leaf, both, sum);
  Errors order = both.gone;
  order.insert(order.end(), both.kept.begin(), both.kept.end());
  const Quadratic cost = without(part_of(sum, order), static_cast<Index>(both.gone.size()));

  change.save_leaf(pair.older);
  leaf.poses.resize(1);
  leaf.poses.insert(leaf.poses.end(), both.kept_poses.begin(), both.kept_poses.end());
  leaf.landmarks = both.kept_landmarks;
  leaf.data = nullptr;
  leaf.factor = nullptr;
  std::vector<std::uint64_t> ids;
  for (const Number landmark : leaf.landmarks) ids.push_back(state_.landmarks[landmark].id);
  leaf.place = std::make_shared<const PlaceFactor<Pose>>(state_.place_values(leaf), std::move(ids), cost);

  changes.leaves.push_back(leaf.key);
  changes.removed.push_back(state_.leaves[pair.younger].key);
  hand_over_poses(change, pair, both);
  hand_over_landmarks(change, pair, both, changes);
  hand_over_submaps(change, pair);
  typename State::Solution& solution = state_.solution;
  for (Numbers* list : {&solution.pending, &solution.stale, &solution.grown}) erase(*list, pair.younger);
  solution.pending.push_back(pair.older);
  solution.grown.push_back(pair.older);
  change.remove_leaf(pair.younger);
  state_.shape(leaf);
  state_.evaluate(pair.older);
}

// A pose that was cut stays with the other leaf that holds it.
template <class Pose>
void SparseFuser<Pose>::hand_over_poses(SparseChange<Pose>& change, const Pair& pair, const Union& both) {
  typename State::Solution& solution = state_.solution;
  const Number own = state_.leaves[pair.older].base();
  Numbers poses = both.poses;
  poses.push_back(own);
  for (const Number number : poses) {
    change.save_base(number);
    typename State::Base& base = state_.bases[number];
    for (const Number leaf : {pair.older, pair.younger})
      if (base.held_by(leaf)) base.replace(leaf, State::kNone);
    if (number == own || contains(both.kept_poses, number)) base.replace(State::kNone, pair.older);
    if (base.held() == 0 && number != solution.newest) {
      change.free_base(number);
      solution.tree.forget(base_variable(number));
      continue;
    }
    solution.tree.set_degree(base_variable(number), number == solution.newest ? 2 : base.held());
    for (const Number leaf : base.leaves)
      if (leaf != State::kNone) solution.pending.push_back(leaf);
  }
}

template <class Pose>
void SparseFuser<Pose>::hand_over_landmarks(SparseChange<Pose>& change, const Pair& pair, const Union& both,
                                            TreeChanges& changes) {
  EliminationTree<Pose>& tree = state_.solution.tree;
  for (const Number number : both.landmarks) {
    typename State::Landmark& landmark = state_.landmarks[number];
    if (!contains(both.kept_landmarks, number)) {
      change.free_landmark(number);
      tree.forget(landmark_variable(number));
      continue;
    }
    if (contains(landmark.submaps, pair.younger)) {
      change.save_holders(number);
      const bool first = landmark.submaps[0] == pair.younger;
      erase(landmark.submaps, pair.younger);
      if (!contains(landmark.submaps, pair.older)) landmark.submaps.push_back(pair.older);
      // Its error is in the axes of another base now, and those who hold it have to be linearised anew.
      if (first)
        for (const Number leaf : landmark.submaps) changes.leaves.push_back(state_.leaves[leaf].key);
    }
    tree.set_degree(landmark_variable(number), static_cast<std::int32_t>(landmark.submaps.size()));
  }
}

template <class Pose>
void SparseFuser<Pose>::hand_over_submaps(SparseChange<Pose>& change, const Pair& pair) {
  const Leaf &older = state_.leaves[pair.older], &younger = state_.leaves[pair.younger];
  const Pose T = state_.bases[older.base()].pose.inverse() * state_.bases[younger.base()].pose;
  const auto move = [&](Number submap) {
    change.move_submap(submap, pair.older, T * state_.submaps[submap].T_leaf_submap);
  };
  if (younger.place == nullptr) return move(younger.submap);
  for (Number submap = 0; submap < state_.submaps.size(); ++submap)
    if (state_.submaps[submap].leaf == pair.younger) move(submap);
}

template class SparseFuser<SE2>;
template class SparseFuser<SE3>;

}  // namespace cairn
