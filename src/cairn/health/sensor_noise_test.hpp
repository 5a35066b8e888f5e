// SPDX-License-Identifier: BSD-3-Clause
// Whether a sensor's noise is more than 1.5 times what is stated: a cumulative sum of the residuals of its frames
// (docs/trust.md, eq. 4 and 8).
#pragma once

#include <algorithm>
#include <cmath>

#include "health/cumulative_sum.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

class SensorNoiseTest {
 public:
  // `residual`: of `dof` degrees of freedom, for the stated noise. `used`: factor of the variances that is in use.
  void add(double residual, Index dof, double used) {
    if (!std::isfinite(residual)) return;
    const auto expected = static_cast<double>(dof);
    sum_.add(std::min(residual / used, kMost * expected) - kHonest * expected, kBound);
  }
  bool found() const { return sum_.found(kBound); }

 private:
  // Two differences of a landmark in a row share an observation, which makes the variance of a residual 1.5 times that
  // of chi-square. With E[exp(t (residual - kHonest dof))] = 1 for t = 0.28 the sum of an honest sensor exceeds kBound
  // with a probability of about exp(-0.28 kBound) = 1e-5 at a frame.
  static constexpr double kHonest = 2.25, kBound = 40.0;
  static constexpr double kMost = 9.0;  // of the expectation

  CumulativeSum sum_;
};

}  // namespace cairn
