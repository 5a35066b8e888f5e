// SPDX-License-Identifier: BSD-3-Clause
// What the command lines of teams ask for.
#pragma once

#include <cairn/fleet.h>

#include "program/drives/mrclam_drive.hpp"
#include "program/options/option_table.hpp"
#include "program/runners/team_runner.hpp"

namespace cairn::program {

struct UsvOptions {
  CommonChoices common;
  TeamChoices team;
  cairn_fleet_options fleet;  // but for its seed
  bool compare = false;
  std::uint32_t runs = 1;
};

struct MrclamOptions {
  CommonChoices common;
  TeamChoices team;
  MrclamNoise noise;
  std::string folder;
};

// `arguments` are what follows the command's word. Throw UsageError.
bool asks_for_usv(const std::vector<std::string>& arguments);
UsvOptions parse_usv_options(const std::vector<std::string>& arguments);
// The folder among the arguments of `run`; empty where there is none.
std::string mrclam_folder(const std::vector<std::string>& arguments);
MrclamOptions parse_mrclam_options(const std::vector<std::string>& arguments);

}  // namespace cairn::program
