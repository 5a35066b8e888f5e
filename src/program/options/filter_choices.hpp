// SPDX-License-Identifier: BSD-3-Clause
// The filter that a command line asks for.
#pragma once

#include <cairn/cairn.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "program/options/option.hpp"
#include "program/options/systematic_choices.hpp"

namespace cairn::program {

constexpr std::uint32_t kUsualSubmap = 60;  // landmarks
constexpr double kUsualLossWidth = 1.5;

// The submap of a drive whose largest frame has so many observations. A submap that one frame fills costs more to close
// than it saves.
constexpr std::uint32_t usual_submap(std::uint32_t largest_frame) {
  constexpr std::uint32_t kFrames = 2, kLargestSubmap = 4096;
  return std::min(kLargestSubmap, std::max(kUsualSubmap, kFrames * largest_frame));
}

// One member for each option of the filter that is a number or a choice, with its name in cairn_filter_options. An
// option that is not set keeps the library's default, or gets the value that the drive needs.
struct FilterChoices {
#define FILTER_CHOICE(field, constants, words, flag) std::optional<std::int32_t> field;
#define FILTER_WHOLE(field, initial, lower, upper, flag) std::optional<std::uint32_t> field;
#define FILTER_REAL(field, initial, bounds, flag) std::optional<double> field;
#include "options/filter_options.def"

  std::uint64_t forget_after = 0;    // frames; 0: never
  std::optional<std::int32_t> loss;  // of the log's sensor
  std::optional<double> loss_width;
  SystematicChoices systematic;

  // Writes the options that are set. A gate of 1 opens the gate of the batch too, unless that one is set.
  void apply(cairn_filter_options& options) const;
  bool names_known() const {
    return association.value_or(CAIRN_ASSOCIATION_KNOWN) == CAIRN_ASSOCIATION_KNOWN;
  }
};

// Throws UsageError if limits or joining of submaps are given for a single map.
void check_contradictions(const FilterChoices& choices);

// `choices` has to live as long as the group.
OptionGroup filter_options(FilterChoices& choices);

}  // namespace cairn::program
