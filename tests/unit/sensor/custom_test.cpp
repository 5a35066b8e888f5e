// SPDX-License-Identifier: BSD-3-Clause
// Custom sensors and the check of their Jacobians.
#include "sensor/custom.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "numerical.hpp"
#include "sensor/sensors.hpp"

using namespace cairn;
using namespace cairn::test;

// A built-in sensor behind callbacks, with Jacobians packed as in the C interface.
namespace {

struct Wrapped {
  const Sensor<SE3>* sensor = nullptr;
  int rows = 3;
  int answer = 1;             // return value of the callbacks
  double wrong_landmark = 0;  // error of one entry of a Jacobian
  double offset = 0;          // offset of the placed landmark
};

SE3 unpack(const double* pose) {
  return SE3(SO3::from_quaternion(pose[3], pose[4], pose[5], pose[6]), Vector3(pose[0], pose[1], pose[2]));
}

std::int32_t predict_wrapped(void* user, const double* pose, const double* landmark, double* z, double* J_pose,
                             double* J_landmark) {
  const Wrapped& w = *static_cast<const Wrapped*>(user);
  Prediction<SE3> out;
  if (!w.sensor->predict(unpack(pose), Vector3(landmark[0], landmark[1], landmark[2]), kNoMount, out)) return 0;
  for (int i = 0; i < w.rows; ++i) {
    z[i] = out.z[i];
    for (int j = 0; j < 6; ++j) J_pose[6 * i + j] = out.J_z_pose(i, j);
    for (int j = 0; j < 3; ++j) J_landmark[3 * i + j] = out.J_z_landmark(i, j);
  }
  J_landmark[1] += w.wrong_landmark;
  return w.answer;
}

std::int32_t place_wrapped(void* user, const double* pose, const double* z, double* landmark, double* J_pose,
                           double* J_z) {
  const Wrapped& w = *static_cast<const Wrapped*>(user);
  Vector3 full(5, 0, 0);  // not determined by fewer than three values
  for (int i = 0; i < w.rows; ++i) full[i] = z[i];
  Placement<SE3> out;
  if (!w.sensor->place(unpack(pose), full, kNoMount, out)) return 0;
  for (int i = 0; i < 3; ++i) {
    landmark[i] = out.landmark[i] + w.offset;
    for (int j = 0; j < 6; ++j) J_pose[6 * i + j] = out.J_landmark_pose(i, j);
    for (int j = 0; j < w.rows; ++j) J_z[w.rows * i + j] = out.J_landmark_z(i, j);
  }
  return w.answer;
}

// Azimuth and elevation of a point in the body frame: two angles, which are the last two rows of the head.
class Bearing final : public Sensor<SE3> {
 public:
  int rows() const override { return 2; }
  const Matrix3& noise() const override { return head_.noise(); }
  bool predict(const SE3& T, const Vector3& p, const Vector2& mount, Prediction<SE3>& out) const override {
    if (!head_.predict(T, p, mount, out)) return false;
    out.z = Vector3(out.z[1], out.z[2], 0);
    out.J_z_pose.topRows<2>() = out.J_z_pose.bottomRows<2>().eval();
    out.J_z_landmark.topRows<2>() = out.J_z_landmark.bottomRows<2>().eval();
    return true;
  }
  bool place(const SE3& T, const Vector3& z, const Vector2& mount, Placement<SE3>& out) const override {
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

TEST_CASE("custom: gives the same numbers as the sensor behind the callbacks") {
  const StereoHead head(mounted_head());
  Wrapped user;
  user.sensor = &head;
  const CustomSensor<SE3> custom(wrap(user, 6));
  Prediction<SE3> expected, seen;
  REQUIRE(head.predict(kPose, kLandmark, kNoMount, expected));
  REQUIRE(custom.predict(kPose, kLandmark, kNoMount, seen));
  // The pose passes through a quaternion that is normalised once more.
  CHECK((seen.z - expected.z).norm() < 1e-13);
  CHECK((seen.J_z_pose - expected.J_z_pose).norm() < 1e-13);
  CHECK((seen.J_z_landmark - expected.J_z_landmark).norm() < 1e-13);
  CHECK(seen.J_z_mount.isZero(0));
  Placement<SE3> there, placed;
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
    const CustomSensor<SE3> custom(wrap(user, 3));
    Prediction<SE3> expected, seen;
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
    Placement<SE3> placed;
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
  const Vector3 r = CustomSensor<SE3>(wrap(user, 2)).residual(Vector3(7, 7, 7), Vector3::Zero());
  CHECK((r - Vector3(7, 7 - 2 * kPi, 7)).norm() < 1e-14);
}

namespace {

// Writes all values except one, which keeps the caller's value or is not finite.
int spoiled = -1;
double spoiled_by = 0;
std::int32_t spoil_predict(void*, const double*, const double*, double* z, double* J_pose, double* J_landmark) {
  for (int i = 0; i < 3; ++i) {
    if (i != spoiled) z[i] = 1;
  }
  std::fill_n(J_pose, 18, 0.0);
  std::fill_n(J_landmark, 9, 0.0);
  if (spoiled == 3) J_pose[17] = spoiled_by;
  if (spoiled == 4) J_landmark[8] = spoiled_by;
  if (spoiled == 5) z[0] = spoiled_by;
  return 1;
}
std::int32_t spoil_place(void*, const double*, const double*, double* landmark, double* J_pose, double* J_z) {
  for (int i = 0; i < 3; ++i) {
    if (i != spoiled) landmark[i] = 1;
  }
  std::fill_n(J_pose, 18, 0.0);
  std::fill_n(J_z, 9, 0.0);
  if (spoiled == 3) J_pose[17] = spoiled_by;
  if (spoiled == 4) J_z[8] = spoiled_by;
  if (spoiled == 5) landmark[0] = spoiled_by;
  return 1;
}

}  // namespace

TEST_CASE("custom: refusals") {
  const StereoHead head;
  Wrapped user;
  user.sensor = &head;
  CustomParameters p = wrap(user, 6);
  Prediction<SE3> seen;
  Placement<SE3> placed;
  CHECK(CustomSensor<SE3>(p).predict(kPose, kLandmark, kNoMount, seen));
  CHECK(CustomSensor<SE3>(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
  CHECK_FALSE(CustomSensor<SE3>(p).predict(kPose, kPose.translation(), kNoMount, seen));
  user.answer = 0;
  CHECK_FALSE(CustomSensor<SE3>(p).predict(kPose, kLandmark, kNoMount, seen));
  CHECK_FALSE(CustomSensor<SE3>(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
  user.answer = -1;
  const auto aborts = [](const auto& call) {
    try {
      call();
    } catch (const Error& caught) {
      return caught.code() == ErrorCode::callback;
    }
    return false;
  };
  CHECK(aborts([&] { (void)CustomSensor<SE3>(p).predict(kPose, kLandmark, kNoMount, seen); }));
  CHECK(aborts([&] { (void)CustomSensor<SE3>(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed); }));
  user.answer = 2;  // neither yes, nor no, nor stop
  CHECK(aborts([&] { (void)CustomSensor<SE3>(p).predict(kPose, kLandmark, kNoMount, seen); }));
  user.answer = 1;
  p.place = nullptr;
  CHECK_FALSE(CustomSensor<SE3>(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));

  p.predict = spoil_predict;
  p.place = spoil_place;
  spoiled = -1;
  CHECK(CustomSensor<SE3>(p).predict(kPose, kLandmark, kNoMount, seen));
  CHECK(CustomSensor<SE3>(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
  for (spoiled = 0; spoiled < 6; ++spoiled) {
    for (double value : {kNaN, kInfinity}) {
      spoiled_by = value;
      CHECK_FALSE(CustomSensor<SE3>(p).predict(kPose, kLandmark, kNoMount, seen));
      CHECK_FALSE(CustomSensor<SE3>(p).place(kPose, Vector3(5, 0, 0), kNoMount, placed));
    }
  }
}

TEST_CASE("custom: check finds a wrong Jacobian and passes a right one") {
  const StereoHead head(mounted_head());
  const StereoCamera camera(mounted_camera());
  const Bearing bearing;
  for (const SE3& T : awkward_poses(37)) {
    if (T.translation().norm() > 1e3) continue;  // the rounding of the coordinates exceeds the resolution of the check
    double worst = -1;
    Wrapped user;
    user.sensor = &head;
    Placement<SE3> ahead;
    REQUIRE(head.place(T, Vector3(12, 0.3, 0.2), kNoMount, ahead));
    REQUIRE(check_custom(CustomSensor<SE3>(wrap(user, 6)), T, ahead.landmark, worst));
    CHECK(worst < 1e-6);
    REQUIRE(camera.place(T, Vector3(300, 290, 200), kNoMount, ahead));
    user.sensor = &camera;
    REQUIRE(check_custom(CustomSensor<SE3>(wrap(user, 0)), T, ahead.landmark, worst));
    CHECK(worst < 1e-6);
    // Two values do not determine where a landmark at 12 m lies, but the check compares what they do determine.
    REQUIRE(bearing.place(T, Vector3(kPi, 0.2, 0), kNoMount, ahead));
    user.sensor = &bearing;
    user.rows = 2;
    REQUIRE(check_custom(CustomSensor<SE3>(wrap(user, 3)), T, ahead.landmark + Vector3(0.1, 0.2, 0.3), worst));
    CHECK(worst < 1e-6);
  }
  Wrapped user;
  user.sensor = &head;
  double worst = -1;
  user.wrong_landmark = 1e-3;
  REQUIRE(check_custom(CustomSensor<SE3>(wrap(user, 6)), kPose, kLandmark, worst));
  CHECK(worst > 0.9e-3);
  CHECK(worst < 1.1e-3);
  user.wrong_landmark = 0;
  user.offset = 0.1;  // relative to the first coordinate of the landmark, 10 m, and to the second one, 3 m
  REQUIRE(check_custom(CustomSensor<SE3>(wrap(user, 6)), kPose, kLandmark, worst));
  CHECK(std::abs(worst - 0.1 / 2) < 1e-3);
  user.offset = 0;
  CustomParameters blind = wrap(user, 6);
  blind.place = nullptr;
  REQUIRE(check_custom(CustomSensor<SE3>(blind), kPose, kLandmark, worst));
  CHECK(worst < 1e-6);
  const StereoHead at_origin;
  user.sensor = &at_origin;
  CHECK_FALSE(check_custom(CustomSensor<SE3>(wrap(user, 6)), kPose, kPose.translation(), worst));
}

TEST_CASE("custom: the first value that is no angle is a plain difference") {
  const struct {
    int rows;
    std::uint32_t angles;
    int plain;
  } cases[] = {{3, 0, 0}, {3, 1, 1}, {3, 3, 2}, {3, 7, -1}, {1, 1, -1}, {2, 4, 0}};
  for (const auto& c : cases) {
    CustomParameters parameters;
    parameters.rows = c.rows;
    parameters.angle_mask = c.angles;
    CHECK(CustomSensor<SE3>(parameters).plain_row() == c.plain);
    CHECK(CustomSensor<SE2>(parameters).plain_row() == c.plain);
  }
}
