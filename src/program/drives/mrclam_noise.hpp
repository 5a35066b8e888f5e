// SPDX-License-Identifier: BSD-3-Clause
// The noise of the robots of a MRCLAM folder, and its derivation: docs/mrclam.md.
#pragma once

namespace cairn::program {

struct MrclamNoise {
  double speed = 0.03;    // of the odometry's speed, m/s per square root of Hz
  double rate = 0.06;     // of its rate of turn, rad/s per square root of Hz
  double range = 0.2;     // in proportion to the range
  double bearing = 0.06;  // rad
};

}  // namespace cairn::program
