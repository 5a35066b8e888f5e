// SPDX-License-Identifier: BSD-3-Clause
// A GeoJSON file (RFC 7946) of a map at a place on the Earth.
#pragma once

#include <cairn/cairn.h>

#include <string>
#include <vector>

#include "program/output/local_frame.hpp"
#include "program/output/output_file.hpp"

namespace cairn::program {

class GeoJson {
 public:
  // The map's axes x, y, z point east, north and up at `origin`. Throws UsageError.
  GeoJson(const std::string& folder, const std::string& name, const GeodeticPoint& origin);

  // A point and, unless its position is known exactly, the horizontal ellipse that contains it with 95 %.
  void landmark(const cairn_landmark& landmark);
  // A line through the poses. A line has at least two points: fewer poses add nothing.
  void line(const char* kind, const std::vector<cairn_pose>& poses);
  void close();

 private:
  void feature(const std::string& geometry, const std::string& coordinates, const std::string& properties);
  std::string coordinates(double east, double north, double up) const;

  LocalFrame frame_;
  OutputFile file_;
  bool begun_ = false;  // a feature has been written
};

}  // namespace cairn::program
