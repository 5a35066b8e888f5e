// SPDX-License-Identifier: BSD-3-Clause
#include "program/options/systematic_choices.hpp"

#include <algorithm>

namespace cairn::program {

Option components(const OptionText& text, const options::Bounds& bounds, std::size_t count, double* target) {
  const std::string name = text.name;
  return custom(text, [=](const std::string& value) {
    std::vector<double> numbers;
    for (const std::string& word : split(value)) numbers.push_back(parse_number(name, word, bounds));
    if (numbers.size() != 1 && numbers.size() != count)
      reject(name, value, "1 or " + std::to_string(count) + " numbers");
    for (std::size_t i = 0; i < count; ++i) target[i] = numbers[numbers.size() == 1 ? 0 : i];
  });
}

void SystematicChoices::apply(cairn_filter_options& options) const {
  std::copy(velocity_bias.begin(), velocity_bias.end(), options.velocity_bias_sigma);
  std::copy(velocity_bias_walk.begin(), velocity_bias_walk.end(), options.velocity_bias_walk);
  std::copy(rate_bias.begin(), rate_bias.end(), options.rate_bias_sigma);
  std::copy(rate_bias_walk.begin(), rate_bias_walk.end(), options.rate_bias_walk);
  std::copy(wheel_scale.begin(), wheel_scale.end(), options.wheel_scale_sigma);
  std::copy(wheel_scale_walk.begin(), wheel_scale_walk.end(), options.wheel_scale_walk);
  options.max_sensor_errors = 0;
  for (const auto* sigmas : {&mount_shift, &mount_turn, &value_offset})
    options.max_sensor_errors += static_cast<std::uint32_t>(
        std::count_if(sigmas->begin(), sigmas->end(), [](double sigma) { return sigma > 0; }));
}

cairn_status SystematicChoices::calibrate(cairn_filter* filter, std::int32_t sensor) const {
  cairn_filter_options room{};
  apply(room);
  if (room.max_sensor_errors == 0) return CAIRN_OK;
  cairn_calibration calibration;
  const cairn_status status = cairn_calibration_init(&calibration, sizeof calibration, nullptr);
  if (status != CAIRN_OK) return status;
  std::copy(mount_shift.begin(), mount_shift.end(), calibration.mount_shift_sigma);
  std::copy(mount_turn.begin(), mount_turn.end(), calibration.mount_turn_sigma);
  std::copy(value_offset.begin(), value_offset.end(), calibration.offset_sigma);
  return cairn_filter_calibrate_sensor(filter, sensor, &calibration, nullptr);
}

std::vector<Option> systematic_flags(SystematicChoices& o) {
  return {
      components({"--velocity-bias", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate a constant error of the measured velocity, with this standard deviation at the start, m/s: "
                  "one number, or one each for forward, left and up. 0 (the default): not this component.",
                  "See docs/systematic_errors.md. The filter then moves by the measured velocity minus the estimate."},
                 options::kNotNegative, 3, o.velocity_bias.data()),
      components(
          {"--velocity-bias-walk", "SIGMA[,SIGMA,SIGMA]",
           "Random walk of the velocity bias, m/s in the square root of a second. 0 (the default): constant.", ""},
          options::kNotNegative, 3, o.velocity_bias_walk.data()),
      components({"--rate-bias", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate a constant error of the measured turning rate, rad/s, as `--velocity-bias` does.", ""},
                 options::kNotNegative, 3, o.rate_bias.data()),
      components({"--rate-bias-walk", "SIGMA[,SIGMA,SIGMA]",
                  "Random walk of the rate bias, rad/s in the square root of a second. 0 (the default): constant.", ""},
                 options::kNotNegative, 3, o.rate_bias_walk.data()),
      components(
          {"--wheel-scale", "SIGMA[,SIGMA]",
           "Estimate a scale of the measured wheel rates, with this standard deviation at the start: one number, "
           "or one each for the left and the right wheels. 0 (the default): no scale.",
           "A wheel turns at its measured rate times 1 plus its scale."},
          options::kNotNegative, 2, o.wheel_scale.data()),
      components({"--wheel-scale-walk", "SIGMA[,SIGMA]",
                  "Random walk of the wheel scale, in the square root of a second. 0 (the default): constant.", ""},
                 options::kNotNegative, 2, o.wheel_scale_walk.data()),
      components({"--mount-shift", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate by how much the sensor is shifted against the body, with this standard deviation at the "
                  "start, m. 0 (the default): not this component.",
                  ""},
                 options::kNotNegative, 3, o.mount_shift.data()),
      components({"--mount-turn", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate by how much the sensor is turned against the body, about its x, y and z axis, rad.", ""},
                 options::kNotNegative, 3, o.mount_turn.data()),
      components({"--value-offset", "SIGMA[,SIGMA,SIGMA]",
                  "Estimate constant errors of the values of an observation, in their units.", ""},
                 options::kNotNegative, 3, o.value_offset.data()),
  };
}

}  // namespace cairn::program
