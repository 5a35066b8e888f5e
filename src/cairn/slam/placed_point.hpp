// SPDX-License-Identifier: BSD-3-Clause
// The point that an observation places, seen from the vehicle.
#pragma once

#include "slam/frame.hpp"

namespace cairn {

template <class Pose>
struct PlacedPoint {
  typename Pose::Point arm;                             // from the vehicle, in the axes of the map
  Eigen::Matrix<double, Pose::kDim, Pose::kDim> noise;  // covariance, of the observation alone

  // Returns false if the observation places no point, or one that does not only depend on its place in the body frame.
  bool place(const Frame<Pose>& frame, Index observation, const Pose& pose, double error_persistence) {
    const Sensor<Pose>& sensor = frame.sensor;
    Placement<Pose> placement;
    if (!sensor.relative() || !sensor.place(pose, frame.z(observation), MountError<Pose>::Zero(), placement))
      return false;
    const int rows = sensor.rows();
    const auto J_z = placement.J_landmark_z.leftCols(rows);
    arm = placement.landmark - pose.translation();
    noise = error_persistence * J_z * frame.noise(observation).topLeftCorner(rows, rows) * J_z.transpose();
    if (sensor.mount_noise_mode() != MountNoise::none)
      noise += placement.J_landmark_mount * sensor.mount_noise() * placement.J_landmark_mount.transpose();
    return arm.allFinite() && noise.allFinite();
  }
};

}  // namespace cairn
