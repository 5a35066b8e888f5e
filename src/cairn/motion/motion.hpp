// SPDX-License-Identifier: BSD-3-Clause
// Motion models: the motion of a vehicle in one step, in the vehicle's own frame, and its covariance.
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "geometry/types.hpp"

namespace cairn {

// Motion from the body frame before a step to the body frame after it. `covariance` is the covariance of its ordinary
// error [dp; dtheta]: the true position is p + dp and the true rotation
// Exp(dtheta) R, both in the axes of the body before the step.
template <class Pose>
struct Increment {
  Pose T_before_after;
  typename Pose::Square covariance = Pose::Square::Zero();
};

// Systematic errors of a measured motion (docs/systematic_errors.md): the true twist is the measured one minus `twist`,
// and a true wheel rate is the measured one times 1 + its scale. Numbered 0 to 5 (twist, in space), 6 and 7 (the scales
// of the left and the right wheels).
struct MotionErrors {
  static constexpr int kCount = 8, kScale = 6;
  Vector6 twist = Vector6::Zero();
  Vector2 scale = Vector2::Zero();

  double& operator[](int number) { return number < kScale ? twist[number] : scale[number - kScale]; }
};

// A step that was corrected by estimates of these errors. Column i of J_error is the derivative of the step's ordinary
// error by the error of estimate i (truth minus estimate).
template <class Pose>
struct CorrectedStep {
  Increment<Pose> increment;
  Eigen::Matrix<double, Pose::kDof, MotionErrors::kCount> J_error;
};

// Constant twist [v; w] in body axes for dt seconds, integrated on the group: Exp([v; w] dt) (Mars paper, eq. 2,
// without its Euler angles). `noise` is the covariance of the measured twist: one white sample for each step.
// `J_out` gets the derivative of the ordinary error by the error of the twist.
template <class Pose>
Increment<Pose> integrate_twist(const typename Pose::Tangent& twist, double dt, const typename Pose::Square& noise,
                                typename Pose::Square* J_out = nullptr) {
  const typename Pose::Tangent tau = twist * dt;
  Increment<Pose> step;
  step.T_before_after = Pose::exp(tau);
  // Exp(tau + n dt) = Exp(xi) Exp(tau) with xi = J_l(tau) n dt. The ordinary error is dtheta = xi_R and
  // dp = xi_p + xi_R x p (docs/notation.md).
  typename Pose::Square J_error_twist = Pose::left_jacobian(tau) * dt;
  J_error_twist.template topRows<Pose::kDim>() +=
      Pose::Rotation::turn(step.T_before_after.translation()) * J_error_twist.template bottomRows<Pose::kTurn>();
  const typename Pose::Square lower = J_error_twist * noise * J_error_twist.transpose();
  step.covariance = lower.template selfadjointView<Eigen::Lower>();
  if (J_out != nullptr) *J_out = J_error_twist;
  return step;
}

// Noise of a measured body velocity and body rate: standard deviations of each sample and axis.
struct TwistNoise {
  Vector3 velocity_sigma = Vector3::Constant(0.05);  // m/s
  Vector3 rate_sigma = Vector3::Constant(0.005);     // rad/s
};

// v in m/s, w in rad/s, body axes. In the plane only v_x, v_y and w_z are used.
template <class Pose>
Increment<Pose> integrate_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise);
template <class Pose>
CorrectedStep<Pose> integrate_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise,
                                    const MotionErrors& errors);

// Four-wheel differential drive. Both wheels of a side turn at the same rate.
struct Wheels {
  bool yaw_left_minus_right = false;  // yaw rate of a z axis that points down, as in the Mars paper, eq. 1
  double radius = 0.3;                // m
  double track = 1.0;                 // distance between left and right wheels, m
  double rate_sigma = 0.01;           // noise of the rate of each side, rad/s
  double slip_sigma = 0.02;           // noise of the rate of each side, in proportion to the rate
  double lateral_sigma = 0.01;        // m/s
  double vertical_sigma = 0.01;       // m/s
  double roll_rate_sigma = 0.05;      // rad/s
  double pitch_rate_sigma = 0.05;     // rad/s
};

// Wheel rates in rad/s, forward positive. A planar vehicle with two driven wheels (a unicycle) has the same model.
template <class Pose>
Increment<Pose> drive_wheels(const Wheels& wheels, double left, double right, double dt);
template <class Pose>
CorrectedStep<Pose> drive_wheels(const Wheels& wheels, double left, double right, double dt,
                                 const MotionErrors& errors);
// The forward velocity of the wheels, and a measured body rate in place of theirs; `noise` is that of the rate.
template <class Pose>
CorrectedStep<Pose> drive_wheels_gyro(const Wheels& wheels, double left, double right, const Vector3& w, double dt,
                                      const TwistNoise& noise, const MotionErrors& errors);

}  // namespace cairn
