// SPDX-License-Identifier: BSD-3-Clause
// Pairs the points of two maps under a transform, and improves the transform and the pairs in turn.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/alignment.hpp"
#include "map/merge/indexed_points.hpp"

namespace cairn {

using IndexPair = std::pair<std::size_t, std::size_t>;  // (index in a, index in b)
using IndexPairs = std::vector<IndexPair>;

// In parts of the spacing: a point is paired only if the transform is at least this certain there. Otherwise the
// nearest point means nothing.
inline constexpr double kPairingReach = 0.5;

struct GatedPairs {
  IndexPairs pairs;      // by index in a
  std::size_t near = 0;  // points of b where the transform is certain enough
  double radius = 0;     // of the largest gate among the pairs, m
};

class PointPairing {
 public:
  // `gate` bounds the squared Mahalanobis distance of a pair. `reach` (m) bounds the part of the gate that the
  // uncertainty of the transform causes. The points must outlive this object.
  PointPairing(const IndexedPoints& a, const IndexedPoints& b, double gate, double reach)
      : a_(a), b_(b), gate_(gate), reach_(reach) {}

  // Pairs that are mutually nearest by Mahalanobis distance and inside the gate, after b was moved by T and by `shift`.
  GatedPairs pair(const SE3& T, const Matrix6& covariance, const Vector3& shift = Vector3::Zero()) const {
    return pair(T, covariance, shift, false);
  }
  // Pairs that are mutually nearest in metres, within the reach.
  GatedPairs pair_within_reach(const SE3& T, const Matrix6& covariance) const {
    return pair(T, covariance, Vector3::Zero(), true);
  }

  // The points of the pairs as independent points.
  PairedPoints independent_points(const IndexPairs& pairs) const { return points(pairs, false); }

  // Aligns and pairs again until nothing changes. The set grows outward from a few neighbours, because the transform
  // becomes more certain in each round. Returns false if align() fails or if no point finds a partner.
  bool grow(const TransformPrior* prior, IndexPairs& pairs, Alignment& alignment) const;

  // Aligns the pairs with their joint covariances, and drops pairs that contradict the others: align_compatible().
  void keep_compatible(double probability, double pair_probability, const TransformPrior* prior, IndexPairs& pairs,
                       Alignment& alignment) const;

 private:
  GatedPairs pair(const SE3& T, const Matrix6& covariance, const Vector3& shift, bool wide) const;
  PairedPoints points(const IndexPairs& pairs, bool jointly) const;

  const IndexedPoints& a_;
  const IndexedPoints& b_;
  const double gate_, reach_;
};

}  // namespace cairn
