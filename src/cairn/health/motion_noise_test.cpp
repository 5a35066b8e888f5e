// SPDX-License-Identifier: BSD-3-Clause
#include "health/motion_noise_test.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

// Noise of the sensor makes all innovations too large, also those that do not correct the pose. `rest`: the sum of
// their squares.
double sensor_factor(double rest, Index dof) {
  constexpr double kClear = 4.0;  // standard deviations
  const auto expected = static_cast<double>(dof);
  return dof > 0 && rest > expected + kClear * std::sqrt(2.0 * expected) ? rest / expected : 1.0;
}

}  // namespace

template <class Pose>
void MotionNoiseTest<Pose>::add(const Correction<Pose>& correction, double nis, Index rows, double sensor) {
  constexpr double kShare = 0.5;  // of an error that an update takes off
  // If the motion's noise has 1.5 times the stated standard deviation: the variance of (10) given the corrections
  // before, and the gain of the filter that foresees it.
  constexpr double kVariance = 1.381543, kGain = 0.276172;
  constexpr double kMost = 3.0;  // of a step: three updates are the least that exceed the bound
  typename Pose::Tangent x;
  if (!correction.whiten(x)) return;
  x /= std::sqrt(std::max({1.0, sensor, sensor_factor(nis - x.squaredNorm(), rows - Pose::kDof)}));
  const typename Pose::Tangent e = x - expected_;
  static const double log_variance = std::log(kVariance);
  const double step = 0.5 * (x.squaredNorm() - e.squaredNorm() / kVariance - Pose::kDof * log_variance);
  expected_ = (1.0 - kShare) * (expected_ + kGain * e);
  sum_.add(std::min(step, kMost), kBound);
  if (sum_.at_zero()) expected_.setZero();
}

template <class Pose>
bool MotionNoiseTest<Pose>::found() const {
  return sum_.found(kBound);
}

template class MotionNoiseTest<SE2>;
template class MotionNoiseTest<SE3>;

}  // namespace cairn
