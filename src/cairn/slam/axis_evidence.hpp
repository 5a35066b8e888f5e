// SPDX-License-Identifier: BSD-3-Clause
// Whether the innovations of a vehicle agree with the stated noise of its motion, for each axis of the body
// (docs/update.md, "Finding back").
#pragma once

#include <Eigen/Core>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

// The bounds of a sum of n chi-square variables with one degree of freedom each, forgotten exponentially.
class ForgottenSums {
 public:
  static constexpr double kForget = 0.9;  // weight of a frame against the next one
  static constexpr Index kMost = 64;      // the bounds do not change any more

  ForgottenSums();
  static const ForgottenSums& shared();  // the same for all filters: computed once, by the first one
  double doubtful(Index samples) const { return doubtful_[samples]; }  // exceeded by chance once in 700,000 frames
  double calm(Index samples) const { return calm_[samples]; }          // the median

 private:
  double doubtful_[kMost + 1], calm_[kMost + 1];
};

template <class Pose>
class AxisEvidence {
 public:
  static constexpr int kDof = Pose::kDof;
  using Square = typename Pose::Square;

  // J = L^-1 dr/d[dp; dtheta] (kDof columns) and r = L^-1 residual of an update's rows with S = L L^T. The columns of
  // `axes` are unit errors of the body's axes. Returns true if the motion has to be widened: adds the covariance of the
  // additional error to `widening`.
  bool weigh(const ForgottenSums& bounds, const double* J, const double* r, Index rows, const Square& axes,
             Square& widening);

 private:
  struct Axis {
    double ratio;                 // sum of g / b
    double excess, information;   // sums of g - b and b^2
    double record, record_count;  // sums of g / b and of 1 outside widenings, forgotten slowly
    Index samples;
    bool wider;
    bool trusted() const;
  };
  Axis axes_[kDof];
};

extern template class AxisEvidence<SE2>;
extern template class AxisEvidence<SE3>;

}  // namespace cairn
