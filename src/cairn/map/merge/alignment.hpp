// SPDX-License-Identifier: BSD-3-Clause
// The rigid transform between two frames from points that are known in both, with covariances, and whether the points
// agree with any such transform. docs/map_merging.md derives it.
#pragma once

#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/paired_points.hpp"
#include "map/merge/transform_iterate.hpp"

namespace cairn {

enum class AlignmentStatus {
  ok,
  too_few,     // fewer than three pairs and no prior, or no pair at all
  degenerate,  // the points lie on a line, within their uncertainty
  singular,    // the covariance of the differences has no Cholesky factor
  diverged
};

struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few;
  SE3 T_a_b;
  Matrix6 covariance = Matrix6::Zero();  // ordinary error [dp; dtheta]
  double distance = 0;                   // squared Mahalanobis, chi-square of `dof` if the pairs are correct
  int dof = 0;                           // 3k - 6, with a prior 3k
  // By pair: how much the distance falls without the pair, to first order. Empty unless the caller asked for it.
  std::vector<double> falls;
  bool ok() const { return status == AlignmentStatus::ok; }
};

// The transform with the smallest distance. If `start` is given, the iterations of a problem without a prior begin
// there.
Alignment align(const PairedPoints& pairs, const TransformPrior* prior = nullptr, bool with_falls = false,
                const SE3* start = nullptr);

}  // namespace cairn
