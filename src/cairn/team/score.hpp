// SPDX-License-Identifier: BSD-3-Clause
// The benefit of a team to a vehicle: by its covariance, and by the truth. The comparison is with a filter of this
// vehicle only, which runs beside the team.
#pragma once

#include <cstdint>

#include "team/team.hpp"

namespace cairn {

// A filter of this vehicle only. Errors of this comparison filter are ignored.
class Baseline {
 public:
  explicit Baseline(const TeamOptions& options);
  void propagate(const Increment<SE2>& increment);
  void observe(const std::vector<Observation>& landmarks);
  const Filter<SE2>& filter() const { return own_.filter(); }

 private:
  VehicleFilter own_;
};

class Score {
 public:
  // Scores the team's current estimate against the truth; `baseline` is null if there is no comparison filter.
  void add(const Team& team, const Baseline* baseline, const SE2& truth);

  std::uint64_t steps() const { return steps_; }
  std::uint64_t nees_steps() const { return nees_steps_; }  // with a covariance that is not singular
  double position_rmse() const;
  double anees_per_dof() const;
  // IR = (||C_qq||_mono - ||C_qq||) / ||C_qq||_mono (cooperative paper, section 3), by the means over all steps.
  double claimed_improvement() const;
  double true_improvement() const;

 private:
  std::uint64_t steps_ = 0, nees_steps_ = 0;
  double claimed_ = 0.0, baseline_claimed_ = 0.0;              // sums of ||C_qq||, Frobenius
  double squared_error_ = 0.0, baseline_squared_error_ = 0.0;  // sums of squared position errors, m^2
  double nees_ = 0.0;
};

}  // namespace cairn
