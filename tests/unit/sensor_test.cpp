// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/angle.hpp"
#include "numerical.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/custom.hpp"
#include "sensor/stereo_camera.hpp"
#include "sensor/stereo_head.hpp"

using namespace cairn;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const Vector2 kNoMount = Vector2::Zero();

template <class A, class B>
double relative(const A& analytic, const B& numerical) {
  return (analytic - numerical).norm() / (1 + numerical.norm());
}

// All Jacobians of a prediction and of a placement against central differences, and that both undo each other.
// The differences are good to 1e-9 of a Jacobian at the nearest points (numerical.hpp); a coordinate x, rounded to
// 1e-16 x a few times, adds a few 1e-12 x when it is divided by the step of 1e-4.
void check_sensor(const Sensor& sensor, const SE3& T, const Vector3& z, const Vector2& mount) {
  Placement placed;
  REQUIRE(sensor.place(T, z, mount, placed));
  const double tolerance = 1e-9 + 1e-11 * placed.landmark.norm();
  Prediction seen;
  REQUIRE(sensor.predict(T, placed.landmark, mount, seen));
  CHECK(sensor.residual(z, seen.z).norm() < tolerance * (1 + z.norm()));

  const auto z_of = [&](const SE3& pose, const Vector3& landmark, const Vector2& angles) {
    Prediction p;
    REQUIRE(sensor.predict(pose, landmark, angles, p));
    return p.z;
  };
  const auto minus = [&](const Vector3& a, const Vector3& b) { return sensor.residual(a, b); };
  const Vector3& l = placed.landmark;
  CHECK(relative(seen.J_z_pose, test::pose_jacobian([&](const SE3& X) { return z_of(X, l, mount); }, T, minus)) <
        tolerance);
  CHECK(relative(seen.J_z_landmark, test::jacobian<3>([&](const Vector3& x) { return z_of(T, x, mount); }, l, minus)) <
        tolerance);
  CHECK(relative(seen.J_z_mount, test::jacobian<2>([&](const Vector2& x) { return z_of(T, l, x); }, mount, minus)) <
        tolerance);

  const auto landmark_of = [&](const SE3& pose, const Vector3& value, const Vector2& angles) {
    Placement p;
    REQUIRE(sensor.place(pose, value, angles, p));
    return p.landmark;
  };
  CHECK(relative(placed.J_landmark_pose,
                 test::pose_jacobian([&](const SE3& X) { return landmark_of(X, z, mount); }, T)) < tolerance);
  CHECK(relative(placed.J_landmark_z,
                 test::jacobian<3>([&](const Vector3& x) { return landmark_of(T, x, mount); }, z)) < tolerance);
  CHECK(relative(placed.J_landmark_mount,
                 test::jacobian<2>([&](const Vector2& x) { return landmark_of(T, z, x); }, mount)) < tolerance);
}

StereoHeadParameters mounted_head() {
  StereoHeadParameters p;
  p.platform << 0.3, -0.1, 1.2;
  p.stick << 0.15, 0.05, 0.2;
  p.R_stick_camera = SO3::exp(Vector3(0.1, 0.4, -0.2));
  return p;
}

StereoCameraParameters mounted_camera() {
  StereoCameraParameters p;
  p.fu = 480;
  p.fv = 510;
  p.cu = 330;
  p.cv = 250;
  p.baseline = 0.25;
  p.T_body_camera = SE3(p.T_body_camera.rotation() * SO3::exp(Vector3(0.1, -0.3, 0.05)), Vector3(0.4, 0.1, 1.1));
  return p;
}

// What a refusal must not depend on: that the point itself is at fault.
bool sees(const Sensor& sensor, const Vector3& landmark) {
  Prediction out;
  return sensor.predict(SE3(), landmark, kNoMount, out);
}
bool places(const Sensor& sensor, const Vector3& z) {
  Placement out;
  return sensor.place(SE3(), z, kNoMount, out);
}

void check_never_nan(const Sensor& sensor) {
  for (double bad : {kNaN, kInfinity, -kInfinity, 1e300}) {
    for (int i = 0; i < 3; ++i) {
      Vector3 x(5, 0.1, 0.2);
      x[i] = bad;
      Prediction seen;
      if (sensor.predict(SE3(), x, kNoMount, seen)) {
        CHECK(seen.z.allFinite());
        CHECK(seen.J_z_pose.allFinite());
        CHECK(seen.J_z_landmark.allFinite());
        CHECK(seen.J_z_mount.allFinite());
      }
      Placement placed;
      if (sensor.place(SE3(), x, kNoMount, placed)) {
        CHECK(placed.landmark.allFinite());
        CHECK(placed.J_landmark_pose.allFinite());
        CHECK(placed.J_landmark_z.allFinite());
      }
      CHECK_FALSE((std::isnan(bad) && (sees(sensor, x) || places(sensor, x))));
    }
    const SE3 nowhere(SO3(), Vector3(0, bad, 0));
    Prediction seen;
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
  Prediction seen;
  REQUIRE(head.predict(T, T * m_b, kNoMount, seen));
  CHECK((seen.z - Vector3(m_c.norm(), std::atan2(2, 8), std::atan2(-1, std::hypot(8, 2)))).norm() < 1e-14);

  // A mount error adds to the encoders.
  StereoHead turned(p);
  turned.point(pan + 0.02, stick - 0.03);
  Prediction expected;
  REQUIRE(turned.predict(T, T * m_b, kNoMount, expected));
  REQUIRE(head.predict(T, T * m_b, Vector2(0.02, -0.03), seen));
  CHECK((seen.z - expected.z).norm() < 1e-14);
}

TEST_CASE("stereo head: signs with the default mount") {
  StereoHead head;
  Prediction seen;
  REQUIRE(head.predict(SE3(), Vector3(3, 3, 0), kNoMount, seen));
  CHECK((seen.z - Vector3(std::sqrt(18), kPi / 4, 0)).norm() < 1e-14);  // left is positive
  REQUIRE(head.predict(SE3(), Vector3(2, 0, 2), kNoMount, seen));
  CHECK((seen.z - Vector3(std::sqrt(8), 0, kPi / 4)).norm() < 1e-14);  // up is positive
  head.point(kPi / 2, 0);
  REQUIRE(head.predict(SE3(), Vector3(0, 4, 0), kNoMount, seen));
  CHECK((seen.z - Vector3(4, 0, 0)).norm() < 1e-14);  // panned left, it looks left
  head.point(0, 0.5);
  REQUIRE(head.predict(SE3(), Vector3(4, 0, 0), kNoMount, seen));
  CHECK(std::abs(seen.z[2] - 0.5) < 1e-14);  // a positive stick angle lowers the lens, the point appears above
}

TEST_CASE("stereo head: Jacobians") {
  const std::vector<SE3> poses = test::awkward_poses(31);
  for (const StereoHeadParameters& p : {StereoHeadParameters(), mounted_head()}) {
    StereoHead head(p);
    test::Random random(32);
    for (const SE3& T : poses) {
      head.point(random.uniform(-3, 3), random.uniform(-1, 1));
      const Vector3 z(random.uniform(0.2, 60), random.uniform(-3.1, 3.1), random.uniform(-1.2, 1.2));
      check_sensor(head, T, z, kNoMount);
      check_sensor(head, T, z, Vector2(0.05, -0.08));
    }
    // Close to the limits: in range, in elevation, and across the cut of the azimuth.
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

TEST_CASE("stereo camera: the pinhole, and where it looks") {
  const StereoCamera camera;
  Prediction seen;
  // 10 m ahead, 1 m to the left, 0.5 m up: in the image left of and above the centre.
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
    test::Random random(33);
    for (const SE3& T : test::awkward_poses(34)) {
      const double left = random.uniform(0, 640), disparity = random.uniform(4, 80);
      check_sensor(camera, T, Vector3(left, left - disparity, random.uniform(0, 480)), kNoMount);
    }
    // Close to the limits: near depth, where the disparity is large, and least disparity.
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
  // Least disparity: 2.5 of its deviations, here of sqrt(2) pixels, or min_disparity where that is more.
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
  CartesianParameters p;
  p.T_body_sensor = SE3(SO3::exp(Vector3(0.2, -0.4, 1)), Vector3(0.5, 0.1, 0.3));
  const Cartesian sensor(p);
  const SE3 T(SO3::exp(Vector3(0.1, 0.2, 2)), Vector3(4, 5, 6));
  Prediction seen;
  REQUIRE(sensor.predict(T, T * (p.T_body_sensor * Vector3(1, 2, 3)), kNoMount, seen));
  CHECK((seen.z - Vector3(1, 2, 3)).norm() < 1e-14);
  CHECK((sensor.noise() - 0.01 * Matrix3::Identity()).norm() < 1e-16);
  test::Random random(35);
  for (const SE3& pose : test::awkward_poses(36)) {
    check_sensor(sensor, pose, 10 * random.normal_vector<3>(), kNoMount);
    check_sensor(Cartesian(), pose, 1e-8 * random.normal_vector<3>(), kNoMount);
  }
  check_never_nan(sensor);
}

// Custom sensors: a built-in one behind the callbacks, packed as the C interface has them.
namespace {

struct Wrapped {
  const Sensor* sensor = nullptr;
  int rows = 3;
  int refuse = 0;             // what the callbacks return
  double wrong_landmark = 0;  // error of one entry of a Jacobian
  double offset = 0;          // where place leads, beside the landmark
};

SE3 unpack(const double* pose) {
  return SE3(SO3::from_quaternion(pose[3], pose[4], pose[5], pose[6]), Vector3(pose[0], pose[1], pose[2]));
}

std::int32_t predict_wrapped(void* user, const double* pose, const double* landmark, double* z, double* J_pose,
                             double* J_landmark) {
  const Wrapped& w = *static_cast<const Wrapped*>(user);
  Prediction out;
  if (!w.sensor->predict(unpack(pose), Vector3(landmark[0], landmark[1], landmark[2]), kNoMount, out)) return 7;
  for (int i = 0; i < w.rows; ++i) {
    z[i] = out.z[i];
    for (int j = 0; j < 6; ++j) J_pose[6 * i + j] = out.J_z_pose(i, j);
    for (int j = 0; j < 3; ++j) J_landmark[3 * i + j] = out.J_z_landmark(i, j);
  }
  J_landmark[1] += w.wrong_landmark;
  return w.refuse;
}

std::int32_t place_wrapped(void* user, const double* pose, const double* z, double* landmark, double* J_pose,
                           double* J_z) {
  const Wrapped& w = *static_cast<const Wrapped*>(user);
  Vector3 full(5, 0, 0);  // what fewer than three values leave open
  for (int i = 0; i < w.rows; ++i) full[i] = z[i];
  Placement out;
  if (!w.sensor->place(unpack(pose), full, kNoMount, out)) return 7;
  for (int i = 0; i < 3; ++i) {
    landmark[i] = out.landmark[i] + w.offset;
    for (int j = 0; j < 6; ++j) J_pose[6 * i + j] = out.J_landmark_pose(i, j);
    for (int j = 0; j < w.rows; ++j) J_z[w.rows * i + j] = out.J_landmark_z(i, j);
  }
  return w.refuse;
}

// Azimuth and elevation of a point of the body frame: two values, both angles, the head's rows moved up.
class Bearing final : public Sensor {
 public:
  int rows() const override { return 2; }
  const Matrix3& noise() const override { return head_.noise(); }
  bool predict(const SE3& T, const Vector3& p, const Vector2& mount, Prediction& out) const override {
    if (!head_.predict(T, p, mount, out)) return false;
    out.z = Vector3(out.z[1], out.z[2], 0);
    out.J_z_pose.topRows<2>() = out.J_z_pose.bottomRows<2>().eval();
    out.J_z_landmark.topRows<2>() = out.J_z_landmark.bottomRows<2>().eval();
    return true;
  }
  bool place(const SE3& T, const Vector3& z, const Vector2& mount, Placement& out) const override {
    if (!head_.place(T, Vector3(20, z[0], z[1]), mount, out)) return false;
    out.J_landmark_z.leftCols<2>() = out.J_landmark_z.rightCols<2>().eval();
    return true;
  }

 private:
  StereoHead head_;
};

CustomParameters wrap(Wrapped& user, std::uint32_t angle_mask) {
  CustomParameters p;
  p.rows = user.rows;
  p.predict = predict_wrapped;
  p.place = place_wrapped;
  p.user = &user;
  p.angle_mask = angle_mask;
  p.sigma << 0.5, 0.1, 0.2;
  return p;
}

const SE3 kPose(SO3::exp(Vector3(0.1, -0.2, 2)), Vector3(3, -4, 1));
const Vector3 kLandmark(10, 3, 2);

}  // namespace

TEST_CASE("custom: the same numbers as the sensor behind the callbacks") {
  const StereoHead head(mounted_head());
  Wrapped user;
  user.sensor = &head;
  const CustomSensor custom(wrap(user, 6));
  Prediction expected, seen;
  REQUIRE(head.predict(kPose, kLandmark, kNoMount, expected));
  REQUIRE(custom.predict(kPose, kLandmark, kNoMount, seen));
  // The pose passes through a quaternion that is normalised once more.
  CHECK((seen.z - expected.z).norm() < 1e-13);
  CHECK((seen.J_z_pose - expected.J_z_pose).norm() < 1e-13);
  CHECK((seen.J_z_landmark - expected.J_z_landmark).norm() < 1e-13);
  CHECK(seen.J_z_mount.isZero(0));
  Placement there, placed;
  REQUIRE(head.place(kPose, expected.z, kNoMount, there));
  REQUIRE(custom.place(kPose, expected.z, kNoMount, placed));
  CHECK((placed.landmark - there.landmark).norm() < 1e-13);
  CHECK((placed.J_landmark_pose - there.J_landmark_pose).norm() < 1e-12);
  CHECK((placed.J_landmark_z - there.J_landmark_z).norm() < 1e-12);
  CHECK(custom.rows() == 3);
  CHECK((custom.noise().diagonal() - Vector3(0.25, 0.01, 0.04)).norm() < 1e-15);
}

TEST_CASE("custom: fewer rows are packed tightly and leave the rest zero") {
  const Bearing bearing;
  for (int rows : {1, 2}) {
    Wrapped user;
    user.sensor = &bearing;
    user.rows = rows;
    const CustomSensor custom(wrap(user, 3));
    Prediction expected, seen;
    seen.z.setConstant(9);
    seen.J_z_pose.setConstant(9);
    seen.J_z_landmark.setConstant(9);
    seen.J_z_mount.setConstant(9);
    REQUIRE(bearing.predict(kPose, kLandmark, kNoMount, expected));
    REQUIRE(custom.predict(kPose, kLandmark, kNoMount, seen));
    CHECK(custom.rows() == rows);
    CHECK((seen.z.head(rows) - expected.z.head(rows)).norm() < 1e-13);
    CHECK((seen.J_z_pose.topRows(rows) - expected.J_z_pose.topRows(rows)).norm() < 1e-13);
    CHECK((seen.J_z_landmark.topRows(rows) - expected.J_z_landmark.topRows(rows)).norm() < 1e-13);
    CHECK(seen.z.tail(3 - rows).isZero(0));
    CHECK(seen.J_z_pose.bottomRows(3 - rows).isZero(0));
    CHECK(seen.J_z_landmark.bottomRows(3 - rows).isZero(0));
    CHECK(seen.J_z_mount.isZero(0));
    Placement placed;
    REQUIRE(custom.place(kPose, seen.z, kNoMount, placed));
    CHECK(placed.J_landmark_z.leftCols(rows).norm() > 1);
    CHECK(placed.J_landmark_z.rightCols(3 - rows).isZero(0));
    CHECK(custom.residual(Vector3(1, 2, 3), Vector3::Zero()).tail(3 - rows).isZero(0));
  }
}

TEST_CASE("custom: angles are wrapped, and only they") {
  const StereoHead head;
  Wrapped user;
  user.sensor = &head;
  const Vector3 r = CustomSensor(wrap(user, 2)).residual(Vector3(7, 7, 7), Vector3::Zero());
  CHECK((r - Vector3(7, 7 - 2 * kPi, 7)).norm() < 1e-14);
}

namespace {

// Writes everything but one value, which stays what the caller made it, or is not finite.
int spoiled = -1;
double spoiled_by = 0;
std::int32_t spoil_predict(void*, const double*, const double*, double* z, double* J_pose, double* J_landmark) {
  for (int i = 0; i < 3; ++i) {
    if (i != spoiled) z[i] = 1;
  }
  if (spoiled == 3) J_pose[17] = spoiled_by;
  if (spoiled == 4) J_landmark[8] = spoiled_by;
  if (spoiled == 5) z[0] = spoiled_by;
  return 0;
}
std::int32_t spoil_place(void*, const double*, const double*, double* landmark, double* J_pose, double* J_z) {
  for (int i = 0; i < 3; ++i) {
    if (i != spoiled) landmark[i] = 1;
  }
  if (spoiled == 3) J_pose[17] = spoiled_by;
  if (spoiled == 4) J_z[8] = spoiled_by;
  if (spoiled == 5) landmark[0] = spoiled_by;
  return 0;
}

}  // namespace

TEST_CASE("custom: refusals") {
  const StereoHead head;
  Wrapped user;
  user.sensor = &head;
  CustomParameters p = wrap(user, 6);
  Prediction seen;
  Placement placed;
  CHECK(CustomSensor(p).predict(kPose, kLandmark, kNoMount, seen));
  CHECK(CustomSensor(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
  CHECK_FALSE(CustomSensor(p).predict(kPose, kPose.translation(), kNoMount, seen));
  for (int code : {1, -1}) {
    user.refuse = code;
    CHECK_FALSE(CustomSensor(p).predict(kPose, kLandmark, kNoMount, seen));
    CHECK_FALSE(CustomSensor(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
  }
  user.refuse = 0;
  p.place = nullptr;
  CHECK_FALSE(CustomSensor(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));

  p.predict = spoil_predict;
  p.place = spoil_place;
  spoiled = -1;
  CHECK(CustomSensor(p).predict(kPose, kLandmark, kNoMount, seen));
  CHECK(CustomSensor(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
  for (spoiled = 0; spoiled < 6; ++spoiled) {
    for (double value : {kNaN, kInfinity}) {
      spoiled_by = value;
      CHECK_FALSE(CustomSensor(p).predict(kPose, kLandmark, kNoMount, seen));
      CHECK_FALSE(CustomSensor(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
    }
  }
}

TEST_CASE("custom: check finds a wrong Jacobian and passes a right one") {
  const StereoHead head(mounted_head());
  const StereoCamera camera(mounted_camera());
  const Bearing bearing;
  for (const SE3& T : test::awkward_poses(37)) {
    if (T.translation().norm() > 1e3) continue;  // rounding of the coordinates exceeds what the check resolves
    double worst = -1;
    Wrapped user;
    user.sensor = &head;
    Placement ahead;
    REQUIRE(head.place(T, Vector3(12, 0.3, 0.2), kNoMount, ahead));
    REQUIRE(check_custom(CustomSensor(wrap(user, 6)), T, ahead.landmark, worst));
    CHECK(worst < 1e-6);
    REQUIRE(camera.place(T, Vector3(300, 290, 200), kNoMount, ahead));
    user.sensor = &camera;
    REQUIRE(check_custom(CustomSensor(wrap(user, 0)), T, ahead.landmark, worst));
    CHECK(worst < 1e-6);
    // Two values don't tell where a landmark at 12 m lies, but the check holds what they do tell.
    REQUIRE(bearing.place(T, Vector3(kPi, 0.2, 0), kNoMount, ahead));
    user.sensor = &bearing;
    user.rows = 2;
    REQUIRE(check_custom(CustomSensor(wrap(user, 3)), T, ahead.landmark + Vector3(0.1, 0.2, 0.3), worst));
    CHECK(worst < 1e-6);
  }
  Wrapped user;
  user.sensor = &head;
  double worst = -1;
  user.wrong_landmark = 1e-3;
  REQUIRE(check_custom(CustomSensor(wrap(user, 6)), kPose, kLandmark, worst));
  CHECK(worst > 0.9e-3);
  CHECK(worst < 1.1e-3);
  user.wrong_landmark = 0;
  user.offset = 0.1;  // relative to the 10 m of the landmark's first coordinate, to 3 of its second
  REQUIRE(check_custom(CustomSensor(wrap(user, 6)), kPose, kLandmark, worst));
  CHECK(std::abs(worst - 0.1 / 2) < 1e-3);
  user.offset = 0;
  CustomParameters blind = wrap(user, 6);
  blind.place = nullptr;
  REQUIRE(check_custom(CustomSensor(blind), kPose, kLandmark, worst));
  CHECK(worst < 1e-6);
  const StereoHead at_origin;
  user.sensor = &at_origin;
  CHECK_FALSE(check_custom(CustomSensor(wrap(user, 6)), kPose, kPose.translation(), worst));
}
