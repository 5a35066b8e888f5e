// SPDX-License-Identifier: BSD-3-Clause
// The rows of an absolute fix (position, attitude or heading), for an update whose window holds only the pose.
#pragma once

#include "ekf/ekf_update.hpp"
#include "sensor/absolute_fix.hpp"

namespace cairn {

// The `fill` that EkfUpdate::linearise() and iterate() ask for.
template <class Pose>
bool fill_fix(EkfUpdate<Pose>& update, const AbsoluteFix<Pose>& fix, double* residual_only) {
  const Pose T = update.pose();
  if (!fix.defined(T)) return false;
  const Vector3 residual = fix.residual(T);
  const Index rows = fix.rows();
  std::copy_n(residual.data(), rows, residual_only != nullptr ? residual_only : update.batch().residual());
  if (residual_only != nullptr) return true;
  update.batch().clear();
  const Index row = update.batch().add_rows(rows);
  update.add_pose_block(row, rows, fix.jacobian(T), false);
  double* noise = update.batch().add_noise(row, rows);
  for (Index c = 0; c < rows; ++c)
    for (Index r = 0; r < rows; ++r) noise[c * rows + r] = fix.covariance()(r, c);
  return true;
}

}  // namespace cairn
