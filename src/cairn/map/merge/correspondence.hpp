// SPDX-License-Identifier: BSD-3-Clause
// Finds the pairs of points that two maps have in common, where neither the pairs nor the transform between the frames
// are known. Deterministic. docs/map_merging.md tells how and why.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/alignment.hpp"

namespace cairn {

struct PointSet {
  std::vector<Vector3> points;
  std::vector<Matrix3> covariances;  // of each point
  // Joint covariance of `count` of them, 3 count x 3 count, symmetric. May be absent: then the points count as
  // independent, which those of a map are not. With it, a map whose frame is vague is still as sharp as its points are
  // relative to each other.
  std::function<void(const std::size_t* indices, std::size_t count, double* matrix)> joint;
};

struct CorrespondenceOptions {
  double gate_probability = 0.999;      // of a right pair, to pass its own gate
  double joint_probability = 0.99;      // of all right pairs, to pass the joint test
  std::size_t min_pairs = 5;            // without a prior
  double ambiguity = 0.8;               // refuse if another transform pairs this fraction of the best one's count
  double false_alarm = 1e-3;            // probability that unrelated maps match
  double max_tilt = 4;                  // rad; between the z axes, for maps that both know up. 4: any
  std::size_t triangle_corners = 8;     // neighbours that a point's triangles are drawn from
  std::size_t max_triangles = 40000;    // a map
  std::size_t max_hypotheses = 400000;  // pairs of triangles that are laid onto each other
  std::size_t max_verified = 400;       // hypotheses that are tested over the whole map
};

enum class CorrespondenceReason {
  found,
  too_few,    // too few points, or triangles whose shape is known
  nothing,    // nothing in common beyond chance
  ambiguous,  // two different transforms fit equally well
  budget,     // more good candidates than max_verified
  too_vague   // the prior is vaguer than the distances between points: search without it
};

struct Correspondence {
  CorrespondenceReason reason = CorrespondenceReason::nothing;
  std::vector<std::pair<std::size_t, std::size_t>>
      pairs;               // (index in a, index in b), by index in a; empty if not found
  Alignment alignment;     // of the pairs
  std::size_t rivals = 0;  // pairs of the second best transform
  double chance = 0;       // pairs that a wrong transform would get there, on average
  std::size_t hypotheses = 0, verified = 0;
  bool found() const { return reason == CorrespondenceReason::found; }
};

// The largest jointly compatible set of pairs that any transform gives.
Correspondence match_points(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options = {});

// With a transform known beforehand, independent of both maps: gates, mutually nearest, joint test.
Correspondence match_points_near(const PointSet& a, const PointSet& b, const TransformPrior& prior,
                                 const CorrespondenceOptions& options = {});

}  // namespace cairn
