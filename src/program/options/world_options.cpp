// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/world_options.hpp"

#include "program/library.hpp"
#include "program/options/parse.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

using options::kFinite;
using options::kNotNegative;
using options::kPositive;

// The words of --drive; the third one is no constant of the library.
Option drive_option(SimulateOptions& o) {
  static_assert(CAIRN_DRIVE_TWIST == 0 && CAIRN_DRIVE_WHEELS_GYRO == 1);
  return custom(
      {"--drive", "NAME",
       "The measurements that move the filter: `twist` (the default), velocity and rate of the IMU; "
       "`wheels-gyro`, the forward velocity of the wheels and the rate of the gyro; `wheels`, only the wheels.",
       ""},
      [&o](const std::string& v) {
        constexpr std::int32_t kWheels = 2;
        std::int32_t drive = 0;
        choice({"--drive", "NAME", "", ""}, {"twist", "wheels-gyro", "wheels"}, drive).set(v);
        o.by_wheels = drive == kWheels;
        o.world.drive = o.by_wheels ? CAIRN_DRIVE_TWIST : drive;
      });
}

Option preset_option(SimulateOptions& o) {
  return custom(
      {"--preset", "NAME",
       "A world with known figures: `paper` (the default: Table 1 as printed), `row1`, `row2`, `row3` or "
       "`row4`. It sets `--submap-landmarks` too.",
       "The rows drive over z = sin(x/15) + 0.8 cos(y/12) on one point of contact, with one motion each 0.2 s. "
       "Their noise is 0.002 m/s and 0.02 degrees/s; 0.05 and 0.2; 0.05 and 0.2; 0.2 and 1. In 400 s they "
       "drive one round, one, two and two. Submaps hold 40 landmarks, those of rows 3 and 4 hold 20. All "
       "other options are applied after the preset, wherever it stands."},
      [&o](const std::string& v) {
        std::int32_t preset = 0;
        choice({"--preset", "NAME", "", ""}, {"paper", "row1", "row2", "row3", "row4"}, preset).set(v);
        std::uint32_t submap_landmarks = 0;
        check_sim(cairn_world_options_preset(&o.world, preset, &submap_landmarks, nullptr));
        o.filter.submap_landmarks = submap_landmarks;
      });
}

OptionGroup runs_group(SimulateOptions& o) {
  OptionGroup group{"runs", "cairn simulate mars, runs", {}};
  group.options = {
      flag(
          {"--compare", "",
           "Run standard EKF-SLAM and submaps through the same world, and print Table 2 of the Mars paper with the "
           "measured figures beside the printed ones.",
           "Standard EKF-SLAM is a single map, the standard error and one linearisation of an update. The paper counts "
           "700 and 440 features in a world of 200. Measured are the landmarks in the filter that processes the "
           "frames, "
           "the sum of their squares over the steps, and the time. With `--summary json` the object holds the figures "
           "of both, under `standard` and `submaps`. With `--output` they are written into folders of these names."},
          o.compare),
      whole(
          {"--runs", "N",
           "Run N worlds, with seeds from `--seed` on, and print the mean of each figure. Default: "
           "{default}.",
           "The standard deviation over the runs is printed under the figure's name with `_std`. Files are written for "
           "the first run."},
          1, 100000, o.runs),
      preset_option(o),
  };
  return group;
}

OptionGroup scene_group(SimulateOptions& o) {
  cairn_world_options& w = o.world;
  OptionGroup group{"world", "cairn simulate mars, world and rover", {}};
  group.options = {
      choice({"--course", "NAME",
              "`circle` (the default), `laps` (a closed curve, driven twice) or `traverse` (a chain of circles, each "
              "driven 1.25 times round).",
              "The radius of the circle is 102 m for 200 landmarks, and grows in proportion to their number."},
             {"circle", "laps", "traverse"}, w.course),
      custom({"--closed", "", "Bend the traverse into a ring that ends where it began.", ""},
             [&w](const std::string&) { w.traverse_closed = 1; }),
      whole({"--landmarks", "N", "Number of landmarks, at most {upper}. Default: {default}.",
             "They stand within 25 m of the course, one on 160 square metres. Laps and traverse get as long as their "
             "number asks for."},
            1, 10000000, w.landmarks),
      number({"--speed", "M_S", "Speed over the plane, m/s. Default: {default}.", ""}, kPositive, w.speed),
      number({"--laps", "N", "Number of rounds. Default: 1 of a circle, 2 of laps.", ""}, kPositive, w.laps),
      number({"--radius", "M", "Radius of the circle. Default: by the number of landmarks.", ""}, kPositive, w.radius),
      number({"--start-azimuth", "RAD", "Where on the circle the rover starts. Default: {default} rad.", ""}, kFinite,
             w.start_azimuth),
      number({"--round-length", "M", "Length of the traverse's circles. Default: {default} m.", ""}, kPositive,
             w.round_length),
      choice({"--terrain", "NAME", "`rolling` (the default: hills that the seed decides), `waves` or `flat`.", ""},
             {"rolling", "waves", "flat"}, w.terrain),
      number({"--max-slope", "RAD", "Steepest slope of the rolling ground. Default: {default_degrees}.", ""},
             kNotNegative, w.max_slope),
      choice({"--contact", "NAME", "The rover stands on four `wheels` (the default) or on one `point`.", ""},
             {"wheels", "point"}, w.contact),
      drive_option(o),
  };
  return group;
}

OptionGroup noise_group(cairn_world_options& w) {
  OptionGroup group{"noise", "cairn simulate mars, noise and field of view", {}};
  group.options = {
      choice({"--accelerometer", "NAME",
              "The accelerometer has white noise of the `velocity` (the default) or of the `acceleration`.",
              "The noise of the velocity is in m/s, as in the paper's table. The noise of the acceleration, in m/s^2, "
              "lets the velocity drift."},
             {"velocity", "acceleration"}, w.accelerometer),
      choice({"--stick", "NAME",
              "The noise of the stick angle is independent `per-observation` (the default), or one error `per-frame`.",
              ""},
             {"per-observation", "per-frame"}, w.stick_noise),
      number(
          {"--velocity-noise", "X", "Standard deviation of the velocity of an IMU sample. Default: {default} m/s.", ""},
          kNotNegative, w.velocity_sigma),
      number({"--rate-noise", "X",
              "Standard deviation of the rate of an IMU sample, rad/s. Default: {default_degrees} per second.", ""},
             kNotNegative, w.rate_sigma),
      number({"--wheel-noise", "X", "Standard deviation of a wheel's rate. Default: {default} rad/s.", ""},
             kNotNegative, w.wheel_rate_sigma),
      number({"--wheel-slip", "X",
              "Standard deviation of a wheel's rate in proportion to the rate. Default: {default}.", ""},
             kNotNegative, w.wheel_slip_sigma),
      number(
          {"--lateral-noise", "X",
           "Standard deviation of the velocity to the side, which wheels do not measure. Default: {default} m/s.",
           "One value for each motion. The rover of a simulated world does not slip: the filter is told this noise."},
          kNotNegative, w.lateral_sigma),
      number({"--vertical-noise", "X", "The same of the velocity upwards. Default: {default} m/s.", ""}, kNotNegative,
             w.vertical_sigma),
      number({"--range-noise", "X", "Standard deviation of an observed range. Default: {default} m.", ""}, kPositive,
             w.range_sigma),
      number(
          {"--azimuth-noise", "X", "Standard deviation of an observed azimuth, rad. Default: {default_degrees}.", ""},
          kPositive, w.azimuth_sigma),
      number(
          {"--stick-noise", "X", "Standard deviation of an observed stick angle, rad. Default: {default_degrees}.", ""},
          kPositive, w.stick_sigma),
      number({"--near-range", "M", "Landmarks nearer than this are not seen. Default: {default} m.", ""}, kPositive,
             w.near_range),
      number({"--far-range", "M", "Landmarks farther than this are not seen. Default: {default} m.", ""}, kPositive,
             w.far_range),
      number({"--half-azimuth", "RAD", "Half of the horizontal field of view. Default: {default_degrees}.", ""},
             kPositive, w.half_azimuth),
      number({"--pan-scan", "RAD", "How far the head pans to both sides. Default: 0, it looks ahead.", ""},
             kNotNegative, w.pan_amplitude),
      number({"--stick-scan", "RAD", "How far the stick moves to both sides. Default: 0, it rests.", ""}, kNotNegative,
             w.stick_amplitude),
      number({"--imu-period", "S", "Time between samples of the IMU. Default: {default} s.", ""}, kPositive,
             w.imu_period),
      number(
          {"--motion-period", "S",
           "Time between motions that move the filter; each is composed of samples of the IMU. Default: {default} s.",
           ""},
          kPositive, w.motion_period),
      number({"--frame-period", "S", "Time between frames. Default: {default} s.", ""}, kPositive, w.frame_period),
  };
  return group;
}

OptionGroup faults_group(cairn_world_options& w) {
  OptionGroup group{"faults", "cairn simulate mars, systematic errors of the rover", {}};
  group.options = {
      components({"--true-velocity-bias", "M_S[,M_S,M_S]",
                  "Error of the measured velocity: one number, or one each for forward, left and up. Default: 0.",
                  "The filter is not told of these errors. `--velocity-bias` and similar make it estimate them."},
                 kFinite, 3, w.velocity_bias),
      components({"--true-rate-bias", "RAD_S[,RAD_S,RAD_S]", "Error of the measured turning rate. Default: 0.", ""},
                 kFinite, 3, w.rate_bias),
      components({"--true-wheel-scale", "SCALE[,SCALE]",
                  "A wheel turns at its measured rate times 1 plus this: one number, or one each for the left and the "
                  "right wheels. Default: 0.",
                  ""},
                 kFinite, 2, w.wheel_scale),
      components({"--true-mount-turn", "RAD,RAD,RAD",
                  "Rotation vector by which the head is turned against the body. Default: 0.", ""},
                 kFinite, 3, w.mount_turn),
      components({"--true-mount-shift", "M,M,M", "By which the head is shifted against the body. Default: 0.", ""},
                 kFinite, 3, w.mount_shift),
      components({"--true-offset", "M,RAD,RAD", "Error of observed range, azimuth and elevation. Default: 0.", ""},
                 kFinite, 3, w.value_offset),
  };
  return group;
}

}  // namespace

SimulateOptions default_simulate_options() {
  SimulateOptions options;
  check_sim(cairn_world_options_init(&options.world, sizeof options.world, nullptr));
  options.filter.gate_probability = options.filter.batch_gate_probability = 1;  // a world has no outliers
  // The largest possible frame is much larger than a usual one.
  options.filter.submap_landmarks = kUsualSubmap;
  return options;
}

std::vector<OptionGroup> world_options(SimulateOptions& o) {
  return {runs_group(o), scene_group(o), noise_group(o.world), faults_group(o.world)};
}

SimulateOptions parse_simulate_options(const std::vector<std::string>& arguments) {
  SimulateOptions options = default_simulate_options();
  std::vector<OptionGroup> groups = world_options(options);
  groups.push_back(common_options(options.common));
  groups.push_back(filter_options(options.filter));
  std::string scenario;
  parse(
      arguments, groups, "simulate",
      [&](const std::string& word) {
        if (!scenario.empty()) throw UsageError("one scenario at a time: '" + word + "' is a second one");
        if (word != "mars") throw UsageError("unknown scenario '" + word + "': this version knows mars and usv");
        scenario = word;
      },
      "--preset");
  if (options.common.help) return options;
  check_common(options.common);
  check_contradictions(options.filter);
  if (scenario.empty()) throw UsageError("no scenario given (usage: cairn simulate mars|usv [options])");
  if (options.compare && options.filter.submap_landmarks == 0u)
    throw UsageError(
        "options --compare and --single-map contradict each other: --compare runs submaps too; leave one out");
  return options;
}

}  // namespace cairn::program
