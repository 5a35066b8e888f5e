// SPDX-License-Identifier: BSD-3-Clause
// The systematic errors that a command line asks the filter to estimate.
#pragma once

#include <cairn/cairn.h>

#include <array>
#include <vector>

#include "program/options/option.hpp"

namespace cairn::program {

// Zero: no state.
struct SystematicChoices {
  std::array<double, 3> velocity_bias{}, velocity_bias_walk{}, rate_bias{}, rate_bias_walk{};
  std::array<double, 2> wheel_scale{}, wheel_scale_walk{};

  void apply(cairn_filter_options& options) const;
};

// `choices` has to live as long as the options.
std::vector<Option> systematic_flags(SystematicChoices& choices);

}  // namespace cairn::program
