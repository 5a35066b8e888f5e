// SPDX-License-Identifier: BSD-3-Clause
// The ground: a smooth, unbounded height field.
#pragma once

#include <cairn/sim.h>

#include <vector>

#include "geometry/types.hpp"

namespace cairn::sim {

class Terrain {
 public:
  explicit Terrain(const cairn_world_options& options);

  double height(double x, double y) const;
  Vector2 slope(double x, double y) const;  // d height / d(x, y)

 private:
  // amplitude sin(k . p + phase)
  struct Wave {
    double kx, ky, phase, amplitude;
  };

  int kind_;
  std::vector<Wave> waves_;
  double shift_ = 0;
};

}  // namespace cairn::sim
