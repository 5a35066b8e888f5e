// SPDX-License-Identifier: BSD-3-Clause
// The rigid transform between two frames from points that are known in both, with covariances; whether the points agree
// with any such transform; and which of them do not. docs/map_merging.md derives it.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"

namespace cairn {

// Covariance of k points: a 3x3 block for each of independent points, or the full 3k x 3k matrix, which is symmetric.
// `full` is used where it is not empty.
struct PointsCovariance {
  std::vector<Matrix3> blocks;
  std::vector<double> full;
};

// Point i of frame a is point i of frame b; the errors of a and of b are independent.
struct PairedPoints {
  std::vector<Vector3> a, b;
  PointsCovariance covariance_a, covariance_b;
  std::size_t size() const { return a.size(); }
};

// What is known of the transform beforehand, independent of the points: covariance of the ordinary error [dp; dtheta],
// singular or zero where it is known exactly.
struct TransformPrior {
  SE3 T_a_b;
  Matrix6 covariance;
};

enum class AlignmentStatus {
  ok,
  too_few,     // fewer than three pairs and no prior, or none at all
  degenerate,  // the points lie on a line, within their uncertainty
  singular,    // the covariance of the differences has no Cholesky factor
  diverged
};

struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few;
  SE3 T_a_b;
  Matrix6 covariance = Matrix6::Zero();  // ordinary error [dp; dtheta]
  double distance = 0;                   // squared Mahalanobis, chi-square of `dof` if the pairs are right
  int dof = 0;                           // 3k - 6, with a prior 3k
  // By pair: how much the distance falls without it, to first order; only where the caller asked for it.
  std::vector<double> falls;
  bool ok() const { return status == AlignmentStatus::ok; }
};

// The transform of the least distance. `start`, where given, replaces the first guess.
Alignment align(const PairedPoints& pairs, const TransformPrior* prior = nullptr, bool with_falls = false,
                const SE3* start = nullptr);

// The largest set that is found by leaving out, one by one, the pair without which the distance falls most, until the
// rest agrees: jointly, distance <= chi2(dof, probability), and each pair with all the others, its fall <= chi2(3,
// pair_probability). Among many pairs the joint test would let a wrong one pass without the single tests. `left_out` is
// in the order of leaving, `kept` ascending. Where even the last few do not agree, or align() fails, `kept` is empty
// and the alignment is the last that was tried.
struct CompatibleAlignment {
  Alignment alignment;
  std::vector<std::size_t> kept, left_out;
};
CompatibleAlignment align_compatible(const PairedPoints& pairs, double probability, double pair_probability,
                                     const TransformPrior* prior = nullptr, const SE3* start = nullptr);

// The pairs with these numbers, and their part of the covariances.
PairedPoints select_pairs(const PairedPoints& pairs, const std::vector<std::size_t>& which);

// Least squares with weights (Horn 1987, by the singular vectors of Umeyama 1991): a rotation, never a reflection.
// False for fewer than three points or where they lie exactly on a line.
bool align_by_weights(const std::vector<Vector3>& a, const std::vector<Vector3>& b, const std::vector<double>& weights,
                      SE3& T_a_b);

}  // namespace cairn
