// SPDX-License-Identifier: BSD-3-Clause
// The start of a robot that has no true pose there.
#pragma once

#include <array>
#include <optional>

#include "program/drives/mrclam_noise.hpp"
#include "program/logs/mrclam_log.hpp"
#include "program/logs/planar.hpp"

namespace cairn::program {

struct RobotStart {
  logs::PlanarPose pose;
  std::array<double, 36> covariance = {};  // of its error [dp; dtheta]; zero: known exactly
};

// The pose at the robot's first odometry in the frame of the true posts. The robot maps posts from an arbitrary start
// for a while; the start is the one that lays this map on the true posts. Empty if it saw too few posts to tell its
// heading.
std::optional<RobotStart> start_from_posts(const logs::MrclamLog& log, const logs::MrclamLog::Robot& robot,
                                           const MrclamNoise& noise);

}  // namespace cairn::program
