// SPDX-License-Identifier: BSD-3-Clause
// How much the distance of an alignment falls if one pair is left out, to first order (docs/map_merging.md).
#pragma once

#include "geometry/se3.hpp"
#include "map/merge/alignment_solver.hpp"

namespace cairn {

// The fall lambda_i^T M_ii^-1 lambda_i of one pair; M = S^-1 - V C V^T. `scale` is the trace of S^-1 for this pair. No
// other pair determines the directions in which M_ii is singular: in these directions, nothing can fall.
double fall_of(const Matrix3& M, const Vector3& lambda, double scale);

// Sets the falls of all pairs in the alignment, which is ok.
void find_falls(const PairedPoints& pairs, AlignmentSolution& solution);

}  // namespace cairn
