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
  if (state_.base_saved[base] == number_) return;
  bases_.emplace_back(base, state_.bases[base]);
  state_.base_saved[base] = number_;
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
void SparseChange<Pose>::add_base(const Pose& base) {
  state_.bases.push_back(base);
  state_.base_saved.push_back(number_);
}

template <class Pose>
typename SparseChange<Pose>::Number SparseChange<Pose>::add_landmark(const Point& position) {
  state_.landmarks.push_back({0, 0, position, {}, State::kNone, number_});
  return static_cast<Number>(state_.landmarks.size() - 1);
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
typename SparseState<Pose>::Leaf SparseChange<Pose>::new_leaf(std::shared_ptr<const SubmapData<Pose>> data) const {
  typename State::Leaf leaf;
  leaf.data = std::move(data);
  leaf.key = state_.key_of(static_cast<Number>(state_.leaves.size()));
  leaf.saved = number_;
  return leaf;
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
  if (l.submaps.size() == 1)
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
void SparseChange<Pose>::finish(JoinReport& report) {
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

template <class Pose>
void SparseChange<Pose>::roll_back() noexcept {
  for (const auto& [landmark, count] : extended_) {
    state_.landmarks[landmark].submaps.pop_back();
    state_.landmarks[landmark].count -= count;
  }
  for (const auto& [landmark, position] : positions_) state_.landmarks[landmark].position = position;
  for (const auto& [base, pose] : bases_) state_.bases[base] = pose;
  for (auto turned = turned_.rbegin(); turned != turned_.rend(); ++turned)
    state_.leaves[turned->first].turned = turned->second;
  for (auto& [number, leaf] : leaves_) state_.leaves[number] = std::move(leaf);
  for (Number landmark = landmarks_; landmark < state_.landmarks.size(); ++landmark) {
    if (state_.landmarks[landmark].slot == State::kNone) continue;
    state_.ids.erase(state_.landmarks[landmark].id);
    index_.remove(state_.landmarks[landmark].slot);
  }
  state_.landmarks.resize(landmarks_, typename State::Landmark());
  state_.leaves.resize(leaf_count_, typename State::Leaf());
  state_.bases.resize(base_count_);
  state_.base_saved.resize(base_count_);
  state_.visible.resize(visible_);
  state_.walking_errors.resize(walking_);
  state_.solution = std::move(solution_);
}

template class SparseChange<SE2>;
template class SparseChange<SE3>;

}  // namespace cairn
