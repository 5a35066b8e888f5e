// SPDX-License-Identifier: BSD-3-Clause
// The options that every command has.
#pragma once

#include <cstdint>

#include "program/options/option.hpp"
#include "program/output/output_place.hpp"

namespace cairn::program {

struct CommonChoices {
  bool help = false;
  bool json = false;
  bool quiet = false;
  OutputPlace output;
  std::uint64_t seed = 1;
};

// `choices` must live as long as the group.
OptionGroup common_options(CommonChoices& choices);

// Throws UsageError if an option has no effect without another one.
void check_common(const CommonChoices& choices);

}  // namespace cairn::program
