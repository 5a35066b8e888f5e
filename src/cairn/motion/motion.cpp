// SPDX-License-Identifier: BSD-3-Clause
// Motion by a measured twist and by wheel rates.
#include "motion/motion.hpp"

#include "geometry/embedding.hpp"

namespace cairn {
namespace {

using Matrix62 = Eigen::Matrix<double, 6, 2>;

Matrix6 noise_of(const TwistNoise& noise) {
  Vector6 sigma;
  sigma << noise.velocity_sigma, noise.rate_sigma;
  return sigma.cwiseAbs2().asDiagonal();
}

// Wheels measure the forward velocity and the yaw rate. The other components are about zero.
// (Mars paper, eq. 1) with an explicit sign of the yaw rate
Matrix62 twist_by_rates(const Wheels& wheels) {
  const double yaw = (wheels.yaw_left_minus_right ? -1 : 1) * wheels.radius / wheels.track;
  Matrix62 J = Matrix62::Zero();
  J.row(0).setConstant(0.5 * wheels.radius);
  J.row(5) << -yaw, yaw;
  return J;
}

Matrix6 noise_of(const Wheels& wheels, const Vector2& rates, const Matrix62& J_twist_rates) {
  const Vector2 rate_variance = Vector2::Constant(wheels.rate_sigma * wheels.rate_sigma) +
                                wheels.slip_sigma * wheels.slip_sigma * rates.cwiseAbs2();
  Vector6 sigma;
  sigma << 0, wheels.lateral_sigma, wheels.vertical_sigma, wheels.roll_rate_sigma, wheels.pitch_rate_sigma, 0;
  Matrix6 noise = sigma.cwiseAbs2().asDiagonal();
  noise += J_twist_rates * rate_variance.asDiagonal() * J_twist_rates.transpose();
  return noise;
}

// A step by the corrected twist. Truth is smaller than the estimate by the error of a bias (docs/systematic_errors.md,
// eq. 3); `by_scale` is the derivative of the twist by the wheels' scales.
template <class Pose>
CorrectedStep<Pose> corrected(const Vector6& twist, double dt, const Matrix6& noise, const Matrix62& by_scale) {
  typename Pose::Square J;
  CorrectedStep<Pose> step;
  step.increment = integrate_twist<Pose>(Embedding<Pose>::down(twist), dt, Embedding<Pose>::down(noise), &J);
  step.J_error.setZero();
  for (int i = 0; i < Pose::kDof; ++i) {
    step.J_error.col(Embedding<Pose>::axis(i)) -= J.col(i);
    for (int side = 0; side < 2; ++side)
      step.J_error.col(MotionErrors::kScale + side) += J.col(i) * by_scale(Embedding<Pose>::axis(i), side);
  }
  return step;
}

}  // namespace

template <class Pose>
Increment<Pose> integrate_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise) {
  Vector6 twist;
  twist << v, w;
  return integrate_twist<Pose>(Embedding<Pose>::down(twist), dt, Embedding<Pose>::down(noise_of(noise)));
}

template <class Pose>
CorrectedStep<Pose> integrate_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise,
                                    const MotionErrors& errors) {
  Vector6 twist;
  twist << v, w;
  return corrected<Pose>(twist - errors.twist, dt, noise_of(noise), Matrix62::Zero());
}

template <class Pose>
Increment<Pose> drive_wheels(const Wheels& wheels, double left, double right, double dt) {
  const Matrix62 J_twist_rates = twist_by_rates(wheels);
  const Vector2 rates(left, right);
  const Matrix6 noise = noise_of(wheels, rates, J_twist_rates);
  const Vector6 twist = J_twist_rates * rates;
  return integrate_twist<Pose>(Embedding<Pose>::down(twist), dt, Embedding<Pose>::down(noise));
}

template <class Pose>
CorrectedStep<Pose> drive_wheels(const Wheels& wheels, double left, double right, double dt,
                                 const MotionErrors& errors) {
  const Matrix62 J_twist_rates = twist_by_rates(wheels);
  const Vector2 rates(left, right);
  const Vector2 true_rates = rates.cwiseProduct(Vector2::Ones() + errors.scale);
  const Matrix6 noise = noise_of(wheels, rates, J_twist_rates);
  const Vector6 twist = J_twist_rates * true_rates - errors.twist;
  return corrected<Pose>(twist, dt, noise, J_twist_rates * rates.asDiagonal());
}

template <class Pose>
CorrectedStep<Pose> drive_wheels_gyro(const Wheels& wheels, double left, double right, const Vector3& w, double dt,
                                      const TwistNoise& noise, const MotionErrors& errors) {
  Matrix62 J_twist_rates = twist_by_rates(wheels);
  J_twist_rates.row(5).setZero();
  const Vector2 rates(left, right);
  const Vector2 true_rates = rates.cwiseProduct(Vector2::Ones() + errors.scale);
  Matrix6 noise_of_twist = noise_of(wheels, rates, J_twist_rates);
  noise_of_twist.bottomRightCorner<3, 3>() = noise_of(noise).bottomRightCorner<3, 3>();
  Vector6 twist = J_twist_rates * true_rates - errors.twist;
  twist.tail<3>() += w;
  return corrected<Pose>(twist, dt, noise_of_twist, J_twist_rates * rates.asDiagonal());
}

template Increment<SE2> integrate_twist<SE2>(const Vector3&, const Vector3&, double, const TwistNoise&);
template Increment<SE3> integrate_twist<SE3>(const Vector3&, const Vector3&, double, const TwistNoise&);
template CorrectedStep<SE2> integrate_twist<SE2>(const Vector3&, const Vector3&, double, const TwistNoise&,
                                                 const MotionErrors&);
template CorrectedStep<SE3> integrate_twist<SE3>(const Vector3&, const Vector3&, double, const TwistNoise&,
                                                 const MotionErrors&);
template Increment<SE2> drive_wheels<SE2>(const Wheels&, double, double, double);
template Increment<SE3> drive_wheels<SE3>(const Wheels&, double, double, double);
template CorrectedStep<SE2> drive_wheels<SE2>(const Wheels&, double, double, double, const MotionErrors&);
template CorrectedStep<SE3> drive_wheels<SE3>(const Wheels&, double, double, double, const MotionErrors&);
template CorrectedStep<SE2> drive_wheels_gyro<SE2>(const Wheels&, double, double, const Vector3&, double,
                                                   const TwistNoise&, const MotionErrors&);
template CorrectedStep<SE3> drive_wheels_gyro<SE3>(const Wheels&, double, double, const Vector3&, double,
                                                   const TwistNoise&, const MotionErrors&);

}  // namespace cairn
