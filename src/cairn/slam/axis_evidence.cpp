// SPDX-License-Identifier: BSD-3-Clause
#include "slam/axis_evidence.hpp"

#include <algorithm>

#include "core/chi_square.hpp"

namespace cairn {

ForgottenSums::ForgottenSums() {
  constexpr double kChance = 1e-7, kMedian = 0.5;
  // A sum of such variables with weights w is about s chi2(k): s = sum w^2 / sum w, k = (sum w)^2 / sum w^2.
  double sum = 0.0, squares = 0.0;
  doubtful_[0] = calm_[0] = 0.0;
  for (Index n = 1; n <= kMost; ++n) {
    sum = kForget * sum + 1.0;
    squares = kForget * kForget * squares + 1.0;
    doubtful_[n] = squares / sum * chi_square_quantile(sum * sum / squares, 1.0 - kChance);
    calm_[n] = squares / sum * chi_square_quantile(sum * sum / squares, kMedian);
  }
}

const ForgottenSums& ForgottenSums::shared() {
  static const ForgottenSums sums;
  return sums;
}

// The stated noise has explained the past: the mean of g / b, which should be 1.
template <class Pose>
bool AxisEvidence<Pose>::Axis::trusted() const {
  constexpr double kEnough = 25.0, kGood = 1.6;
  return record_count > kEnough && record < kGood * record_count;
}

template <class Pose>
bool AxisEvidence<Pose>::weigh(const ForgottenSums& bounds, const double* J, const double* r, Index rows,
                               const Square& axes, Square& widening) {
  constexpr double kForgetRecord = 0.99;
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, kDof>> whitened(J, rows, kDof);
  const Eigen::Map<const Eigen::VectorXd> residual(r, rows);
  typename Pose::Tangent a;  // J^T S^-1 r
  Square B;                  // J^T S^-1 J
  for (int c = 0; c < kDof; ++c) {
    a(c) = whitened.col(c).dot(residual);
    for (int d = 0; d <= c; ++d) B(c, d) = B(d, c) = whitened.col(c).dot(whitened.col(d));
  }
  bool wider = false;
  for (int i = 0; i < kDof; ++i) {
    const typename Pose::Tangent u = axes.col(i);
    // (F4): E[g] = b if the motion is as told, b + v b^2 if its variance along u is larger by v.
    const double b = u.dot(B * u), g = u.dot(a) * u.dot(a);
    if (!(b > 0.0)) continue;
    Axis& axis = axes_[i];
    axis.ratio = ForgottenSums::kForget * axis.ratio + g / b;
    axis.excess = ForgottenSums::kForget * axis.excess + (g - b);
    axis.information = ForgottenSums::kForget * axis.information + b * b;
    axis.samples = std::min(axis.samples + 1, ForgottenSums::kMost);
    // The record of the past decides, without this frame. A frame that does not lead to a widening enters the record,
    // whatever it says: a source that contradicts the motion again and again is not believed.
    axis.wider = axis.wider ? axis.ratio > bounds.calm(axis.samples)
                            : axis.trusted() && axis.ratio > bounds.doubtful(axis.samples);
    if (!axis.wider) {
      axis.record = kForgetRecord * axis.record + g / b;
      axis.record_count = kForgetRecord * axis.record_count + 1.0;
    }
    if (!axis.wider || !(axis.excess > 0.0)) continue;
    widening += axis.excess / axis.information * u * u.transpose();  // (F5)
    wider = true;
  }
  return wider;
}

template class AxisEvidence<SE2>;
template class AxisEvidence<SE3>;

}  // namespace cairn
