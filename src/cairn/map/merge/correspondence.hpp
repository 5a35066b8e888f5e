// SPDX-License-Identifier: BSD-3-Clause
// Finds the pairs of points that two maps have in common, if neither the pairs nor the transform between the frames are
// known. Deterministic. docs/map_merging.md explains how and why.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "map/merge/alignment.hpp"
#include "map/merge/point_set.hpp"

namespace cairn {

struct CorrespondenceOptions {
  double gate_probability = 0.999;      // that a correct pair passes its own gate
  double joint_probability = 0.99;      // that all correct pairs pass the joint test
  std::size_t min_pairs = 5;            // without a prior
  double ambiguity = 0.8;               // refuse if another transform pairs this fraction of the best one's count
  double false_alarm = 1e-3;            // probability that unrelated maps match
  double max_tilt = 4;                  // rad, between the z axes, if both maps know the vertical; 4: any
  std::size_t triangle_corners = 8;     // nearest points that form triangles with a point
  std::size_t max_triangles = 40000;    // of one map
  std::size_t max_hypotheses = 400000;  // pairs of triangles that are tried
  std::size_t max_verified = 400;       // hypotheses that are tested over the whole map
};

enum class CorrespondenceReason {
  found,
  too_few,    // too few points, or too few triangles of known shape
  nothing,    // nothing in common beyond chance
  ambiguous,  // two different transforms fit equally well
  budget,     // more good hypotheses than max_verified
  too_vague   // the prior is less certain than the distances between points: search without it
};

struct Correspondence {
  CorrespondenceReason reason = CorrespondenceReason::nothing;
  std::vector<std::pair<std::size_t, std::size_t>>
      pairs;               // (index in a, index in b), by index in a; empty if not found
  Alignment alignment;     // of the pairs
  std::size_t rivals = 0;  // pairs of the second best transform
  double chance = 0;       // mean number of pairs that a wrong transform finds in the same place
  std::size_t hypotheses = 0, verified = 0;
  bool found() const { return reason == CorrespondenceReason::found; }
};

// The largest jointly compatible set of pairs that any transform gives.
Correspondence match_points(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options = {});

// The pairs that are mutually nearest within gates and pass the joint test. The prior is independent of both maps.
Correspondence match_points_near(const PointSet& a, const PointSet& b, const TransformPrior& prior,
                                 const CorrespondenceOptions& options = {});

}  // namespace cairn
