// SPDX-License-Identifier: BSD-3-Clause
// Which of the pairs agree with one transform.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/alignment.hpp"

namespace cairn {

struct CompatibleAlignment {
  Alignment alignment;                      // of the kept pairs; the last that was tried if no pair is kept
  std::vector<std::size_t> kept, left_out;  // `kept` is ascending, `left_out` in the order of removal
};

// Removes the pair without which the distance falls most, one pair after the other, until the rest agrees. All pairs
// must agree jointly, distance <= chi2(dof, probability), and each pair must agree with all other pairs, its fall <=
// chi2(3, pair_probability). Without the second test, a wrong pair among many correct ones would pass the joint test.
// `kept` is empty if even the last few pairs do not agree, or if align() fails.
CompatibleAlignment align_compatible(const PairedPoints& pairs, double probability, double pair_probability,
                                     const TransformPrior* prior = nullptr, const SE3* start = nullptr);

}  // namespace cairn
