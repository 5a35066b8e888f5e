// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/run_options.hpp"

#include <utility>

#include "program/options/parse.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {
namespace {

// Without an option the file or the library decides; there is no default to print.
Option decided_elsewhere(const OptionText& text, const options::Bounds& bounds, std::optional<double>& target) {
  return number(text, bounds, 0, target);
}

}  // namespace

OptionGroup log_options(RunOptions& o) {
  using namespace options;
  OptionGroup group{"log", "cairn run, sensors of a STARS file", {}};
  group.options = {
      decided_elsewhere({"--pixel-noise", "PX",
                         "Standard deviation of a pixel, in both images. Default: the variances in the file, or 2.",
                         "It holds for u and v in each image. The observed v is the mean of both images, and gets it "
                         "over sqrt(2)."},
                        kPositive, o.noise.pixel),
      decided_elsewhere(
          {"--velocity-noise", "M_S",
           "Standard deviation of each axis of the measured body velocity, m/s. Default: the variances in "
           "the file, or 0.1.",
           ""},
          kPositive, o.noise.velocity),
      decided_elsewhere({"--rate-noise", "RAD_S",
                         "Standard deviation of each axis of the measured body rate, rad/s. Default: the variances in "
                         "the file, or 0.01.",
                         ""},
                        kPositive, o.noise.rate),
      decided_elsewhere(
          {"--min-disparity", "PX",
           "Place a landmark only from an observation with at least this disparity, u_left minus u_right. "
           "Default: the library's.",
           ""},
          kPositive, o.camera.min_disparity),
      decided_elsewhere(
          {"--min-disparity-sigmas", "N",
           "Place a landmark only if the disparity is at least N of its standard deviations. 0: no limit. "
           "Default: the library's.",
           "Landmarks that are farther away wait until they are seen from nearer."},
          kNotNegative, o.camera.min_disparity_sigmas),
  };
  return group;
}

RunOptions parse_run_options(const std::vector<std::string>& arguments) {
  RunOptions options;
  bool has_log = false;
  const std::vector<OptionGroup> groups = {common_options(options.common), filter_options(options.filter),
                                           log_options(options)};
  parse(arguments, groups, "run", [&](const std::string& word) {
    if (has_log) throw UsageError("one log at a time: '" + word + "' is a second one");
    options.log = word;
    has_log = true;
  });
  check_common(options.common);
  check_contradictions(options.filter);
  if (!options.common.help && options.log.empty()) throw UsageError("no log given (usage: cairn run LOG [options])");
  return options;
}

void check_log(const RunOptions& o, const logs::Log& log) {
  if (log.sensor == logs::SensorKind::kStereoCamera) return;
  const std::pair<const char*, const std::optional<double>&> camera[] = {
      {"--pixel-noise", o.noise.pixel},
      {"--velocity-noise", o.noise.velocity},
      {"--rate-noise", o.noise.rate},
      {"--min-disparity", o.camera.min_disparity},
      {"--min-disparity-sigmas", o.camera.min_disparity_sigmas}};
  for (const auto& [name, value] : camera) {
    if (value)
      throw UsageError(std::string("option ") + name + " is for STARS files, and " + o.log + " is none (" + log.format +
                       "); leave the option out");
  }
}

}  // namespace cairn::program
