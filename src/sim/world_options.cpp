// SPDX-License-Identifier: BSD-3-Clause
// Defaults, presets and checks of the options of a world.
#include "sim/world_options.hpp"

#include <cmath>
#include <limits>

#include "capi/boundary.hpp"
#include "geometry/angle.hpp"
#include "sim/checks.hpp"
#include "sim/course.hpp"

namespace cairn::sim {
namespace {

constexpr double kDegree = kPi / 180;

// The range is (0, upper], or [0, upper] if `zero`.
void check_angle(double value, bool zero, double upper, const char* name) {
  if (!zero) capi::check_positive(value, name);
  capi::check_range(value, 0, upper, name);
}

void check_multiple(double period, double of, const char* name, const char* of_name) {
  capi::check_positive(period, name);
  constexpr double kMost = 1e6;
  const double ratio = period / of;
  if (!(ratio > 0.5 && ratio < kMost) || std::abs(ratio - std::round(ratio)) > 1e-9 * ratio)
    throw Error(ErrorCode::argument, "%s = %g must be a multiple (at most %g times) of %s = %g", name, period, kMost,
                of_name, of);
}

void check_choices(const cairn_world_options& o) {
  check_choice(o.course, CAIRN_COURSE_TRAVERSE, "course", "CAIRN_COURSE_");
  check_choice(o.terrain, CAIRN_TERRAIN_FLAT, "terrain", "CAIRN_TERRAIN_");
  check_choice(o.contact, CAIRN_CONTACT_POINT, "contact", "CAIRN_CONTACT_");
  check_choice(o.drive, CAIRN_DRIVE_WHEELS_GYRO, "drive", "CAIRN_DRIVE_");
  check_choice(o.accelerometer, CAIRN_ACCELEROMETER_ACCELERATION, "accelerometer", "CAIRN_ACCELEROMETER_");
  check_choice(o.stick_noise, CAIRN_STICK_PER_FRAME, "stick_noise", "CAIRN_STICK_");
  capi::read_bool(o.observe_at_start, "options.observe_at_start");
  capi::read_bool(o.traverse_closed, "options.traverse_closed");
}

void check_course(const cairn_world_options& o) {
  capi::check_range(o.landmarks, 1, 10000000, "options.landmarks");
  capi::check_positive(o.speed, "options.speed");
  capi::check_not_negative(o.laps, "options.laps");
  capi::check_finite(o.centre, 2, "options.centre");
  capi::check_not_negative(o.radius, "options.radius");
  capi::check_finite(o.start_azimuth, "options.start_azimuth");
  capi::check_positive(o.round_length, "options.round_length");
  capi::check_range(o.round_variation, 0, 0.3, "options.round_variation");
  capi::check_positive(o.strip, "options.strip");
  capi::check_positive(o.landmark_area, "options.landmark_area");
  capi::check_not_negative(o.landmark_height, "options.landmark_height");
}

void check_ground_and_rover(const cairn_world_options& o) {
  check_angle(o.max_slope, true, 45 * kDegree, "options.max_slope");
  capi::check_positive(o.wavelength, 2, "options.wavelength");
  if (o.wavelength[0] > o.wavelength[1])
    throw Error(ErrorCode::argument, "options.wavelength[0] = %g must not exceed options.wavelength[1] = %g",
                o.wavelength[0], o.wavelength[1]);
  capi::check_finite(o.start_height, "options.start_height");
  capi::check_positive(o.wheel_radius, "options.wheel_radius");
  capi::check_positive(o.track, "options.track");
  capi::check_positive(o.wheelbase, "options.wheelbase");
  capi::check_not_negative(o.gravity, "options.gravity");
}

void check_noise_and_head(const cairn_world_options& o) {
  capi::check_not_negative(o.velocity_sigma, "options.velocity_sigma");
  capi::check_not_negative(o.rate_sigma, "options.rate_sigma");
  capi::check_not_negative(o.wheel_rate_sigma, "options.wheel_rate_sigma");
  capi::check_not_negative(o.wheel_slip_sigma, "options.wheel_slip_sigma");
  capi::check_not_negative(o.lateral_sigma, "options.lateral_sigma");
  capi::check_not_negative(o.vertical_sigma, "options.vertical_sigma");
  capi::check_positive(o.imu_period, "options.imu_period");
  check_multiple(o.motion_period, o.imu_period, "options.motion_period", "options.imu_period");
  check_multiple(o.frame_period, o.motion_period, "options.frame_period", "options.motion_period");
  capi::check_positive(o.range_sigma, "options.range_sigma");
  capi::check_positive(o.azimuth_sigma, "options.azimuth_sigma");
  capi::check_positive(o.stick_sigma, "options.stick_sigma");
  capi::check_positive(o.image_sigma, "options.image_sigma");
  capi::check_positive(o.near_range, "options.near_range");
  capi::check_positive(o.far_range, "options.far_range");
  if (o.far_range <= o.near_range)
    throw Error(ErrorCode::argument, "options.far_range = %g must exceed options.near_range = %g", o.far_range,
                o.near_range);
  check_angle(o.half_azimuth, false, kPi, "options.half_azimuth");
  check_angle(o.pan_amplitude, true, kPi, "options.pan_amplitude");
  capi::check_positive(o.pan_period, "options.pan_period");
  check_angle(o.stick_amplitude, true, 60 * kDegree, "options.stick_amplitude");
  capi::check_positive(o.stick_period, "options.stick_period");
  capi::check_finite(o.platform, 3, "options.platform");
  capi::check_finite(o.stick, 3, "options.stick");
  capi::check_finite(o.velocity_bias, 3, "options.velocity_bias");
  capi::check_finite(o.rate_bias, 3, "options.rate_bias");
  for (const double scale : o.wheel_scale) {
    capi::check_finite(scale, "options.wheel_scale");
    if (!(scale > -1.0))
      throw Error(ErrorCode::argument, "options.wheel_scale = %g must exceed -1; a wheel turns forward", scale);
  }
  capi::check_finite(o.mount_turn, 3, "options.mount_turn");
  capi::check_finite(o.mount_shift, 3, "options.mount_shift");
  capi::check_finite(o.value_offset, 3, "options.value_offset");
}

}  // namespace

cairn_world_options default_world_options() {
  cairn_world_options o = {};  // zero means: the first constant of each choice, no offset of the head, no scanning
  o.struct_size = sizeof o;
  o.seed = 1;
  o.landmarks = 200;
  o.speed = 2 * kPi * std::hypot(kStartX, kStartY) / 400;
  o.start_azimuth = std::atan2(kStartY, kStartX);
  o.round_length = 1500;
  o.round_variation = 0.1;
  o.strip = 25;
  o.landmark_area = 160;
  o.landmark_height = 1.5;
  o.max_slope = 15 * kDegree;
  o.wavelength[0] = 25;
  o.wavelength[1] = 150;
  o.start_height = -0.3174;
  o.wheel_radius = 0.3;
  o.track = 1;
  o.wheelbase = 1.2;
  o.velocity_sigma = 2e-3;
  o.rate_sigma = 0.02 * kDegree;
  o.gravity = 3.71;
  o.wheel_rate_sigma = 0.01;
  o.wheel_slip_sigma = 0.02;
  o.lateral_sigma = 0.01;
  o.vertical_sigma = 0.01;
  o.imu_period = 0.05;
  o.motion_period = 0.2;
  o.frame_period = 2;
  o.range_sigma = 1;
  o.azimuth_sigma = 3 * kDegree;
  o.stick_sigma = 3 * kDegree;
  o.image_sigma = 0.5 * kDegree;
  o.near_range = 2;
  o.far_range = 40;
  o.half_azimuth = 60 * kDegree;
  o.pan_period = 20;
  o.stick_period = 26;
  return o;
}

cairn_world_options preset_world_options(std::int32_t preset, std::uint32_t& submap_landmarks) {
  cairn_world_options o = default_world_options();
  submap_landmarks = 40;
  if (preset == CAIRN_PRESET_PAPER) return o;
  struct Row {
    double velocity, rate, laps;
    std::uint32_t submap_landmarks;
  };
  constexpr Row kRows[] = {{0.002, 0.02, 1, 40}, {0.05, 0.2, 1, 40}, {0.05, 0.2, 2, 20}, {0.2, 1, 2, 20}};
  if (preset < CAIRN_PRESET_ROW1 || preset > CAIRN_PRESET_ROW4)
    throw Error(ErrorCode::argument, "preset = %d is none of the CAIRN_PRESET_ constants; use one of them", preset);
  const Row& row = kRows[preset - CAIRN_PRESET_ROW1];
  constexpr double kRadius = 101.98, kDuration = 400;
  o.terrain = CAIRN_TERRAIN_WAVES;
  o.contact = CAIRN_CONTACT_POINT;
  o.radius = kRadius;
  o.laps = row.laps;
  o.speed = 2 * kPi * kRadius * row.laps / kDuration;
  o.velocity_sigma = row.velocity;
  o.rate_sigma = row.rate * kDegree;
  o.imu_period = o.motion_period = 0.2;
  submap_landmarks = row.submap_landmarks;
  return o;
}

cairn_world_options read_world_options(const cairn_world_options* user) {
  const cairn_world_options o = capi::read_options(user, default_world_options(), "options");
  check_choices(o);
  check_course(o);
  check_ground_and_rover(o);
  check_noise_and_head(o);
  return o;
}

}  // namespace cairn::sim
