// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_change.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn {

template <class Pose>
SparseChange<Pose>::SparseChange(SparseState<Pose>& state, SpatialIndex& index)
    : state_(state),
      index_(index),
      number_(++state.change),
      landmarks_(static_cast<Number>(state.landmarks.size())),
      leaf_count_(state.leaves.size()),
      base_count_(state.bases.size()),
      submap_count_(state.submaps.size()),
      visible_(state.visible.size()),
      walking_(state.walking_errors.size()),
      solution_(state.solution) {}

template <class Pose>
SparseChange<Pose>::~SparseChange() {
  if (!kept_) roll_back();
}

template <class Pose>
void SparseChange<Pose>::save_landmark(Number landmark) {
  if (state_.landmarks[landmark].saved == number_) return;
  positions_.emplace_back(landmark, state_.landmarks[landmark].position);
  state_.landmarks[landmark].saved = number_;
}

template <class Pose>
void SparseChange<Pose>::save_base(Number base) {
  if (state_.bases[base].saved == number_) return;
  bases_.emplace_back(base, state_.bases[base]);
  state_.bases[base].saved = number_;
}

// And the positions of its private landmarks.
template <class Pose>
void SparseChange<Pose>::save_leaf(Number leaf) {
  if (state_.leaves[leaf].saved == number_) return;
  leaves_.emplace_back(leaf, state_.leaves[leaf]);
  for (const Number landmark : state_.leaves[leaf].landmarks)
    if (landmark != State::kNone && landmark < landmarks_) save_landmark(landmark);
  state_.leaves[leaf].saved = number_;
}

template <class Pose>
void SparseChange<Pose>::save_turn(Number leaf) {
  if (state_.leaves[leaf].saved != number_) turned_.emplace_back(leaf, state_.leaves[leaf].turned);
}

template <class Pose>
typename SparseChange<Pose>::Number SparseChange<Pose>::add_base(const Pose& base) {
  std::vector<Number>& free = state_.solution.free_bases;
  typename State::Base fresh;
  fresh.pose = base;
  fresh.saved = number_;
  if (free.empty()) {
    state_.bases.push_back(fresh);
    return static_cast<Number>(state_.bases.size() - 1);
  }
  const Number number = free.back();
  save_base(number);
  state_.bases[number] = fresh;
  free.pop_back();
  return number;
}

template <class Pose>
typename SparseChange<Pose>::Number SparseChange<Pose>::add_landmark(const Point& position) {
  std::vector<Number>& free = state_.solution.free_landmarks;
  const typename State::Landmark fresh{0, 0, position, {}, State::kNone, number_};
  if (free.empty()) {
    state_.landmarks.push_back(fresh);
    return static_cast<Number>(state_.landmarks.size() - 1);
  }
  const Number number = free.back();
  again_.push_back(number);
  state_.landmarks[number] = fresh;
  free.pop_back();
  return number;
}

template <class Pose>
void SparseChange<Pose>::add_errors(const Eigen::VectorXd& values) {
  for (Index at = 0; at < values.size(); at += Pose::kDim) {
    state_.walking_errors.push_back(add_landmark(values.segment<Pose::kDim>(at)));
    state_.landmarks.back().error = true;
  }
}

template <class Pose>
void SparseChange<Pose>::show_landmark(Number number, std::uint64_t id) {
  typename State::Landmark& landmark = state_.landmarks[number];
  landmark.id = id;
  landmark.slot = static_cast<Number>(state_.visible.size());
  state_.visible.push_back(number);
  state_.ids.emplace(id, number);
  index_.add(landmark.slot);
}

template <class Pose>
typename SparseChange<Pose>::Number SparseChange<Pose>::add_leaf(std::vector<Number> poses) {
  std::vector<Number>& free = state_.solution.free_leaves;
  const Number number = free.empty() ? static_cast<Number>(state_.leaves.size()) : free.back();
  for (const Number base : poses) {
    save_base(base);
    state_.bases[base].add(number);
  }
  typename State::Leaf leaf;
  leaf.key = state_.key_of(number, poses[0]);
  leaf.poses = std::move(poses);
  leaf.submap = static_cast<Number>(state_.submaps.size());
  leaf.saved = number_;
  state_.submaps.push_back({number, Pose()});
  if (free.empty()) {
    state_.leaves.push_back(std::move(leaf));
  } else {
    save_leaf(number);
    state_.leaves[number] = std::move(leaf);
    free.pop_back();
  }
  return number;
}

template <class Pose>
void SparseChange<Pose>::remove_leaf(Number number) {
  save_leaf(number);
  state_.solution.free_leaves.push_back(number);
  state_.leaves[number] = typename State::Leaf();
  state_.leaves[number].saved = number_;
}

template <class Pose>
void SparseChange<Pose>::free_base(Number base) {
  save_base(base);
  state_.solution.free_bases.push_back(base);
}

template <class Pose>
void SparseChange<Pose>::free_landmark(Number landmark) {
  save_landmark(landmark);
  save_holders(landmark);
  state_.solution.free_landmarks.push_back(landmark);
  state_.landmarks[landmark].submaps.clear();
}

template <class Pose>
void SparseChange<Pose>::save_holders(Number landmark) {
  holders_.emplace_back(landmark, state_.landmarks[landmark].submaps);
}

template <class Pose>
void SparseChange<Pose>::move_submap(Number submap, Number leaf, const Pose& T_leaf_submap) {
  submaps_.emplace_back(submap, state_.submaps[submap]);
  state_.submaps[submap] = {leaf, T_leaf_submap};
}

template <class Pose>
void SparseChange<Pose>::extend(Number landmark, Number submap, std::uint64_t count) {
  save_landmark(landmark);
  extended_.emplace_back(landmark, count);
  typename State::Landmark& l = state_.landmarks[landmark];
  try {
    l.submaps.push_back(submap);
  } catch (...) {
    extended_.pop_back();
    throw;
  }
  l.count += count;
}

template <class Pose>
void SparseChange<Pose>::note_held_again(Number landmark, std::vector<Number>& reshaped, TreeChanges& changes) const {
  const typename State::Landmark& l = state_.landmarks[landmark];
  if (!state_.shared(landmark))
    reshaped.push_back(l.submaps[0]);
  else
    changes.variables.emplace_back(landmark_variable(landmark), state_.leaves[l.submaps[0]].key);
}

template <class Pose>
double SparseChange<Pose>::cost_growth() const {
  double change = 0.0;
  for (std::size_t i = leaf_count_; i < state_.leaves.size(); ++i) change += state_.leaves[i].cost;
  for (const auto& [number, leaf] : leaves_) change += state_.leaves[number].cost - leaf.cost;
  return change;
}

template <class Pose>
void SparseChange<Pose>::prepare(JoinReport& report) {
  for (const auto& [number, leaf] : leaves_) state_.place_private(number);
  for (std::size_t i = leaf_count_; i < state_.leaves.size(); ++i) state_.place_private(static_cast<Number>(i));
  state_.refresh_base_covariance();
  double sum = 0.0;
  for (const auto& [landmark, before] : positions_) {
    if (state_.landmarks[landmark].error) continue;
    const double way = (state_.landmarks[landmark].position - before).squaredNorm();
    sum += way;
    report.moved_max = std::max(report.moved_max, std::sqrt(way));
  }
  if (landmarks_ > 0) report.moved_rms = std::sqrt(sum / landmarks_);
}

template <class Pose>
void SparseChange<Pose>::keep() noexcept {
  hide();
  note_moves();
  kept_ = true;
}

template <class Pose>
void SparseChange<Pose>::hide() noexcept {
  for (const auto& [old, next] : hidden_) {
    const auto name = state_.ids.find(state_.landmarks[old].id);
    if (next != State::kNone) {
      const Number slot = std::exchange(state_.landmarks[old].slot, State::kNone);
      state_.landmarks[next].id = name->first;
      state_.landmarks[next].slot = slot;
      state_.visible[slot] = next;
      name->second = next;
    } else {
      state_.hide(name);
      index_.remove(state_.visible.size());
    }
  }
  if (!hidden_.empty()) index_.moved_all();
}

// Reports the motions to the spatial index. The index may allocate for single moves, but moved_all() needs no memory.
template <class Pose>
void SparseChange<Pose>::note_moves() noexcept {
  try {
    for (const auto& [landmark, before] : positions_)
      if (state_.landmarks[landmark].slot != State::kNone) index_.moved(state_.landmarks[landmark].slot);
  } catch (...) {
    index_.moved_all();
  }
}

// In reverse order: of a value that was saved twice, the first one stays.
template <class Pose>
void SparseChange<Pose>::roll_back() noexcept {
  const auto in_reverse = [](auto& list, auto&& restore) {
    for (auto saved = list.rbegin(); saved != list.rend(); ++saved) restore(saved->first, saved->second);
  };
  for (const auto& [landmark, count] : extended_) {
    state_.landmarks[landmark].submaps.pop_back();
    state_.landmarks[landmark].count -= count;
  }
  in_reverse(positions_, [&](Number landmark, const Point& place) { state_.landmarks[landmark].position = place; });
  in_reverse(holders_, [&](Number landmark, auto& holders) { state_.landmarks[landmark].submaps.swap(holders); });
  in_reverse(submaps_, [&](Number submap, const auto& closed) { state_.submaps[submap] = closed; });
  in_reverse(bases_, [&](Number number, const auto& base) { state_.bases[number] = base; });
  in_reverse(turned_, [&](Number leaf, const Rotation& turned) { state_.leaves[leaf].turned = turned; });
  in_reverse(leaves_, [&](Number number, auto& leaf) { state_.leaves[number] = std::move(leaf); });
  const auto take_name = [&](Number landmark) {
    if (state_.landmarks[landmark].slot == State::kNone) return;
    state_.ids.erase(state_.landmarks[landmark].id);
    index_.remove(state_.landmarks[landmark].slot);
    state_.landmarks[landmark].slot = State::kNone;
  };
  for (const Number landmark : again_) {
    take_name(landmark);
    state_.landmarks[landmark].submaps.clear();
  }
  for (Number landmark = landmarks_; landmark < state_.landmarks.size(); ++landmark) take_name(landmark);
  state_.landmarks.resize(landmarks_, typename State::Landmark());
  state_.leaves.resize(leaf_count_, typename State::Leaf());
  state_.bases.resize(base_count_);
  state_.submaps.resize(submap_count_, typename State::Closed());
  state_.visible.resize(visible_);
  state_.walking_errors.resize(walking_);
  state_.solution = std::move(solution_);
}

template class SparseChange<SE2>;
template class SparseChange<SE3>;

}  // namespace cairn
