// SPDX-License-Identifier: BSD-3-Clause
// Updates of one batch that is gated as a whole: absolute position, attitude, heading, and what the caller linearised.
// Included by filter.cpp alone.
#pragma once

#include <algorithm>

#include "core/chi_square.hpp"
#include "ekf/iterate.hpp"
#include "slam/filter.hpp"

namespace cairn {

// A batch that touches no landmark, or such as the caller linearised: gated as a whole.
template <class Pose>
template <class Linearise>
void Filter<Pose>::update_alone(Index rows, int iterations, std::uint64_t landmark, Linearise&& linearise) {
  fill_batch(ekf_, linearise);
  Match& match = next_matches_[0];
  match.landmark = landmark;
  match.threshold = single_threshold(rows);
  if (!ekf_.factor()) throw_not_definite();
  match.distance = ekf_.nis();
  if (!(match.distance <= match.threshold)) {
    match.reason = Reason::gate;
    say("update: the gate refused a batch of %td rows, distance %g over %g", rows, match.distance, match.threshold);
  } else {
    iterate(iterations, false, linearise);
    match.decision = Decision::matched;
  }
  finish_report(1);
}

template <class Pose>
void Filter<Pose>::take_in(const AbsoluteFix<Pose>& fix) {
  start_report(1);
  if (!fix.defined(pose())) {
    next_matches_[0].reason = Reason::no_image;
    say("update: no heading, the body's x axis stands too steep");
    return finish_report(1);
  }
  if (map_ != nullptr) return update_map_by_fix(fix);
  ekf_.open(nullptr, 0, nullptr);
  update_alone(fix.rows(), options_.iterations, kNoId,
               [&](double* residual_only) { return linearise_fix(ekf_, fix, residual_only); });
}

template <class Pose>
void Filter<Pose>::take_in(const Linear& linear) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  start_report(1);
  frame_ids_.clear();
  for (Index k = 0; k < linear.count; ++k) {
    const std::uint64_t id = linear.landmarks[k];
    if (frame_ids_.find(id) != IdTable::kAbsent)
      throw Error(ErrorCode::argument, "landmarks: %llu comes twice", static_cast<unsigned long long>(id));
    frame_ids_.set(id, static_cast<std::int32_t>(k));
    const std::int32_t slot = slots_.find(id);
    if (slot == IdTable::kAbsent)
      throw Error(ErrorCode::not_found, "landmarks: the map has no landmark %llu", static_cast<unsigned long long>(id));
    window_slots_[k] = slot;
  }
  ekf_.open(window_slots_, linear.count, nullptr);
  const Index rows = linear.rows;
  update_alone(rows, 1, linear.count > 0 ? linear.landmarks[0] : kNoId, [&](double*) {
    ekf_.batch().clear();
    const Index row = ekf_.batch().add_rows(rows);
    std::copy_n(linear.residual, rows, ekf_.batch().residual());
    std::copy_n(linear.covariance, rows * rows, ekf_.batch().add_noise(row, rows));
    const auto J_pose = [&](Index r, Index c) {
      return linear.J_pose != nullptr ? linear.J_pose[r * 6 + Embedding<Pose>::axis(c)] : 0.0;
    };
    const auto pose = ekf_.add_pose_block(row, rows, J_pose, false);
    if (linear.count == 0) return true;
    const Eigen::Map<const RowMajor> J(linear.J_landmarks, rows, 3 * linear.count);
    for (Index k = 0; k < linear.count; ++k)
      ekf_.add_landmark_block(row, rows, J.template middleCols<kDim>(3 * k), k, pose);
    return true;
  });
  if (matches_[0].decision == Decision::matched)
    for (Index k = 0; k < linear.count; ++k) ++counts_[window_slots_[k]];
}

}  // namespace cairn
