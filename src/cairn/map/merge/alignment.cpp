// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/alignment.hpp"

#include "map/merge/alignment_solver.hpp"
#include "map/merge/distance_falls.hpp"

namespace cairn {

Alignment align(const PairedPoints& pairs, const TransformPrior* prior, bool with_falls, const SE3* start) {
  AlignmentSolution solution;
  solve_alignment(pairs, prior, start, solution);
  if (with_falls && solution.alignment.ok()) find_falls(pairs, solution);
  return solution.alignment;
}

}  // namespace cairn
