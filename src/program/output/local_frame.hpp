// SPDX-License-Identifier: BSD-3-Clause
// A frame of axes east, north and up at a place on the Earth.
#pragma once

#include <optional>

namespace cairn::program {

// A place on the ellipsoid WGS84.
struct GeodeticPoint {
  double latitude;               // degrees
  double longitude;              // degrees
  std::optional<double> height;  // above the ellipsoid, m
};

class LocalFrame {
 public:
  // An origin without a height lies on the ellipsoid, and the frame's points get no heights.
  explicit LocalFrame(const GeodeticPoint& origin);

  // `position` is east, north, up, in m. The longitude is within 180 degrees of the origin's, so that a line across the
  // 180th meridian has no jump; it can therefore lie outside -180 to 180 degrees.
  GeodeticPoint geodetic(const double position[3]) const;

 private:
  GeodeticPoint origin_;
  double sin_, cos_;  // of the origin's latitude
  // The origin in the plane of its meridian, m: distance from the Earth's axis, and distance from the equator.
  double axis_distance_, equator_distance_;
};

}  // namespace cairn::program
