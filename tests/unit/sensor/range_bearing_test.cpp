// SPDX-License-Identifier: BSD-3-Clause
// Range and bearing in the plane, and extended observations through a mutual sighting: values by hand, Jacobians by
// differences.
#include "sensor/range_bearing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/angle.hpp"
#include "numerical.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/jacobian_check.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

const Vector3 kNone = Vector3::Zero();

// All Jacobians of a prediction and of a placement. Errors are relative to the distance, because bearings of near
// points change fast.
void check_sensor(const Sensor<SE2>& sensor, const SE2& T, const Vector3& z, const Vector3& mount) {
  CAPTURE(z.transpose());
  CAPTURE(T.translation().transpose());
  CAPTURE(T.rotation().angle());
  CAPTURE(mount.transpose());
  Placement<SE2> placed;
  REQUIRE(sensor.place(T, z, mount, placed));
  Prediction<SE2> seen;
  REQUIRE(sensor.predict(T, placed.landmark, mount, seen));
  // A coordinate is rounded to 1e-16 of its size; this is divided by the step of 1e-4 and by the distance.
  const double tolerance = 1e-8 + 1e-11 * placed.landmark.norm() / std::min(z[0], 1.0);
  CHECK(sensor.residual(z, seen.z).norm() < tolerance);
  check_jacobians<SE2>(sensor, T, z, mount, placed, seen, tolerance);
}

const double kBearings[] = {0, 1e-9, 0.7, kPi / 2, -kPi / 2, 3, kPi - 1e-9, -kPi + 1e-9, kPi, 5};

MutualSighting sighting_of(double range, double bearing, double back) {
  MutualSighting s;
  s.range = range, s.bearing = bearing, s.back = back;
  s.covariance = Vector3(900, 1e-4, 2e-4).asDiagonal();
  return s;
}

}  // namespace

TEST_CASE("range and bearing: a mounted sensor by hand") {
  RangeBearingParameters p;
  p.T_body_sensor = SE2(SO2::from_angle(kPi / 2), Vector2(1, 2));
  const RangeBearing radar(p);
  const SE2 T(SO2::from_angle(kPi / 2), Vector2(10, 20));
  // The sensor is at (10, 20) + R(90) (1, 2) = (8, 21) and looks along -x.
  Prediction<SE2> seen;
  REQUIRE(radar.predict(T, Vector2(5, 21), kNone, seen));
  CHECK(seen.z[0] == doctest::Approx(3));
  CHECK(std::abs(wrap_angle(seen.z[1])) < 1e-15);
  REQUIRE(radar.predict(T, Vector2(8, 17), kNone, seen));  // to the left of -x
  CHECK(seen.z[0] == doctest::Approx(4));
  CHECK(seen.z[1] == doctest::Approx(kPi / 2));
  Placement<SE2> placed;
  REQUIRE(radar.place(T, Vector3(4, kPi / 2, 0), kNone, placed));
  CHECK((placed.landmark - Vector2(8, 17)).norm() < 1e-14);
  CHECK(radar.rows() == 2);
  CHECK(radar.relative());
}

TEST_CASE("range and bearing: Jacobians") {
  RangeBearingParameters mounted;
  mounted.T_body_sensor = SE2(SO2::from_angle(-2.5), Vector2(0.3, -0.7));
  mounted.near_range = 0.01;
  const RangeBearing plain, aside(mounted);
  for (const RangeBearing* radar : {&plain, &aside})
    for (const SE2& T : awkward_poses<SE2>(3))
      for (double range : {0.2, 1.0, 30.0, 5000.0})
        for (double bearing : kBearings) check_sensor(*radar, T, Vector3(range, bearing, 0), kNone);
}

TEST_CASE("range and bearing: near the sensor's origin") {
  RangeBearingParameters p;
  p.near_range = 0.5;
  const RangeBearing radar(p);
  Prediction<SE2> seen;
  Placement<SE2> placed;
  const SE2 T(SO2::from_angle(1), Vector2(3, 4));
  for (double range : {0.0, 1e-300, 1e-9, 0.4999999}) {
    CHECK_FALSE(radar.predict(T, T * Vector2(range, 0), kNone, seen));
    CHECK_FALSE(radar.place(T, Vector3(range, 0.1, 0), kNone, placed));
  }
  CHECK(radar.predict(T, T * Vector2(0.5000001, 0), kNone, seen));
  CHECK(radar.place(T, Vector3(0.5, 0.1, 0), kNone, placed));
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (double bad : {nan, infinity, -infinity}) {
    CHECK_FALSE(radar.predict(T, Vector2(bad, 0), kNone, seen));
    CHECK_FALSE(radar.predict(T, Vector2(0, bad), kNone, seen));
    CHECK_FALSE(radar.place(T, Vector3(bad, 0, 0), kNone, placed));
    CHECK_FALSE(radar.place(T, Vector3(1, bad, 0), kNone, placed));
  }
}

TEST_CASE("range and bearing: residuals of bearings take the short way round") {
  const RangeBearing radar;
  const ExtendedObservation extended({}, sighting_of(1, 0, 0), true);
  for (const Sensor<SE2>* sensor :
       {static_cast<const Sensor<SE2>*>(&radar), static_cast<const Sensor<SE2>*>(&extended)}) {
    Vector3 r = sensor->residual(Vector3(5, kPi - 0.1, 0), Vector3(4, -kPi + 0.1, 0));
    CHECK(r[0] == doctest::Approx(1));
    CHECK(r[1] == doctest::Approx(-0.2));
    r = sensor->residual(Vector3(5, 7 * kPi + 0.1, 0), Vector3(5, -kPi + 0.2, 0));
    CHECK(r[1] == doctest::Approx(-0.1));
  }
}

TEST_CASE("range and bearing: noise") {
  RangeBearingParameters p;
  p.range_sigma = 30, p.bearing_sigma = 0.02;
  const Matrix3 expected = Vector3(900, 4e-4, 1).asDiagonal();
  CHECK((RangeBearing(p).noise() - expected).norm() < 1e-12);
  CHECK((ExtendedObservation(p, sighting_of(1, 0, 0), true).noise() - expected).norm() < 1e-12);
  CHECK(RangeBearing(p).mount_noise_mode() == MountNoise::none);
  CHECK(ExtendedObservation(p, sighting_of(1, 0, 0), true).mount_noise_mode() == MountNoise::per_frame);
  CHECK(ExtendedObservation(p, sighting_of(1, 0, 0), false).mount_noise_mode() == MountNoise::per_observation);
  CHECK((ExtendedObservation(p, sighting_of(1, 0, 0), true).mount_noise() - sighting_of(1, 0, 0).covariance).norm() ==
        0);
}

TEST_CASE("extended observation: Jacobians") {
  Random random(9);
  const double ranges[] = {0.5, 20.0, 1500.0};
  for (const SE2& T : awkward_poses<SE2>(3))
    for (double range : ranges)
      for (double bearing : {0.0, 0.7, kPi - 1e-9, kPi, -2.0}) {
        const double back = random.uniform(-kPi, kPi);
        const ExtendedObservation extended({}, sighting_of(range, bearing, back), true);
        for (double z : kBearings) {
          // Not so near to the teammate that a rotation of this vehicle by the step of the differences leads past
          // it.
          const double distance = std::max(std::pow(10.0, random.uniform(-0.5, 3)), range / 20);
          check_sensor(extended, T, Vector3(distance, z, 0), kNone);
          const Vector3 mount(0.01 * range * random.normal(), 0.05 * random.normal(), 0.05 * random.normal());
          check_sensor(extended, T, Vector3(distance, z, 0), mount);
        }
      }
}

// y_j = r_0 u(theta_0) + r_j u(theta_j + delta), delta = theta_0 - theta_0' + pi; A_j = [u, r_j u_perp](theta_j +
// delta); B_j = [u(theta_0), r_0 u_perp(theta_0) + r_j u_perp(theta_j + delta), -r_j u_perp(theta_j + delta)].
TEST_CASE("extended observation: the placement follows the theory") {
  Random random(11);
  const auto u = [](double a) { return Vector2(std::cos(a), std::sin(a)); };
  const auto u_perp = [](double a) { return Vector2(-std::sin(a), std::cos(a)); };
  for (int n = 0; n < 200; ++n) {
    const double r_0 = random.uniform(1, 2000), theta_0 = random.uniform(-kPi, kPi), back = random.uniform(-kPi, kPi);
    const double r_j = random.uniform(1, 5000), theta_j = random.uniform(-kPi, kPi);
    const double at = theta_j + theta_0 - back + kPi;
    const SE2 T(SO2::from_angle(random.uniform(-kPi, kPi)), Vector2(100 * random.normal_vector<2>()));
    const Matrix2 R = T.rotation().matrix();
    const ExtendedObservation extended({}, sighting_of(r_0, theta_0, back), true);
    Placement<SE2> placed;
    REQUIRE(extended.place(T, Vector3(r_j, theta_j, 0), kNone, placed));
    const Vector2 y = r_0 * u(theta_0) + r_j * u(at);
    CHECK((placed.landmark - T * y).norm() < 1e-9);
    Eigen::Matrix<double, 2, 3> B;
    B << u(theta_0), r_0 * u_perp(theta_0) + r_j * u_perp(at), -r_j * u_perp(at);
    CHECK((placed.J_landmark_mount - R * B).norm() < 1e-9);
    Matrix2 A;
    A << u(at), r_j * u_perp(at);
    CHECK((placed.J_landmark_z.leftCols<2>() - R * A).norm() < 1e-9);
    CHECK(placed.J_landmark_z.col(2).norm() == 0);
  }
}

// The extended observation equals the observation of the teammate's own radar at the sighted pose.
TEST_CASE("extended observation: equals the view of the teammate") {
  Random random(12);
  const RangeBearing radar;
  for (int n = 0; n < 200; ++n) {
    const SE2 own(SO2::from_angle(random.uniform(-kPi, kPi)), Vector2(300 * random.normal_vector<2>()));
    const SE2 teammate(SO2::from_angle(random.uniform(-kPi, kPi)), Vector2(300 * random.normal_vector<2>()));
    const Vector2 landmark = 500 * random.normal_vector<2>();
    Prediction<SE2> there, back, direct, extended;
    REQUIRE(radar.predict(own, teammate.translation(), kNone, there));
    REQUIRE(radar.predict(teammate, own.translation(), kNone, back));
    REQUIRE(radar.predict(teammate, landmark, kNone, direct));
    const ExtendedObservation sensor({}, sighting_of(there.z[0], there.z[1], back.z[1]), true);
    REQUIRE(sensor.predict(own, landmark, kNone, extended));
    CHECK(radar.residual(direct.z, extended.z).norm() < 1e-9);
    // Another sighting, by set() and by the error of the mount.
    ExtendedObservation off({}, sighting_of(there.z[0] + 3, there.z[1] - 0.02, back.z[1] + 0.03), true);
    Prediction<SE2> by_mount;
    REQUIRE(off.predict(own, landmark, Vector3(-3, 0.02, -0.03), by_mount));
    CHECK(radar.residual(by_mount.z, extended.z).norm() < 1e-9);
    off.set(sighting_of(there.z[0], there.z[1], back.z[1]));
    REQUIRE(off.predict(own, landmark, kNone, by_mount));
    CHECK(radar.residual(by_mount.z, extended.z).norm() < 1e-12);
  }
}

TEST_CASE("extended observation: nothing is seen near the teammate") {
  RangeBearingParameters p;
  p.near_range = 0.5;
  const ExtendedObservation extended(p, sighting_of(10, 0, kPi), true);
  Prediction<SE2> seen;
  Placement<SE2> placed;
  CHECK_FALSE(extended.predict(SE2(), Vector2(10.1, 0), kNone, seen));
  CHECK(extended.predict(SE2(), Vector2(0.1, 0), kNone, seen));  // near this vehicle, far from the teammate
  CHECK_FALSE(extended.place(SE2(), Vector3(0.1, 0, 0), kNone, placed));
}

TEST_CASE("range-bearing: a sensor of points in the plane") {
  CartesianParameters<SE2> parameters;
  parameters.T_body_sensor = SE2(SO2::from_angle(0.4), Vector2(0.3, -0.1));
  parameters.sigma << 0.1, 0.2;
  const Cartesian<SE2> sensor(parameters);
  CHECK(sensor.rows() == 2);
  CHECK(sensor.noise().diagonal().head<2>().isApprox(Vector2(0.01, 0.04)));
  for (const SE2& T : awkward_poses<SE2>(3)) {
    check_sensor(sensor, T, Vector3(3, -2, 0), kNone);
    check_sensor(sensor, T, Vector3(1, 40, 0), kNone);
  }
}
