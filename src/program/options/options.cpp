// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/options.hpp"

#include "program/library.hpp"

namespace cairn::program {
namespace {

OptionTable run_table(RunOptions& o) {
  OptionTable table;
  add_common_options(table, o.common);  // a log is no game of chance: the seed is checked, and not used
  add_filter_options(table, o.filter);
  table.push_back(number("--min-disparity", Range::kPositive, o.camera.min_disparity));
  table.push_back(number("--min-disparity-sigmas", Range::kNotNegative, o.camera.min_disparity_sigmas));
  table.push_back(number("--pixel-noise", Range::kPositive, o.noise.pixel));
  table.push_back(number("--velocity-noise", Range::kPositive, o.noise.velocity));
  table.push_back(number("--rate-noise", Range::kPositive, o.noise.rate));
  return table;
}

// --drive knows a third way: the wheels alone.
Option drive_option(SimulateOptions& o) {
  static_assert(CAIRN_DRIVE_TWIST == 0 && CAIRN_DRIVE_WHEELS_GYRO == 1);
  return {"--drive", true, [&o](const std::string& v) {
            constexpr std::int32_t kWheels = 2;
            std::int32_t drive = 0;
            choice("--drive", {"twist", "wheels-gyro", "wheels"}, drive).set(v);
            o.by_wheels = drive == kWheels;
            o.world.drive = o.by_wheels ? CAIRN_DRIVE_TWIST : drive;
          }};
}

Option preset_option(SimulateOptions& o) {
  return {"--preset", true, [&o](const std::string& v) {
            std::int32_t preset = 0;
            choice("--preset", {"paper", "row1", "row2", "row3", "row4"}, preset).set(v);
            std::uint32_t submap_landmarks = 0;
            check_sim(cairn_world_options_preset(&o.world, preset, &submap_landmarks));
            o.filter.submap_landmarks = submap_landmarks;
          }};
}

void add_world_options(OptionTable& table, SimulateOptions& o) {
  cairn_world_options& w = o.world;
  table.push_back(preset_option(o));
  table.push_back(choice("--course", {"circle", "laps", "traverse"}, w.course));
  table.push_back(whole("--landmarks", 1, 10000000, w.landmarks));
  table.push_back({"--closed", false, [&w](const std::string&) { w.traverse_closed = 1; }});
  table.push_back(number("--speed", Range::kPositive, w.speed));
  table.push_back(number("--laps", Range::kPositive, w.laps));
  table.push_back(number("--radius", Range::kPositive, w.radius));
  table.push_back(number("--start-azimuth", Range::kAny, w.start_azimuth));
  table.push_back(number("--round-length", Range::kPositive, w.round_length));
  table.push_back(choice("--terrain", {"rolling", "waves", "flat"}, w.terrain));
  table.push_back(number("--max-slope", Range::kNotNegative, w.max_slope));
  table.push_back(choice("--contact", {"wheels", "point"}, w.contact));
  table.push_back(drive_option(o));
  table.push_back(choice("--accelerometer", {"velocity", "acceleration"}, w.accelerometer));
  table.push_back(choice("--stick", {"per-observation", "per-frame"}, w.stick_noise));
  table.push_back(number("--velocity-noise", Range::kNotNegative, w.velocity_sigma));
  table.push_back(number("--rate-noise", Range::kNotNegative, w.rate_sigma));
  table.push_back(number("--wheel-noise", Range::kNotNegative, w.wheel_rate_sigma));
  table.push_back(number("--wheel-slip", Range::kNotNegative, w.wheel_slip_sigma));
  table.push_back(number("--range-noise", Range::kPositive, w.range_sigma));
  table.push_back(number("--azimuth-noise", Range::kPositive, w.azimuth_sigma));
  table.push_back(number("--stick-noise", Range::kPositive, w.stick_sigma));
  table.push_back(number("--near-range", Range::kPositive, w.near_range));
  table.push_back(number("--far-range", Range::kPositive, w.far_range));
  table.push_back(number("--half-azimuth", Range::kPositive, w.half_azimuth));
  table.push_back(number("--pan-scan", Range::kNotNegative, w.pan_amplitude));
  table.push_back(number("--stick-scan", Range::kNotNegative, w.stick_amplitude));
  table.push_back(number("--imu-period", Range::kPositive, w.imu_period));
  table.push_back(number("--motion-period", Range::kPositive, w.motion_period));
  table.push_back(number("--frame-period", Range::kPositive, w.frame_period));
}

}  // namespace

RunOptions parse_run_options(const std::vector<std::string>& arguments) {
  RunOptions options;
  bool has_log = false;
  parse(arguments, run_table(options), "run", [&](const std::string& word) {
    if (has_log) throw UsageError("one log at a time: '" + word + "' is a second one");
    options.log = word;
    has_log = true;
  });
  if (!options.common.help && options.log.empty()) throw UsageError("no log given (usage: cairn run LOG [options])");
  return options;
}

SimulateOptions parse_simulate_options(const std::vector<std::string>& arguments) {
  SimulateOptions options;
  check_sim(cairn_world_options_init(&options.world, sizeof options.world));
  options.filter.gate = options.filter.batch_gate = 1;  // a world has no outliers
  options.filter.submap_landmarks = kUsualSubmap;       // what a frame may hold at most says little of what it does
  OptionTable table;
  add_common_options(table, options.common);
  add_filter_options(table, options.filter);
  add_world_options(table, options);
  table.push_back(flag("--compare", options.compare));
  table.push_back(whole("--runs", 1, 100000, options.runs));
  std::string scenario;
  parse(
      arguments, table, "simulate",
      [&](const std::string& word) {
        if (!scenario.empty()) throw UsageError("one scenario at a time: '" + word + "' is a second one");
        if (word != "mars") throw UsageError("unknown scenario '" + word + "': this version knows mars and usv");
        scenario = word;
      },
      "--preset");
  if (options.common.help) return options;
  if (scenario.empty()) throw UsageError("no scenario given (usage: cairn simulate mars|usv [options])");
  if (options.compare && options.filter.submap_landmarks == 0u)
    throw UsageError("option --compare runs a single map and submaps: it can't be had with --single-map");
  return options;
}

}  // namespace cairn::program
