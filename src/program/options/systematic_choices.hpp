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
  std::array<double, 3> mount_shift{}, mount_turn{}, value_offset{};  // of the sensor

  void apply(cairn_filter_options& options) const;
  bool scales_wheels() const { return wheel_scale[0] > 0 || wheel_scale[1] > 0; }
  // Makes the errors of the sensor states of the filter, if there are any.
  cairn_status calibrate(cairn_filter* filter, std::int32_t sensor) const;
};

// An option with one number for all `count` components, or one for each, separated by commas. `target` has to live as
// long as the option.
Option components(const OptionText& text, const options::Bounds& bounds, std::size_t count, double* target);

// `choices` has to live as long as the options.
std::vector<Option> systematic_flags(SystematicChoices& choices);

}  // namespace cairn::program
