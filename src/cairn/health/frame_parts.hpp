// SPDX-License-Identifier: BSD-3-Clause
// What one frame says about noise, in independent numbers (docs/trust.md, eq. 4).
#pragma once

#include "linear/small_algebra.hpp"

namespace cairn {

struct FrameParts {
  static constexpr Index kMostCommon = 6;

  // A direction of the pose in which the motion has noise: E[square] = alpha + beta weight.
  struct Common {
    double weight, square;
  };
  Common common[kMostCommon] = {};
  Index commons = 0;
  // The other directions of the pose. If the motion is as stated: E[rest] = alpha rest_dof.
  double rest = 0.0;
  Index rest_dof = 0;
  // What no motion of the pose explains: E[residual] = alpha residual_dof.
  double residual = 0.0;
  Index residual_dof = 0;
  Index blocks = 0;  // observations that were used
};

}  // namespace cairn
