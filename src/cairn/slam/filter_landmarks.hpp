// SPDX-License-Identifier: BSD-3-Clause
// The life of landmarks: when one counts, when it goes, when two are one. Included by filter.cpp alone.
#pragma once

#include <utility>

#include "core/error.hpp"
#include "slam/filter.hpp"

namespace cairn {

// Names of a landmark whose values have moved.
template <class Pose>
void Filter<Pose>::move_slot(Index from, Index to) {
  ids_[to] = ids_[from];
  counts_[to] = counts_[from];
  sightings_[to] = sightings_[from];
  slots_.set(ids_[to], static_cast<std::int32_t>(to));
}

template <class Pose>
void Filter<Pose>::exchange_slots(Index a, Index b) {
  if (a == b) return;
  ekf_.exchange_landmarks(a, b);
  std::swap(ids_[a], ids_[b]);
  std::swap(counts_[a], counts_[b]);
  std::swap(sightings_[a], sightings_[b]);
  slots_.set(ids_[a], static_cast<std::int32_t>(a));
  slots_.set(ids_[b], static_cast<std::int32_t>(b));
}

// Names of the one that the covariance got last, observed once.
template <class Pose>
void Filter<Pose>::append_landmark(std::uint64_t id) {
  const Index slot = ekf_.size() - 1;
  ids_[slot] = id;
  counts_[slot] = 1;
  sightings_[slot] = {frames_, frames_, 0};
  slots_.set(id, static_cast<std::int32_t>(slot));
  if (options_.deferred_sightings > 1) ++deferred_;
}

template <class Pose>
Index Filter<Pose>::slot_at(std::uint64_t id) const {
  const std::int32_t slot = slots_.find(id);
  if (slot == IdTable::kAbsent)
    throw Error(ErrorCode::not_found, "id: there is no landmark %llu here", static_cast<unsigned long long>(id));
  return slot;
}

template <class Pose>
void Filter<Pose>::forget_local(std::int32_t slot) {
  const std::uint64_t id = ids_[slot];
  Index at = slot;
  if (at < first_deferred()) {  // the last that counts takes its place, and the last of all that one's
    exchange_slots(at, first_deferred() - 1);
    at = first_deferred() - 1;
  } else {
    --deferred_;
  }
  const Index last = ekf_.size() - 1;
  ekf_.remove(at);
  slots_.erase(id);
  if (at != last) move_slot(last, at);
}

template <class Pose>
void Filter<Pose>::remove_landmark(std::uint64_t id) {
  const std::int32_t slot = slots_.find(id);
  std::size_t index = 0;
  const bool mapped = map_ != nullptr && map_->find(id, index);
  if (slot == IdTable::kAbsent && !mapped)
    throw Error(ErrorCode::not_found, "id: the map has no landmark %llu", static_cast<unsigned long long>(id));
  if (mapped) map_->remove(id);
  if (slot != IdTable::kAbsent) forget_local(slot);
}

template <class Pose>
void Filter<Pose>::set_view(int sensor, const Vector3& lower, const Vector3& upper) {
  sensor_slot(sensor);  // there is one of this number
  views_[sensor] = {true, lower, upper};
}

// Whether the sensor should see a landmark: its image lies in the view, and would so three standard deviations off.
template <class Pose>
bool Filter<Pose>::in_view(const Sensor<Pose>& sensor, const View& view, Index slot) const {
  constexpr double kOff = 3.0;
  Prediction<Pose> prediction;
  Matrix3 S;
  if (!image_of(sensor, slot, prediction, S)) return false;
  for (int r = 0; r < sensor.rows(); ++r) {
    const double off = kOff * std::sqrt(S(r, r));
    if (!(prediction.z[r] - off >= view.lower[r] && prediction.z[r] + off <= view.upper[r])) return false;
  }
  return true;
}

// After a frame: landmarks that were observed often enough count from now on; those that did not come to that in time
// go, and those that should have been seen and were not. What an observation was compared with is not missed, whatever
// became of that observation.
template <class Pose>
void Filter<Pose>::review_landmarks(int sensor_number, Index count) {
  const bool defers = options_.deferred_sightings > 1, misses = options_.missed_frames > 0;
  ++frames_;
  if (!defers && !misses) return;
  for (Index i = 0; i < count; ++i) {
    const std::int32_t slot = matches_[i].landmark == kNoId ? IdTable::kAbsent : slots_.find(matches_[i].landmark);
    if (slot == IdTable::kAbsent) continue;
    sightings_[slot].seen = frames_;
    sightings_[slot].missed = 0;
  }
  for (Index slot = first_deferred(); slot < ekf_.size(); ++slot)
    if (counts_[slot] >= static_cast<std::uint64_t>(options_.deferred_sightings)) {
      exchange_slots(slot, first_deferred());
      --deferred_;
    }
  const auto remove = [&](Index slot) {
    forget_local(static_cast<std::int32_t>(slot));
    ++report_.removed;
  };
  for (Index slot = ekf_.size(); slot-- > first_deferred();)
    if (frames_ - sightings_[slot].placed > static_cast<std::uint64_t>(options_.deferred_frames)) remove(slot);
  report_.deferred = deferred_;
  const View& view = views_[sensor_number];
  if (!misses || !view.set) return;
  const Sensor<Pose>& sensor = sensor_at(sensor_number);
  for (Index slot = ekf_.size(); slot-- > ekf_.companions();) {
    Sightings& own = sightings_[slot];
    if (own.seen == frames_ || !in_view(sensor, view, slot)) continue;
    if (++own.missed >= options_.missed_frames) remove(slot);
  }
  report_.deferred = deferred_;
}

// l_id - l_other = 0: an observation of both, exact but for what keeps S positive definite.
template <class Pose>
void Filter<Pose>::take_in_merge(std::uint64_t id, std::uint64_t other) {
  constexpr double kExact = 1e-6;  // of the smaller variance
  if (id == other) throw Error(ErrorCode::argument, "id: a landmark cannot be merged with itself");
  if (options_.max_observations < 2)
    throw Error(ErrorCode::capacity, "id: merging looks at two landmarks at once, and max_observations is 1");
  const Index keep = slot_at(id), gone = slot_at(other);
  start_report(1);
  window_slots_[0] = keep;
  window_slots_[1] = gone;
  const double variance =
      std::min(ekf_.landmark_covariance(keep).trace(), ekf_.landmark_covariance(gone).trace()) / kDim;
  const Point apart = ekf_.landmark(gone) - ekf_.landmark(keep);
  ekf_.open(window_slots_, 2, nullptr);
  update_alone(kDim, 1, id, [&](double*) {
    using Block = Eigen::Matrix<double, kDim, kDim>;
    ekf_.batch().clear();
    const Index row = ekf_.batch().add_rows(kDim);
    std::copy_n(apart.data(), kDim, ekf_.batch().residual());
    Eigen::Map<Block>(ekf_.batch().add_noise(row, kDim)) = kExact * variance * Block::Identity();
    const Eigen::Matrix<double, kDim, kDof> J_pose = Eigen::Matrix<double, kDim, kDof>::Zero();
    const auto pose = ekf_.add_pose_block(row, kDim, J_pose, false);
    const Block one = Block::Identity(), minus = -Block::Identity();
    ekf_.add_landmark_block(row, kDim, one, 0, pose);
    ekf_.add_landmark_block(row, kDim, minus, 1, pose);
    return true;
  });
  if (matches_[0].decision != Decision::matched) return;
  counts_[keep] += counts_[gone];
  forget_local(static_cast<std::int32_t>(gone));
}

template <class Pose>
void Filter<Pose>::split_landmark(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance) {
  const Index slot = slot_at(id);
  if (slots_.find(fresh) != IdTable::kAbsent)
    throw Error(ErrorCode::argument, "fresh: there is a landmark %llu already", static_cast<unsigned long long>(fresh));
  if (landmark_count() >= options_.local_landmarks())
    throw Error(ErrorCode::capacity, "fresh: the map holds %td landmarks already", landmark_count());
  const bool counts = slot < first_deferred();
  ekf_.duplicate(slot, covariance);
  append_landmark(fresh);
  unknowns_.next_id = std::max(unknowns_.next_id, options_.association == AssociationKind::known ? 0 : fresh + 1);
  if (counts && deferred_ > 0 && slots_.find(fresh) >= first_deferred()) {  // it counts as the one that it was part of
    exchange_slots(slots_.find(fresh), first_deferred());
    --deferred_;
  }
}

}  // namespace cairn
