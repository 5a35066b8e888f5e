// SPDX-License-Identifier: BSD-3-Clause
// One frame of observations, as the parts of a filter pass it on.
#pragma once

#include "sensor/calibrated_sensor.hpp"
#include "slam/observation.hpp"
#include "slam/sensor_rack.hpp"

namespace cairn {

template <class Pose>
struct Frame {
  const Sensor<Pose>& sensor;
  const View* view;  // of the sensor; null: none was set
  const RobustLoss& loss;
  const Observation* observations;
  Index landmarks, companions;  // observations of landmarks, then observations of companions
  int number = 0;               // of the sensor
  double noise_factor = 1.0;    // of the stated covariances, as learned
  // The same sensor, if its systematic errors are states: an update sets the errors of its iterate.
  CalibratedSensor<Pose>* calibrated = nullptr;

  Index count() const { return landmarks + companions; }
  Frame with(CalibratedSensor<Pose>& other) const {  // the same frame of the calibrated sensor
    return {other, view, loss, observations, landmarks, companions, number, noise_factor, &other};
  }
  Vector3 z(Index observation) const { return Vector3(observations[observation].z); }
  // The noise of one observation's values. The noise of the mount comes on top.
  Matrix3 noise(Index observation) const { return noise_factor * stated_noise(observation); }
  Matrix3 stated_noise(Index observation) const {
    const Observation& given = observations[observation];
    if (!given.has_covariance()) return sensor.noise();
    Matrix3 noise = Matrix3::Zero();
    const int rows = sensor.rows();
    for (int c = 0; c < rows; ++c)
      for (int r = 0; r < rows; ++r) noise(r, c) = given.covariance[r * rows + c];
    return noise;
  }
};

}  // namespace cairn
