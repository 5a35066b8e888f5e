// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/local_frame.hpp"

#include <cmath>

namespace cairn::program {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kEquatorRadius = 6378137;         // m
constexpr double kFlattening = 1 / 298.257223563;  // both as WGS84 defines them
constexpr double kPolarRadius = kEquatorRadius * (1 - kFlattening);
constexpr double kSquare = kFlattening * (2 - kFlattening);                          // of the first eccentricity
constexpr double kSecondSquare = kSquare / ((1 - kFlattening) * (1 - kFlattening));  // of the second eccentricity

// Radius of curvature of the ellipsoid across the meridian.
double normal_radius(double sin_latitude) {
  return kEquatorRadius / std::sqrt(1 - kSquare * sin_latitude * sin_latitude);
}

}  // namespace

LocalFrame::LocalFrame(const GeodeticPoint& origin)
    : origin_(origin), sin_(std::sin(origin.latitude * kDegree)), cos_(std::cos(origin.latitude * kDegree)) {
  const double height = origin.height.value_or(0), radius = normal_radius(sin_);
  axis_distance_ = (radius + height) * cos_;
  equator_distance_ = (radius * (1 - kSquare) + height) * sin_;
}

// East, north, up to geocentric coordinates, whose first axis points to the origin's meridian; then to latitude and
// height by Bowring's iteration (Survey Review 23, 1976), which converges in three steps.
GeodeticPoint LocalFrame::geodetic(const double position[3]) const {
  const double east = position[0], north = position[1], up = position[2];
  const double x = axis_distance_ + cos_ * up - sin_ * north;
  const double z = equator_distance_ + sin_ * up + cos_ * north;
  const double from_axis = std::hypot(x, east);
  double reduced = std::atan2(kEquatorRadius * z, kPolarRadius * from_axis), latitude = 0;
  for (int step = 0; step < 3; ++step) {
    latitude = std::atan2(z + kSecondSquare * kPolarRadius * std::pow(std::sin(reduced), 3),
                          from_axis - kSquare * kEquatorRadius * std::pow(std::cos(reduced), 3));
    reduced = std::atan2((1 - kFlattening) * std::sin(latitude), std::cos(latitude));
  }
  GeodeticPoint point{latitude / kDegree, origin_.longitude + std::atan2(east, x) / kDegree, std::nullopt};
  if (origin_.height) {
    const double sin = std::sin(latitude);
    point.height = from_axis * std::cos(latitude) + z * sin - kEquatorRadius * std::sqrt(1 - kSquare * sin * sin);
  }
  return point;
}

}  // namespace cairn::program
