// SPDX-License-Identifier: BSD-3-Clause
// Contact of a rover with the ground, and wheel kinematics.
#include "sim/rover.hpp"

#include <cmath>

#include "core/error.hpp"

namespace cairn::sim {

Stance stand_on_point(const Terrain& terrain, const Place& place) {
  const Vector2 slope = terrain.slope(place.x, place.y);
  const Vector3 z = Vector3(-slope.x(), -slope.y(), 1).normalized();
  const double cx = std::cos(place.heading), cy = std::sin(place.heading);
  const Vector3 x = Vector3(cx, cy, slope.x() * cx + slope.y() * cy).normalized();
  Matrix3 R;
  R << x, z.cross(x), z;
  Stance stance;
  stance.T_map_body = SE3(SO3::from_matrix(R), Vector3(place.x, place.y, terrain.height(place.x, place.y)));
  return stance;
}

// The wheels touch the ground at T (a, b, s w) with a = +-wheelbase/2, b = +-track/2. The rockers with their
// differential move the wheels up and down by s w, with s = +1, -1, -1, +1. The unknowns are height, pitch, roll and w.
// The distances of the four wheels from the ground, combined with the same four patterns of signs, give the correction
// of each unknown. The correction ignores the slope of the ground where the wheels shift sideways, which is a few per
// cent; the iteration converges nevertheless.
Stance stand_on_wheels(const Terrain& terrain, const Place& place, double track, double wheelbase) {
  constexpr double kSignA[4] = {1, 1, -1, -1}, kSignB[4] = {1, -1, 1, -1}, kSignW[4] = {1, -1, -1, 1};
  constexpr double kTolerance = 1e-11;  // m
  constexpr int kMaxIterations = 60;
  const double ch = std::cos(place.heading), sh = std::sin(place.heading);
  const Vector2 slope = terrain.slope(place.x, place.y);
  double pitch_sine = 0, roll_sine = 0,
         w = 0;  // sines of the angles of the x axis and of the y axis against the horizontal
  {
    const double along = slope.x() * ch + slope.y() * sh, across = -slope.x() * sh + slope.y() * ch;
    pitch_sine = along / std::sqrt(1 + along * along);
    roll_sine = across / std::sqrt(1 + along * along + across * across);
  }
  double height = terrain.height(place.x, place.y);
  Stance stance;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    // The x axis rises by pitch_sine, the y axis by roll_sine: R = Rz(heading) Ry(-pitch) Rx(roll).
    const double cp = std::sqrt(1 - pitch_sine * pitch_sine);
    const double sr = roll_sine / cp, cr = std::sqrt(1 - sr * sr);
    Matrix3 R;
    R.col(0) << ch * cp, sh * cp, pitch_sine;
    R.col(1) << -sh * cr - ch * pitch_sine * sr, ch * cr - sh * pitch_sine * sr, roll_sine;
    R.col(2) = R.col(0).cross(R.col(1));
    double mean = 0, by_pitch = 0, by_roll = 0, by_w = 0, worst = 0;
    for (int i = 0; i < 4; ++i) {
      const Vector3 arm(kSignA[i] * wheelbase / 2, kSignB[i] * track / 2, kSignW[i] * w);
      Vector3& contact = stance.contacts[i];
      contact = Vector3(place.x, place.y, height) + R * arm;
      const double gap = terrain.height(contact.x(), contact.y()) - contact.z();
      mean += gap / 4;
      by_pitch += kSignA[i] * gap / 4;
      by_roll += kSignB[i] * gap / 4;
      by_w += kSignW[i] * gap / 4;
      worst = std::max(worst, std::abs(gap));
    }
    if (!(worst < 1e6) || !(cp > 0.1) || !(cr > 0.1)) break;
    if (worst < kTolerance) {
      stance.T_map_body = SE3(SO3::from_matrix(R), Vector3(place.x, place.y, height));
      return stance;
    }
    height += mean;
    pitch_sine += by_pitch / (wheelbase / 2);
    roll_sine += by_roll / (track / 2);
    w += by_w / R(2, 2);
  }
  throw Error(ErrorCode::numerical,
              "the rover cannot stand on four wheels at (%g, %g): the ground is too rough; use longer waves", place.x,
              place.y);
}

Vector2 wheel_rates(double velocity_x, double rate_z, double radius, double track) {
  return Vector2(velocity_x - rate_z * track / 2, velocity_x + rate_z * track / 2) / radius;
}

}  // namespace cairn::sim
