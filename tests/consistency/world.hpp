// SPDX-License-Identifier: BSD-3-Clause
// The simulated world of the consistency tests: a rover on a circle over rolling ground, among landmarks. It does not
// depend on the filter. Its measurements have exactly the noise that it states.
#pragma once

#include <cairn/cairn.h>

#include <random>
#include <vector>

namespace consistency {

struct Noise {
  double velocity = 0.05;   // m/s, each axis and sample
  double rate = 0.0035;     // rad/s, each axis and sample
  double range = 1.0;       // m
  double bearing = 0.0524;  // rad, azimuth and elevation
};

// Random numbers that are the same everywhere. The engine of <random> is portable, its distributions are not.
class Random {
 public:
  explicit Random(unsigned long long seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) / 9007199254740992.0);
  }
  double normal(double sigma);

 private:
  std::mt19937_64 engine_;
};

class World {
 public:
  static constexpr double kDuration = 400, kStep = 0.2;  // s
  static constexpr int kSteps = 2000, kStepsPerFrame = 10, kFrames = kSteps / kStepsPerFrame;
  static constexpr int kLandmarks = 200;

  World(const Noise& noise, int laps, unsigned long long seed);

  // The true pose after `step` steps.
  cairn_pose pose(int step) const;
  // Measured body velocity and rate from `step` to the next step.
  void twist(int step, double velocity[3], double rate[3]);
  // The observations at a step: landmarks between 2 m and 40 m, within 60 degrees to both sides.
  const std::vector<cairn_observation>& look(int step);

 private:
  struct Frame {
    double R[3][3], p[3];  // body to world
  };
  Frame frame(int step) const;

  Noise noise_;
  int laps_;
  Random random_;
  double landmarks_[kLandmarks][3];
  std::vector<cairn_observation> seen_;
};

}  // namespace consistency
