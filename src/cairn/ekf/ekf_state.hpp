// SPDX-License-Identifier: BSD-3-Clause
// The filter between updates: memory, motion, marginals, new and removed landmarks. Included by ekf.cpp alone.
#pragma once

#include <cmath>
#include <cstring>

#include "ekf/ekf.hpp"
#include "linear/triangle.hpp"

namespace cairn {

// Rows of P are this far apart: whole cache lines, and no power of two, whose columns would share their cache sets.
inline Index leading_dimension(Index states) {
  const Index rounded = (states + 7) / 8 * 8;
  return rounded % 64 == 0 ? rounded + 8 : rounded;
}

template <class Pose>
Ekf<Pose>::Ekf(Arena& arena, ErrorKind error, const Capacity& capacity)
    : error_(error),
      capacity_(capacity),
      ld_(leading_dimension(capacity.states() + kMount)),
      landmarks_(arena.take<double>(kDim * capacity.landmarks)),
      companion_rotations_(arena.take<Rotation>(capacity.companions)),
      P_(arena.take<double>(ld_ * capacity.states())),
      slots_(arena.take<Index>(capacity.observations)),
      iterate_landmarks_(arena.take<double>(kDim * capacity.observations)),
      batch_(arena, capacity.rows(), capacity.window(), 3 * capacity.observations + 1),
      HP_(arena.take<double>(capacity.window() * capacity.rows())),
      S_(arena.take<double>(capacity.rows() * capacity.rows())),
      S_inverse_(arena.take<double>(capacity.rows() * capacity.rows())),
      innovation_(arena.take<double>(capacity.rows())),
      weights_(arena.take<double>(capacity.rows())),
      error_window_(arena.take<double>(capacity.window())),
      foreseen_(arena.take<double>(capacity.rows())),
      columns_(arena.take<double>(ld_ * capacity.window())),
      noise_left_(arena.take<double>(ld_ * kTurn)),
      noise_right_(arena.take<double>(ld_ * kTurn)),
      W_(arena.take<double>(ld_ * capacity.rows())),
      error_state_(arena.take<double>(capacity.states() + kMount)),
      shrunk_(arena.take<double>(capacity.states() + kMount)),
      diagonal_(arena.take<double>(capacity.states())),
      mount_cross_(arena.take<double>(ld_ * kMount)),
      scratch_(arena.take<double>(
          std::max({solve_workspace(capacity.rows()),
                    static_cast<std::size_t>(capacity.rows() * capacity.rows()) + cholesky_workspace(capacity.rows()),
                    update_triangle_workspace(capacity.states(), capacity.rows() + kTurn)}))) {}

template <class Pose>
void Ekf<Pose>::clear_pending() {
  pending_ = false;
  F_.setIdentity();
  N_.setZero();
}

template <class Pose>
void Ekf<Pose>::start(const Pose& pose, const Square& ordinary_covariance) {
  origin_ = pose.translation();
  pose_ = Pose(pose.rotation(), Point::Zero());
  size_ = companions_ = 0;
  const Square& covariance = ordinary_covariance;  // xi_p = e_p - G(p) e_R, and p is zero
  for (Index c = 0; c < kDof; ++c)
    for (Index r = c; r < kDof; ++r) P(r, c) = covariance(r, c);
  clear_pending();
}

template <class Pose>
bool Ekf<Pose>::propagate(const Increment<Pose>& increment) {
  const Pose next = pose_ * increment.T_before_after;
  // The increment's ordinary error turned into the map's axes: e_p += R dp + G(R d) e_theta, e_theta += R dtheta.
  Square B = Square::Zero();
  B.template topLeftCorner<kDim, kDim>() = pose_.rotation().matrix();
  B.template bottomRightCorner<kTurn, kTurn>() = pose_.rotation().adjoint();
  Square F = F_, N = N_;
  if (error_ == ErrorKind::invariant) {
    // xi_p = e_p - G(p) e_theta at the new position; the error itself stays: propagation is the identity.
    B.template topRightCorner<kDim, kTurn>() =
        -Rotation::turn(next.translation()) * B.template bottomRightCorner<kTurn, kTurn>();
  } else {
    Square step = Square::Identity();
    step.template topRightCorner<kDim, kTurn>() = Rotation::turn(next.translation() - pose_.translation());
    F = step * F_;
    N = step * N_ * step.transpose();
  }
  N += B * increment.covariance * B.transpose();
  if (!next.translation().allFinite() || !next.rotation().matrix().allFinite() || !N.allFinite() || !F.allFinite())
    return false;
  pose_ = next;
  F_ = F;
  N_ = 0.5 * (N + N.transpose());
  pending_ = true;
  return true;
}

template <class Pose>
typename Ekf<Pose>::Square Ekf<Pose>::pose_block() const {
  Square block;
  for (Index c = 0; c < kDof; ++c)
    for (Index r = c; r < kDof; ++r) block(r, c) = block(c, r) = P(r, c);
  if (!pending_) return block;
  const Square moved = F_ * block * F_.transpose() + N_;
  return 0.5 * (moved + moved.transpose());
}

template <class Pose>
void Ekf<Pose>::gather(const Index* slots, Index count, double* out, Index ld) const {
  using Turn = typename Rotation::Turn;
  const Square pose = pose_block();
  for (Index c = 0; c < kDof; ++c)
    for (Index r = 0; r < kDof; ++r) out[c * ld + r] = pose(r, c);
  const bool noisy = pending_ && error_ == ErrorKind::invariant;
  const Eigen::Matrix<double, kTurn, kDof> N_turn = N_.template bottomRows<kTurn>();
  for (Index a = 0; a < count; ++a) {
    const Index row = state(slots[a]);
    PointByPose cross;
    for (Index c = 0; c < kDof; ++c)
      for (Index r = 0; r < kDim; ++r) cross(r, c) = P(row + r, c);
    Turn U = Turn::Zero();
    if (noisy) {
      U = -Rotation::turn(local(slots[a]));
      cross += U * N_turn;
    } else if (pending_) {
      cross = (cross * F_.transpose()).eval();
    }
    const Index at = kDof + kDim * a;
    for (Index c = 0; c < kDof; ++c)
      for (Index r = 0; r < kDim; ++r) out[c * ld + at + r] = out[(at + r) * ld + c] = cross(r, c);
    const Turn UN = U * N_turn.template rightCols<kTurn>();
    for (Index b = 0; b <= a; ++b) {
      PointSquare block;
      for (Index c = 0; c < kDim; ++c)
        for (Index r = 0; r < kDim; ++r) block(r, c) = symmetric(row + r, state(slots[b]) + c);
      if (noisy) block -= UN * Rotation::turn(local(slots[b])).transpose();
      for (Index c = 0; c < kDim; ++c)
        for (Index r = 0; r < kDim; ++r) {
          out[(kDof + kDim * b + c) * ld + at + r] = block(r, c);
          out[(at + r) * ld + kDof + kDim * b + c] = block(r, c);
        }
    }
  }
}

// e = A xi with e_x = xi_x + G(x) xi_R for the position and every landmark: A M A^T, one block row and column a time.
template <class Pose>
void Ekf<Pose>::to_ordinary(const Index* slots, Index count, double* matrix, Index ld) const {
  if (error_ == ErrorKind::standard) return;
  const Index size = kDof + kDim * count;
  for (Index x = -1; x < count; ++x) {
    const Index at = x < 0 ? 0 : kDof + kDim * x;
    const typename Rotation::Turn G = Rotation::turn(x < 0 ? pose_.translation() : local(slots[x]));
    for (Index c = 0; c < size; ++c)
      for (Index r = 0; r < kDim; ++r)
        for (Index t = 0; t < kTurn; ++t) matrix[c * ld + at + r] += G(r, t) * matrix[c * ld + kDim + t];
    for (Index r = 0; r < size; ++r)
      for (Index c = 0; c < kDim; ++c)
        for (Index t = 0; t < kTurn; ++t) matrix[(at + c) * ld + r] += G(c, t) * matrix[(kDim + t) * ld + r];
  }
  for (Index c = 0; c < size; ++c)  // both triangles, bit for bit
    for (Index r = c + 1; r < size; ++r) matrix[r * ld + c] = matrix[c * ld + r];
}

template <class Pose>
void Ekf<Pose>::gather_ordinary(const Index* slots, Index count, double* out, Index ld) const {
  gather(slots, count, out, ld);
  to_ordinary(slots, count, out, ld);
}

template <class Pose>
typename Ekf<Pose>::Square Ekf<Pose>::pose_covariance() const {
  Square covariance;
  gather_ordinary(nullptr, 0, covariance.data(), kDof);
  return covariance;
}

template <class Pose>
typename Ekf<Pose>::PointSquare Ekf<Pose>::landmark_covariance(Index slot) const {
  Eigen::Matrix<double, kDof + kDim, kDof + kDim> joint;
  gather_ordinary(&slot, 1, joint.data(), kDof + kDim);
  return joint.template bottomRightCorner<kDim, kDim>();
}

template <class Pose>
typename Ekf<Pose>::PointSquare Ekf<Pose>::relative_covariance(Index slot) const {
  const Index row = state(slot);
  const Index dofs = error_ == ErrorKind::invariant ? kDim : kDof;  // that the error has to do with
  Eigen::Matrix<double, kDim, kDof> J = Eigen::Matrix<double, kDim, kDof>::Zero();
  J.template leftCols<kDim>() = -PointSquare::Identity();
  PointByPose cross = PointByPose::Zero();
  PointSquare own;
  for (Index c = 0; c < dofs; ++c)
    for (Index r = 0; r < kDim; ++r) cross(r, c) = P(row + r, c);
  for (Index c = 0; c < kDim; ++c)
    for (Index r = c; r < kDim; ++r) own(r, c) = own(c, r) = P(row + r, row + c);
  PointSquare sum;
  if (error_ == ErrorKind::invariant) {
    const PointSquare across = cross.template leftCols<kDim>();
    for (Index c = 0; c < kDim; ++c)
      for (Index r = c; r < kDim; ++r) sum(r, c) = sum(c, r) = P(r, c);
    sum += own - across - across.transpose();
    if (!pending_) return sum;
    J.template rightCols<kTurn>() = -Rotation::turn(local(slot));  // of the pending motion's error
    return sum + J.lazyProduct(N_.lazyProduct(J.transpose()).eval());
  }
  J.template rightCols<kTurn>() = -Rotation::turn(local(slot) - pose_.translation());
  if (pending_) cross = (cross * F_.transpose()).eval();
  const PointSquare across = cross.lazyProduct(J.transpose());
  return own + across + across.transpose() + J * pose_block() * J.transpose();
}

// error^T covariance^-1 error, negative where the covariance is singular.
template <class Pose>
double Ekf<Pose>::normalised(Square covariance, Tangent error) {
  Square& L = covariance;
  // Scaled to unit diagonal first: metres and radians must not decide what counts as singular.
  for (Index i = 0; i < kDof; ++i)
    if (!(L(i, i) > 0.0)) return -1.0;
  const Tangent scale = L.diagonal().cwiseSqrt().cwiseInverse();
  L = (scale.asDiagonal() * L * scale.asDiagonal()).eval();
  error = scale.cwiseProduct(error);
  if (!cholesky(L.data(), kDof, kDof)) return -1.0;
  for (Index i = 0; i < kDof; ++i)
    if (L(i, i) < 1e-7) return -1.0;  // pivots of rounding alone
  solve_lower(L.data(), kDof, kDof, error.data());
  return error.squaredNorm();
}

template <class Pose>
double Ekf<Pose>::pose_nees(const Pose& truth) const {
  const Pose local_truth(truth.rotation(), truth.translation() - origin_);
  Tangent error = (local_truth * pose_.inverse()).log();
  if (error_ == ErrorKind::standard) error.template head<kDim>() = local_truth.translation() - pose_.translation();
  return normalised(pose_block(), error);
}

template <class Pose>
double Ekf<Pose>::nees(ErrorKind error_kind, const Point& origin, const Pose& truth, const Pose& estimate,
                       const Square& ordinary_covariance) {
  const Pose from_origin(truth.rotation(), truth.translation() - origin);
  const Pose pose(estimate.rotation(), estimate.translation() - origin);
  if (error_kind == ErrorKind::standard) {
    Tangent error = (from_origin * pose.inverse()).log();
    error.template head<kDim>() = from_origin.translation() - pose.translation();
    return normalised(ordinary_covariance, error);
  }
  Square J = Square::Identity();  // xi_p = e_p - G(p) e_R
  J.template topRightCorner<kDim, kTurn>() = -Rotation::turn(pose.translation());
  return normalised(J * ordinary_covariance * J.transpose(), (from_origin * pose.inverse()).log());
}

template <class Pose>
double Ekf<Pose>::smallest_pivot() {
  // R^T R = D P D with R in the strict upper triangle of P's own storage, its diagonal and D apart: no memory is
  // needed.
  apply_pending();
  const Index n = states();
  double smallest = 1.0;
  for (Index i = 0; i < n; ++i) diagonal_[i] = P(i, i);
  for (Index j = 0; j < n; ++j) {
    double* column = P_ + j * ld_;  // rows 0..j-1: R
    const double variance = diagonal_[j];
    double pivot = 1.0;
    if (variance > 0.0) {
      for (Index i = 0; i < j; ++i) {
        const double* other = P_ + i * ld_;
        double sum = 0.0;
        if (P(i, i) > 0.0) {
          sum = P(j, i) / std::sqrt(variance * P(i, i));
          for (Index k = 0; k < i; ++k) sum -= other[k] * column[k];
          sum /= error_state_[i];
        }
        column[i] = sum;
        pivot -= sum * sum;
      }
      smallest = std::min(smallest, pivot);
      if (!(pivot > 0.0)) return pivot;
    } else {
      std::fill(column, column + j, 0.0);  // exactly known: left out
      if (variance < 0.0) return variance;
    }
    error_state_[j] = std::sqrt(pivot);
  }
  return smallest;
}

template <class Pose>
bool Ekf<Pose>::augment(const Point& position, const PointByPose& J_pose, const PointByMount* J_mount,
                        const PointSquare& noise, bool relative) {
  const Point landmark = position - origin_;
  // By the filter's own errors: xi_l = e_l - G(l) xi_R, and e_p = xi_p + G(p) xi_R.
  PointByPose J = J_pose;
  if (error_ == ErrorKind::invariant) {
    if (relative) {
      J.template rightCols<kTurn>().setZero();
    } else {
      J.template rightCols<kTurn>() +=
          J_pose.template leftCols<kDim>() * Rotation::turn(pose_.translation()) - Rotation::turn(landmark);
    }
  }
  const PointByMount M = J_mount != nullptr ? *J_mount : PointByMount(PointByMount::Zero());
  const Square pose = pose_block();
  PointByMount cross;  // covariance of the new landmark with the mount
  Eigen::Matrix<double, kDof, kMount> pose_mount = Eigen::Matrix<double, kDof, kMount>::Zero();
  if (J_mount != nullptr)
    for (Index c = 0; c < kMount; ++c)
      for (Index r = 0; r < kDof; ++r) pose_mount(r, c) = mount_cross_[c * ld_ + r];
  cross = J * pose_mount + M * mount_covariance_;
  const PointSquare mixed = J * pose_mount * M.transpose();
  const PointSquare block =
      J * pose * J.transpose() + mixed + mixed.transpose() + M * mount_covariance_ * M.transpose() + noise;
  if (!landmark.allFinite() || !J.allFinite() || !block.allFinite()) return false;
  apply_pending();

  const Index n = states();
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < kDim; ++r) {
      double value = 0.0;
      for (Index k = 0; k < kDof; ++k) value += J(r, k) * symmetric(c, k);
      if (J_mount != nullptr)
        for (Index k = 0; k < kMount; ++k) value += M(r, k) * mount_cross_[k * ld_ + c];
      P(n + r, c) = value;
    }
  for (Index c = 0; c < kDim; ++c)
    for (Index r = c; r < kDim; ++r) P(n + r, n + c) = 0.5 * (block(r, c) + block(c, r));
  if (J_mount != nullptr)
    for (Index c = 0; c < kMount; ++c)
      for (Index r = 0; r < kDim; ++r) mount_cross_[c * ld_ + n + r] = cross(r, c);
  Eigen::Map<Point>(landmarks_ + kDim * size_) = landmark;
  ++size_;
  return true;
}

// The invariant error xi_l = e_l - G(l) xi_R is that of the landmark, plus the noise: both stand at one place.
template <class Pose>
void Ekf<Pose>::duplicate(Index slot, const PointSquare& noise) {
  const Index n = states(), from = state(slot);
  for (Index c = 0; c < n; ++c)
    for (Index d = 0; d < kDim; ++d) P(n + d, c) = symmetric(from + d, c);
  for (Index c = 0; c < kDim; ++c)
    for (Index r = c; r < kDim; ++r) P(n + r, n + c) = P(from + r, from + c) + noise(r, c);
  std::memcpy(landmarks_ + kDim * size_, landmarks_ + kDim * slot, kDim * sizeof(double));
  ++size_;
}

template <class Pose>
void Ekf<Pose>::exchange_landmarks(Index a, Index b) {
  if (a == b) return;
  for (Index d = 0; d < kDim; ++d) exchange(state(a) + d, state(b) + d);
  std::swap_ranges(landmarks_ + kDim * a, landmarks_ + kDim * (a + 1), landmarks_ + kDim * b);
}

template <class Pose>
void Ekf<Pose>::remove(Index slot) {
  // Motion held back needs no part in it: it reaches each landmark by its position alone.
  const Index last = size_ - 1;
  if (slot != last) {
    const Index to = state(slot), from = state(last);
    for (Index c = 0; c < to; ++c)
      for (Index r = 0; r < kDim; ++r) P(to + r, c) = P(from + r, c);
    for (Index c = 0; c < kDim; ++c)
      for (Index r = c; r < kDim; ++r) P(to + r, to + c) = P(from + r, from + c);
    for (Index c = to + kDim; c < from; ++c)
      for (Index r = 0; r < kDim; ++r) P(c, to + r) = P(from + r, c);
    std::memcpy(landmarks_ + kDim * slot, landmarks_ + kDim * last, kDim * sizeof(double));
  }
  --size_;
}

}  // namespace cairn
