// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/common_options.hpp"

#include <limits>

namespace cairn::program {

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
                                  "folder DIR.",
                                  "The folder is created if it does not exist. See `OUTPUT` for the files."},
                                 [&o](const std::string& v) {
                                   if (v.empty()) reject("--output", v, "a folder");
                                   o.output = v;
                                 }));
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

}  // namespace cairn::program
