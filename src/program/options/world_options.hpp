// SPDX-License-Identifier: BSD-3-Clause
// The command line of `cairn simulate mars`.
#pragma once

#include <cairn/sim.h>

#include <cstdint>
#include <string>
#include <vector>

#include "program/options/common_options.hpp"
#include "program/options/filter_choices.hpp"

namespace cairn::program {

struct SimulateOptions {
  CommonChoices common;
  FilterChoices filter;
  cairn_world_options world;  // all but its seed
  bool by_wheels = false;     // the filter gets only the rates of the wheels
  bool compare = false;
  std::uint32_t runs = 1;
};

// Throws LibraryError.
SimulateOptions default_simulate_options();

// `options` must live as long as the groups. It holds the defaults that their texts contain.
std::vector<OptionGroup> world_options(SimulateOptions& options);

// `arguments` are the words after the command. Throws UsageError.
SimulateOptions parse_simulate_options(const std::vector<std::string>& arguments);

}  // namespace cairn::program
