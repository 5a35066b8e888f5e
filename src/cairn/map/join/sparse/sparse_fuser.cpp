// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_fuser.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <unordered_map>
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
  if (state_.solution.recent.size() < kNewest + kTogether) return;
  SparseChange<Pose> change(state_, index_);
  SparseSolver<Pose> solver(state_, change);
  const std::vector<Group> groups = plan();
  if (groups.empty()) return change.keep();
  TreeChanges paths, changes;
  for (const Group& group : groups)
    for (const Number leaf : group) paths.leaves.push_back(state_.leaves[leaf].key);
  solver.settle(paths);
  bool cut = false;
  for (const Group& group : groups) cut = fuse(change, group, changes) || cut;
  const auto left = [&](const TreeKey& key) { return !state_.leaves[key.leaf].used(); };
  changes.leaves.erase(std::remove_if(changes.leaves.begin(), changes.leaves.end(), left), changes.leaves.end());
  JoinReport report;
  solver.remake(changes, report);
  if (cut) solver.optimise(report);
  change.prepare(report);
  change.keep();
}

// Of the submaps that are old enough, and of the places that have grown. A leaf either leaves or grows; what cannot be
// done now is looked at again the next time.
template <class Pose>
std::vector<typename SparseFuser<Pose>::Group> SparseFuser<Pose>::plan() {
  typename State::Solution& solution = state_.solution;
  Numbers candidates;
  candidates.swap(solution.grown);
  candidates.insert(candidates.end(), solution.recent.begin(), solution.recent.end() - kNewest);
  solution.recent.erase(solution.recent.begin(), solution.recent.end() - kNewest);
  std::vector<Group> groups;
  Numbers leaving;
  for (const Number leaf : candidates) {
    if (!fusible(leaf) || contains(leaving, leaf)) continue;
    const Number partner = partner_of(leaf, leaving);
    if (partner == State::kNone) continue;
    const bool older = state_.leaves[leaf].submap < state_.leaves[partner].submap;
    const Number stays = older ? leaf : partner, leaves = older ? partner : leaf;
    const auto group_of = [&](Number oldest) {
      return std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return group[0] == oldest; });
    };
    auto group = group_of(stays);
    if (group_of(leaves) != groups.end() || (group != groups.end() && !has_room(*group, leaves))) {
      solution.grown.push_back(leaf);
      continue;
    }
    if (group == groups.end()) group = groups.insert(groups.end(), {stays});
    group->push_back(leaves);
    leaving.push_back(leaves);
  }
  return groups;
}

template <class Pose>
bool SparseFuser<Pose>::fusible(Number leaf) const {
  return state_.leaves[leaf].used() && !state_.leaves[leaf].fixed() &&
         state_.solution.anchors.fixes_of(leaf) == nullptr;
}

// The leaf of the same place: the one with most landmarks in common. Two submaps of one place stay as they are, for
// they cost less than a place, whose landmarks all are variables: it takes three.
template <class Pose>
typename SparseFuser<Pose>::Number SparseFuser<Pose>::partner_of(Number leaf, const Numbers& leaving) const {
  std::map<Number, std::size_t> common;
  for (const Index i : held(state_.leaves[leaf]))
    for (const Number other : state_.landmarks[state_.leaves[leaf].landmarks[i]].submaps)
      if (other != leaf && !contains(state_.solution.recent, other) && !contains(leaving, other) && fusible(other))
        ++common[other];
  Number best = State::kNone;
  std::size_t partners = 0;
  bool place = state_.leaves[leaf].place != nullptr;
  for (const auto& [other, count] : common) {
    if (!of_one_place(leaf, other, count) || !has_room({leaf}, other)) continue;
    ++partners;
    place = place || state_.leaves[other].place != nullptr;
    if (best == State::kNone || count > common[best]) best = other;
  }
  return place || partners > 1 ? best : State::kNone;
}

// A submap belongs to a place if half of the smaller one's landmarks are among the `common` ones. Two places have been
// visited again and again, and need only touch.
template <class Pose>
bool SparseFuser<Pose>::of_one_place(Number a, Number b, std::size_t common) const {
  const Leaf &first = state_.leaves[a], &second = state_.leaves[b];
  if (first.place != nullptr && second.place != nullptr) return true;
  return 2 * common >= std::min(held(first).size(), held(second).size());
}

// Whether all of them together are not too large.
template <class Pose>
bool SparseFuser<Pose>::has_room(Group group, Number another) const {
  group.push_back(another);
  return landmarks_of(group).size() <= std::max(kFew, kLargest * state_.solution.largest);
}

// Each landmark once, those of the first leaf first.
template <class Pose>
typename SparseFuser<Pose>::Numbers SparseFuser<Pose>::landmarks_of(const Group& group) const {
  Numbers landmarks;
  for (auto leaf = group.begin(); leaf != group.end(); ++leaf)
    for (const Index i : held(state_.leaves[*leaf])) {
      const Number landmark = state_.leaves[*leaf].landmarks[i];
      const bool before = std::any_of(
          group.begin(), leaf, [&](Number earlier) { return contains(state_.landmarks[landmark].submaps, earlier); });
      if (!before) landmarks.push_back(landmark);
    }
  return landmarks;
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
typename SparseFuser<Pose>::Union SparseFuser<Pose>::unite(const Group& group) const {
  Union all;
  all.landmarks = landmarks_of(group);
  for (const Number leaf : group)
    for (const Number pose : state_.leaves[leaf].poses)
      if (pose != state_.leaves[group[0]].base() && !contains(all.poses, pose)) all.poses.push_back(pose);
  const auto elsewhere = [&](Number leaf) { return leaf != State::kNone && !contains(group, leaf); };
  const auto sort = [&](bool keep, Index first, int size) {
    for (int d = 0; d < size; ++d) (keep ? all.kept : all.gone).push_back(first + d);
  };
  Numbers held_elsewhere;
  for (const Number pose : all.poses) {
    const Number* holders = state_.bases[pose].leaves;
    if (pose == state_.solution.newest || elsewhere(holders[0]) || elsewhere(holders[1]))
      held_elsewhere.push_back(pose);
  }
  const Numbers cut = poses_to_cut(group, held_elsewhere);
  all.cut = !cut.empty();
  for (std::size_t i = 0; i < all.poses.size(); ++i) {
    const bool keep = contains(held_elsewhere, all.poses[i]) && !contains(cut, all.poses[i]);
    if (keep) all.kept_poses.push_back(all.poses[i]);
    sort(keep, all.error_of_pose(i), kDof);
  }
  for (std::size_t i = 0; i < all.landmarks.size(); ++i) {
    const typename State::Landmark& landmark = state_.landmarks[all.landmarks[i]];
    const bool keep =
        landmark.slot != State::kNone || std::any_of(landmark.submaps.begin(), landmark.submaps.end(), elsewhere);
    if (keep) all.kept_landmarks.push_back(all.landmarks[i]);
    sort(keep, all.error_of_landmark(i), kDim);
  }
  return all;
}

// The oldest of these poses, until few enough are left; not those that another leaf needs.
template <class Pose>
typename SparseFuser<Pose>::Numbers SparseFuser<Pose>::poses_to_cut(const Group& group, const Numbers& poses) const {
  Numbers cut;
  for (const Number pose : poses) {
    if (poses.size() - cut.size() <= kPoses) break;
    const auto needs = [&](Number leaf) {
      return leaf != State::kNone && !contains(group, leaf) && !stands_by_itself(leaf);
    };
    const Number* holders = state_.bases[pose].leaves;
    if (pose != state_.solution.newest && !needs(holders[0]) && !needs(holders[1])) cut.push_back(pose);
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

// An error in the axes of the oldest leaf's base, while this base stays, is an error in its frame. A leaf's cost does
// not change if all of its variables move together, so that the base may stay for every leaf (docs/submaps.md, eq. F1).
template <class Pose>
void SparseFuser<Pose>::add_cost(const Leaf& leaf, const Leaf& oldest, const Union& all, Quadratic& sum) const {
  std::unordered_map<Number, Index> of_pose, of_landmark;  // errors of the union
  for (std::size_t i = 0; i < all.poses.size(); ++i) of_pose[all.poses[i]] = all.error_of_pose(i);
  for (std::size_t i = 0; i < all.landmarks.size(); ++i) of_landmark[all.landmarks[i]] = all.error_of_landmark(i);
  Errors from, to;
  Index next = 0;
  const auto add = [&](Index first, int size) {
    for (int d = 0; d < size; ++d) from.push_back(next + d), to.push_back(first + d);
  };
  for (const Number pose : leaf.poses) {
    if (pose != oldest.base()) add(of_pose.at(pose), kDof);
    next += kDof;
  }
  for (const Index i : held(leaf)) {
    add(of_landmark.at(leaf.landmarks[i]), kDim);
    next += kDim;
  }
  add_part(cost_of(leaf, state_.bases[oldest.base()].pose.rotation()), from, to, sum);
}

template <class Pose>
bool SparseFuser<Pose>::fuse(SparseChange<Pose>& change, const Group& group, TreeChanges& changes) {
  const Union all = unite(group);
  const Number oldest = group[0];
  Leaf& leaf = state_.leaves[oldest];
  const Index n = all.error_of_landmark(all.landmarks.size());
  Quadratic sum{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n), 0.0};
  for (const Number part : group) add_cost(state_.leaves[part], leaf, all, sum);
  const Quadratic cost = without(sum, all.gone, all.kept);

  change.save_leaf(oldest);
  leaf.poses.resize(1);
  leaf.poses.insert(leaf.poses.end(), all.kept_poses.begin(), all.kept_poses.end());
  leaf.landmarks = all.kept_landmarks;
  leaf.data = nullptr;
  leaf.factor = nullptr;
  std::vector<std::uint64_t> ids;
  for (const Number landmark : leaf.landmarks) ids.push_back(state_.landmarks[landmark].id);
  leaf.place = std::make_shared<const PlaceFactor<Pose>>(state_.place_values(leaf), std::move(ids), cost);

  changes.leaves.push_back(leaf.key);
  hand_over_poses(change, group, all);
  hand_over_landmarks(change, group, all, changes);
  typename State::Solution& solution = state_.solution;
  for (std::size_t k = 1; k < group.size(); ++k) {
    hand_over_submaps(change, group[k], oldest);
    changes.removed.push_back(state_.leaves[group[k]].key);
    for (Numbers* list : {&solution.pending, &solution.stale, &solution.grown}) erase(*list, group[k]);
    change.remove_leaf(group[k]);
  }
  solution.pending.push_back(oldest);
  solution.grown.push_back(oldest);
  state_.shape(leaf);
  state_.evaluate(oldest);
  return all.cut;
}

// A pose that was cut stays with the other leaf that holds it.
template <class Pose>
void SparseFuser<Pose>::hand_over_poses(SparseChange<Pose>& change, const Group& group, const Union& all) {
  typename State::Solution& solution = state_.solution;
  const Number own = state_.leaves[group[0]].base();
  Numbers poses = all.poses;
  poses.push_back(own);
  for (const Number number : poses) {
    change.save_base(number);
    typename State::Base& base = state_.bases[number];
    for (Number& leaf : base.leaves)
      if (contains(group, leaf)) leaf = State::kNone;
    if (number == own || contains(all.kept_poses, number)) base.add(group[0]);
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
void SparseFuser<Pose>::hand_over_landmarks(SparseChange<Pose>& change, const Group& group, const Union& all,
                                            TreeChanges& changes) {
  EliminationTree<Pose>& tree = state_.solution.tree;
  std::size_t kept = 0;
  for (const Number number : all.landmarks) {
    typename State::Landmark& landmark = state_.landmarks[number];
    if (kept == all.kept_landmarks.size() || all.kept_landmarks[kept] != number) {
      change.free_landmark(number);
      tree.forget(landmark_variable(number));
      continue;
    }
    ++kept;
    const Number first = landmark.submaps[0];
    if (landmark.submaps.size() > 1 || first != group[0]) {
      change.save_holders(number);
      for (std::size_t k = 1; k < group.size(); ++k) erase(landmark.submaps, group[k]);
      if (!contains(landmark.submaps, group[0])) landmark.submaps.push_back(group[0]);
      // Its error is in the axes of another base now, and those who hold it have to be linearised anew.
      if (first != landmark.submaps[0])
        for (const Number leaf : landmark.submaps) changes.leaves.push_back(state_.leaves[leaf].key);
    }
    tree.set_degree(landmark_variable(number), static_cast<std::int32_t>(landmark.submaps.size()));
  }
}

template <class Pose>
void SparseFuser<Pose>::hand_over_submaps(SparseChange<Pose>& change, Number from, Number to) {
  const Leaf &old = state_.leaves[from], &next = state_.leaves[to];
  const Pose T = state_.bases[next.base()].pose.inverse() * state_.bases[old.base()].pose;
  const auto move = [&](Number submap) { change.move_submap(submap, to, T * state_.submaps[submap].T_leaf_submap); };
  if (old.place == nullptr) return move(old.submap);
  for (Number submap = 0; submap < state_.submaps.size(); ++submap)
    if (state_.submaps[submap].leaf == from) move(submap);
}

template class SparseFuser<SE2>;
template class SparseFuser<SE3>;

}  // namespace cairn
