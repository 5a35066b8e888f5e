// SPDX-License-Identifier: BSD-3-Clause
// How clearly the landmarks that the gates of a closing refuse contradict the others.
#pragma once

#include <algorithm>
#include <limits>

#include "linear/joint_gate.hpp"

namespace cairn {

// Hears each refusal of gate_blocks(). A landmark that the single gate refuses has its squared distance. A landmark
// that the joint gate refuses has that by which the joint distance falls without it.
class Refusals {
 public:
  void add(Gate gate, double distance, double bound) {
    if (gate == Gate::single) {
      worst_ = std::max(worst_, distance >= 0.0 ? distance : std::numeric_limits<double>::infinity());
    } else {
      worst_ = std::max(worst_, joint_ - distance);
      joint_ = distance;
      bound_ = bound;
    }
  }
  // The largest squared distance of a refused landmark; 0 if there is none. The fall by the last landmark is at least
  // what exceeded the bound.
  double worst() const { return std::max(worst_, joint_ - bound_); }

 private:
  double worst_ = 0.0;
  double joint_ = 0.0, bound_ = 0.0;  // before the last refusal of the joint gate
};

}  // namespace cairn
