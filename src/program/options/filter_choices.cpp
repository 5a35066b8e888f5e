// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/filter_choices.hpp"

#include <limits>
#include <string>
#include <utility>

#include "program/usage_error.hpp"

namespace cairn::program {

void FilterChoices::apply(cairn_filter_options& options) const {
#define FILTER_CHOICE(field, constants, words, flag) options.field = field.value_or(options.field);
#define FILTER_WHOLE(field, initial, lower, upper, flag) options.field = field.value_or(options.field);
#define FILTER_REAL(field, initial, bounds, flag) options.field = field.value_or(options.field);
#include "options/filter_options.def"
  systematic.apply(options);
  if (gate_probability == 1.0) options.batch_gate_probability = batch_gate_probability.value_or(1);
}

namespace {

using namespace options;  // the names of bounds in the table

// The library checks the upper bound of a real number, with the exception of probabilities.
constexpr Bounds checked_here(const Bounds& bounds) {
  return bounds.upper == 1 ? bounds : Bounds{bounds.lower, bounds.lower_open, kInfinity, true};
}

// The flags of the table, in its order.
std::vector<Option> table_flags(FilterChoices& o) {
  std::vector<Option> options;
  const auto add = [&](const std::optional<OptionText>& flag, const auto& make) {
    if (flag) options.push_back(make(*flag));
  };
#define NO_FLAG std::nullopt
#define FLAG(...) \
  OptionText {    \
    __VA_ARGS__   \
  }
#define LIST(...) \
  { __VA_ARGS__ }
#define FILTER_CHOICE(field, constants, words, flag) \
  add(flag, [&](const OptionText& text) { return choice(text, LIST words, LIST constants, o.field); });
#define FILTER_WHOLE(field, initial, lower, upper, flag) \
  add(flag, [&](const OptionText& text) { return whole(text, lower, upper, initial, o.field); });
#define FILTER_REAL(field, initial, bounds, flag) \
  add(flag, [&](const OptionText& text) { return number(text, checked_here(bounds), initial, o.field); });
#include "options/filter_options.def"
  return options;
}

}  // namespace

void check_contradictions(const FilterChoices& o) {
  if (o.submap_landmarks != 0u) return;
  const std::pair<const char*, bool> given[] = {{"--submap-distance", o.submap_distance.value_or(0) > 0},
                                                {"--submap-extent", o.submap_extent.value_or(0) > 0},
                                                {"--submap-sigma", o.submap_sigma.value_or(0) > 0},
                                                {"--join", o.join.value_or(CAIRN_JOIN_AUTO) != CAIRN_JOIN_AUTO}};
  for (const auto& [name, contradicts] : given) {
    if (contradicts)
      throw UsageError(std::string("options --single-map and ") + name +
                       " contradict each other: a single map has no submaps; leave one out");
  }
}

OptionGroup filter_options(FilterChoices& o) {
  OptionGroup group{"filter", "The filter", table_flags(o)};
  group.options.push_back(custom({"--single-map", "", "Keep all landmarks in one map, as EKF-SLAM does.", ""},
                                 [&o](const std::string&) { o.submap_landmarks = 0; }));
  group.options.push_back(custom(
      {"--forget-after", "N",
       "Remove a landmark when no observation of it was accepted for N frames. 0 (the default): "
       "never.",
       "It is removed from the map and from the open submap. With 1 they hold the landmarks of the last frame. A "
       "landmark that is seen again later starts anew."},
      [&o](const std::string& v) {
        o.forget_after = parse_whole("--forget-after", v, 0, std::numeric_limits<std::uint64_t>::max());
      }));
  group.options.push_back(choice({"--loss", "LOSS",
                                  "Loss of the sensor's residuals: `none` (the default), `huber` or `cauchy`. An "
                                  "observation with a large residual gets less weight.",
                                  "The gates stay; `--gate 1 --batch-gate 1` opens them."},
                                 {"none", "huber", "cauchy"}, {CAIRN_LOSS_NONE, CAIRN_LOSS_HUBER, CAIRN_LOSS_CAUCHY},
                                 o.loss));
  group.options.push_back(number({"--loss-width", "W",
                                  "Where `--loss` leaves the parabola, in standard deviations of an observation. "
                                  "Default: {default}.",
                                  ""},
                                 kPositive, kUsualLossWidth, o.loss_width));
  for (Option& option : systematic_flags(o.systematic)) group.options.push_back(std::move(option));
  return group;
}

}  // namespace cairn::program
