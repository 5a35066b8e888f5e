// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/common_options.hpp"

#include <cmath>
#include <limits>

#include "program/read_number.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

GeodeticPoint parse_origin(const std::string& value) {
  const char* name = "--origin";
  const std::vector<std::string> words = split(value);
  if (words.size() != 2 && words.size() != 3) reject(name, value, "LAT,LON or LAT,LON,HEIGHT");
  const auto angle = [&](const std::string& word, const char* what, double limit) {
    const std::optional<double> degrees = read_number(word);
    if (!degrees || !(std::abs(*degrees) <= limit)) {  // NaN too
      const std::string range = std::to_string(static_cast<int>(limit));
      reject(name, word, std::string("a ") + what + " from -" + range + " to " + range + " degrees");
    }
    return *degrees;
  };
  GeodeticPoint origin{angle(words[0], "latitude", 90), angle(words[1], "longitude", 180), std::nullopt};
  if (words.size() == 3) origin.height = parse_number(name, words[2], options::kFinite);
  return origin;
}

}  // namespace

OptionGroup common_options(CommonChoices& o) {
  OptionGroup group{"common", "All commands", {}};
  group.options.push_back(
      custom({"--summary", "json", "Print the figures as one JSON object on one line, instead of a table.", ""},
             [&o](const std::string& v) {
               if (v != "json") reject("--summary", v, "json");
               o.json = true;
             }));
  group.options.push_back(custom({"--output", "DIR",
                                  "Write trajectory, landmarks, submaps, innovations and timing as CSV files into the "
                                  "folder DIR, trajectories also as TUM and the map as PLY.",
                                  "The folder is created if it does not exist. See `OUTPUT` for the files."},
                                 [&o](const std::string& v) {
                                   if (v.empty()) reject("--output", v, "a folder");
                                   o.output.folder = v;
                                 }));
  group.options.push_back(custom(
      {"--origin", "LAT,LON[,HEIGHT]",
       "Place of the map's frame on the Earth (WGS84, degrees and m): `--output` then also writes map and trajectories "
       "as GeoJSON.",
       "The axes x, y and z of the map point east, north and up at this place. GeoJSON has only longitudes and "
       "latitudes: a map in m needs the place of its frame, and no file is written without it. Without HEIGHT the "
       "frame lies on the ellipsoid, and the file has no heights."},
      [&o](const std::string& v) { o.output.origin = parse_origin(v); }));
  group.options.push_back(
      flag({"--quiet", "", "Print no progress and no notes on standard error.", "Errors are still printed."}, o.quiet));
  group.options.push_back(custom(
      {"--seed", "N",
       "Seed of all that is random in a simulated world. Default: 1. A log has nothing "
       "random.",
       "The same drive gives the same figures."},
      [&o](const std::string& v) { o.seed = parse_whole("--seed", v, 0, std::numeric_limits<std::uint64_t>::max()); }));
  group.options.push_back(flag({"--help", "", "Print the options and exit.", ""}, o.help));
  group.options.back().alias = "-h";
  return group;
}

void check_common(const CommonChoices& o) {
  if (o.output.origin && !o.output.wanted())
    throw UsageError("option --origin places the files of --output, and there is no --output; add it");
}

}  // namespace cairn::program
