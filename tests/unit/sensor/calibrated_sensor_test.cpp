// SPDX-License-Identifier: BSD-3-Clause
// A sensor with systematic errors: all Jacobians, and what the errors mean.
#include "sensor/calibrated_sensor.hpp"

#include <doctest/doctest.h>

#include "numerical.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/jacobian_check.hpp"
#include "sensor/range_bearing.hpp"
#include "sensor/sensors.hpp"
#include "sensor/stereo_head.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

template <class Pose>
Calibration<Pose> random_errors(Random& random, double size) {
  return size * random.normal_vector<kCalibrationErrors<Pose>>();
}

template <class Pose>
void check_calibrated(const Sensor<Pose>& sensor, const Pose& T, const typename Pose::Point& landmark,
                      const Calibration<Pose>& errors) {
  using Numbers = Calibration<Pose>;
  const MountError<Pose> none = MountError<Pose>::Zero();
  CalibratedSensor<Pose> calibrated(sensor, errors);
  const int rows = calibrated.rows();
  Prediction<Pose> seen;
  REQUIRE(calibrated.predict(T, landmark, none, seen));
  Placement<Pose> placed;
  REQUIRE(calibrated.place(T, seen.z, none, placed));
  CHECK((placed.landmark - landmark).norm() < 1e-9 * (1 + landmark.norm()));
  const double tolerance = 1e-8 * (1 + landmark.norm());
  check_jacobians<Pose>(calibrated, T, seen.z, none, placed, seen, tolerance);

  const auto predicted = [&](const Numbers& change) {
    Prediction<Pose> out;
    REQUIRE(CalibratedSensor<Pose>(sensor, errors + change).predict(T, landmark, none, out));
    return Vector3(sensor.residual(out.z, seen.z));
  };
  const auto J = jacobian_at_zero<kCalibrationErrors<Pose>>(predicted);
  CHECK((J - calibrated.by_calibration(T, seen)).topRows(rows).norm() < tolerance);
  const auto position = [&](const Numbers& change) {
    Placement<Pose> out;
    REQUIRE(CalibratedSensor<Pose>(sensor, errors + change).place(T, seen.z, none, out));
    return out.landmark;
  };
  const auto K = jacobian_at_zero<kCalibrationErrors<Pose>>(position);
  CHECK((K - calibrated.by_calibration(T, placed)).leftCols(Pose::kDof + rows).norm() < tolerance);
}

}  // namespace

TEST_CASE("calibrated sensor: Jacobians in space") {
  Random random(5);
  StereoHead head(mounted_head());
  head.point(0.3, -0.2);
  const Cartesian<SE3> points;
  for (const double size : {0.0, 1e-8, 0.01, 0.3})
    for (int i = 0; i < 5; ++i) {
      CAPTURE(size);
      const SE3 T(SO3::exp(random.normal_vector<3>()), Vector3(4 * random.normal_vector<3>()));
      const Calibration<SE3> errors = random_errors<SE3>(random, size);
      check_calibrated<SE3>(head, T, T * Vector3(12, 1.5, -1), errors);
      check_calibrated<SE3>(points, T, T * Vector3(12, 1.5, -1), errors);
    }
}

TEST_CASE("calibrated sensor: Jacobians in the plane") {
  Random random(6);
  const RangeBearing radar;
  const Cartesian<SE2> points;
  for (const double size : {0.0, 1e-8, 0.01, 0.3})
    for (int i = 0; i < 5; ++i) {
      CAPTURE(size);
      const SE2 T(SO2::from_angle(random.normal()), Vector2(4 * random.normal_vector<2>()));
      Calibration<SE2> errors = random_errors<SE2>(random, size);
      errors[5] = 0;  // these sensors give two values
      check_calibrated<SE2>(radar, T, T * Vector2(12, 1.5), errors);
      check_calibrated<SE2>(points, T, T * Vector2(12, 1.5), errors);
    }
}

TEST_CASE(
    "calibrated sensor: the sensor works as if the body were at T E, and its values are too large by the offset") {
  const Cartesian<SE3> sensor;
  Calibration<SE3> errors;
  errors << 0.1, -0.2, 0.3, 0.02, 0.01, -0.03, 0.5, 0.6, 0.7;
  const CalibratedSensor<SE3> calibrated(sensor, errors);
  const SE3 T(SO3::exp(Vector3(0.3, -0.1, 0.8)), Vector3(1, 2, 3));
  const SE3 E(SO3::exp(Vector3(0.02, 0.01, -0.03)), Vector3(0.1, -0.2, 0.3));
  const Vector3 landmark(7, 8, 9);
  Prediction<SE3> seen;
  REQUIRE(calibrated.predict(T, landmark, MountError<SE3>::Zero(), seen));
  CHECK((seen.z - (Vector3((T * E).inverse() * landmark) + Vector3(0.5, 0.6, 0.7))).norm() < 1e-12);
}
