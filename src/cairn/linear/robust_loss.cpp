// SPDX-License-Identifier: BSD-3-Clause
#include "linear/robust_loss.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

RobustLoss::RobustLoss(LossKind kind, double width) : kind_(kind), width_(width) {
  if (!robust()) return;
  // Means over d, chi-distributed with `rows` degrees of freedom, by the midpoint rule.
  constexpr int kSteps = 4000;
  constexpr double kEnd = 12.0;
  for (int rows = 1; rows <= kMostRows; ++rows) {
    double one = 0.0, w = 0.0, wdd = 0.0, wwdd = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double d = kEnd * (i + 0.5) / kSteps, density = std::pow(d, rows - 1) * std::exp(-0.5 * d * d),
                   at = weight(d * d);
      one += density;
      w += density * at;
      wdd += density * at * d * d;
      wwdd += density * at * at * d * d;
    }
    const double A = wdd / (rows * one), B = wwdd / (rows * one);  // E[psi'], E[psi^2] of one row (L3)
    efficiency_[rows] = A * A / (B * (w / one));
  }
}

double RobustLoss::weight(double squared_distance) const {
  constexpr double kLeast = 1e-12;  // the noise of a block stays finite
  const double square = std::max(0.0, squared_distance);
  switch (kind_) {
    case LossKind::huber:
      return square <= width_ * width_ ? 1.0 : std::max(kLeast, width_ / std::sqrt(square));
    case LossKind::cauchy:
      return std::max(kLeast, 1.0 / (1.0 + square / (width_ * width_)));
    case LossKind::none:
      break;
  }
  return 1.0;
}

}  // namespace cairn
