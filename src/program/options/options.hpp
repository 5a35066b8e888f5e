// SPDX-License-Identifier: BSD-3-Clause
// What the command lines of the commands ask for.
#pragma once

#include <cairn/sim.h>

#include <cstdint>
#include <string>
#include <vector>

#include "program/drives/log_drive.hpp"
#include "program/logs/log.hpp"
#include "program/options/filter_choices.hpp"
#include "program/options/option_table.hpp"

namespace cairn::program {

struct RunOptions {
  CommonChoices common;
  FilterChoices filter;
  CameraChoices camera;
  std::string log;
  logs::NoiseOverride noise;
};

struct SimulateOptions {
  CommonChoices common;
  FilterChoices filter;
  cairn_world_options world;  // but for its seed
  bool by_wheels = false;     // the filter gets the rates of the wheels alone
  bool compare = false;
  std::uint32_t runs = 1;
};

// `arguments` are what follows the command's word. Throw UsageError.
RunOptions parse_run_options(const std::vector<std::string>& arguments);
SimulateOptions parse_simulate_options(const std::vector<std::string>& arguments);

}  // namespace cairn::program
