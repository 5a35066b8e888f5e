// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/systematic_csv.hpp"

#include <cstdio>

#include "program/library.hpp"

namespace cairn::program {
namespace {

std::string component_of(const cairn_systematic_error& error) {
  static constexpr const char* kAxes[] = {"x", "y", "z"};
  if (error.kind == CAIRN_SYSTEMATIC_WHEEL_SCALE) return error.component == 0 ? "left" : "right";
  return kAxes[error.component];
}

// The unit stands in brackets; a scale has none. The offsets have the units of the sensor's values.
std::string name_of(const cairn_systematic_error& error) {
  const std::string sensor = " of sensor " + std::to_string(error.sensor);
  switch (error.kind) {
    case CAIRN_SYSTEMATIC_VELOCITY_BIAS:
      return "velocity bias " + component_of(error) + " [m/s]";
    case CAIRN_SYSTEMATIC_RATE_BIAS:
      return "rate bias " + component_of(error) + " [rad/s]";
    case CAIRN_SYSTEMATIC_WHEEL_SCALE:
      return "wheel scale " + component_of(error) + " []";
    case CAIRN_SYSTEMATIC_MOUNT_SHIFT:
      return "shift " + component_of(error) + sensor + " [m]";
    case CAIRN_SYSTEMATIC_MOUNT_TURN:
      return "turn " + component_of(error) + sensor + " [rad]";
    default:
      return "offset of value " + std::to_string(error.component + 1) + sensor + " [unit of the value]";
  }
}

}  // namespace

SystematicCsv::SystematicCsv(const std::string& folder) : folder_(folder) {
  std::remove((folder + "/systematic.csv").c_str());
}

void SystematicCsv::add(const cairn_filter* filter, const DriveStep& step) {
  std::size_t count = 0;
  check(cairn_filter_systematic_errors(filter, nullptr, nullptr, 0, &count, nullptr));
  if (count == 0) return;
  errors_.resize(count);
  check(cairn_filter_systematic_errors(filter, errors_.data(), nullptr, count, &count, nullptr));
  if (!file_) file_.emplace(folder_, "systematic.csv").text("step,time,name,value,sigma\n");
  for (const cairn_systematic_error& error : errors_) {
    file_->field(step.number);
    file_->field(step.time);
    file_->field(name_of(error));
    file_->field(error.value);
    file_->field(error.sigma);
    file_->end();
  }
}

void SystematicCsv::finish() {
  if (file_) file_->close();
}

}  // namespace cairn::program
