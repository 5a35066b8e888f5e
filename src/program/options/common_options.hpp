// SPDX-License-Identifier: BSD-3-Clause
// The options that every command has.
#pragma once

#include <cstdint>
#include <string>

#include "program/options/option.hpp"

namespace cairn::program {

struct CommonChoices {
  bool help = false;
  bool json = false;
  bool quiet = false;
  std::string output;  // folder; empty: none
  std::uint64_t seed = 1;
};

// `choices` must live as long as the group.
OptionGroup common_options(CommonChoices& choices);

}  // namespace cairn::program
