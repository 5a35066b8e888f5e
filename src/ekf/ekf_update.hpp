// SPDX-License-Identifier: BSD-3-Clause
// The filter's update by one batch. Included by ekf.cpp alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ekf/ekf.hpp"
#include "ekf/triangle.hpp"

namespace cairn {

template <class Pose>
void Ekf<Pose>::open(const Index* slots, Index count, const Eigen::Matrix<double, kMount, kMount>* mount_noise) {
  slot_count_ = count;
  mount_ = mount_noise != nullptr ? kMount : 0;
  window_ = kDof + mount_ + kDim * count;
  iterate_pose_ = pose_;
  iterate_mount_.setZero();
  for (Index a = 0; a < count; ++a) {
    slots_[a] = slots[a];
    Eigen::Map<Point>(iterate_landmarks_ + kDim * a) = landmark(slots[a]);
  }
  // The mount's angles are states for as long as the frame lasts, independent of all others before it.
  gather(slots, count, P_window_, window_);
  if (mount_ != 0) {
    const Index known = window_ - mount_;
    for (Index c = known - 1; c >= 0; --c) {
      double* from = P_window_ + c * window_;
      double* to = P_window_ + (c < kDof ? c : c + mount_) * window_;
      std::memmove(to + kDof + mount_, from + kDof, (known - kDof) * sizeof(double));
      std::memmove(to, from, kDof * sizeof(double));
      std::fill_n(to + kDof, mount_, 0.0);
    }
    for (Index c = 0; c < mount_; ++c) {
      double* column = P_window_ + (kDof + c) * window_;
      std::fill_n(column, window_, 0.0);
      for (Index r = 0; r < mount_; ++r) column[kDof + r] = (*mount_noise)(r, c);
    }
    mount_covariance_ = *mount_noise;
    for (Index c = 0; c < kMount; ++c) std::fill_n(mount_cross_ + c * ld_, states(), 0.0);
  }
  std::fill_n(error_window_, window_, 0.0);
  batch_.clear();
}

template <class Pose>
void Ekf<Pose>::add_mount_block(Index row, Index rows, const PointByMount& J_mount) {
  double* block = batch_.add_jacobian(row, rows, kDof, kMount);
  for (Index c = 0; c < kMount; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_mount(r, c);
}

template <class Pose>
void Ekf<Pose>::compute_innovation() {
  const Index m = batch_.rows();
  batch_.times_transposed(P_window_, window_, window_, T_, window_);
  batch_.innovation_covariance(T_, window_, S_, m);
  std::copy_n(batch_.residual(), m, innovation_);
}

template <class Pose>
const double* Ekf<Pose>::inverse_innovation() {
  const Index m = batch_.rows();
  double* L = scratch_;
  for (Index j = 0; j < m; ++j) std::copy(S_ + j * m + j, S_ + (j + 1) * m, L + j * m + j);
  if (!cholesky(L, m, m)) return nullptr;
  inverse_from_cholesky(L, m, m, S_inverse_, m);
  return S_inverse_;
}

template <class Pose>
double Ekf<Pose>::distance_by_inverse(double* u) const {
  const Index m = batch_.rows();
  std::fill_n(u, m, 0.0);
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < m; ++i) u[i] += S_inverse_[j * m + i] * batch_.residual()[j];
  double sum = 0.0;
  for (Index i = 0; i < m; ++i) sum += u[i] * batch_.residual()[i];
  return sum;
}

// Block inversion: with S^-1 = [A B; B^T D], the inverse of S without D's rows is A - B D^-1 B^T.
template <class Pose>
void Ekf<Pose>::leave_out(Index row, Index rows, double* u) {
  const Index m = batch_.rows();
  double* D = scratch_;
  double* B = scratch_ + rows * rows;  // m x rows, then B L^-T
  for (Index c = 0; c < rows; ++c) {
    for (Index r = 0; r < rows; ++r) D[c * rows + r] = S_inverse_[(row + c) * m + row + r];
    std::copy_n(S_inverse_ + (row + c) * m, m, B + c * m);
  }
  double part[3] = {};
  for (Index r = 0; r < rows; ++r) part[r] = u[row + r];
  if (!cholesky(D, rows, rows)) return;
  solve_lower(D, rows, rows, part);
  for (Index c = 0; c < rows; ++c) {
    for (Index k = 0; k < c; ++k)
      for (Index i = 0; i < m; ++i) B[c * m + i] -= D[k * rows + c] * B[k * m + i];
    for (Index i = 0; i < m; ++i) B[c * m + i] /= D[c * rows + c];
  }
  for (Index c = 0; c < rows; ++c) {
    for (Index i = 0; i < m; ++i) u[i] -= B[c * m + i] * part[c];
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < m; ++i) S_inverse_[j * m + i] -= B[c * m + i] * B[c * m + j];
  }
}

template <class Pose>
bool Ekf<Pose>::factor() {
  const Index m = batch_.rows();
  if (!cholesky(S_, m, m)) return false;
  // The residual of the iterated filter: r(x_i) + H_i xi_i (Bell and Cathey 1993); xi is zero at the first.
  batch_.add_product(1.0, error_window_, innovation_);
  std::copy_n(innovation_, m, foreseen_);
  solve_lower(S_, m, m, innovation_);
  nis_ = 0.0;
  for (Index i = 0; i < m; ++i) nis_ += innovation_[i] * innovation_[i];
  return std::isfinite(nis_);
}

template <class Pose>
void Ekf<Pose>::solve() {
  const Index m = batch_.rows();
  std::copy_n(innovation_, m, weights_);
  solve_lower_transposed(S_, m, m, weights_);
  std::fill_n(error_window_, window_, 0.0);
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < window_; ++i) error_window_[i] += T_[j * window_ + i] * weights_[j];
  batch_.add_product(-1.0, error_window_, foreseen_);
}

template <class Pose>
void Ekf<Pose>::retract(const Tangent& error, Pose& pose) const {
  if (error_ == ErrorKind::invariant) {
    pose = Pose::exp(error) * pose;
  } else {
    const typename Rotation::Tangent turn = error.template tail<kTurn>();
    pose = Pose(Rotation::exp(turn) * pose.rotation(), pose.translation() + error.template head<kDim>());
  }
}

template <class Pose>
void Ekf<Pose>::step() {
  const Tangent error = Eigen::Map<const Tangent>(error_window_);
  iterate_pose_ = pose_;
  retract(error, iterate_pose_);
  for (Index i = 0; i < mount_; ++i) iterate_mount_(i) = error_window_[kDof + i];
  const Mover mover(error_, error.template tail<kTurn>());
  for (Index a = 0; a < slot_count_; ++a)
    Eigen::Map<Point>(iterate_landmarks_ + kDim * a) =
        mover(landmark(slots_[a]), Eigen::Map<const Point>(error_window_ + landmark_column(a)));
}

template <class Pose>
double Ekf<Pose>::misfit(const double* residual) const {
  double sum = 0.0;
  for (Index i = 0; i < batch_.rows(); ++i) {
    const double difference = residual[i] - foreseen_[i];
    sum += difference * difference / batch_.noise_variance(i);
  }
  return std::sqrt(sum);
}

template <class Pose>
void Ekf<Pose>::pending_pose_columns(double* out) const {
  const Index n = states();
  const Square pose = pose_block();
  for (Index c = 0; c < kDof; ++c) std::copy_n(pose.data() + c * kDof, kDof, out + c * ld_);
  if (!pending_) {
    for (Index c = 0; c < kDof; ++c) std::copy_n(P_ + c * ld_ + kDof, n - kDof, out + c * ld_ + kDof);
    return;
  }
  const Eigen::Matrix<double, kTurn, kDof> N_turn = N_.template bottomRows<kTurn>();
  for (Index slot = 0; slot < size_; ++slot) {
    const Index row = state(slot);
    PointByPose cross;
    for (Index c = 0; c < kDof; ++c)
      for (Index r = 0; r < kDim; ++r) cross(r, c) = P(row + r, c);
    if (error_ == ErrorKind::invariant)
      cross -= Rotation::turn(landmark(slot)) * N_turn;
    else
      cross = (cross * F_.transpose()).eval();
    for (Index c = 0; c < kDof; ++c)
      for (Index r = 0; r < kDim; ++r) out[c * ld_ + row + r] = cross(r, c);
  }
}

// Columns of U N and U behind column `first` of left_ and right_; the number of them.
template <class Pose>
Index Ekf<Pose>::pending_factors(Index first) {
  if (!pending_ || error_ == ErrorKind::standard) return 0;
  const Eigen::Matrix<double, kTurn, kTurn> N = N_.template bottomRightCorner<kTurn, kTurn>();
  for (Index t = 0; t < kTurn; ++t) {
    double* left = left_ + (first + t) * ld_;
    double* right = right_ + (first + t) * ld_;
    std::fill_n(left, kDof, 0.0);  // the pose's columns are written whole
    std::fill_n(right, kDof, 0.0);
  }
  for (Index slot = 0; slot < size_; ++slot) {
    const typename Rotation::Turn U = -Rotation::turn(landmark(slot));
    const typename Rotation::Turn UN = U * N;
    for (Index t = 0; t < kTurn; ++t)
      for (Index r = 0; r < kDim; ++r) {
        left_[(first + t) * ld_ + state(slot) + r] = UN(r, t);
        right_[(first + t) * ld_ + state(slot) + r] = U(r, t);
      }
  }
  return kTurn;
}

// P <- P_now + left right^T over `rank` columns that stand there, and those of the motion held back.
template <class Pose>
void Ekf<Pose>::write_covariance(Index rank, const double* pose_columns) {
  const Index n = states();
  const Index noise = pending_factors(rank);
  for (Index c = 0; c < kDof; ++c) std::copy(pose_columns + c * ld_ + c, pose_columns + c * ld_ + n, P_ + c * ld_ + c);
  if (rank + noise > 0) update_triangle(P_, ld_, n, left_, ld_, right_, ld_, rank + noise, scratch_);
  clear_pending();
}

template <class Pose>
void Ekf<Pose>::apply_pending() {
  if (!pending_) return;
  pending_pose_columns(columns_);
  write_covariance(0, columns_);
}

template <class Pose>
void Ekf<Pose>::gather_columns() {
  const Index n = states();
  pending_pose_columns(columns_);
  for (Index i = 0; i < mount_; ++i) std::fill_n(columns_ + (kDof + i) * ld_, n, 0.0);
  const bool noisy = pending_ && error_ == ErrorKind::invariant;
  for (Index a = 0; a < slot_count_; ++a) {
    const Index from = state(slots_[a]);
    double* to = columns_ + landmark_column(a) * ld_;
    for (Index c = 0; c < kDof; ++c)
      for (Index d = 0; d < kDim; ++d) to[d * ld_ + c] = columns_[c * ld_ + from + d];
    for (Index c = kDof; c < from; ++c)
      for (Index d = 0; d < kDim; ++d) to[d * ld_ + c] = P(from + d, c);
    for (Index d = 0; d < kDim; ++d)
      for (Index r = 0; r < kDim; ++r) to[d * ld_ + from + r] = symmetric(from + r, from + d);
    for (Index d = 0; d < kDim; ++d)
      std::copy_n(&P_[(from + d) * ld_ + from + kDim], n - from - kDim, to + d * ld_ + from + kDim);
    if (!noisy) continue;
    // + U_i N U_a^T
    const Eigen::Matrix<double, kTurn, kDim> NU =
        -N_.template bottomRightCorner<kTurn, kTurn>() * Rotation::turn(landmark(slots_[a])).transpose();
    for (Index slot = 0; slot < size_; ++slot) {
      const PointSquare noise = -Rotation::turn(landmark(slot)) * NU;
      for (Index d = 0; d < kDim; ++d)
        for (Index r = 0; r < kDim; ++r) to[d * ld_ + state(slot) + r] += noise(r, d);
    }
  }
}

template <class Pose>
bool Ekf<Pose>::commit() {
  const Index n = states(), m = batch_.rows();
  gather_columns();
  batch_.times_transposed(columns_, ld_, n, right_, ld_);
  for (Index j = 0; j < m; ++j)  // the mount's rows stand behind the states
    for (Index i = 0; i < mount_; ++i) right_[j * ld_ + n + i] = T_[j * window_ + kDof + i];
  solve_right_transposed(S_, m, m, right_, ld_, n + mount_, scratch_);  // W = P H^T L^-T

  for (Index i = 0; i < n; ++i) diagonal_[i] = P(i, i);
  for (Index c = 0; c < kDof; ++c) diagonal_[c] = columns_[c * ld_ + c];
  if (pending_ && error_ == ErrorKind::invariant) {
    const auto N = N_.template bottomRightCorner<kTurn, kTurn>();
    for (Index slot = 0; slot < size_; ++slot) {
      const auto U = Rotation::turn(landmark(slot));
      const PointSquare noise = U * N * U.transpose();
      for (Index d = 0; d < kDim; ++d) diagonal_[state(slot) + d] += noise(d, d);
    }
  }
  // P_new = P - W W^T (Mars paper, eq. 13): its diagonal, and the error xi = W L^-1 r, before anything is changed.
  std::fill_n(error_state_, n, 0.0);
  double* shrunk = scratch_;  // what the update takes off the diagonal
  std::fill_n(shrunk, n, 0.0);
  for (Index j = 0; j < m; ++j) {
    const double* W = right_ + j * ld_;
    double* negative = left_ + j * ld_;
    const double weight = innovation_[j];
    for (Index i = 0; i < n; ++i) {
      shrunk[i] += W[i] * W[i];
      error_state_[i] += W[i] * weight;
      negative[i] = -W[i];
    }
  }
  for (Index i = 0; i < n; ++i) {
    if (!std::isfinite(error_state_[i])) return false;
    const double left = diagonal_[i] - shrunk[i];
    if (!(diagonal_[i] > 0.0 ? left > 0.0 : left >= 0.0)) return false;
  }

  if (mount_ != 0) {
    for (Index c = 0; c < kMount; ++c) std::fill_n(mount_cross_ + c * ld_, n, 0.0);
    for (Index j = 0; j < m; ++j) {
      const double* W = right_ + j * ld_;
      for (Index c = 0; c < kMount; ++c) {
        for (Index i = 0; i < n; ++i) mount_cross_[c * ld_ + i] -= W[i] * W[n + c];
        for (Index r = 0; r < kMount; ++r) mount_covariance_(r, c) -= W[n + r] * W[n + c];
      }
    }
    for (Index i = 0; i < kMount; ++i) iterate_mount_(i) = error_window_[kDof + i];
  }
  write_covariance(m, columns_);
  const Tangent error = Eigen::Map<const Tangent>(error_state_);
  const Mover mover(error_, error.template tail<kTurn>());
  for (Index slot = 0; slot < size_; ++slot)
    Eigen::Map<Point>(landmarks_ + kDim * slot) =
        mover(landmark(slot), Eigen::Map<const Point>(error_state_ + state(slot)));
  retract(error, pose_);
  return true;
}

}  // namespace cairn
