// SPDX-License-Identifier: BSD-3-Clause
// Motion: the structs of cairn/motion.h with their defaults and checks, and the functions that move a filter.
#include "motion/motion.hpp"

#include "capi/convert.hpp"
#include "capi/filter_handle.hpp"

namespace cairn {
namespace capi {
namespace {

cairn_wheels default_wheels() {
  const Wheels d;
  cairn_wheels wheels = {};
  wheels.struct_size = sizeof wheels;
  wheels.yaw_sign = CAIRN_YAW_RIGHT_MINUS_LEFT;
  wheels.radius = d.radius;
  wheels.track = d.track;
  wheels.rate_sigma = d.rate_sigma;
  wheels.slip_sigma = d.slip_sigma;
  wheels.lateral_sigma = d.lateral_sigma;
  wheels.vertical_sigma = d.vertical_sigma;
  wheels.roll_rate_sigma = d.roll_rate_sigma;
  wheels.pitch_rate_sigma = d.pitch_rate_sigma;
  return wheels;
}

cairn_twist_noise default_twist_noise() {
  const TwistNoise d;
  cairn_twist_noise noise = {};
  noise.struct_size = sizeof noise;
  std::copy_n(d.velocity_sigma.data(), 3, noise.velocity_sigma);
  std::copy_n(d.rate_sigma.data(), 3, noise.rate_sigma);
  return noise;
}

}  // namespace

Wheels read_wheels(const cairn_wheels* user) {
  const cairn_wheels w = read_options(user, default_wheels(), "wheels");
  if (w.yaw_sign != CAIRN_YAW_RIGHT_MINUS_LEFT && w.yaw_sign != CAIRN_YAW_LEFT_MINUS_RIGHT)
    throw Error(ErrorCode::argument, "wheels.yaw_sign = %d is none of the CAIRN_YAW_ constants; use one of them",
                w.yaw_sign);
  check_positive(w.radius, "wheels.radius");
  check_positive(w.track, "wheels.track");
  check_sigma_or_zero(w.rate_sigma, "wheels.rate_sigma");
  check_sigma_or_zero(w.slip_sigma, "wheels.slip_sigma");
  check_sigma_or_zero(w.lateral_sigma, "wheels.lateral_sigma");
  check_sigma_or_zero(w.vertical_sigma, "wheels.vertical_sigma");
  check_sigma_or_zero(w.roll_rate_sigma, "wheels.roll_rate_sigma");
  check_sigma_or_zero(w.pitch_rate_sigma, "wheels.pitch_rate_sigma");
  return {w.yaw_sign == CAIRN_YAW_LEFT_MINUS_RIGHT,
          w.radius,
          w.track,
          w.rate_sigma,
          w.slip_sigma,
          w.lateral_sigma,
          w.vertical_sigma,
          w.roll_rate_sigma,
          w.pitch_rate_sigma};
}

TwistNoise read_twist_noise(const cairn_twist_noise* user) {
  const cairn_twist_noise n = read_options(user, default_twist_noise(), "noise");
  check_reserved(n.reserved, "noise.reserved");
  check_sigma_or_zero(n.velocity_sigma, 3, "noise.velocity_sigma");
  check_sigma_or_zero(n.rate_sigma, 3, "noise.rate_sigma");
  return {Vector3(n.velocity_sigma), Vector3(n.rate_sigma)};
}

}  // namespace capi
}  // namespace cairn

using namespace cairn;
using namespace cairn::capi;

extern "C" {

cairn_status cairn_wheels_init(cairn_wheels* wheels, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(wheels, struct_size, default_wheels(), "wheels"); });
}

cairn_status cairn_twist_noise_init(cairn_twist_noise* noise, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(noise, struct_size, default_twist_noise(), "noise"); });
}

cairn_status cairn_filter_set_wheels(cairn_filter* filter, const cairn_wheels* wheels, cairn_error* error) {
  return guard(error, [&] { with_filter(filter, [&](auto& f) { f.set_wheels(read_wheels(wheels)); }); });
}

cairn_status cairn_filter_set_twist_noise(cairn_filter* filter, const cairn_twist_noise* noise, cairn_error* error) {
  return guard(error, [&] { with_filter(filter, [&](auto& f) { f.set_twist_noise(read_twist_noise(noise)); }); });
}

cairn_status cairn_filter_predict_wheels(cairn_filter* filter, double dt, double left_rad_per_s, double right_rad_per_s,
                                         cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_positive(dt, "dt");
      check_finite(left_rad_per_s, "left_rad_per_s");
      check_finite(right_rad_per_s, "right_rad_per_s");
      f.predict_wheels(dt, left_rad_per_s, right_rad_per_s);
    });
  });
}

cairn_status cairn_filter_predict_wheels_gyro(cairn_filter* filter, double dt, double left_rad_per_s,
                                              double right_rad_per_s, const double rate[3], cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_positive(dt, "dt");
      check_finite(left_rad_per_s, "left_rad_per_s");
      check_finite(right_rad_per_s, "right_rad_per_s");
      check_pointer(rate, "rate");
      check_finite(rate, 3, "rate");
      f.predict_wheels_gyro(dt, left_rad_per_s, right_rad_per_s, Vector3(rate));
    });
  });
}

cairn_status cairn_filter_predict_twist(cairn_filter* filter, double dt, const double velocity[3], const double rate[3],
                                        cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_positive(dt, "dt");
      check_pointer(velocity, "velocity");
      check_finite(velocity, 3, "velocity");
      check_pointer(rate, "rate");
      check_finite(rate, 3, "rate");
      f.predict_twist(dt, Vector3(velocity), Vector3(rate));
    });
  });
}

cairn_status cairn_filter_predict_increment(cairn_filter* filter, const cairn_pose* T_before_after,
                                            const double covariance[36], cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      using Pose = PoseOf<decltype(f)>;
      Increment<Pose> increment;
      increment.T_before_after = read_pose_of<Pose>(T_before_after, "T_before_after");
      increment.covariance = read_pose_covariance<Pose>(covariance, "covariance");
      f.propagate(increment);
    });
  });
}

}  // extern "C"
