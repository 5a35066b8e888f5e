// SPDX-License-Identifier: BSD-3-Clause
// Jacobians and limits of the built-in sensors.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"
#include "numerical.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/jacobian_check.hpp"
#include "sensor/sensors.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

// Compares all Jacobians of a prediction and of a placement with central differences, and checks that both invert each
// other. The differences are accurate to 1e-9 of a Jacobian at the nearest points (numerical.hpp). A coordinate x,
// rounded to 1e-16 x a few times, adds a few 1e-12 x when it is divided by the step of 1e-4.
void check_sensor(const Sensor<SE3>& sensor, const SE3& T, const Vector3& z, const Vector2& mount) {
  Placement<SE3> placed;
  REQUIRE(sensor.place(T, z, mount, placed));
  const double tolerance = 1e-9 + 1e-11 * placed.landmark.norm();
  Prediction<SE3> seen;
  REQUIRE(sensor.predict(T, placed.landmark, mount, seen));
  CHECK(sensor.residual(z, seen.z).norm() < tolerance * (1 + z.norm()));
  check_jacobians<SE3>(sensor, T, z, mount, placed, seen, tolerance);
}

// Whether a sensor at the identity pose observes `landmark`, and whether it places a landmark from z.
bool sees(const Sensor<SE3>& sensor, const Vector3& landmark) {
  Prediction<SE3> out;
  return sensor.predict(SE3(), landmark, kNoMount, out);
}
bool places(const Sensor<SE3>& sensor, const Vector3& z) {
  Placement<SE3> out;
  return sensor.place(SE3(), z, kNoMount, out);
}

void check_never_nan(const Sensor<SE3>& sensor) {
  for (double bad : {kNaN, kInfinity, -kInfinity, 1e300}) {
    for (int i = 0; i < 3; ++i) {
      Vector3 x(5, 0.1, 0.2);
      x[i] = bad;
      Prediction<SE3> seen;
      if (sensor.predict(SE3(), x, kNoMount, seen)) {
        CHECK(seen.z.allFinite());
        CHECK(seen.J_z_pose.allFinite());
        CHECK(seen.J_z_landmark.allFinite());
        CHECK(seen.J_z_mount.allFinite());
      }
      Placement<SE3> placed;
      if (sensor.place(SE3(), x, kNoMount, placed)) {
        CHECK(placed.landmark.allFinite());
        CHECK(placed.J_landmark_pose.allFinite());
        CHECK(placed.J_landmark_z.allFinite());
      }
      CHECK_FALSE((std::isnan(bad) && (sees(sensor, x) || places(sensor, x))));
    }
    const SE3 nowhere(SO3(), Vector3(0, bad, 0));
    Prediction<SE3> seen;
    if (sensor.predict(nowhere, Vector3(5, 0, 0), kNoMount, seen)) CHECK(seen.z.allFinite());
  }
}

}  // namespace

TEST_CASE("stereo head: the mount of eq. 4") {
  const StereoHeadParameters p = mounted_head();
  StereoHead head(p);
  const double pan = 0.7, stick = -0.3;
  head.point(pan, stick);
  const SE3 T = SE3(SO3::exp(Vector3(0.1, 0.2, 2)), Vector3(4, 5, 6));
  const Vector3 m_c(8, 2, -1);
  const Vector3 m_b =
      p.platform + SO3::exp(Vector3(0, 0, pan)) * (SO3::exp(Vector3(0, stick, 0)) * (p.stick + p.R_stick_camera * m_c));
  Prediction<SE3> seen;
  REQUIRE(head.predict(T, T * m_b, kNoMount, seen));
  CHECK((seen.z - Vector3(m_c.norm(), std::atan2(2, 8), std::atan2(-1, std::hypot(8, 2)))).norm() < 1e-14);

  // A mount error adds to the encoder readings.
  StereoHead turned(p);
  turned.point(pan + 0.02, stick - 0.03);
  Prediction<SE3> expected;
  REQUIRE(turned.predict(T, T * m_b, kNoMount, expected));
  REQUIRE(head.predict(T, T * m_b, Vector2(0.02, -0.03), seen));
  CHECK((seen.z - expected.z).norm() < 1e-14);
}

TEST_CASE("stereo head: signs with the default mount") {
  StereoHead head;
  Prediction<SE3> seen;
  REQUIRE(head.predict(SE3(), Vector3(3, 3, 0), kNoMount, seen));
  CHECK((seen.z - Vector3(std::sqrt(18), kPi / 4, 0)).norm() < 1e-14);  // left is positive
  REQUIRE(head.predict(SE3(), Vector3(2, 0, 2), kNoMount, seen));
  CHECK((seen.z - Vector3(std::sqrt(8), 0, kPi / 4)).norm() < 1e-14);  // up is positive
  head.point(kPi / 2, 0);
  REQUIRE(head.predict(SE3(), Vector3(0, 4, 0), kNoMount, seen));
  CHECK((seen.z - Vector3(4, 0, 0)).norm() < 1e-14);  // panned to the left, it looks to the left
  head.point(0, 0.5);
  REQUIRE(head.predict(SE3(), Vector3(4, 0, 0), kNoMount, seen));
  CHECK(std::abs(seen.z[2] - 0.5) < 1e-14);  // a positive stick angle lowers the lens, so the point appears above
}

TEST_CASE("stereo head: Jacobians") {
  const std::vector<SE3> poses = awkward_poses(31);
  for (const StereoHeadParameters& p : {StereoHeadParameters(), mounted_head()}) {
    StereoHead head(p);
    Random random(32);
    for (const SE3& T : poses) {
      head.point(random.uniform(-3, 3), random.uniform(-1, 1));
      const Vector3 z(random.uniform(0.2, 60), random.uniform(-3.1, 3.1), random.uniform(-1.2, 1.2));
      check_sensor(head, T, z, kNoMount);
      check_sensor(head, T, z, Vector2(0.05, -0.08));
    }
    // Close to the limits of range and elevation, and across the cut of the azimuth.
    const SE3 T(SO3::exp(Vector3(0.3, -0.2, 1)), Vector3(1, 2, 3));
    check_sensor(head, T, Vector3(p.near_range + 1e-3, 0.4, 0.1), kNoMount);
    check_sensor(head, T, Vector3(10, 0.4, p.max_elevation - 1e-3), kNoMount);
    check_sensor(head, T, Vector3(10, 0.4, -p.max_elevation + 1e-3), kNoMount);
    check_sensor(head, T, Vector3(10, kPi, 0.1), kNoMount);
    check_sensor(head, T, Vector3(10, -kPi, 0.1), Vector2(1e-8, 1e-8));
  }
}

TEST_CASE("stereo head: refusals") {
  const StereoHead head;
  CHECK(sees(head, Vector3(0.11, 0, 0)));
  CHECK_FALSE(sees(head, Vector3(0.09, 0, 0)));
  CHECK_FALSE(sees(head, Vector3(0, 0, 0)));
  CHECK_FALSE(sees(head, Vector3(0, 0, 5)));
  const double above = 1.4835298641951802;  // 85 degrees
  CHECK(sees(head, Vector3(1, 0, std::tan(above - 1e-9))));
  CHECK_FALSE(sees(head, Vector3(1, 0, std::tan(above + 1e-9))));
  CHECK_FALSE(sees(head, Vector3(1, 0, -std::tan(above + 1e-9))));
  CHECK(places(head, Vector3(0.11, 0, 0)));
  CHECK_FALSE(places(head, Vector3(0.09, 0, 0)));
  CHECK_FALSE(places(head, Vector3(0, 0, 0)));
  CHECK_FALSE(places(head, Vector3(-5, 0, 0)));
  CHECK(places(head, Vector3(5, 0, above - 1e-9)));
  CHECK_FALSE(places(head, Vector3(5, 0, above + 1e-9)));
  CHECK_FALSE(places(head, Vector3(5, 0, -above - 1e-9)));
  check_never_nan(head);
}

TEST_CASE("stereo head: noise and residual") {
  StereoHeadParameters p;
  CHECK(std::abs(StereoHead(p).noise()(0, 0) - 1) < 1e-15);
  CHECK(std::abs(std::sqrt(StereoHead(p).noise()(1, 1)) - 3 * kPi / 180) < 1e-15);
  CHECK(std::abs(std::sqrt(StereoHead(p).noise()(2, 2)) - 3 * kPi / 180) < 1e-15);
  CHECK(StereoHead(p).mount_noise_mode() == MountNoise::none);
  p.stick_sigma = 0.02;
  CHECK(StereoHead(p).mount_noise_mode() == MountNoise::per_observation);
  p.pan_sigma = 0.01;
  p.encoder_per_frame = true;
  CHECK(StereoHead(p).mount_noise_mode() == MountNoise::per_frame);
  CHECK((StereoHead(p).mount_noise() - Matrix2(Vector2(1e-4, 4e-4).asDiagonal())).norm() < 1e-18);
  const Vector3 r = StereoHead(p).residual(Vector3(9, 3.1, 0.2), Vector3(10, -3.1, 0.1));
  CHECK((r - Vector3(-1, 6.2 - 2 * kPi, 0.1)).norm() < 1e-14);
}

TEST_CASE("stereo camera: projection and viewing direction") {
  const StereoCamera camera;
  Prediction<SE3> seen;
  // 10 m ahead, 1 m to the left, 0.5 m up: in the image to the left of the centre and above it.
  REQUIRE(camera.predict(SE3(), Vector3(10, 1, 0.5), kNoMount, seen));
  CHECK((seen.z - Vector3(320 - 50, 320 - 60, 240 - 25)).norm() < 1e-11);

  const StereoCameraParameters p = mounted_camera();
  const SE3 T(SO3::exp(Vector3(0.1, 0.2, 2)), Vector3(4, 5, 6));
  const Vector3 x(1, -2, 7);
  REQUIRE(StereoCamera(p).predict(T, T * (p.T_body_camera * x), kNoMount, seen));
  CHECK((seen.z - Vector3(480.0 / 7 + 330, 480 * 0.75 / 7 + 330, -510 * 2.0 / 7 + 250)).norm() < 1e-11);
  CHECK(StereoCamera(p).noise() == Matrix3::Identity());
}

TEST_CASE("stereo camera: Jacobians") {
  for (const StereoCameraParameters& p : {StereoCameraParameters(), mounted_camera()}) {
    const StereoCamera camera(p);
    Random random(33);
    for (const SE3& T : awkward_poses(34)) {
      const double left = random.uniform(0, 640), disparity = random.uniform(4, 80);
      check_sensor(camera, T, Vector3(left, left - disparity, random.uniform(0, 480)), kNoMount);
    }
    // Close to the limits: near depth, where the disparity is large, and the smallest disparity.
    const SE3 T(SO3::exp(Vector3(0.3, -0.2, 1)), Vector3(1, 2, 3));
    const double largest = p.fu * p.baseline / (p.near_depth + 1e-3);
    check_sensor(camera, T, Vector3(800, 800 - largest, 300), kNoMount);
    const double least = std::max(p.min_disparity, p.min_disparity_sigmas * std::sqrt(2));
    check_sensor(camera, T, Vector3(300, 300 - least - 1e-3, 200), kNoMount);
  }
}

TEST_CASE("stereo camera: refusals") {
  const StereoCamera camera;
  CHECK(sees(camera, Vector3(0.1 + 1e-9, 0, 0)));
  CHECK_FALSE(sees(camera, Vector3(0.1 - 1e-9, 0, 0)));
  CHECK_FALSE(sees(camera, Vector3(0, 1, 1)));
  CHECK_FALSE(sees(camera, Vector3(-5, 0, 0)));
  // The smallest disparity is the larger of 2.5 standard deviations, here of sqrt(2) pixels, and min_disparity.
  const double least = 2.5 * std::sqrt(2);
  CHECK(places(camera, Vector3(300, 300 - least - 1e-9, 200)));
  CHECK_FALSE(places(camera, Vector3(300, 300 - least + 1e-9, 200)));
  CHECK_FALSE(places(camera, Vector3(300, 300, 200)));
  CHECK_FALSE(places(camera, Vector3(300, 310, 200)));
  StereoCameraParameters sharp;
  sharp.sigma << 0.1, 0.1, 5;
  CHECK(places(StereoCamera(sharp), Vector3(300, 299, 200)));
  CHECK_FALSE(places(StereoCamera(sharp), Vector3(300, 299.001, 200)));
  CHECK_FALSE(places(camera, Vector3(3000, 1900, 200)));  // 0.09 m away, nearer than the camera images
  check_never_nan(camera);
}

TEST_CASE("cartesian: the point in the sensor's frame") {
  CartesianParameters<SE3> p;
  p.T_body_sensor = SE3(SO3::exp(Vector3(0.2, -0.4, 1)), Vector3(0.5, 0.1, 0.3));
  const Cartesian<SE3> sensor(p);
  const SE3 T(SO3::exp(Vector3(0.1, 0.2, 2)), Vector3(4, 5, 6));
  Prediction<SE3> seen;
  REQUIRE(sensor.predict(T, T * (p.T_body_sensor * Vector3(1, 2, 3)), kNoMount, seen));
  CHECK((seen.z - Vector3(1, 2, 3)).norm() < 1e-14);
  CHECK((sensor.noise() - 0.01 * Matrix3::Identity()).norm() < 1e-16);
  Random random(35);
  for (const SE3& pose : awkward_poses(36)) {
    check_sensor(sensor, pose, 10 * random.normal_vector<3>(), kNoMount);
    check_sensor(Cartesian<SE3>(), pose, 1e-8 * random.normal_vector<3>(), kNoMount);
  }
  check_never_nan(sensor);
}
