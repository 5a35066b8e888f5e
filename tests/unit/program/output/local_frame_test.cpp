// SPDX-License-Identifier: BSD-3-Clause
// Places in a frame east, north, up as latitude, longitude and height, against published and independent values.
#include "program/output/local_frame.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace cairn::program {
namespace {

constexpr double kMetre = 1 / 111320.0;  // of latitude, in degrees

struct Case {
  double origin[3];    // degrees, degrees, m
  double position[3];  // east, north, up, m
  double point[3];     // degrees, degrees, m
};

void check_case(const Case& c, double tolerance) {
  const LocalFrame frame({c.origin[0], c.origin[1], c.origin[2]});
  const GeodeticPoint point = frame.geodetic(c.position);
  CAPTURE(c.origin[0]);
  CHECK(std::abs(point.latitude - c.point[0]) < tolerance * kMetre);
  CHECK(std::abs(point.longitude - c.point[1]) * std::cos(c.point[0] * 3.14159265358979323846 / 180) <
        tolerance * kMetre);
  REQUIRE(point.height);
  CHECK(std::abs(*point.height - c.point[2]) < tolerance);
}

}  // namespace

// The example of "Geographic/topocentric conversions" (EPSG method 9837) in IOGP Geomatics Guidance Note 7, part 2. Its
// numbers are rounded to mm.
TEST_CASE("a point of the guidance note of EPSG") {
  check_case({{55, 5, 200},
              {-189013.869, -128642.040, -4220.171},
              {53 + 48 / 60.0 + 33.82 / 3600, 2 + 7 / 60.0 + 46.38 / 3600, 73.0}},
             1e-3);
}

// From pyproj 3.7.2 with PROJ 9.5.1, as x, y, z of
//   +proj=pipeline +step +inv +proj=topocentric +ellps=WGS84 +lat_0=... +lon_0=... +h_0=...
//   +step +inv +proj=cart +ellps=WGS84 +step +proj=unitconvert +xy_in=rad +xy_out=deg
TEST_CASE("points that PROJ computed") {
  const Case cases[] = {
      {{-33.8568, 151.2153, 20}, {1234.5, -678.9, 45.6}, {-33.862919850161, 151.228641060538, 65.755606}},
      {{0, 0, 0}, {100, -200, 3}, {-0.001808738097, 0.000898314862, 3.003941}},
      {{78.22, 15.65, -3}, {-40000, 60000, 2500}, {78.751546213994, 13.814364707551, 2903.235367}},
      {{89.9, 30, 1500}, {2000, 9000, 10}, {89.973571660228, 72.638647510634, 1516.639477}},
      {{90, 0, 0}, {300, 400, 5}, {89.995523486491, 143.130102354129, 5.019532}},
      {{-12.5, -77, 4000}, {1e5, 2e5, -3000}, {-10.691544901788, -76.086588246911, 4937.493086}},
  };
  for (const Case& c : cases) check_case(c, 2e-6);
}

// PROJ's longitude of this point is 179.993781698909.
TEST_CASE("no jump at the 180th meridian") {
  check_case({{48.137, -179.9995, 0}, {-500, 300, -7.25}, {48.139697817968, 179.993781698909 - 360, -7.223375}}, 2e-6);
}

TEST_CASE("an origin without a height gives no heights") {
  const double position[] = {100, -200, 3};
  const GeodeticPoint point = LocalFrame({0, 0, std::nullopt}).geodetic(position);
  CHECK(!point.height);
  CHECK(point.latitude == LocalFrame({0, 0, 0.0}).geodetic(position).latitude);
}

TEST_CASE("the origin itself") {
  const double position[] = {0, 0, 0};
  for (const double latitude : {-90.0, -47.3, 0.0, 1e-8, 66.0, 90.0}) {
    const GeodeticPoint point = LocalFrame({latitude, 12.5, 430.0}).geodetic(position);
    CHECK(point.latitude == doctest::Approx(latitude).epsilon(1e-14));
    CHECK(*point.height == doctest::Approx(430).epsilon(1e-10));
    if (std::abs(latitude) < 90) CHECK(point.longitude == 12.5);
  }
}

}  // namespace cairn::program
