// SPDX-License-Identifier: BSD-3-Clause
// What a team is worth to a vehicle: what its covariance claims, and what the truth says.
#pragma once

#include <cmath>
#include <cstdint>

#include "ekf/state.hpp"

namespace cairn {

struct Score {
  std::uint64_t steps = 0, nees_steps = 0;
  double claimed = 0.0, claimed_alone = 0.0;        // sums of ||C_qq||, Frobenius
  double squared_error = 0.0, squared_alone = 0.0;  // sums of squared position errors, m^2
  double nees = 0.0;

  // IR = (||C_qq||_mono - ||C_qq||) / ||C_qq||_mono (cooperative paper, section 3), by the means over all steps.
  double claimed_improvement() const { return claimed_alone > 0.0 ? 1.0 - claimed / claimed_alone : 0.0; }
  double true_improvement() const { return squared_alone > 0.0 ? 1.0 - squared_error / squared_alone : 0.0; }
  double anees_per_dof() const { return nees_steps > 0 ? nees / (3.0 * static_cast<double>(nees_steps)) : 0.0; }
  double position_rmse() const { return steps > 0 ? std::sqrt(squared_error / static_cast<double>(steps)) : 0.0; }
};

}  // namespace cairn
