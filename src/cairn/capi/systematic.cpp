// SPDX-License-Identifier: BSD-3-Clause
// Systematic errors of a filter that are states.
#include <cairn/systematic.h>

#include <cmath>
#include <vector>

#include "capi/filter_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

cairn_systematic_error describe(int number) {
  cairn_systematic_error error = {};
  error.sensor = -1;
  error.kind = number < 3                      ? CAIRN_SYSTEMATIC_VELOCITY_BIAS
               : number < MotionErrors::kScale ? CAIRN_SYSTEMATIC_RATE_BIAS
                                               : CAIRN_SYSTEMATIC_WHEEL_SCALE;
  error.component = number < MotionErrors::kScale ? number % 3 : number - MotionErrors::kScale;
  return error;
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_systematic_errors(const cairn_filter* filter, cairn_systematic_error* errors,
                                            double* covariance, size_t capacity, size_t* needed) {
  return guard([&] {
    with_filter(filter, [&](const auto& f) {
      const auto count = static_cast<std::size_t>(f.systematic().count());
      if (!check_room(errors, capacity, count, needed, "errors")) return;
      std::vector<double> values(count), joint(count * count);
      f.systematic_errors(values.data(), joint.data());
      for (std::size_t i = 0; i < count; ++i) {
        errors[i] = describe(f.systematic().number(static_cast<Index>(i)));
        errors[i].value = values[i];
        errors[i].sigma = std::sqrt(joint[i * (count + 1)]);
      }
      if (covariance != nullptr) std::copy(joint.begin(), joint.end(), covariance);
    });
  });
}

}  // extern "C"
