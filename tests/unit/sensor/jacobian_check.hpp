// SPDX-License-Identifier: BSD-3-Clause
// Compares the Jacobians of a sensor with differences on the manifold, for spatial and planar sensors.
#pragma once

#include <doctest/doctest.h>

#include "numerical.hpp"
#include "sensor/sensor.hpp"

namespace cairn::test {

template <class A, class B>
double relative(const A& analytic, const B& numerical) {
  return (analytic - numerical).norm() / (1 + numerical.norm());
}

// All Jacobians of the placement `placed` of observation z at pose T, and of the prediction `seen` of that landmark.
template <class Pose>
void check_jacobians(const Sensor<Pose>& sensor, const Pose& T, const Vector3& z, const MountError<Pose>& mount,
                     const Placement<Pose>& placed, const Prediction<Pose>& seen, double tolerance) {
  using Point = typename Pose::Point;
  using Mount = MountError<Pose>;
  constexpr int kDim = Pose::kDim, kMount = kMountErrors<Pose>;
  const auto z_of = [&](const Pose& pose, const Point& landmark, const Mount& error) {
    Prediction<Pose> p;
    REQUIRE(sensor.predict(pose, landmark, error, p));
    return p.z;
  };
  const auto minus = [&](const Vector3& a, const Vector3& b) { return sensor.residual(a, b); };
  const Point& l = placed.landmark;
  CHECK(relative(seen.J_z_pose, pose_jacobian([&](const Pose& X) { return z_of(X, l, mount); }, T, minus)) < tolerance);
  CHECK(relative(seen.J_z_landmark, jacobian<kDim>([&](const Point& x) { return z_of(T, x, mount); }, l, minus)) <
        tolerance);
  CHECK(relative(seen.J_z_mount, jacobian<kMount>([&](const Mount& x) { return z_of(T, l, x); }, mount, minus)) <
        tolerance);

  const auto landmark_of = [&](const Pose& pose, const Vector3& value, const Mount& error) {
    Placement<Pose> p;
    REQUIRE(sensor.place(pose, value, error, p));
    return p.landmark;
  };
  CHECK(relative(placed.J_landmark_pose, pose_jacobian([&](const Pose& X) { return landmark_of(X, z, mount); }, T)) <
        tolerance);
  CHECK(relative(placed.J_landmark_z, jacobian<3>([&](const Vector3& x) { return landmark_of(T, x, mount); }, z)) <
        tolerance);
  CHECK(relative(placed.J_landmark_mount,
                 jacobian<kMount>([&](const Mount& x) { return landmark_of(T, z, x); }, mount)) < tolerance);
}

}  // namespace cairn::test
