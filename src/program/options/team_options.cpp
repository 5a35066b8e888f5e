// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/team_options.hpp"

#include <algorithm>

#include "program/library.hpp"
#include "program/logs/mrclam_log.hpp"

namespace cairn::program {
namespace {

// Posts without names: the noise of a sighting by itself tells neighbours apart, and what of it lasts counts in updates
// alone. A post counts after three sightings that are worth one each (docs/mrclam.md).
constexpr double kSightingRange = 0.044, kSightingBearing = 0.016, kPersistence = 18;
constexpr std::uint32_t kDeferredSightings = 54, kDeferredFrames = 2000;

void add_team_options(OptionTable& table, CommonChoices& common, TeamChoices& team) {
  static_assert(CAIRN_TEAM_MONO == 0 && CAIRN_TEAM_EO_DIAGONAL == 1 && CAIRN_TEAM_EO_FULL == 2 &&
                CAIRN_TEAM_JOINT == 3 && CAIRN_TEAM_SUBMAPS == 4);
  add_common_options(table, common);
  add_filter_options(table, team.filter);
  table.push_back(choice("--mode", kModeNames, team.mode));
}

// What a team makes no use of is not taken in silence.
void check_choices(const TeamChoices& team) {
  const FilterChoices& o = team.filter;
  if (o.forget_after != 0) throw UsageError("option --forget-after: a team forgets no landmark");
  if (o.join != CAIRN_JOIN_AUTO) throw UsageError("option --join: a team joins submaps densely");
  const bool submaps = o.submap_landmarks || o.submap_distance > 0 || o.submap_extent > 0 || o.submap_sigma > 0;
  if (submaps && team.mode != CAIRN_TEAM_SUBMAPS) throw UsageError("options of submaps go with --mode submaps alone");
  if (team.mode == CAIRN_TEAM_SUBMAPS && o.submap_landmarks == 0u)
    throw UsageError("option --mode submaps can't be had with --single-map");
}

// Words that are no option and no option's value, by what a table knows of each.
std::vector<std::string> words_of(const std::vector<std::string>& arguments) {
  static const char* const flags[] = {"--help", "-h", "--quiet", "--single-map", "--compare", "--closed"};
  std::vector<std::string> words;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument.size() < 2 || argument[0] != '-') {
      words.push_back(argument);
    } else if (argument.find('=') == std::string::npos && argument != "--" &&
               std::none_of(std::begin(flags), std::end(flags), [&](const char* f) { return argument == f; })) {
      ++i;  // its value
    }
  }
  return words;
}

}  // namespace

bool asks_for_usv(const std::vector<std::string>& arguments) {
  const std::vector<std::string> words = words_of(arguments);
  return !words.empty() && words[0] == "usv";
}

UsvOptions parse_usv_options(const std::vector<std::string>& arguments) {
  UsvOptions options;
  check_sim(cairn_fleet_options_init(&options.fleet, sizeof options.fleet));
  cairn_fleet_options& f = options.fleet;
  options.team.filter.gate = options.team.filter.batch_gate = 1;  // a world has no outliers
  options.team.score_from = 0.1;  // as the start, known exactly, wears off (docs/team.md)
  OptionTable table;
  add_team_options(table, options.common, options.team);
  static_assert(CAIRN_FLEET_UNIFORM == 0 && CAIRN_FLEET_COAST == 1);
  table.push_back(choice("--layout", {"uniform", "coast"}, f.layout));
  table.push_back(whole("--vehicles", 1, 64, f.vehicles));
  table.push_back(whole("--features", 1, 1000, f.features));
  table.push_back(number("--separation", Range::kPositive, f.separation));
  table.push_back(number("--duration", Range::kPositive, f.duration));
  table.push_back(number("--period", Range::kPositive, f.period));
  table.push_back(number("--far-range", Range::kPositive, f.radar_range));
  table.push_back(number("--range-noise", Range::kPositive, f.range_sigma));
  table.push_back(number("--bearing-noise", Range::kPositive, f.bearing_sigma));
  table.push_back(number("--velocity-noise", Range::kNotNegative, f.speed_sigma));
  table.push_back(number("--rate-noise", Range::kNotNegative, f.rate_sigma));
  table.push_back(flag("--compare", options.compare));
  table.push_back(whole("--runs", 1, 100000, options.runs));
  parse(arguments, table, "simulate", [&](const std::string& word) {
    if (word != "usv") throw UsageError("one scenario at a time: '" + word + "' is a second one");
  });
  check_choices(options.team);
  return options;
}

std::string mrclam_folder(const std::vector<std::string>& arguments) {
  for (const std::string& word : words_of(arguments))
    if (logs::is_mrclam(word)) return word;
  return "";
}

MrclamOptions parse_mrclam_options(const std::vector<std::string>& arguments) {
  MrclamOptions options;
  OptionTable table;
  add_team_options(table, options.common, options.team);
  table.push_back(number("--velocity-noise", Range::kPositive, options.noise.speed));
  table.push_back(number("--rate-noise", Range::kPositive, options.noise.rate));
  std::optional<double> range, bearing;
  table.push_back(number("--range-noise", Range::kPositive, range));
  table.push_back(number("--bearing-noise", Range::kPositive, bearing));
  parse(arguments, table, "run", [&](const std::string& word) {
    if (!options.folder.empty()) throw UsageError("one log at a time: '" + word + "' is a second one");
    options.folder = word;
  });
  FilterChoices& filter = options.team.filter;
  if (!filter.names_known()) {
    options.noise.range = kSightingRange;
    options.noise.bearing = kSightingBearing;
    filter.error_persistence = filter.error_persistence.value_or(kPersistence);
    filter.deferred_sightings = filter.deferred_sightings.value_or(kDeferredSightings);
    filter.deferred_frames = filter.deferred_frames.value_or(kDeferredFrames);
  }
  options.noise.range = range.value_or(options.noise.range);
  options.noise.bearing = bearing.value_or(options.noise.bearing);
  check_choices(options.team);
  return options;
}

}  // namespace cairn::program
