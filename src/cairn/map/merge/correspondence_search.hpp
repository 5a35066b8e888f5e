// SPDX-License-Identifier: BSD-3-Clause
// The search for a correspondence without a prior (docs/map_merging.md): hypotheses from triangles, tests of the best
// hypotheses over the whole map, and the choice between the transforms that result.
#pragma once

#include <cstddef>
#include <vector>

#include "map/merge/correspondence.hpp"
#include "map/merge/indexed_points.hpp"
#include "map/merge/point_pairing.hpp"
#include "map/merge/triangle_hypotheses.hpp"

namespace cairn {

// The search for one pair of maps. All arguments must outlive this object.
class CorrespondenceSearch {
 public:
  CorrespondenceSearch(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options);
  Correspondence run();

 private:
  // A transform and all pairs under it.
  struct Candidate {
    double score;      // of the best hypothesis that led here
    IndexPairs pairs;  // ascending
    Alignment alignment;
    bool has(std::size_t i, std::size_t j) const;
    bool explains(const TriangleHypothesis& h) const;
    // Whether both are the same transform: they share most of the pairs.
    bool same_as(const Candidate& other) const;
  };

  void verify(const TriangleHypotheses& hypotheses, const PointPairing& pairing);
  void choose(const TriangleHypotheses& hypotheses, const PointPairing& pairing);
  double chance(const Candidate& candidate, const PointPairing& pairing, double spacing) const;
  void extend(Candidate& candidate, const PointPairing& pairing) const;
  void keep_compatible(Candidate& candidate, const PointPairing& pairing) const;

  const IndexedPoints a_, b_;
  const CorrespondenceOptions& options_;
  const double gate_;
  const std::size_t least_;  // pairs of a correspondence
  std::vector<Candidate> candidates_;
  double unverified_ = 0;  // score of the best hypothesis that no candidate explains and that was not tested
  Correspondence result_;
};

}  // namespace cairn
