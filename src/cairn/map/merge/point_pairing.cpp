// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/point_pairing.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "map/merge/compatible_alignment.hpp"

namespace cairn {

namespace {
constexpr int kRounds = 15;  // of pairing and aligning
}

GatedPairs PointPairing::pair(const SE3& T, const Matrix6& covariance, const Vector3& shift, bool wide) const {
  struct Best {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t index = 0;
    double radius = 0;
  };
  const Matrix3 R = T.rotation().matrix();
  std::vector<Best> of_a(a_.size()), of_b(b_.size());
  std::vector<SpatialIndex::Hit> hits;
  GatedPairs result;
  for (std::size_t j = 0; j < b_.size(); ++j) {
    const Vector3 arm = R * b_.point(j);
    Matrix36 J;
    J << Matrix3::Identity(), -hat(arm);
    const Matrix3 by_transform = J * covariance * J.transpose();
    if (!(gate_ * by_transform.trace() <= reach_ * reach_)) continue;
    ++result.near;
    const Matrix3 by_b = by_transform + R * b_.covariance(j) * R.transpose();
    const Vector3 p = arm + T.translation() + shift;
    a_.index().within(p, wide ? reach_ : std::sqrt(gate_ * (by_b.trace() + a_.largest_trace())), hits);
    for (const SpatialIndex::Hit& hit : hits) {
      const Matrix3 S = a_.covariance(hit.index) + by_b;
      double distance = hit.distance;
      if (!wide) {
        const Eigen::LLT<Matrix3> L(S);
        if (L.info() != Eigen::Success) continue;
        const Vector3 difference = a_.point(hit.index) - p;
        distance = difference.dot(L.solve(difference));
        if (distance > gate_) continue;
      }
      if (distance < of_b[j].distance) of_b[j] = {distance, hit.index, std::sqrt(gate_ * S.trace() / 3)};
      if (distance < of_a[hit.index].distance) of_a[hit.index] = {distance, j, 0};
    }
  }
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (!std::isfinite(of_a[i].distance) || of_b[of_a[i].index].index != i) continue;
    result.pairs.emplace_back(i, of_a[i].index);
    result.radius = std::max(result.radius, of_b[of_a[i].index].radius);
  }
  return result;
}

PairedPoints PointPairing::points(const IndexPairs& pairs, bool jointly) const {
  PairedPoints paired;
  std::vector<std::size_t> of_a, of_b;
  for (const IndexPair& pair : pairs) {
    of_a.push_back(pair.first);
    of_b.push_back(pair.second);
    paired.a.push_back(a_.point(pair.first));
    paired.b.push_back(b_.point(pair.second));
  }
  const auto covariance = [jointly](const IndexedPoints& side, const std::vector<std::size_t>& indices) {
    PointsCovariance result;
    if (jointly && side.set().joint) {
      result.full.resize(9 * indices.size() * indices.size());
      side.set().joint(indices.data(), indices.size(), result.full.data());
    } else {
      for (std::size_t i : indices) result.blocks.push_back(side.covariance(i));
    }
    return result;
  };
  paired.covariance_a = covariance(a_, of_a);
  paired.covariance_b = covariance(b_, of_b);
  return paired;
}

bool PointPairing::grow(const TransformPrior* prior, IndexPairs& pairs, Alignment& alignment) const {
  for (int round = 0; round < kRounds; ++round) {
    if (!pairs.empty()) {
      const SE3 start = alignment.T_a_b;
      alignment = align(independent_points(pairs), prior, false, round > 0 ? &start : nullptr);
      if (!alignment.ok()) return false;
    }
    IndexPairs next = pair(alignment.T_a_b, alignment.covariance).pairs;
    if (next.empty()) return false;
    if (next == pairs) break;
    pairs.swap(next);
  }
  return true;
}

void PointPairing::keep_compatible(double probability, double pair_probability, const TransformPrior* prior,
                                   IndexPairs& pairs, Alignment& alignment) const {
  const SE3 start = alignment.T_a_b;
  const CompatibleAlignment compatible =
      align_compatible(points(pairs, true), probability, pair_probability, prior, prior == nullptr ? &start : nullptr);
  IndexPairs kept;
  for (std::size_t i : compatible.kept) kept.push_back(pairs[i]);
  pairs.swap(kept);
  alignment = compatible.alignment;
}

}  // namespace cairn
