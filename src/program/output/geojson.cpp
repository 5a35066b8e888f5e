// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/geojson.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cairn::program {
namespace {

constexpr int kEllipseCorners = 32;
const double kScale95 = std::sqrt(-2 * std::log(0.05));  // chi-square with two degrees of freedom

std::string number(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string join(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ",") + part;
  return "[" + all + "]";
}

std::string sigma(const char* axis, double variance) {
  return std::string(",\"sigma_") + axis + "_m\":" + number("%.9g", std::sqrt(std::max(variance, 0.0)));
}

}  // namespace

GeoJson::GeoJson(const std::string& folder, const std::string& name, const GeodeticPoint& origin)
    : frame_(origin), file_(folder, name) {
  file_.text("{\"type\":\"FeatureCollection\",\"features\":[");
}

// One feature a line. Angles have nine decimals, which are 0.1 mm.
std::string GeoJson::coordinates(double east, double north, double up) const {
  const double position[] = {east, north, up};
  const GeodeticPoint point = frame_.geodetic(position);
  std::vector<std::string> numbers = {number("%.9f", point.longitude), number("%.9f", point.latitude)};
  if (point.height) numbers.push_back(number("%.4f", *point.height));
  return join(numbers);
}

void GeoJson::feature(const std::string& geometry, const std::string& coordinates, const std::string& properties) {
  file_.text(std::string(begun_ ? ",\n" : "\n") + "{\"type\":\"Feature\",\"properties\":{" + properties +
             "},\"geometry\":{\"type\":\"" + geometry + "\",\"coordinates\":" + coordinates + "}}");
  begun_ = true;
}

void GeoJson::landmark(const cairn_landmark& landmark) {
  const double *p = landmark.position, *c = landmark.covariance;
  // Not "id": GDAL takes a property of this name for the feature's own number, and two features have it.
  const std::string id = ",\"landmark_id\":" + std::to_string(landmark.id);
  std::vector<std::string> covariance;
  for (int i = 0; i < 9; ++i) covariance.push_back(number("%.9g", c[i]));
  feature("Point", coordinates(p[0], p[1], p[2]),
          "\"kind\":\"landmark\"" + id + ",\"observations\":" + std::to_string(landmark.observations) +
              sigma("east", c[0]) + sigma("north", c[4]) + sigma("up", c[8]) +
              ",\"covariance_m2\":" + join(covariance));

  // The Cholesky factor of the horizontal covariance maps the unit circle to the ellipse.
  const double east = std::sqrt(std::max(c[0], 0.0));
  if (east == 0) return;
  const double mixed = c[1] / east;
  const double north = std::sqrt(std::max(c[4] - mixed * mixed, 0.0));
  if (north == 0) return;
  std::vector<std::string> corners;
  for (int i = 0; i < kEllipseCorners; ++i) {  // counterclockwise, as RFC 7946 wants an outer ring
    const double angle = 2 * 3.14159265358979323846 * i / kEllipseCorners;
    const double u = kScale95 * std::cos(angle), v = kScale95 * std::sin(angle);
    corners.push_back(coordinates(p[0] + east * u, p[1] + mixed * u + north * v, p[2]));
  }
  corners.push_back(corners.front());
  feature("Polygon", "[" + join(corners) + "]", "\"kind\":\"ellipse_95\"" + id);
}

void GeoJson::line(const char* kind, const std::vector<cairn_pose>& poses) {
  if (poses.size() < 2) return;
  std::vector<std::string> points;
  for (const cairn_pose& pose : poses) {
    points.push_back(coordinates(pose.position[0], pose.position[1], pose.position[2]));
  }
  feature("LineString", join(points), std::string("\"kind\":\"") + kind + "\"");
}

void GeoJson::close() {
  file_.text("\n]}\n");
  file_.close();
}

}  // namespace cairn::program
