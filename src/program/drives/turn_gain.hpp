// SPDX-License-Identifier: BSD-3-Clause
// How much of a recorded rate of turn the robots of a MRCLAM folder really turn (docs/mrclam.md, "Turns").
#pragma once

#include <cstddef>

#include "program/logs/mrclam_log.hpp"

namespace cairn::program {

// True over recorded rate, for robots that turn while they drive and that turn on the spot. The two differ because
// the odometry holds commands, and wheels follow a turn differently when they have to drive as well.
struct TurnGain {
  struct Kind {
    double gain = 1;        // 1 unless the sightings show another one
    std::size_t turns = 0;  // turns that were compared
  };
  Kind driving, on_spot;
};

// From posts that one robot saw before and after a turn. It needs neither true poses nor true places of the posts.
TurnGain turn_gain(const logs::MrclamLog& log);

// Multiplies the recorded rates by the gains, and adds a note to the log if one of them is not 1.
void correct_turns(logs::MrclamLog& log);

}  // namespace cairn::program
