// SPDX-License-Identifier: BSD-3-Clause
// A recorded run, independent of its file format: the motions, the observations, and the truth if it is known.
#pragma once

#include <cairn/cairn.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace cairn::program::logs {

// The file is no log, or the log is broken. The message is one line: file, line or variable, cause.
class LogError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Relative pose of a step, and the covariance of its error [dp; dtheta] in the axes of the body before.
struct Increment {
  cairn_pose T_before_after;
  std::array<double, 36> covariance;
};

// Body velocity (m/s) and rate (rad/s), held for `dt` seconds.
struct Twist {
  double dt;
  std::array<double, 3> velocity;
  std::array<double, 3> rate;
};

struct Step {
  std::uint64_t number = 0;                                // as counted in the log
  double time = std::numeric_limits<double>::quiet_NaN();  // s; NaN if the log has none
  std::optional<Increment> increment;                      // motion that leads to this step: one of these two,
  std::optional<Twist> twist;                              // none at the first step
  std::vector<cairn_observation> observations;
  std::optional<cairn_pose> truth;  // body in the map frame; if any step has it, the first one has it
};

enum class SensorKind { kStereoHead, kStereoCamera, kCartesian, kRangeBearing };

struct Log {
  std::string format;              // for people
  std::vector<std::string> notes;  // what the reader left out
  bool planar = false;             // the vehicle moves in the plane z = 0
  SensorKind sensor = SensorKind::kStereoHead;
  cairn_stereo_head head{};                                  // if the sensor is a stereo head
  cairn_stereo_camera camera{};                              // if it is a stereo camera
  cairn_twist_noise twist_noise{};                           // of every twist, with the stereo camera
  cairn_cartesian cartesian{};                               // if it gives points; each observation has its covariance
  cairn_range_bearing radar{};                               // if it gives ranges and bearings; the same
  std::vector<Step> steps;                                   // never empty
  std::map<std::uint64_t, std::array<double, 3>> landmarks;  // true positions, m
};

// Noise that replaces the file's, as standard deviations.
struct NoiseOverride {
  std::optional<double> pixel;     // u_left and u_right; v, a mean of two rows, gets it over sqrt(2)
  std::optional<double> velocity;  // m/s, each axis
  std::optional<double> rate;      // rad/s, each axis
};

// Reads a log; its content decides its kind. Throws LogError.
Log read_log(const std::string& path, const NoiseOverride& noise);

// The kinds. `text` is the file's whole content.
Log read_neutral_log(const std::string& path, const std::string& text);
Log read_isam_log(const std::string& path, const std::string& text);
Log read_stars_log(const std::string& path, const std::string& content, const NoiseOverride& noise);

}  // namespace cairn::program::logs
