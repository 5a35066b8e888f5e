// SPDX-License-Identifier: BSD-3-Clause
// A rover whose velocity, rate, wheels and head are wrong, in a world of libcairn_sim, and a filter that follows it.
#pragma once

#include <cairn/cairn.h>
#include <cairn/sim.h>

#include <cstddef>
#include <vector>

namespace consistency {

// Standard deviations of the errors, which are the filter's priors, too: velocity bias, m/s; rate bias, rad/s; scale of
// a wheel; turn of the mount, rad.
constexpr double kVelocityBias = 0.15, kRateBias = 2e-3, kWheelScale = 0.02, kMountTurn = 3.14159265358979323846 / 180;

struct Rover {
  bool wheels = false;       // wheels and gyro instead of velocity and rate
  bool known_mount = false;  // the mount is not turned and is no state
  int32_t preset = CAIRN_PRESET_ROW2;
  double laps = 0;          // 0: that of the preset
  double camera_noise = 1;  // times that of the preset
  double rate = kRateBias, velocity = kVelocityBias;
};

struct Follower {
  const char* name;
  bool wrong, knows;  // the rover has errors; the filter estimates them
  uint32_t submap_landmarks;
  int32_t join;
  // All that is drawn is this times its stated size: noise of motion and sensor, and systematic errors. The filter is
  // told the stated size.
  double drawn;
};

// Sums over runs. Errors and NEES are in units of what is drawn: divided by `Follower::drawn` and by its square.
struct Score {
  std::vector<double> nees;  // by step
  double squares = 0.0;      // of the position
  double sensor_squares = 0.0;
  double variance = 0.0;  // trace of the covariance of the position
  long steps = 0;
};

// One drive through the world of a seed. Its errors are added to `score`.
void drive(const Rover& rover, const Follower& follower, int seed, Score& score);

}  // namespace consistency
