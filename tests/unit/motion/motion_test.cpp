// SPDX-License-Identifier: BSD-3-Clause
// Motion models: values and covariances.
#include "motion/motion.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/se2.hpp"
#include "numerical.hpp"

using namespace cairn;

namespace {

// Twists from rest to a rotation of pi in the step.
std::vector<Vector6> twists(double dt) {
  test::Random random(21);
  std::vector<Vector6> all;
  for (const Vector3& turn : test::awkward_turns<3>(22)) {
    Vector6 twist;
    twist << 2 * random.normal_vector<3>(), turn / dt;
    all.push_back(twist);
  }
  return all;
}

}  // namespace

TEST_CASE("twist: many small steps add up to one") {
  const double dt = 0.5;
  for (const Vector6& twist : twists(dt)) {
    const Increment<SE3> step = integrate_twist<SE3>(twist.head<3>(), twist.tail<3>(), dt, TwistNoise());
    // Midpoint rule: its error is (turn / steps)^2 / 24 of the distance, 1e-9 of 3 m.
    constexpr int kSteps = 20000;
    const SO3 whole = SO3::exp(twist.tail<3>() * (dt / kSteps)), half = SO3::exp(twist.tail<3>() * (dt / kSteps / 2));
    SO3 R;
    Vector3 p = Vector3::Zero();
    for (int i = 0; i < kSteps; ++i) {
      p += R * (half * (twist.head<3>() * (dt / kSteps)));
      R = R * whole;
    }
    CHECK((step.T_before_after.translation() - p).norm() < 1e-8);
    CHECK((step.T_before_after.rotation().matrix() - R.matrix()).norm() < 1e-10);
  }
}

TEST_CASE("twist: covariance of the ordinary error") {
  const double dt = 0.5;
  TwistNoise noise;
  noise.velocity_sigma << 0.1, 0.2, 0.3;
  noise.rate_sigma << 0.04, 0.05, 0.06;
  Vector6 sigma;
  sigma << noise.velocity_sigma, noise.rate_sigma;
  for (const Vector6& twist : twists(dt)) {
    const Increment<SE3> step = integrate_twist<SE3>(twist.head<3>(), twist.tail<3>(), dt, noise);
    const auto error = [&](const Vector6& n) {
      return Vector6(pose_error(SE3::exp((twist + n) * dt), step.T_before_after));
    };
    const Matrix6 J = test::jacobian_at_zero<6>(error);
    const Matrix6 expected = J * sigma.cwiseAbs2().asDiagonal() * J.transpose();
    CHECK((step.covariance - expected).norm() < 1e-10);
    CHECK(step.covariance == step.covariance.transpose());
  }
}

TEST_CASE("twist: sampled errors have the covariance") {
  const Vector3 v(2, -0.5, 0.1), w(0.2, -0.3, 1.5);
  const double dt = 0.8;
  const TwistNoise noise;
  const Increment<SE3> step = integrate_twist<SE3>(v, w, dt, noise);
  const Matrix6 information = step.covariance.inverse();
  test::Random random(23);
  constexpr int kSamples = 20000;
  double sum = 0;
  for (int i = 0; i < kSamples; ++i) {
    Vector6 sample;
    sample << v + noise.velocity_sigma.cwiseProduct(random.normal_vector<3>()),
        w + noise.rate_sigma.cwiseProduct(random.normal_vector<3>());
    const Vector6 error = pose_error(SE3::exp(sample * dt), step.T_before_after);
    sum += error.dot(information * error);
  }
  // Chi-square with 6 degrees of freedom for each sample: mean 6, standard deviation of the mean sqrt(12 / samples).
  // The bound is four of them.
  CHECK(std::abs(sum / kSamples - 6) < 4 * std::sqrt(12.0 / kSamples));
}

TEST_CASE("twist: a planar vehicle has the planar blocks of a spatial one") {
  const Vector3 twist(1.5, -0.2, 0.7), variance(0.04, 0.01, 0.0025);
  const Increment<SE2> planar = integrate_twist<SE2>(twist, 0.5, variance.asDiagonal());
  TwistNoise noise{Vector3(0.2, 0.1, 1), Vector3(1, 1, 0.05)};
  const Increment<SE3> spatial = integrate_twist<SE3>(Vector3(1.5, -0.2, 0), Vector3(0, 0, 0.7), 0.5, noise);
  const int rows[] = {0, 1, 5};
  CHECK((planar.covariance - spatial.covariance(rows, rows)).norm() < 1e-15);
  CHECK((planar.T_before_after.translation() - spatial.T_before_after.translation().head<2>()).norm() < 1e-15);
}

TEST_CASE("twist: no time, no motion, no uncertainty") {
  const Increment<SE3> step = integrate_twist<SE3>(Vector3(1, 2, 3), Vector3(1, 2, 3), 0, TwistNoise());
  CHECK(step.T_before_after.log() == Vector6::Zero());
  CHECK(step.covariance == Matrix6::Zero());
}

TEST_CASE("wheels: both on, straight ahead") {
  const Increment<SE3> step = drive_wheels<SE3>(Wheels(), 2, 2, 0.5);
  CHECK((step.T_before_after.translation() - Vector3(0.3, 0, 0)).norm() < 1e-15);
  CHECK(step.T_before_after.rotation().log() == Vector3::Zero());
}

TEST_CASE("wheels: sign of the yaw rate") {
  Wheels wheels;
  wheels.radius = 0.25;
  wheels.track = 0.5;
  // With z up the right side turns faster, and the vehicle turns left. On the spot: 0.25 / 0.5 * (1 - -1) * 0.5.
  const Increment<SE3> up = drive_wheels<SE3>(wheels, -1, 1, 0.5);
  CHECK((up.T_before_after.rotation().log() - Vector3(0, 0, 0.5)).norm() < 1e-15);
  CHECK(up.T_before_after.translation().norm() < 1e-15);
  CHECK(drive_wheels<SE3>(wheels, 1, 2, 0.5).T_before_after.translation().y() > 0);
  wheels.yaw_left_minus_right = true;
  const Increment<SE3> down = drive_wheels<SE3>(wheels, -1, 1, 0.5);
  CHECK((down.T_before_after.rotation().log() - Vector3(0, 0, -0.5)).norm() < 1e-15);
  CHECK(drive_wheels<SE3>(wheels, 1, 2, 0.5).T_before_after.translation().y() < 0);
}

TEST_CASE("wheels: an arc ends where geometry says") {
  Wheels wheels;
  const double left = 1.0, right = 3.0, dt = 0.7;
  const double turn = wheels.radius / wheels.track * (right - left) * dt;
  const double radius = 0.5 * wheels.radius * (right + left) * dt / turn;
  const SE3 T = drive_wheels<SE3>(wheels, left, right, dt).T_before_after;
  CHECK((T.translation() - Vector3(radius * std::sin(turn), radius * (1 - std::cos(turn)), 0)).norm() < 1e-15);
  CHECK((T.rotation().log() - Vector3(0, 0, turn)).norm() < 1e-15);
}

TEST_CASE("wheels: without noise nothing is uncertain") {
  Wheels wheels;
  wheels.rate_sigma = wheels.slip_sigma = wheels.lateral_sigma = wheels.vertical_sigma = 0;
  wheels.roll_rate_sigma = wheels.pitch_rate_sigma = 0;
  CHECK(drive_wheels<SE3>(wheels, 2, 3, 0.5).covariance == Matrix6::Zero());
}

TEST_CASE("wheels: covariance of a straight step, by hand") {
  const Wheels wheels;
  const double left = 3, right = 3, dt = 0.5, way = 0.3 * 3 * 0.5;
  const double side = 0.01 * 0.01 + 0.02 * 0.02 * 9;  // variance of the rate of each side
  const double yaw = 2 * 0.3 * 0.3 * side * dt * dt;  // (r / B)^2 twice
  const double pitch = 0.05 * 0.05 * dt * dt;
  Matrix6 expected = Matrix6::Zero();
  expected(0, 0) = 2 * 0.15 * 0.15 * side * dt * dt;
  // Half way along, the rotation has moved the rest of the way sideways.
  expected(1, 1) = 0.01 * 0.01 * dt * dt + way * way / 4 * yaw;
  expected(2, 2) = 0.01 * 0.01 * dt * dt + way * way / 4 * pitch;
  expected(3, 3) = 0.05 * 0.05 * dt * dt;
  expected(4, 4) = pitch;
  expected(5, 5) = yaw;
  expected(1, 5) = expected(5, 1) = way / 2 * yaw;
  expected(2, 4) = expected(4, 2) = -way / 2 * pitch;  // nose down is a positive pitch rate
  CHECK((drive_wheels<SE3>(wheels, left, right, dt).covariance - expected).norm() < 1e-17);
}

TEST_CASE("wheels: covariance of any step against the numerical one") {
  Wheels wheels;
  wheels.slip_sigma = 0.1;
  for (bool left_minus_right : {false, true}) {
    wheels.yaw_left_minus_right = left_minus_right;
    const double left = -1, right = 4, dt = 0.6;
    const Increment<SE3> step = drive_wheels<SE3>(wheels, left, right, dt);
    using Noise = Eigen::Matrix<double, 6, 1>;  // left, right, lateral, vertical, roll rate, pitch rate
    const auto error = [&](const Noise& n) {
      const double l = left + n[0], r = right + n[1], sign = left_minus_right ? -1 : 1;
      Vector6 twist;
      twist << wheels.radius * (l + r) / 2, n[2], n[3], n[4], n[5], sign * wheels.radius / wheels.track * (r - l);
      return Vector6(pose_error(SE3::exp(twist * dt), step.T_before_after));
    };
    Noise sigma;
    sigma << std::hypot(0.01, 0.1 * left), std::hypot(0.01, 0.1 * right), 0.01, 0.01, 0.05, 0.05;
    const Matrix6 J = test::jacobian_at_zero<6>(error);
    CHECK((step.covariance - J * sigma.cwiseAbs2().asDiagonal() * J.transpose()).norm() < 1e-12);
  }
}

// Column i of J_error: by the error of the estimate of systematic error i, truth minus estimate.
TEST_CASE_TEMPLATE("corrected steps: derivative by the systematic errors", Pose, SE2, SE3) {
  using Error = Eigen::Matrix<double, MotionErrors::kCount, 1>;
  test::Random random(31);
  const double dt = 0.4;
  const TwistNoise noise;
  Wheels wheels;
  for (int k = 0; k < 5; ++k) {
    wheels.yaw_left_minus_right = k % 2 == 1;
    MotionErrors estimate;
    for (int i = 0; i < MotionErrors::kCount; ++i) estimate[i] = 0.1 * random.normal();
    const auto changed = [&](const Error& change) {
      MotionErrors errors = estimate;
      for (int i = 0; i < MotionErrors::kCount; ++i) errors[i] += change[i];
      return errors;
    };
    const Vector3 v = random.normal_vector<3>(), w = random.normal_vector<3>();
    const double left = 3 + random.normal(), right = 3 + random.normal();
    const auto check = [&](const auto& step_with, const CorrectedStep<Pose>& step) {
      const auto error = [&](const Error& change) {
        return pose_error(step_with(changed(change)).increment.T_before_after, step.increment.T_before_after);
      };
      const auto J = test::jacobian_at_zero<MotionErrors::kCount>(error);
      CHECK((J - step.J_error).norm() < 1e-8);
    };
    const auto twist = [&](const MotionErrors& e) { return integrate_twist<Pose>(v, w, dt, noise, e); };
    const auto drive = [&](const MotionErrors& e) { return drive_wheels<Pose>(wheels, left, right, dt, e); };
    const auto gyro = [&](const MotionErrors& e) {
      return drive_wheels_gyro<Pose>(wheels, left, right, w, dt, noise, e);
    };
    check(twist, twist(estimate));
    check(drive, drive(estimate));
    check(gyro, gyro(estimate));
  }
}

TEST_CASE("corrected steps: without systematic errors they are the plain steps") {
  const TwistNoise noise;
  const Wheels wheels;
  const Vector3 v(1, 0.2, -0.1), w(0.1, 0.2, 0.3);
  const MotionErrors none;
  const auto same = [](const Increment<SE3>& a, const Increment<SE3>& b) {
    return (a.T_before_after.translation() - b.T_before_after.translation()).norm() < 1e-15 &&
           (a.covariance - b.covariance).norm() < 1e-15;
  };
  CHECK(same(integrate_twist<SE3>(v, w, 0.2, noise, none).increment, integrate_twist<SE3>(v, w, 0.2, noise)));
  CHECK(same(drive_wheels<SE3>(wheels, 3, 4, 0.2, none).increment, drive_wheels<SE3>(wheels, 3, 4, 0.2)));
  // The gyro's rate takes the place of that of the wheels, with its noise.
  const Increment<SE3> step = drive_wheels_gyro<SE3>(wheels, 3, 4, w, 0.2, noise, none).increment;
  CHECK((step.T_before_after.rotation().matrix() - SO3::exp(0.2 * w).matrix()).norm() < 1e-14);
  CHECK(step.covariance(5, 5) == doctest::Approx(std::pow(0.2 * noise.rate_sigma[2], 2)).epsilon(1e-3));
}
