// SPDX-License-Identifier: BSD-3-Clause
// Updates of one batch that is gated as a whole: absolute position, attitude, heading, and what the caller linearised.
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "slam/filter_batch.hpp"

namespace cairn {

// A batch that touches no landmark, or such as the caller linearised: gated as a whole.
template <class Linearise>
void Filter::update_alone(Index rows, int iterations, std::uint64_t landmark, Linearise&& linearise) {
  fill(linearise);
  Match& match = next_matches_[0];
  match.landmark = landmark;
  match.threshold =
      rows <= 6 ? gate_thresholds_[rows] : chi_square_quantile(static_cast<double>(rows), options_.gate_probability);
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

void Filter::update_position(const Vector3& position, const Matrix3& covariance, const Vector3& lever_arm) {
  start_report(1);
  ekf_.open(nullptr, 0, nullptr);
  update_alone(3, options_.iterations, kNoId, [&](double* residual_only) {
    const SE3& T = ekf_.iterate_pose();
    const Vector3 arm = T.rotation() * lever_arm;
    const Vector3 residual = position - T.translation() - arm;
    std::copy_n(residual.data(), 3, residual_only != nullptr ? residual_only : ekf_.batch().residual());
    if (residual_only != nullptr) return true;
    Matrix36 J;  // h = p + R a
    J << Matrix3::Identity(), SO3::turn(arm);
    add_pose_rows(3, J, covariance.data());
    return true;
  });
}

void Filter::update_attitude(const SO3& attitude, const Matrix3& covariance) {
  start_report(1);
  ekf_.open(nullptr, 0, nullptr);
  update_alone(3, options_.iterations, kNoId, [&](double* residual_only) {
    const Vector3 residual = (attitude * ekf_.iterate_pose().rotation().inverse()).log();
    std::copy_n(residual.data(), 3, residual_only != nullptr ? residual_only : ekf_.batch().residual());
    if (residual_only != nullptr) return true;
    Matrix36 J;  // Log(R_z (Exp(theta) R)^T) = r - J_r(r)^-1 theta, and J_r(r) = J_l(-r)
    J << Matrix3::Zero(), SO3::left_jacobian_inverse(-residual);
    add_pose_rows(3, J, covariance.data());
    return true;
  });
}

void Filter::update_heading(double heading, double sigma) {
  constexpr double kMinimumLevel = 0.0871557427476582;  // sin of 5 degrees
  start_report(1);
  const auto level = [&] { return (ekf_.iterate_pose().rotation() * Vector3::UnitX()).head<2>().norm(); };
  ekf_.open(nullptr, 0, nullptr);
  if (level() < kMinimumLevel) {
    next_matches_[0].reason = Reason::no_image;
    say("update: no heading, the body's x axis stands too steep");
    return finish_report(1);
  }
  const double variance = sigma * sigma;
  update_alone(1, options_.iterations, kNoId, [&](double* residual_only) {
    if (level() < kMinimumLevel) return false;
    const Vector3 a = ekf_.iterate_pose().rotation() * Vector3::UnitX();
    (residual_only != nullptr ? residual_only : ekf_.batch().residual())[0] =
        wrap_angle(heading - std::atan2(a.y(), a.x()));
    if (residual_only != nullptr) return true;
    const double level_squared = a.head<2>().squaredNorm();
    Eigen::Matrix<double, 1, 6> J;  // d atan2(a_y, a_x) for da = theta x a
    J << 0.0, 0.0, 0.0, -a.x() * a.z() / level_squared, -a.y() * a.z() / level_squared, 1.0;
    add_pose_rows(1, J, &variance);
    return true;
  });
}

template <class JPose>
void Filter::add_pose_rows(Index rows, const JPose& J_pose, const double* covariance) {
  ekf_.batch().clear();
  const Index row = ekf_.batch().add_rows(rows);
  ekf_.add_pose_block(row, rows, J_pose, false);
  std::copy_n(covariance, rows * rows, ekf_.batch().add_noise(row, rows));
}

void Filter::update_linear(const Linear& linear) {
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
    const auto J_pose = [&](Index r, Index c) { return linear.J_pose != nullptr ? linear.J_pose[r * 6 + c] : 0.0; };
    const auto pose = ekf_.add_pose_block(row, rows, J_pose, false);
    if (linear.count == 0) return true;
    const Eigen::Map<const RowMajor> J(linear.J_landmarks, rows, 3 * linear.count);
    for (Index k = 0; k < linear.count; ++k) ekf_.add_landmark_block(row, rows, J.middleCols<3>(3 * k), k, pose);
    return true;
  });
  if (matches_[0].decision == Decision::matched)
    for (Index k = 0; k < linear.count; ++k) ++counts_[window_slots_[k]];
}

}  // namespace cairn
