// SPDX-License-Identifier: BSD-3-Clause
// The rows of an absolute fix (position, attitude or heading), for an update whose window holds no landmarks.
#pragma once

#include "ekf/ekf_update.hpp"
#include "sensor/absolute_fix.hpp"

namespace cairn {

// Residual and noise of a fix of the pose T, and the Jacobians that `add(row)` adds; the `fill` that
// EkfUpdate::linearise() and iterate() ask for.
template <class Pose, class Add>
bool fill_fix(EkfUpdate<Pose>& update, const AbsoluteFix<Pose>& fix, const Pose& T, double* residual_only, Add&& add) {
  if (!fix.defined(T)) return false;
  const Vector3 residual = fix.residual(T);
  const Index rows = fix.rows();
  std::copy_n(residual.data(), rows, residual_only != nullptr ? residual_only : update.batch().residual());
  if (residual_only != nullptr) return true;
  update.batch().clear();
  const Index row = update.batch().add_rows(rows);
  add(row);
  double* noise = update.batch().add_noise(row, rows);
  for (Index c = 0; c < rows; ++c)
    for (Index r = 0; r < rows; ++r) noise[c * rows + r] = fix.covariance()(r, c);
  return true;
}

// Of the state's pose.
template <class Pose>
bool fill_fix(EkfUpdate<Pose>& update, const AbsoluteFix<Pose>& fix, double* residual_only) {
  const Pose T = update.pose();
  return fill_fix(update, fix, T, residual_only,
                  [&](Index row) { update.add_pose_block(row, fix.rows(), fix.jacobian(T), false); });
}

// Of a vehicle in a submap, T = T_S T_L: T_L is the state's pose, and the error of the base T_S against `base` is its
// systematic errors from number `first` on.
template <class Pose>
bool fill_fix(EkfUpdate<Pose>& update, const AbsoluteFix<Pose>& fix, const Pose& base, Index first,
              double* residual_only) {
  constexpr int kDof = Pose::kDof, kTurn = Pose::kTurn;
  typename Pose::Tangent error;
  for (Index d = 0; d < kDof; ++d) error(d) = update.systematic(first + d);
  const Pose T_base = retract(base, error), T_local = update.pose(), T = T_base * T_local;
  return fill_fix(update, fix, T, residual_only, [&](Index row) {
    const ProductJacobians J(T_base, T_local);
    const typename AbsoluteFix<Pose>::ByPose by_pose = fix.jacobian(T);
    typename AbsoluteFix<Pose>::ByPose by_base = by_pose * J.by_a;
    by_base.template rightCols<kTurn>() =
        (by_base.template rightCols<kTurn>() * Pose::Rotation::left_jacobian(error.template tail<kTurn>())).eval();
    update.add_pose_block(row, fix.rows(), by_pose * J.by_b, false);
    update.add_systematic_block(row, fix.rows(), by_base, first, kDof);
  });
}

}  // namespace cairn
