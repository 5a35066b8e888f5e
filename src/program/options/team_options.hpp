// SPDX-License-Identifier: BSD-3-Clause
// The command lines of teams: `cairn simulate usv`, and `cairn run` of a MRCLAM folder.
#pragma once

#include <cairn/fleet.h>

#include <optional>
#include <string>
#include <vector>

#include "program/drives/mrclam_drive.hpp"
#include "program/options/common_options.hpp"
#include "program/runners/team_runner.hpp"

namespace cairn::program {

struct UsvOptions {
  CommonChoices common;
  TeamChoices team;
  cairn_fleet_options fleet;  // all but its seed
  bool compare = false;
  std::uint32_t runs = 1;
};

struct MrclamOptions {
  CommonChoices common;
  TeamChoices team;
  MrclamNoise noise;
  std::int32_t turns = 0;  // 0: measured, 1: recorded
  std::optional<double> range_noise, bearing_noise;  // as requested; `noise` holds the values that are used
  std::string folder;
};

// Throws LibraryError.
UsvOptions default_usv_options();

// The argument must live as long as the group. It holds the defaults that the texts contain.
OptionGroup team_options(TeamChoices& team);
OptionGroup boat_options(UsvOptions& options);
OptionGroup robot_options(MrclamOptions& options);

// `arguments` are the words after the command. Throw UsageError.
UsvOptions parse_usv_options(const std::vector<std::string>& arguments);
MrclamOptions parse_mrclam_options(const std::vector<std::string>& arguments);

}  // namespace cairn::program
