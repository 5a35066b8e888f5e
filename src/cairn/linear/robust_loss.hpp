// SPDX-License-Identifier: BSD-3-Clause
// Robust losses of an observation: how much the noise of a block of rows is inflated, given its squared distance
// (docs/update.md, "Robust losses").
#pragma once

#include "linear/small_algebra.hpp"

namespace cairn {

enum class LossKind { none, huber, cauchy };

class RobustLoss {
 public:
  static constexpr int kMostRows = 3;

  RobustLoss() = default;
  // `width` > 0, in standard deviations: where the loss leaves the parabola.
  RobustLoss(LossKind kind, double width);

  bool robust() const { return kind_ != LossKind::none; }
  // w(d), the weight of a block at the squared distance d^2 (L2).
  double weight(double squared_distance) const;
  // 1 / (eta w): by this the noise of the block is multiplied (L4).
  double noise_factor(double squared_distance, Index rows) const {
    return robust() ? 1.0 / (efficiency_[rows] * weight(squared_distance)) : 1.0;
  }
  double efficiency(Index rows) const { return efficiency_[rows]; }  // eta

 private:
  LossKind kind_ = LossKind::none;
  double width_ = 1.0;
  double efficiency_[kMostRows + 1] = {1.0, 1.0, 1.0, 1.0};
};

}  // namespace cairn
