// SPDX-License-Identifier: BSD-3-Clause
// The image of one landmark: its predicted observation from the estimated pose, and the covariance of the prediction.
#pragma once

#include "ekf/state.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

// The prediction of the point in a slot, and its covariance without the mount's part. Returns false if it has no image.
template <class Pose>
bool image_of(const State<Pose>& state, const Sensor<Pose>& sensor, Index slot, Prediction<Pose>& prediction,
              Matrix3& covariance);

extern template bool image_of(const State<SE2>&, const Sensor<SE2>&, Index, Prediction<SE2>&, Matrix3&);
extern template bool image_of(const State<SE3>&, const Sensor<SE3>&, Index, Prediction<SE3>&, Matrix3&);

}  // namespace cairn
