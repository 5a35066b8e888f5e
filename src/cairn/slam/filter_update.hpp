// SPDX-License-Identifier: BSD-3-Clause
// Observations: sorted into known and new, gated, taken in as one batch, and the new ones placed. Included by
// filter.cpp alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "slam/filter.hpp"

namespace cairn {
namespace {

bool given(const Observation& observation) {
  return std::any_of(observation.covariance, observation.covariance + 9, [](double v) { return v != 0.0; });
}

}  // namespace

template <class Pose>
double Filter<Pose>::batch_threshold(Index rows) {
  if (thresholds_[rows] == 0.0)
    thresholds_[rows] = chi_square_quantile(static_cast<double>(rows), options_.batch_gate_probability);
  return thresholds_[rows];
}

// Gate of a batch that is taken as a whole.
template <class Pose>
double Filter<Pose>::single_threshold(Index rows) const {
  return rows <= 6 ? gate_thresholds_[rows] : chi_square_quantile(static_cast<double>(rows), options_.gate_probability);
}

// The noise of one observation's values; that of the mount's angles comes on top.
template <class Pose>
Matrix3 Filter<Pose>::noise_of(const Sensor<Pose>& sensor, const Observation& observation) const {
  if (!given(observation)) return sensor.noise();
  Matrix3 noise = Matrix3::Zero();
  const int rows = sensor.rows();
  for (int c = 0; c < rows; ++c)
    for (int r = 0; r < rows; ++r) noise(r, c) = observation.covariance[r * rows + c];
  return noise;
}

template <class Pose>
void Filter<Pose>::start_report(Index count) {
  next_report_ = UpdateReport();
  for (Index i = 0; i < count; ++i) next_matches_[i] = Match();
}

template <class Pose>
void Filter<Pose>::finish_report(Index count) {
  for (Index i = 0; i < count; ++i) {
    const Match& match = next_matches_[i];
    next_report_.matched += match.decision == Decision::matched;
    next_report_.placed += match.decision == Decision::placed;
    next_report_.rejected += match.decision == Decision::rejected;
  }
  report_ = next_report_;
  std::swap(matches_, next_matches_);
}

// Candidates for the batch, and observations that could place a landmark; all others get their reason.
template <class Pose>
void Filter<Pose>::sort_out(const Sensor<Pose>& sensor, Index count, Index companions) {
  candidate_count_ = new_count_ = 0;
  if (options_.association == AssociationKind::known)
    sort_by_id(sensor, count);
  else
    sort_by_association(sensor, count);
  sort_companions(sensor, count, companions);
  const Index room = options_.local_landmarks(), held = landmark_count();
  if (held + new_count_ <= room) return;
  if (map_ != nullptr)
    throw Error(ErrorCode::capacity,
                "observations: %td new landmarks, and the open submap, which could not be closed, "
                "holds %td of %td",
                new_count_, held, room);
  throw Error(ErrorCode::capacity, "observations: %td new landmarks, and the map holds %td of max_landmarks = %td",
              new_count_, held, room);
}

template <class Pose>
void Filter<Pose>::add_candidate(const Sensor<Pose>& sensor, Index observation, Index slot,
                                 const Prediction<Pose>& prediction) {
  candidates_[candidate_count_] = {observation, slot, noise_of(sensor, observations_[observation]), prediction,
                                   candidate_count_};
  ++candidate_count_;
}

template <class Pose>
void Filter<Pose>::add_new_one(const Sensor<Pose>& sensor, Index observation) {
  Placement<Pose> placement;
  if (sensor.place(ekf_.pose(), Vector3(observations_[observation].z), Mount::Zero(), placement))
    new_ones_[new_count_++] = observation;
  else
    next_matches_[observation] = {kNoId, Decision::rejected, Reason::no_place, 0.0, 0.0};
}

template <class Pose>
void Filter<Pose>::sort_by_id(const Sensor<Pose>& sensor, Index count) {
  frame_ids_.clear();
  for (Index i = 0; i < count; ++i) {
    const Observation& observation = observations_[i];
    if (frame_ids_.find(observation.id) != IdTable::kAbsent)
      throw Error(ErrorCode::argument, "observations: landmark %llu comes twice in one frame",
                  static_cast<unsigned long long>(observation.id));
    frame_ids_.set(observation.id, static_cast<std::int32_t>(i));
    Match& match = next_matches_[i];
    const std::int32_t slot = slots_.find(observation.id);
    if (slot == IdTable::kAbsent) {
      add_new_one(sensor, i);
      continue;
    }
    match.landmark = observation.id;
    Prediction<Pose> prediction;
    if (sensor.predict(ekf_.pose(), ekf_.landmark(slot), Mount::Zero(), prediction))
      add_candidate(sensor, i, slot, prediction);
    else
      match.reason = Reason::no_image;
  }
}

template <class Pose>
void Filter<Pose>::open_candidates(const Sensor<Pose>& sensor) {
  for (Index a = 0; a < candidate_count_; ++a) window_slots_[a] = candidates_[a].slot;
  const MountSquare<Pose> mount = sensor.mount_noise();
  ekf_.open(window_slots_, candidate_count_, sensor.mount_noise_mode() == MountNoise::per_frame ? &mount : nullptr);
}

// Fills the batch at the iterate; or, where `residual_only` is given, just that. False where a landmark has no image.
template <class Pose>
bool Filter<Pose>::linearise(const Sensor<Pose>& sensor, double* residual_only) {
  const Index rows = sensor.rows();
  const MountNoise mode = sensor.mount_noise_mode();
  if (residual_only == nullptr) ekf_.batch().clear();
  for (Index a = 0; a < candidate_count_; ++a) {
    const Candidate& candidate = candidates_[a];
    Prediction<Pose> moved;
    if (ekf_.iterating() &&
        !sensor.predict(ekf_.iterate_pose(), ekf_.iterate_landmark(candidate.number), ekf_.iterate_mount(), moved))
      return false;
    const Prediction<Pose>& prediction = ekf_.iterating() ? moved : candidate.prediction;
    const Vector3 residual = sensor.residual(Vector3(observations_[candidate.observation].z), prediction.z);
    double* target = residual_only != nullptr ? residual_only : ekf_.batch().residual();
    for (Index r = 0; r < rows; ++r) target[a * rows + r] = residual(r);
    if (residual_only != nullptr) continue;

    const Index row = ekf_.batch().add_rows(rows);
    const auto pose = ekf_.add_pose_block(row, rows, prediction.J_z_pose, sensor.relative());
    if (mode == MountNoise::per_frame) ekf_.add_mount_block(row, rows, prediction.J_z_mount);
    ekf_.add_landmark_block(row, rows, prediction.J_z_landmark, candidate.number, pose);
    Matrix3 noise = options_.error_persistence * candidate.noise;
    if (mode == MountNoise::per_observation)
      noise += prediction.J_z_mount * sensor.mount_noise() * prediction.J_z_mount.transpose();
    double* block = ekf_.batch().add_noise(row, rows);
    for (Index c = 0; c < rows; ++c)
      for (Index r = 0; r < rows; ++r) block[c * rows + r] = noise(r, c);
  }
  return true;
}

// Chi-square gate of every observation by itself.
template <class Pose>
void Filter<Pose>::gate_each() {
  if (candidate_count_ == 0) return;
  const Index m = ekf_.batch().rows(), rows = m / candidate_count_;
  Index kept = 0;
  for (Index a = 0; a < candidate_count_; ++a) {
    Match& match = next_matches_[candidates_[a].observation];
    match.distance =
        squared_distance(ekf_.batch().residual() + a * rows, ekf_.innovation() + a * rows * (m + 1), m, rows);
    match.threshold = gate_thresholds_[rows];
    if (match.distance < 0.0) throw_not_definite();
    if (match.distance <= match.threshold)
      kept_[kept++] = a;
    else
      match.reason = Reason::gate;
  }
  keep(kept, rows);
}

// Leaves the candidates that kept_ tells.
template <class Pose>
void Filter<Pose>::keep(Index count, Index rows) {
  if (count == candidate_count_) return;
  for (Index k = 0; k < count; ++k) candidates_[k] = candidates_[kept_[k]];
  candidate_count_ = count;
  ekf_.keep(kept_, count, rows);
}

// Chi-square gate of the batch: what does not fit with the rest goes.
template <class Pose>
void Filter<Pose>::gate_batch(const Sensor<Pose>& sensor) {
  if (ekf_.batch().rows() == 0) return;
  const auto bound = [&](Index rows) { return batch_threshold(rows); };
  const Index left = gate_jointly(
      ekf_, candidate_count_, sensor.rows(), residual_, bound, [&](Index a) { return candidates_[a].slot < 0; },
      [&](Index a, double distance, double threshold) {
        Match& match = next_matches_[candidates_[a].observation];
        match.reason = Reason::batch_gate;
        match.distance = distance;
        match.threshold = threshold;
        candidates_[a].slot = -1;
      });
  if (left == candidate_count_) return;
  say("update: the batch gate refused %td of %td observations", candidate_count_ - left, candidate_count_);
  Index kept = 0;
  for (Index a = 0; a < candidate_count_; ++a)
    if (candidates_[a].slot >= 0) kept_[kept++] = a;
  keep(kept, sensor.rows());
  if (!ekf_.factor()) throw_not_definite();
}

// What is new because its neighbour was seen by itself stays refused where the gates refused that.
template <class Pose>
void Filter<Pose>::keep_founded() {
  const auto taken_in = [&](std::uint64_t id) {
    return std::any_of(candidates_, candidates_ + candidate_count_, [&](const Candidate& candidate) {
      return candidate.slot >= ekf_.companions() && ids_[candidate.slot] == id;
    });
  };
  Index kept = 0;
  for (Index k = 0; k < new_count_; ++k) {
    const std::uint64_t neighbour = next_matches_[new_ones_[k]].landmark;
    if (neighbour == kNoId || taken_in(neighbour)) new_ones_[kept++] = new_ones_[k];
  }
  new_count_ = kept;
}

template <class Pose>
void Filter<Pose>::place_new(const Sensor<Pose>& sensor) {
  const MountNoise mode = sensor.mount_noise_mode();
  for (Index k = 0; k < new_count_; ++k) {
    const Observation& observation = observations_[new_ones_[k]];
    Match& match = next_matches_[new_ones_[k]];
    match = {kNoId, Decision::rejected, Reason::no_place, 0.0, 0.0};
    Placement<Pose> placement;
    if (!sensor.place(ekf_.pose(), Vector3(observation.z), ekf_.iterate_mount(), placement)) continue;
    const int rows = sensor.rows();
    const auto J_z = placement.J_landmark_z.leftCols(rows);
    PointSquare noise = PointSquare::Zero();
    noise.noalias() +=
        J_z.lazyProduct(noise_of(sensor, observation).topLeftCorner(rows, rows).eval().lazyProduct(J_z.transpose()));
    if (mode == MountNoise::per_observation)
      noise += placement.J_landmark_mount * sensor.mount_noise() * placement.J_landmark_mount.transpose();
    if (!ekf_.augment(placement.landmark, placement.J_landmark_pose,
                      mode == MountNoise::per_frame ? &placement.J_landmark_mount : nullptr, noise, sensor.relative()))
      continue;
    const std::uint64_t id = options_.association == AssociationKind::known ? observation.id : unknowns_.next_id++;
    append_landmark(id);
    match = {id, Decision::placed, Reason::none, 0.0, 0.0};
  }
}

template <class Pose>
void Filter<Pose>::take_in(int sensor_number, Index landmarks, Index companions) {
  const Sensor<Pose>& sensor = sensor_at(sensor_number);
  const Index count = landmarks + companions;
  start_report(count);
  sort_out(sensor, landmarks, companions);
  const auto relinearise = [&](double* residual_only) { return linearise(sensor, residual_only); };

  open_candidates(sensor);
  fill_batch(ekf_, relinearise);
  gate_each();
  gate_batch(sensor);
  if (candidate_count_ > 0) iterate(options_.iterations, sensor.relative(), relinearise);
  for (Index a = 0; a < candidate_count_; ++a) {
    next_matches_[candidates_[a].observation].decision = Decision::matched;
    ++counts_[candidates_[a].slot];
  }
  keep_founded();
  place_new(sensor);
  finish_report(count);
  review_landmarks(sensor_number, landmarks);
}

}  // namespace cairn
