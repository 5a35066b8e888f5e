// SPDX-License-Identifier: BSD-3-Clause
// The iterations that find the transform with the smallest distance.
#pragma once

#include "geometry/se3.hpp"
#include "map/merge/alignment.hpp"
#include "map/merge/linearised_pairs.hpp"

namespace cairn {

// An alignment, and the problem as it was linearised there.
struct AlignmentSolution {
  Alignment alignment;
  LinearisedPairs linearised;
  Matrix6 centred_covariance;  // of [dq; dtheta]; set if the alignment is ok
};

// Gauss-Newton; a step is halved while the distance would grow.
void solve_alignment(const PairedPoints& pairs, const TransformPrior* prior, const SE3* start,
                     AlignmentSolution& solution);

}  // namespace cairn
