// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/team_options.hpp"

#include "program/library.hpp"
#include "program/options/parse.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

using options::kNotNegative;
using options::kPositive;

// Without ids the noise of a single observation is used to distinguish neighbouring landmarks. Errors that last count
// only in updates. A landmark counts after three observations that are independent of each other (docs/mrclam.md).
constexpr double kSightingRange = 0.044, kSightingBearing = 0.016, kPersistence = 18;
constexpr double kRobotGate = 0.99;  // their barcodes are misread now and then (docs/mrclam.md)
constexpr std::uint32_t kDeferredSightings = 54, kDeferredFrames = 2000;

// A team refuses the options that it does not use.
void check_choices(const TeamChoices& team) {
  const FilterChoices& o = team.filter;
  if (o.forget_after != 0)
    throw UsageError("option --forget-after is not for teams, which keep all landmarks; leave it out");
  if (o.join.value_or(CAIRN_JOIN_AUTO) != CAIRN_JOIN_AUTO)
    throw UsageError("option --join is not for teams, which join submaps densely; leave it out");
  const bool submaps = o.submap_landmarks.value_or(0) > 0 || o.submap_distance.value_or(0) > 0 ||
                       o.submap_extent.value_or(0) > 0 || o.submap_sigma.value_or(0) > 0;
  if (submaps && team.mode != CAIRN_TEAM_SUBMAPS) throw UsageError("options of submaps need --mode submaps");
  if (team.mode == CAIRN_TEAM_SUBMAPS && o.submap_landmarks == 0u)
    throw UsageError("options --mode submaps and --single-map contradict each other; leave one out");
}

std::vector<OptionGroup> groups_of_team(CommonChoices& common, TeamChoices& team) {
  return {common_options(common), filter_options(team.filter), team_options(team)};
}

}  // namespace

OptionGroup team_options(TeamChoices& team) {
  static_assert(CAIRN_TEAM_MONO == 0 && CAIRN_TEAM_EO_DIAGONAL == 1 && CAIRN_TEAM_EO_FULL == 2 &&
                CAIRN_TEAM_JOINT == 3 && CAIRN_TEAM_SUBMAPS == 4);
  OptionGroup group{"team", "Teams (cairn simulate usv, and cairn run of a MRCLAM folder)", {}};
  group.options = {choice(
      {"--mode", "MODE",
       "How a vehicle uses the packets of the others: `mono`, `eo_diagonal`, `eo_full`, `joint` (the default) or "
       "`submaps`.",
       "`joint`: each vehicle runs the same filter over all poses and landmarks. `submaps`: each vehicle works in "
       "submaps "
       "of its own, which are joined by their common landmarks. `eo_full`: extended observations, with the noise that "
       "all "
       "observations of a scan share. `eo_diagonal`: extended observations as the paper prints them, each with "
       "independent "
       "noise, which is overconfident. `mono`: not at all."},
      kModeNames, team.mode)};
  return group;
}

OptionGroup boat_options(UsvOptions& o) {
  cairn_fleet_options& f = o.fleet;
  static_assert(CAIRN_FLEET_UNIFORM == 0 && CAIRN_FLEET_COAST == 1);
  OptionGroup group{"boats", "cairn simulate usv", {}};
  group.options = {
      flag(
          {"--compare", "",
           "Run all modes with 6, 10 and 40 features, and print the figures beside those of the cooperative paper.",
           "For each mode the table has the improvement on a boat without a team: as its covariance claims it, and the "
           "true one. It also has consistency, error and time. With `--output` the folder gets team_compare.csv, "
           "team_steps.csv, team_scene.csv and summary.json."},
          o.compare),
      whole({"--runs", "N",
             "Run N worlds, with seeds from `--seed` on, and print the mean of each figure. Default: "
             "{default}.",
             "With `--compare` all figures come from the sums over the worlds."},
            1, 100000, o.runs),
      whole({"--vehicles", "N", "Number of boats, at most {upper}. Default: {default}.", ""}, 1, 64, f.vehicles),
      whole({"--features", "N", "Number of features, at most {upper}. Default: {default}.", ""}, 1, 1000, f.features),
      choice({"--layout", "NAME",
              "Features lie anywhere in the square (`uniform`, the default) or in the water along the `coast`.", ""},
             {"uniform", "coast"}, f.layout),
      number({"--separation", "M", "Distance between neighbouring boats at the start. Default: {default} m.", ""},
             kPositive, f.separation),
      number({"--duration", "S", "Length of the drive. Default: {default} s.", ""}, kPositive, f.duration),
      number({"--period", "S", "Time between scans of a radar. Default: {default} s.", ""}, kPositive, f.period),
      number({"--far-range", "M", "Range of the radars. Default: {default} m.", ""}, kPositive, f.radar_range),
      number({"--range-noise", "X", "Standard deviation of an observed range. Default: {default} m.", ""}, kPositive,
             f.range_sigma),
      number(
          {"--bearing-noise", "X", "Standard deviation of an observed bearing, rad. Default: {default_degrees}.", ""},
          kPositive, f.bearing_sigma),
      number({"--velocity-noise", "X",
              "Standard deviation of the difference between executed and commanded speed. Default: {default} m/s.", ""},
             kNotNegative, f.speed_sigma),
      number({"--rate-noise", "X",
              "Standard deviation of the difference between executed and commanded rate of turn, rad/s. Default: "
              "{default_degrees} per second.",
              ""},
             kNotNegative, f.rate_sigma),
  };
  return group;
}

OptionGroup robot_options(MrclamOptions& o) {
  OptionGroup group{"robots", "cairn run of a MRCLAM folder", {}};
  group.options = {
      number({"--velocity-noise", "X",
              "Noise density of the odometry's speed, m/s per square root of Hz. Default: {default}.", ""},
             kPositive, o.noise.speed),
      number({"--rate-noise", "X",
              "Noise density of the odometry's rate of turn, rad/s per square root of Hz. Default: {default}.", ""},
             kPositive, o.noise.rate),
      number(
          {"--range-noise", "X",
           "Standard deviation of an observed range in proportion to the range. Default: {default}; without ids 0.044.",
           ""},
          kPositive, o.noise.range, o.range_noise),
      number({"--bearing-noise", "X",
              "Standard deviation of an observed bearing, rad. Default: {default}; without ids 0.016.", ""},
             kPositive, o.noise.bearing, o.bearing_noise),
      choice({"--turns", "HOW",
              "The odometry's rate of turn: `measured` (the default) corrects it, if the posts of the whole recording "
              "show that the robots turn at another rate; `recorded` takes it as it is.",
              ""},
             {"measured", "recorded"}, o.turns),
  };
  return group;
}

UsvOptions default_usv_options() {
  UsvOptions options;
  check_sim(cairn_fleet_options_init(&options.fleet, sizeof options.fleet, nullptr));
  // A world has no outliers.
  options.team.filter.gate_probability = options.team.filter.batch_gate_probability = 1;
  options.team.score_from = 0.1;  // by then the exactly known start has lost its weight (docs/team.md)
  return options;
}

UsvOptions parse_usv_options(const std::vector<std::string>& arguments) {
  UsvOptions options = default_usv_options();
  std::vector<OptionGroup> groups = groups_of_team(options.common, options.team);
  groups.push_back(boat_options(options));
  parse(arguments, groups, "simulate", [&](const std::string& word) {
    if (word != "usv") throw UsageError("one scenario at a time: '" + word + "' is a second one");
  });
  check_common(options.common);
  check_choices(options.team);
  if (options.compare && options.common.output.origin)
    throw UsageError("option --origin is not for --compare of boats, which writes no maps; leave it out");
  return options;
}

MrclamOptions parse_mrclam_options(const std::vector<std::string>& arguments) {
  MrclamOptions options;
  std::vector<OptionGroup> groups = groups_of_team(options.common, options.team);
  groups.push_back(robot_options(options));
  parse(arguments, groups, "run", [&](const std::string& word) {
    if (!options.folder.empty()) throw UsageError("one log at a time: '" + word + "' is a second one");
    options.folder = word;
  });
  FilterChoices& filter = options.team.filter;
  filter.gate_probability = filter.gate_probability.value_or(kRobotGate);
  if (!filter.names_known()) {
    options.noise.range = kSightingRange;
    options.noise.bearing = kSightingBearing;
    filter.error_persistence = filter.error_persistence.value_or(kPersistence);
    filter.deferred_sightings = filter.deferred_sightings.value_or(kDeferredSightings);
    filter.deferred_frames = filter.deferred_frames.value_or(kDeferredFrames);
  }
  options.noise.range = options.range_noise.value_or(options.noise.range);
  options.noise.bearing = options.bearing_noise.value_or(options.noise.bearing);
  check_common(options.common);
  check_choices(options.team);
  return options;
}

}  // namespace cairn::program
