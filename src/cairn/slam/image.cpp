// SPDX-License-Identifier: BSD-3-Clause
// The image of one landmark.
#include "slam/image.hpp"

namespace cairn {

template <class Pose>
bool image_of(const State<Pose>& state, const Sensor<Pose>& sensor, Index slot, Prediction<Pose>& prediction,
              Matrix3& covariance) {
  if (!sensor.predict(state.pose(), state.landmark(slot), MountError<Pose>::Zero(), prediction)) return false;
  if (sensor.relative()) {
    const auto& J = prediction.J_z_landmark;
    covariance.noalias() = J.lazyProduct((state.relative_covariance(slot).lazyProduct(J.transpose())).eval());
    return true;
  }
  constexpr Index n = Pose::kDof + Pose::kDim;
  double P[n * n];
  state.gather_ordinary(&slot, 1, P, n);
  covariance = image_covariance(Eigen::Map<const Eigen::MatrixXd>(P, n, n), prediction, 0, prediction, 0);
  return true;
}

template bool image_of(const State<SE2>&, const Sensor<SE2>&, Index, Prediction<SE2>&, Matrix3&);
template bool image_of(const State<SE3>&, const Sensor<SE3>&, Index, Prediction<SE3>&, Matrix3&);

}  // namespace cairn
