// SPDX-License-Identifier: BSD-3-Clause
// Whether the motion's noise is larger than what is stated. Then the filter trusts the motion too much, and the
// corrections of the pose are too large and correlated. A sequential test of likelihoods (docs/trust.md, eq. 10 to 12).
#pragma once

#include "health/correction.hpp"
#include "health/cumulative_sum.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

template <class Pose>
class MotionNoiseTest {
 public:
  // An update of `rows` rows. `sensor`: factor of the variances of the sensor's noise in use, as learned.
  void add(const Correction<Pose>& correction, double nis, Index rows, double sensor);
  bool found() const;

 private:
  static constexpr double kBound = 7.0;

  typename Pose::Tangent expected_ = Pose::Tangent::Zero();  // of (10), if the motion's noise is larger than stated
  CumulativeSum sum_;
};

extern template class MotionNoiseTest<SE2>;
extern template class MotionNoiseTest<SE3>;

}  // namespace cairn
