// SPDX-License-Identifier: BSD-3-Clause
// Defaults and checks of the options of a fleet.
#include "sim/fleet_options.hpp"

#include "geometry/angle.hpp"
#include "sim/checks.hpp"

namespace cairn::sim {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kMostSteps = 1e9;

void check_square(const cairn_fleet_options& o) {
  capi::check_positive(o.area, "options.area");
  capi::check_positive(o.separation, "options.separation");
  if (o.separation > o.area / 2)
    throw Error(ErrorCode::argument, "options.separation = %g exceeds half of options.area = %g; reduce the separation",
                o.separation, o.area);
  capi::check_positive(o.course_length, "options.course_length");
  if (o.course_length > o.area)
    throw Error(ErrorCode::argument, "options.course_length = %g exceeds options.area = %g; shorten the course",
                o.course_length, o.area);
}

void check_times(const cairn_fleet_options& o) {
  capi::check_positive(o.duration, "options.duration");
  capi::check_positive(o.period, "options.period");
  if (o.period > o.duration)
    throw Error(ErrorCode::argument, "options.period = %g exceeds options.duration = %g; scan more often", o.period,
                o.duration);
  if (!(o.duration / o.period < kMostSteps))
    throw Error(ErrorCode::argument, "options.duration = %g holds %g of options.period; scan less often", o.duration,
                o.duration / o.period);
}

void check_noise(const cairn_fleet_options& o) {
  capi::check_positive(o.radar_range, "options.radar_range");
  capi::check_not_negative(o.range_sigma, "options.range_sigma");
  capi::check_not_negative(o.bearing_sigma, "options.bearing_sigma");
  capi::check_not_negative(o.speed_sigma, "options.speed_sigma");
  capi::check_not_negative(o.rate_sigma, "options.rate_sigma");
}

void check_coast(const cairn_fleet_options& o) {
  capi::check_positive(o.coast_distance, "options.coast_distance");
  capi::check_range(o.coast_distance, 0, 0.5, "options.coast_distance");
  capi::check_range(o.coast_relief, 0, 0.5, "options.coast_relief");
  if (o.coast_distance + o.coast_relief > 0.5 * (1 + 1e-12))
    throw Error(ErrorCode::argument,
                "options.coast_distance = %g and options.coast_relief = %g lead out of the square; keep their sum at "
                "0.5 or less",
                o.coast_distance, o.coast_relief);
  capi::check_range(o.coast_strip, 0, 0.5, "options.coast_strip");
}

}  // namespace

cairn_fleet_options default_fleet_options() {
  cairn_fleet_options o = {};
  o.struct_size = sizeof o;
  o.layout = CAIRN_FLEET_UNIFORM;
  o.seed = 1;
  o.vehicles = 2;
  o.features = 10;
  o.area = 10000;
  o.separation = 1500;
  o.course_length = 1700;
  o.duration = 1500;
  o.period = 5;
  o.radar_range = 5000;
  o.range_sigma = 30;
  o.bearing_sigma = 0.3 * kDegree;
  o.speed_sigma = 0.2;
  o.rate_sigma = 0.1 * kDegree;
  o.coast_distance = 0.35;
  o.coast_relief = 0.05;
  o.coast_strip = 0.03;
  return o;
}

cairn_fleet_options read_fleet_options(const cairn_fleet_options* user) {
  const cairn_fleet_options o = capi::read_options(user, default_fleet_options(), "options");
  check_choice(o.layout, CAIRN_FLEET_COAST, "layout", "CAIRN_FLEET_");
  capi::check_range(o.vehicles, 1, kMostBoats, "options.vehicles");
  capi::check_range(o.features, 1, kMostFeatures, "options.features");
  check_square(o);
  check_times(o);
  check_noise(o);
  check_coast(o);
  return o;
}

std::size_t steps_of(const cairn_fleet_options& o) {
  // The factor compensates rounding: a duration of n periods has n + 1 steps even if the quotient is just below n.
  return static_cast<std::size_t>(o.duration / o.period * (1 + 1e-12)) + 1;
}

}  // namespace cairn::sim
