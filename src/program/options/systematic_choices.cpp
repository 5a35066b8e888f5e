// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/systematic_choices.hpp"

#include <algorithm>
#include <sstream>

namespace cairn::program {
namespace {

// One number for all components, or one for each, separated by commas.
template <std::size_t n>
Option components(const OptionText& text, std::array<double, n>& target) {
  const std::string name = text.name;
  return custom(text, [name, &target](const std::string& value) {
    std::vector<double> numbers;
    std::stringstream words(value);
    for (std::string word; std::getline(words, word, ',');)
      numbers.push_back(parse_number(name, word, options::kNotNegative));
    if (numbers.size() != 1 && numbers.size() != n) reject(name, value, "1 or " + std::to_string(n) + " numbers");
    for (std::size_t i = 0; i < n; ++i) target[i] = numbers[numbers.size() == 1 ? 0 : i];
  });
}

}  // namespace

void SystematicChoices::apply(cairn_filter_options& options) const {
  std::copy(velocity_bias.begin(), velocity_bias.end(), options.velocity_bias_sigma);
  std::copy(velocity_bias_walk.begin(), velocity_bias_walk.end(), options.velocity_bias_walk);
  std::copy(rate_bias.begin(), rate_bias.end(), options.rate_bias_sigma);
  std::copy(rate_bias_walk.begin(), rate_bias_walk.end(), options.rate_bias_walk);
  std::copy(wheel_scale.begin(), wheel_scale.end(), options.wheel_scale_sigma);
  std::copy(wheel_scale_walk.begin(), wheel_scale_walk.end(), options.wheel_scale_walk);
}

std::vector<Option> systematic_flags(SystematicChoices& o) {
  return {
      components({"--velocity-bias", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate a constant error of the measured velocity, with this standard deviation at the start, m/s: "
                  "one number, or one each for forward, left and up. 0 (the default): not this component.",
                  "See docs/systematic_errors.md. The filter then moves by the measured velocity minus the estimate."},
                 o.velocity_bias),
      components({"--velocity-bias-walk", "SIGMA[,SIGMA,SIGMA]",
                  "Random walk of the velocity bias, m/s in the square root of a second. 0 (the default): constant.",
                  ""},
                 o.velocity_bias_walk),
      components({"--rate-bias", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate a constant error of the measured turning rate, rad/s, as `--velocity-bias` does.", ""},
                 o.rate_bias),
      components({"--rate-bias-walk", "SIGMA[,SIGMA,SIGMA]",
                  "Random walk of the rate bias, rad/s in the square root of a second. 0 (the default): constant.", ""},
                 o.rate_bias_walk),
      components({"--wheel-scale", "SIGMA[,SIGMA]",
                  "Estimate a scale of the measured wheel rates, with this standard deviation at the start: one number, "
                  "or one each for the left and the right wheels. 0 (the default): no scale.",
                  "A wheel turns at its measured rate times 1 plus its scale."},
                 o.wheel_scale),
      components({"--wheel-scale-walk", "SIGMA[,SIGMA]",
                  "Random walk of the wheel scale, in the square root of a second. 0 (the default): constant.", ""},
                 o.wheel_scale_walk),
  };
}

}  // namespace cairn::program
