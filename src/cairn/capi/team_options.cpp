// SPDX-License-Identifier: BSD-3-Clause
// Options of teams.
#include "capi/convert.hpp"
#include "capi/team_handle.hpp"
#include "slam/systematic_errors.hpp"

namespace cairn {
namespace capi {
namespace {

cairn_team_options default_options() {
  const MailboxOptions d;
  cairn_team_options options = {};
  options.struct_size = sizeof options;
  options.mode = CAIRN_TEAM_JOINT;
  options.max_vehicles = static_cast<std::uint32_t>(d.max_vehicles);
  options.max_lag = d.max_lag;
  options.time_tolerance = d.time_tolerance;
  options.max_waiting = static_cast<std::uint32_t>(d.max_waiting);
  options.history = static_cast<std::uint32_t>(d.history);
  options.max_jump = d.max_jump;
  return options;
}

TeamMode read_mode(std::int32_t mode) {
  switch (mode) {
    case CAIRN_TEAM_MONO:
      return TeamMode::mono;
    case CAIRN_TEAM_EO_DIAGONAL:
      return TeamMode::eo_diagonal;
    case CAIRN_TEAM_EO_FULL:
      return TeamMode::eo_full;
    case CAIRN_TEAM_JOINT:
      return TeamMode::joint;
    case CAIRN_TEAM_SUBMAPS:
      return TeamMode::submaps;
    default:
      throw Error(ErrorCode::argument, "options.mode is %d, none of the CAIRN_TEAM_ constants", mode);
  }
}

}  // namespace

cairn_team_options read_team_options(const cairn_team_options* user) {
  return read_options(user, default_options(), "options");
}

TeamOptions team_options(const cairn_team_options& o, const cairn_filter_options* filter,
                         const cairn_range_bearing* radar) {
  TeamOptions options;
  options.mode = read_mode(o.mode);
  if (o.vehicle == CAIRN_ID_NONE) throw Error(ErrorCode::argument, "options.vehicle is CAIRN_ID_NONE");
  read_bool(o.baseline, "options.baseline");
  check_range(o.max_vehicles, 1, 256, "options.max_vehicles");
  check_positive(o.max_lag, "options.max_lag");
  check_not_negative(o.time_tolerance, "options.time_tolerance");
  check_range(o.max_waiting, 1, 1000000, "options.max_waiting");
  check_range(o.history, 1, 1000000, "options.history");
  check_positive(o.max_jump, "options.max_jump");
  options.mail.vehicle = o.vehicle;
  options.mail.max_vehicles = o.max_vehicles;
  options.mail.max_lag = o.max_lag;
  options.mail.time_tolerance = o.time_tolerance;
  options.mail.max_waiting = o.max_waiting;
  options.mail.history = o.history;
  options.mail.max_jump = o.max_jump;
  check_pointer(filter, "filter");  // read_filter_options calls it "options"
  const auto filter_options = read_filter_options(filter);
  const auto* planar = std::get_if<FilterOptions<SE2>>(&filter_options);
  if (planar == nullptr)
    throw Error(ErrorCode::argument, "filter: its vehicle is spatial; a team's is CAIRN_VEHICLE_PLANAR");
  if (planar->trajectory_poses != 0)
    throw Error(ErrorCode::argument, "filter.trajectory_poses must be 0 for a team, and is %td",
                planar->trajectory_poses);
  options.filter = *planar;
  if (SystematicErrors(planar->systematic, false).any() || planar->max_sensor_errors > 0)
    throw Error(
        ErrorCode::argument,
        "filter: the filters of a team estimate no systematic errors; set velocity_bias_sigma, rate_bias_sigma, "
        "wheel_scale_sigma and max_sensor_errors to 0");
  options.filter.max_sensors = 2;
  options.radar = read_range_bearing(radar);
  const bool extended = options.mode == TeamMode::eo_diagonal || options.mode == TeamMode::eo_full;
  const SE2& mount = options.radar.T_body_sensor;
  if (extended && (!mount.translation().isZero(0.0) || mount.rotation().angle() != 0.0))
    throw Error(ErrorCode::argument, "radar.T_body_sensor: extended observations need the radar at the body's origin");
  return options;
}

}  // namespace capi
}  // namespace cairn

extern "C" cairn_status cairn_team_options_init(cairn_team_options* options, size_t struct_size, cairn_error* error) {
  using namespace cairn::capi;
  return guard(error, [&] { init_options(options, struct_size, default_options(), "options"); });
}
