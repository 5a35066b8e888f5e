// SPDX-License-Identifier: BSD-3-Clause
// One robot of a MRCLAM folder on its way through its records.
#pragma once

#include "program/drives/mrclam_noise.hpp"
#include "program/drives/team_drive.hpp"
#include "program/logs/mrclam_log.hpp"

namespace cairn::program {

class RobotTrack {
 public:
  // Starts at the robot's first odometry. `log` and `robot`, one of its robots, have to live as long as the track.
  RobotTrack(const logs::MrclamLog& log, const logs::MrclamLog::Robot& robot, const MrclamNoise& noise)
      : log_(log), robot_(robot), noise_(noise), time_(robot.odometry.front().time) {}

  bool started(double time) const { return time >= robot_.odometry.front().time; }
  // Adds the motions up to `time`, and the observations made at `time`.
  void advance(double time, VehicleStep& step);

 private:
  void move(double time, VehicleStep& step);
  void look(double time, VehicleStep& step);

  const logs::MrclamLog& log_;
  const logs::MrclamLog::Robot& robot_;
  MrclamNoise noise_;
  double time_;  // the robot has moved up to here
  std::size_t odometry_ = 0, measurement_ = 0;
};

// The sensor of all robots. Each observation has a covariance of its own; `noise` is that of an observation at 1 m.
cairn_range_bearing robot_radar(const MrclamNoise& noise);

}  // namespace cairn::program
