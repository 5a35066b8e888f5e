// SPDX-License-Identifier: BSD-3-Clause
// The input of a team, step by step, recorded or simulated.
#pragma once

#include <cairn/cairn.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "program/logs/planar.hpp"

namespace cairn::program {

using logs::planar_pose;

// A planar body's speed and rate of turn, held for `dt` seconds, and their noise over that time.
struct TeamMotion {
  double dt;     // s
  double speed;  // m/s
  double rate;   // rad/s
  double speed_sigma;
  double rate_sigma;
};

// One vehicle's step: its motions since the step before, then its scan.
struct VehicleStep {
  std::vector<TeamMotion> motions;
  std::vector<cairn_observation> landmarks;  // by true ids
  std::vector<cairn_observation> vehicles;
  std::optional<cairn_pose> truth;
};

struct TeamStep {
  double time = 0;  // s
  std::vector<VehicleStep> vehicles;
};

class TeamDrive {
 public:
  TeamDrive() = default;
  TeamDrive(const TeamDrive&) = delete;
  TeamDrive& operator=(const TeamDrive&) = delete;
  virtual ~TeamDrive() = default;

  virtual const std::vector<std::uint64_t>& vehicles() const = 0;  // their numbers
  virtual std::size_t steps() const = 0;
  virtual cairn_pose start(std::size_t vehicle) const = 0;
  // 6 x 6, of the error of the start; NULL: known exactly.
  virtual const double* start_covariance(std::size_t) const { return nullptr; }
  virtual cairn_range_bearing radar() const = 0;
  virtual std::uint32_t landmarks() const = 0;      // at most
  virtual std::uint32_t largest_frame() const = 0;  // landmarks and vehicles
  virtual double submap_distance() const = 0;       // after which a submap is closed, m
  virtual bool next(TeamStep& step) = 0;            // false after the last step
  virtual bool true_landmark(std::uint64_t id, double position[2]) const = 0;
};

}  // namespace cairn::program
