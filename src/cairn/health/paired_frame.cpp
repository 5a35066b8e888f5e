// SPDX-License-Identifier: BSD-3-Clause
// Splits the differences of a frame into the motion's part and the sensor's part.
#include "health/paired_frame.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "core/chi_square.hpp"
#include "health/semidefinite.hpp"
#include "health/small_factor.hpp"

namespace cairn {
namespace {

// L^T M L for a lower factor L.
template <class Square>
Square by_factor(const Square& M, const Square& L) {
  constexpr int n = Square::RowsAtCompileTime;
  Square product = Square::Zero(), W;
  for (int c = 0; c < n; ++c)
    for (int k = c; k < n; ++k)
      for (int r = 0; r < n; ++r) product(r, c) += M(r, k) * L(k, c);
  for (int c = 0; c < n; ++c)
    for (int r = c; r < n; ++r) {
      double sum = 0.0;
      for (int k = r; k < n; ++k) sum += L(k, r) * product(k, c);
      W(r, c) = W(c, r) = sum;
    }
  return W;
}

}  // namespace

template <class Pose>
PairedFrame<Pose>::PairedFrame(Arena& arena, Index max_observations)
    : blocks_(arena.take<Block>(static_cast<std::size_t>(max_observations))),
      sorted_(arena.take<double>(static_cast<std::size_t>(max_observations))) {
  if (arena.measuring()) return;
  for (int rows = 1; rows <= kMostRows; ++rows) {
    keep_[rows] = chi_square_quantile(rows, kKeep);
    median_[rows] = chi_square_quantile(rows, 0.5);
    // The mean of a chi-square variable below its bound, over its mean (eq. 6).
    shrink_[rows] = chi_square_cdf(rows + 2, keep_[rows]) / kKeep;
  }
}

template <class Pose>
void PairedFrame<Pose>::start(Index rows) {
  rows_ = rows;
  count_ = 0;
}

template <class Pose>
bool PairedFrame<Pose>::add(const Vector3& difference, const Matrix3& noise, const ByMotion& J_motion) {
  if (!difference.allFinite() || !J_motion.allFinite()) return false;
  const SmallFactor factor(noise, rows_);
  if (!factor.definite()) return false;
  Block& block = blocks_[count_++];
  block.difference = difference;
  block.J = J_motion;
  for (Index r = rows_; r < kMostRows; ++r) {
    block.difference(r) = 0.0;
    block.J.row(r).setZero();
  }
  factor.solve(block.difference);
  factor.solve(block.J);
  return true;
}

// Of one difference by itself, from the covariance alpha + beta J N J^T (eq. 3).
template <class Pose>
double PairedFrame<Pose>::distance(const Block& block, const Square& L, double alpha, double beta) {
  const ByMotion B = block.J.lazyProduct(L);
  Matrix3 S;
  for (int c = 0; c < kMostRows; ++c)
    for (int r = c; r < kMostRows; ++r) S(r, c) = beta * B.row(r).dot(B.row(c));
  S.diagonal().array() += alpha;
  const SmallFactor factor(S, kMostRows);
  if (!factor.definite()) return std::numeric_limits<double>::infinity();
  Vector3 whitened = block.difference;
  factor.solve(whitened);
  return whitened.squaredNorm();
}

// Up to half of a frame may be gross errors, and its motion may be far off: the median sets the scale.
template <class Pose>
double PairedFrame<Pose>::largest_distance() {
  for (Index i = 0; i < count_; ++i) sorted_[i] = blocks_[i].distance;
  double* middle = sorted_ + count_ / 2;
  std::nth_element(sorted_, middle, sorted_ + count_);
  return keep_[rows_] * std::max(1.0, *middle / median_[rows_]);
}

template <class Pose>
typename PairedFrame<Pose>::Step PairedFrame<Pose>::step(Index difference) const {
  constexpr double kJump = 3.0;
  const double distance = blocks_[difference].distance;
  return distance <= largest_ ? Step::agrees : distance > kJump * largest_ ? Step::jumped : Step::unclear;
}

template <class Pose>
FrameParts PairedFrame<Pose>::split(const Square& motion, double alpha, double beta) {
  FrameParts parts;
  if (count_ == 0) return parts;
  const Square L = semidefinite_factor(motion);
  for (Index i = 0; i < count_; ++i) blocks_[i].distance = distance(blocks_[i], L, alpha, beta);
  largest_ = largest_distance();

  typename Pose::Tangent g = Pose::Tangent::Zero();
  Square M = Square::Zero();
  double whole = 0.0;
  for (Index i = 0; i < count_; ++i) {
    const Block& block = blocks_[i];
    if (!(block.distance <= largest_)) continue;
    ++parts.blocks;
    for (int c = 0; c < kDof; ++c) {
      for (int r = c; r < kDof; ++r) M(r, c) += block.J.col(r).dot(block.J.col(c));
      g(c) += block.J.col(c).dot(block.difference);
    }
    whole += block.difference.squaredNorm();
  }
  for (int c = 0; c < kDof; ++c)
    for (int r = c + 1; r < kDof; ++r) M(c, r) = M(r, c);
  int rank = 0;
  const double explained = semidefinite_square(semidefinite_factor(M, &rank), g);  // by any motion of the pose
  information_ = M;
  const Eigen::SelfAdjointEigenSolver<Square> spectrum(by_factor(M, L));
  const typename Pose::Tangent along = spectrum.eigenvectors().transpose() * (L.transpose() * g);
  const double largest_weight = spectrum.eigenvalues()(kDof - 1);
  double by_noise = 0.0;
  for (Index j = kDof - 1; j >= 0; --j) {  // the largest one first
    const double weight = spectrum.eigenvalues()(j);
    if (!(weight > 1e-9 * largest_weight && weight > 1e-12) || parts.commons == rank) continue;
    const double square = along(j) * along(j) / weight;
    parts.common[parts.commons++] = {weight, square};
    by_noise += square;
  }
  parts.rest = std::max(0.0, explained - by_noise);
  parts.rest_dof = rank - parts.commons;
  parts.residual = std::max(0.0, whole - explained) / shrink_[rows_];
  parts.residual_dof = std::max<Index>(0, rows_ * parts.blocks - rank);
  return parts;
}

template class PairedFrame<SE2>;
template class PairedFrame<SE3>;

}  // namespace cairn
