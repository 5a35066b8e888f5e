// SPDX-License-Identifier: BSD-3-Clause
// Absolute position, attitude and heading: known values, and Jacobians by differences on the manifold.
#include "sensor/absolute_fix.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "numerical.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;

constexpr double kPi = 3.14159265358979323846;

// The residual is z - h: its derivative is that of h with the opposite sign. Only the first rows() of three values are
// used.
Matrix36 numerical(const AbsoluteFix<SE3>& fix, const SE3& T) {
  return -cairn::test::pose_jacobian([&](const SE3& pose) { return fix.residual(pose); }, T);
}

double scaled(const Matrix36& J, const Matrix36& expected) {
  return (J - expected).norm() / (1 + expected.norm());
}

}  // namespace

TEST_CASE("absolute fix: the residual is zero at the measured pose") {
  Random random(1);
  const Vector3 lever(0.4, -0.2, 1.1);
  for (const SE3& T : cairn::test::awkward_poses(2)) {
    const AbsoluteFix<SE3> position = AbsoluteFix<SE3>::position(T * lever, Matrix3::Identity(), lever);
    CHECK(position.residual(T).norm() <= 1e-13 * (1 + T.translation().norm()));
    CHECK(position.rows() == 3);
    const AbsoluteFix<SE3> attitude = AbsoluteFix<SE3>::attitude(T.rotation(), Matrix3::Identity());
    CHECK(attitude.residual(T).norm() <= 1e-14);
    CHECK(attitude.rows() == 3);
    CHECK(position.defined(T));
    CHECK(attitude.defined(T));
  }
  const SE3 yawed(SO3::exp(Vector3(0, 0, 0.7)), Vector3(1, 2, 3));
  CHECK(std::abs(AbsoluteFix<SE3>::heading(0.7, 0.1).residual(yawed)(0)) <= 1e-15);
}

TEST_CASE("absolute fix: the residual is the error that the covariance describes") {
  Random random(3);
  for (const double size : {0.0, 1e-8, 0.1, 1.5, 3.0}) {
    const SE3 T(SO3::exp(random.normal_vector<3>()), 20 * random.normal_vector<3>());
    const Vector3 turn = size * random.normal_vector<3>().normalized();
    const AbsoluteFix<SE3> fix = AbsoluteFix<SE3>::attitude(SO3::exp(turn) * T.rotation(), Matrix3::Identity());
    CHECK((fix.residual(T) - turn).norm() <= 1e-13 * (1 + size));
  }
  // Headings wrap.
  const SE3 back(SO3::exp(Vector3(0, 0, kPi - 0.01)), Vector3::Zero());
  CHECK(AbsoluteFix<SE3>::heading(-kPi + 0.02, 0.1).residual(back)(0) == doctest::Approx(0.03).epsilon(1e-10));
  CHECK(AbsoluteFix<SE3>::heading(7 * kPi, 0.1).residual(back)(0) == doctest::Approx(0.01).epsilon(1e-10));
}

TEST_CASE("absolute fix: Jacobians against differences") {
  Random random(4);
  const Vector3 lever(0.4, -0.2, 1.1);
  for (const SE3& T : cairn::test::awkward_poses(5)) {
    if (T.translation().norm() > 1e3) continue;  // differences lose their digits there
    const AbsoluteFix<SE3> position = AbsoluteFix<SE3>::position(random.normal_vector<3>(), Matrix3::Identity(), lever);
    CHECK(scaled(position.jacobian(T), numerical(position, T)) <= 1e-7);
    for (const double size : {0.0, 1e-8, 0.1, 1.0, 2.5}) {
      const SO3 seen = SO3::exp(size * random.normal_vector<3>().normalized()) * T.rotation();
      const AbsoluteFix<SE3> attitude = AbsoluteFix<SE3>::attitude(seen, Matrix3::Identity());
      CHECK(scaled(attitude.jacobian(T), numerical(attitude, T)) <= 1e-7);
    }
    const Vector3 a = T.rotation() * Vector3::UnitX();
    const AbsoluteFix<SE3> heading = AbsoluteFix<SE3>::heading(std::atan2(a.y(), a.x()) + 0.3, 0.1);
    if (!heading.defined(T)) continue;
    CHECK(scaled(heading.jacobian(T), numerical(heading, T)) <= 1e-6);
    CHECK(heading.jacobian(T).bottomRows<2>().isZero(0.0));
  }
}

TEST_CASE("absolute fix: no heading of a vertical axis") {
  const AbsoluteFix<SE3> fix = AbsoluteFix<SE3>::heading(0.3, 0.1);
  CHECK(fix.rows() == 1);
  CHECK(fix.covariance()(0, 0) == doctest::Approx(0.01));
  for (const double degrees : {0.0, 30.0, 89.9, -89.9, 90.1}) {
    const SE3 T(SO3::exp(Vector3(0, 0, 1.1)) * SO3::exp(Vector3(0, degrees * kPi / 180, 0)), Vector3::Zero());
    CHECK(fix.defined(T));
    CHECK(fix.residual(T).allFinite());
  }
  for (const double degrees : {89.97, 90.0, -90.0, 90.03}) {
    const SE3 T(SO3::exp(Vector3(0, 0, 1.1)) * SO3::exp(Vector3(0, degrees * kPi / 180, 0)), Vector3::Zero());
    CHECK(!fix.defined(T));
  }
}

TEST_CASE("absolute fix: in the plane, values and Jacobians") {
  Random random(6);
  const Vector2 lever(0.4, -0.2);
  for (const SE2& T : cairn::test::awkward_poses<SE2>(7)) {
    if (T.translation().norm() > 1e3) continue;  // differences lose their digits there
    const double yaw = T.rotation().angle();
    const AbsoluteFix<SE2> there = AbsoluteFix<SE2>::position(T * lever, Matrix2::Identity(), lever);
    CHECK(there.rows() == 2);
    CHECK(there.residual(T).norm() <= 1e-13 * (1 + T.translation().norm()));
    const AbsoluteFix<SE2> fixes[] = {AbsoluteFix<SE2>::position(random.normal_vector<2>(), Matrix2::Identity(), lever),
                                      AbsoluteFix<SE2>::attitude(SO2::from_angle(yaw + 0.3), Vector1(1.0)),
                                      AbsoluteFix<SE2>::heading(yaw - 0.4, 0.1)};
    for (const AbsoluteFix<SE2>& fix : fixes) {
      CHECK(fix.defined(T));
      const auto numerical = cairn::test::pose_jacobian([&](const SE2& pose) { return fix.residual(pose); }, T);
      CHECK((fix.jacobian(T) + numerical).norm() <= 1e-7 * (1 + numerical.norm()));
      CHECK(fix.jacobian(T).bottomRows(3 - fix.rows()).isZero(0.0));
    }
    CHECK(fixes[1].rows() == 1);
    CHECK(fixes[1].residual(T)(0) == doctest::Approx(0.3).epsilon(1e-12));
    CHECK(fixes[2].residual(T)(0) == doctest::Approx(-0.4).epsilon(1e-12));
  }
}
