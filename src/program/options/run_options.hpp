// SPDX-License-Identifier: BSD-3-Clause
// The command line of `cairn run` of a log.
#pragma once

#include <string>
#include <vector>

#include "program/drives/log_drive.hpp"
#include "program/logs/log.hpp"
#include "program/options/common_options.hpp"
#include "program/options/filter_choices.hpp"

namespace cairn::program {

struct RunOptions {
  CommonChoices common;
  FilterChoices filter;
  CameraChoices camera;
  std::string log;
  logs::NoiseOverride noise;
};

// Options of the sensors of a log. `options` must live as long as the group.
OptionGroup log_options(RunOptions& options);

// `arguments` are the words after the command. Throws UsageError.
RunOptions parse_run_options(const std::vector<std::string>& arguments);
// Throws UsageError if an option has no effect on this log.
void check_log(const RunOptions& options, const logs::Log& log);

}  // namespace cairn::program
