// SPDX-License-Identifier: BSD-3-Clause
// Motion by a measured twist and by wheel rates.
#include "motion/motion.hpp"

#include "geometry/embedding.hpp"

namespace cairn {

template <class Pose>
Increment<Pose> integrate_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise) {
  Vector6 twist, sigma;
  twist << v, w;
  sigma << noise.velocity_sigma, noise.rate_sigma;
  const Matrix6 noise_of_twist = sigma.cwiseAbs2().asDiagonal();
  return integrate_twist<Pose>(Embedding<Pose>::down(twist), dt, Embedding<Pose>::down(noise_of_twist));
}

template <class Pose>
Increment<Pose> drive_wheels(const Wheels& wheels, double left, double right, double dt) {
  using Matrix62 = Eigen::Matrix<double, 6, 2>;
  // (Mars paper, eq. 1) with an explicit sign of the yaw rate
  const double yaw = (wheels.yaw_left_minus_right ? -1 : 1) * wheels.radius / wheels.track;
  Matrix62 J_twist_rates = Matrix62::Zero();
  J_twist_rates.row(0).setConstant(0.5 * wheels.radius);
  J_twist_rates.row(5) << -yaw, yaw;

  const Vector2 rates(left, right);
  const Vector2 rate_variance = Vector2::Constant(wheels.rate_sigma * wheels.rate_sigma) +
                                wheels.slip_sigma * wheels.slip_sigma * rates.cwiseAbs2();
  // Wheels measure the forward velocity and the yaw rate. The other components are about zero.
  Vector6 sigma;
  sigma << 0, wheels.lateral_sigma, wheels.vertical_sigma, wheels.roll_rate_sigma, wheels.pitch_rate_sigma, 0;
  Matrix6 noise = sigma.cwiseAbs2().asDiagonal();
  noise += J_twist_rates * rate_variance.asDiagonal() * J_twist_rates.transpose();
  const Vector6 twist = J_twist_rates * rates;
  return integrate_twist<Pose>(Embedding<Pose>::down(twist), dt, Embedding<Pose>::down(noise));
}

template Increment<SE2> integrate_twist<SE2>(const Vector3&, const Vector3&, double, const TwistNoise&);
template Increment<SE3> integrate_twist<SE3>(const Vector3&, const Vector3&, double, const TwistNoise&);
template Increment<SE2> drive_wheels<SE2>(const Wheels&, double, double, double);
template Increment<SE3> drive_wheels<SE3>(const Wheels&, double, double, double);

}  // namespace cairn
