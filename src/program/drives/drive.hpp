// SPDX-License-Identifier: BSD-3-Clause
// The input of a filter, step by step, recorded or simulated.
#pragma once

#include <cairn/cairn.h>
#include <cairn/sim.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "program/logs/log.hpp"

namespace cairn::program {

// Turning rates of left and right wheels (rad/s), held for `dt` seconds.
struct WheelTurn {
  double dt;
  double left;
  double right;
  std::optional<std::array<double, 3>> rate;  // of a gyro, rad/s
};

// The motions that lead to a step, its observations, and the truth. Valid until the next step.
struct DriveStep {
  std::size_t index = 0;  // from 0
  std::uint64_t number = 0;
  double time = 0;  // s; NaN if it is not known
  const logs::Increment* increment = nullptr;
  std::vector<logs::Twist> twists;
  std::vector<WheelTurn> wheel_turns;
  std::optional<cairn_twist_noise> noise;  // of the twists, if it has changed
  double pan = 0;                          // of a stereo head, rad
  double stick = 0;
  const cairn_observation* observations = nullptr;
  std::size_t count = 0;
  std::optional<cairn_pose> truth;
};

class Drive {
 public:
  Drive() = default;
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;
  virtual ~Drive() = default;

  virtual std::size_t steps() const = 0;
  virtual cairn_pose start() const = 0;
  // Whether the vehicle moves in the plane z = 0.
  virtual bool planar() const { return false; }
  virtual std::size_t largest_frame() const = 0;
  // The largest number of landmarks that a filter holds at once if it forgets those that were not seen for
  // `forget_after` frames (0: never).
  virtual std::size_t landmarks_at_once(std::uint64_t forget_after) const = 0;
  // Gives the filter its sensor and the noise of the motion. Returns the sensor's number.
  virtual std::int32_t equip(cairn_filter* filter) const = 0;
  // Whether each step contains the angles of the sensor's mount.
  virtual bool has_mount() const = 0;
  // False after the last step.
  virtual bool next(DriveStep& step) = 0;
  // False if it is not known.
  virtual bool true_landmark(std::uint64_t id, double position[3]) const = 0;
  // The world of a simulated drive, or NULL.
  virtual const cairn_world* world() const { return nullptr; }
};

}  // namespace cairn::program
