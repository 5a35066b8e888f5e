// SPDX-License-Identifier: BSD-3-Clause
// Systematic errors of a filter that are states.
#include <cairn/systematic.h>

#include <cmath>
#include <string>
#include <vector>

#include "capi/filter_handle.hpp"
#include "capi/read_errors.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

void set_kind(cairn_systematic_error& error, std::int32_t kind, int component) {
  error.kind = kind;
  error.component = component;
}

template <class Pose>
cairn_systematic_error describe(int sensor, int number) {
  cairn_systematic_error error = {};
  error.sensor = sensor;
  if (sensor == SystematicErrors::kMotion) {
    if (number >= MotionErrors::kScale)
      set_kind(error, CAIRN_SYSTEMATIC_WHEEL_SCALE, number - MotionErrors::kScale);
    else
      set_kind(error, number < 3 ? CAIRN_SYSTEMATIC_VELOCITY_BIAS : CAIRN_SYSTEMATIC_RATE_BIAS, number % 3);
    return error;
  }
  if (number >= Pose::kDof) {
    set_kind(error, CAIRN_SYSTEMATIC_OFFSET, number - Pose::kDof);
  } else {
    const int axis = Embedding<Pose>::axis(number);
    set_kind(error, axis < 3 ? CAIRN_SYSTEMATIC_MOUNT_SHIFT : CAIRN_SYSTEMATIC_MOUNT_TURN, axis % 3);
  }
  return error;
}

cairn_calibration default_calibration() {
  cairn_calibration calibration = {};
  calibration.struct_size = sizeof calibration;
  return calibration;
}

// In the order of Calibration<Pose>.
template <class Pose>
void read_calibration(const cairn_calibration* user, Calibration<Pose>& sigma, Calibration<Pose>& walk) {
  const cairn_calibration c = read_options(user, default_calibration(), "calibration");
  check_reserved(c.reserved, "calibration.reserved");
  constexpr bool planar = Pose::kDim == 2;
  double sigmas[9], walks[9];
  read_errors(c.mount_shift_sigma, c.mount_shift_walk, 3, "calibration.mount_shift", planar ? Axes::xy : Axes::all,
              sigmas, walks);
  read_errors(c.mount_turn_sigma, c.mount_turn_walk, 3, "calibration.mount_turn", planar ? Axes::z : Axes::all,
              sigmas + 3, walks + 3);
  read_errors(c.offset_sigma, c.offset_walk, 3, "calibration.offset", Axes::all, sigmas + 6, walks + 6);
  for (int i = 0; i < kCalibrationErrors<Pose>; ++i) {
    const int from = i < Pose::kDof ? Embedding<Pose>::axis(i) : 6 + i - Pose::kDof;
    sigma[i] = sigmas[from];
    walk[i] = walks[from];
  }
}

}  // namespace

void read_errors(const double* sigma, const double* walk, int count, const char* name, Axes axes, double* sigmas,
                 double* walks) {
  for (int i = 0; i < count; ++i) {
    const std::string at = "[" + std::to_string(i) + "]";
    const std::string of_sigma = std::string(name) + "_sigma" + at;
    const std::string of_walk = std::string(name) + "_walk" + at;
    check_range(sigma[i], 0.0, 1e6, of_sigma.c_str());
    check_range(walk[i], 0.0, 1e6, of_walk.c_str());
    if (walk[i] > 0.0 && !(sigma[i] > 0.0))
      throw Error(ErrorCode::argument, "%s is %g, but %s is 0; a random walk needs a standard deviation at the start",
                  of_walk.c_str(), walk[i], of_sigma.c_str());
    const bool exists = axes == Axes::all || (axes == Axes::z) == (i == 2);
    if (sigma[i] > 0.0 && !exists)
      throw Error(ErrorCode::argument, "%s is %g, but a vehicle in the plane has no such component; set it to 0",
                  of_sigma.c_str(), sigma[i]);
    sigmas[i] = sigma[i];
    walks[i] = walk[i];
  }
}

}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_calibration_init(cairn_calibration* calibration, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(calibration, struct_size, default_calibration(), "calibration"); });
}

cairn_status cairn_filter_calibrate_sensor(cairn_filter* filter, int32_t sensor, const cairn_calibration* calibration,
                                           cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      using Pose = PoseOf<decltype(f)>;
      Calibration<Pose> sigma, walk;
      read_calibration<Pose>(calibration, sigma, walk);
      // The filter makes its map anew, even if memory runs out. The handle of the map stays, and shows the new map.
      const auto show_map = [&] { filter->map.landmarks = &f.landmarks(); };
      try {
        f.calibrate(sensor, sigma, walk);
      } catch (...) {
        show_map();
        throw;
      }
      show_map();
    });
  });
}

cairn_status cairn_filter_systematic_errors(const cairn_filter* filter, cairn_systematic_error* errors,
                                            double* covariance, size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const auto count = static_cast<std::size_t>(f.systematic().count());
      if (!check_room(errors, capacity, count, needed, "errors")) return;
      std::vector<double> values(count), joint(count * count);
      f.systematic_errors(values.data(), joint.data());
      for (std::size_t i = 0; i < count; ++i) {
        const auto number = static_cast<Index>(i);
        errors[i] = describe<PoseOf<decltype(f)>>(f.systematic().sensor(number), f.systematic().number(number));
        errors[i].value = values[i];
        errors[i].sigma = std::sqrt(joint[i * (count + 1)]);
      }
      if (covariance != nullptr) std::copy(joint.begin(), joint.end(), covariance);
    });
  });
}

}  // extern "C"
