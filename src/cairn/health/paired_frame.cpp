// SPDX-License-Identifier: BSD-3-Clause
// Splits the differences of a frame into the motion's part and the sensor's part.
#include "health/paired_frame.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "core/chi_square.hpp"
#include "health/semidefinite.hpp"
#include "linear/joint_gate.hpp"

namespace cairn {

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
  Block& block = blocks_[count_];
  block.difference = difference;
  block.J = J_motion;
  if (!whiten_block(noise.data(), 3, rows_, block.difference.data(), block.J.data(), kDof)) return false;
  ++count_;
  return true;
}

// Of one difference by itself, from the covariance alpha + beta J N J^T (eq. 3).
template <class Pose>
double PairedFrame<Pose>::distance(const Block& block, const Square& L, double alpha, double beta) const {
  const ByMotion B = block.J * L;
  Matrix3 S = beta * B * B.transpose();
  S.diagonal().array() += alpha;
  const double distance = squared_distance(block.difference.data(), S.data(), 3, rows_);
  return distance >= 0.0 ? distance : std::numeric_limits<double>::infinity();
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
    const auto J = block.J.topRows(rows_);
    const auto d = block.difference.head(rows_);
    M.noalias() += J.transpose().lazyProduct(J);
    g.noalias() += J.transpose().lazyProduct(d);
    whole += d.squaredNorm();
  }
  int rank = 0;
  const double explained = semidefinite_square(semidefinite_factor(M, &rank), g);  // by any motion of the pose
  information_ = M;
  const Square weights = L.transpose() * M * L;
  const typename Pose::Tangent h = L.transpose() * g;
  const Eigen::SelfAdjointEigenSolver<Square> eigen(weights);
  const double largest_weight = eigen.eigenvalues()(kDof - 1);
  double by_noise = 0.0;
  for (Index j = 0; j < kDof; ++j) {
    const double weight = eigen.eigenvalues()(j);
    if (!(weight > 1e-9 * largest_weight && weight > 1e-12) || parts.commons == rank) continue;
    const double along = eigen.eigenvectors().col(j).dot(h);
    parts.common[parts.commons++] = {weight, along * along / weight};
    by_noise += along * along / weight;
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
