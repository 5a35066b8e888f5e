// SPDX-License-Identifier: BSD-3-Clause
// The filter's update by one batch. Included by ekf.cpp alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "ekf/ekf.hpp"
#include "linear/triangle.hpp"

namespace cairn {

// y += factor x from row `first` to before row `last`.
inline void add_scaled(double factor, const double* x, Index first, Index last, double* y) {
  for (Index i = first; i < last; ++i) y[i] += factor * x[i];
}

template <class Pose>
void Ekf<Pose>::open(const Index* slots, Index count, const Eigen::Matrix<double, kMount, kMount>* mount_noise) {
  slot_count_ = count;
  mount_ = mount_noise != nullptr ? kMount : 0;
  window_ = kDof + mount_ + kDim * count;
  iterating_ = false;
  iterate_pose_ = pose_;
  iterate_mount_.setZero();
  for (Index a = 0; a < count; ++a) {
    slots_[a] = slots[a];
    Eigen::Map<Point>(iterate_landmarks_ + kDim * a) = local(slots[a]);
  }
  if (mount_ != 0) {
    mount_covariance_ = *mount_noise;
    for (Index c = 0; c < kMount; ++c) std::fill_n(mount_cross_ + c * ld_, states(), 0.0);
  }
  gather_columns();
  std::fill_n(error_window_, window_, 0.0);
  batch_.clear();
}

template <class Pose>
void Ekf<Pose>::compute_innovation() {
  const Index m = batch_.rows(), n = states();
  batch_.times_transposed(columns_, ld_, n + mount_, W_, ld_);
  const auto take_rows = [&](Index row, Index count, Index column) {
    constexpr Index kAtOnce = 4;
    Index j = 0;
    for (; j + kAtOnce <= m; j += kAtOnce)
      for (Index k = 0; k < count; ++k)
        for (Index i = 0; i < kAtOnce; ++i) HP_[(column + k) * m + j + i] = W_[(j + i) * ld_ + row + k];
    for (; j < m; ++j)
      for (Index k = 0; k < count; ++k) HP_[(column + k) * m + j] = W_[j * ld_ + row + k];
  };
  take_rows(0, kDof, 0);
  take_rows(n, mount_, kDof);
  for (Index a = 0; a < slot_count_; ++a) take_rows(state(slots_[a]), kDim, landmark_column(a));
  form_innovation();
}

template <class Pose>
void Ekf<Pose>::form_innovation() {
  const Index m = batch_.rows();
  batch_.innovation_covariance(HP_, m, S_, m);
  std::copy_n(batch_.residual(), m, innovation_);
}

template <class Pose>
void Ekf<Pose>::keep(const Index* blocks, Index count, Index rows) {
  const Index before = batch_.rows(), m = count * rows, height = states() + mount_;
  for (Index k = 0; k < count; ++k)
    for (Index r = 0; r < rows && blocks[k] != k; ++r)
      std::copy_n(W_ + (blocks[k] * rows + r) * ld_, height, W_ + (k * rows + r) * ld_);
  for (Index c = 0; c < window_; ++c)
    for (Index k = 0; k < count; ++k)
      std::memmove(HP_ + c * m + k * rows, HP_ + c * before + blocks[k] * rows, rows * sizeof(double));
  batch_.keep(blocks, count, rows);
  form_innovation();
}

template <class Pose>
double* Ekf<Pose>::inverse_innovation() {
  const Index m = batch_.rows();
  double* L = scratch_;
  for (Index j = 0; j < m; ++j) std::copy(S_ + j * m + j, S_ + (j + 1) * m, L + j * m + j);
  if (!cholesky(L, m, m, scratch_ + m * m)) return nullptr;
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

template <class Pose>
bool Ekf<Pose>::factor() {
  const Index m = batch_.rows();
  if (!cholesky(S_, m, m, scratch_)) return false;
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
  for (Index c = 0; c < window_; ++c) error_window_[c] = dot(HP_ + c * m, weights_, m);
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
  iterating_ = true;
  iterate_pose_ = pose_;
  retract(error, iterate_pose_);
  for (Index i = 0; i < mount_; ++i) iterate_mount_(i) = error_window_[kDof + i];
  const Mover mover(error_, error.template tail<kTurn>());
  for (Index a = 0; a < slot_count_; ++a)
    Eigen::Map<Point>(iterate_landmarks_ + kDim * a) =
        mover(local(slots_[a]), Eigen::Map<const Point>(error_window_ + landmark_column(a)));
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

// U N and U, one row a state; the pose's rows are zero, its columns of P are written whole. noise_rank_ tells how many
// columns there are: none with the standard error.
template <class Pose>
void Ekf<Pose>::prepare_pending() {
  noise_rank_ = pending_ && error_ == ErrorKind::invariant ? kTurn : 0;
  if (noise_rank_ == 0) return;
  const Eigen::Matrix<double, kTurn, kTurn> N = N_.template bottomRightCorner<kTurn, kTurn>();
  for (Index t = 0; t < kTurn; ++t) {
    std::fill_n(noise_left_ + t * ld_, kDof, 0.0);
    std::fill_n(noise_right_ + t * ld_, lead(), 0.0);
  }
  for (Index slot = 0; slot < size_; ++slot) {
    const typename Rotation::Turn U = -Rotation::turn(local(slot));
    for (Index t = 0; t < kTurn; ++t)
      for (Index r = 0; r < kDim; ++r) noise_right_[t * ld_ + state(slot) + r] = U(r, t);
  }
  // Down whole columns: a product a landmark would wait for its own small matrices to leave the store buffer.
  for (Index t = 0; t < kTurn; ++t) {
    std::fill(noise_left_ + t * ld_ + kDof, noise_left_ + t * ld_ + states(), 0.0);
    add_noise(noise_right_, N.col(t).data(), 1, states(), noise_left_ + t * ld_);
  }
}

// y += columns weights over the landmarks' rows, for the columns of prepare_pending(); weights lie `stride` apart.
template <class Pose>
void Ekf<Pose>::add_noise(const double* columns, const double* weights, Index stride, Index n, double* y) const {
  if (noise_rank_ == 0) return;
  if constexpr (kTurn == 3) {  // one pass
    const double a = weights[0], b = weights[stride], c = weights[2 * stride];
    const double *u = columns, *v = columns + ld_, *w = columns + 2 * ld_;
    for (Index i = kDof; i < n; ++i) y[i] += a * u[i] + b * v[i] + c * w[i];
  } else {
    for (Index t = 0; t < kTurn; ++t) add_scaled(weights[t * stride], columns + t * ld_, kDof, n, y);
  }
}

// The pose's columns of P_now, all rows: P F^T + U N.
template <class Pose>
void Ekf<Pose>::pending_pose_columns(double* out) const {
  const Index n = states();
  const Square pose = pose_block();
  for (Index c = 0; c < kDof; ++c) {
    double* to = out + c * ld_;
    std::copy_n(pose.data() + c * kDof, kDof, to);
    if (!pending_ || error_ == ErrorKind::invariant) {  // F = I
      std::copy(P_ + c * ld_ + kDof, P_ + c * ld_ + n, to + kDof);
    } else {
      std::fill(to + kDof, to + n, 0.0);
      for (Index k = 0; k < kDof; ++k) add_scaled(F_(c, k), P_ + k * ld_, kDof, n, to);
    }
    double weights[kTurn];
    for (Index t = 0; t < kTurn; ++t) weights[t] = N_(kDim + t, c);
    add_noise(noise_right_, weights, 1, n, to);
  }
}

// P <- P_now - W W^T over `rank` columns of W, those of prepare_pending() added in the same pass.
template <class Pose>
void Ekf<Pose>::write_covariance(Index rank, const double* pose_columns) {
  const Index n = states();
  for (Index c = 0; c < kDof; ++c) std::copy(pose_columns + c * ld_ + c, pose_columns + c * ld_ + n, P_ + c * ld_ + c);
  const TriangleTerm terms[] = {{W_, ld_, W_, ld_, rank, -1.0},
                                {noise_left_, ld_, noise_right_, ld_, noise_rank_, 1.0}};
  if (rank + noise_rank_ > 0) update_triangle(P_, ld_, n, terms, 2, scratch_);
  clear_pending();
}

template <class Pose>
void Ekf<Pose>::apply_pending() {
  if (!pending_) return;
  prepare_pending();
  pending_pose_columns(columns_);
  write_covariance(0, columns_);
}

template <class Pose>
void Ekf<Pose>::gather_columns() {
  constexpr Index kAhead = 4;  // columns
  const Index n = states();
  prepare_pending();
  pending_pose_columns(columns_);
  // The mount's angles are states for as long as the frame lasts, independent of all others before it; their rows stand
  // behind those of the states.
  for (Index i = 0; i < mount_; ++i) {
    for (Index c = 0; c < window_; ++c) columns_[c * ld_ + n + i] = 0.0;
    std::fill_n(columns_ + (kDof + i) * ld_, n, 0.0);
    for (Index r = 0; r < mount_; ++r) columns_[(kDof + i) * ld_ + n + r] = mount_covariance_(r, i);
  }
  // What stands left of a landmark's diagonal block lies along rows of P: a cache line a column. All landmarks of a few
  // columns in turn keep to their few pages, and the lines of those ahead are fetched meanwhile.
  for (Index c = kDof; c < n; c += kAhead) {
    const double* columns = P_ + c * ld_;
    for (Index a = 0; a < slot_count_; ++a) {
      const Index from = state(slots_[a]);
      if (c >= from) continue;
      double* to = columns_ + landmark_column(a) * ld_ + c;
      if (c + kAhead > from) {
        for (Index k = 0; c + k < from; ++k)
          for (Index d = 0; d < kDim; ++d) to[d * ld_ + k] = columns[k * ld_ + from + d];
        continue;
      }
      for (Index k = 0; k < kAhead; ++k) __builtin_prefetch(columns + (kAhead + k) * ld_ + from);
      for (Index d = 0; d < kDim; ++d)
        for (Index k = 0; k < kAhead; ++k) to[d * ld_ + k] = columns[k * ld_ + from + d];
    }
  }
  for (Index a = 0; a < slot_count_; ++a) {
    const Index from = state(slots_[a]);
    double* to = columns_ + landmark_column(a) * ld_;
    for (Index c = 0; c < kDof; ++c)
      for (Index d = 0; d < kDim; ++d) to[d * ld_ + c] = columns_[c * ld_ + from + d];
    for (Index d = 0; d < kDim; ++d)
      for (Index r = 0; r < kDim; ++r) to[d * ld_ + from + r] = symmetric(from + r, from + d);
    for (Index d = 0; d < kDim; ++d)
      std::copy_n(&P_[(from + d) * ld_ + from + kDim], n - from - kDim, to + d * ld_ + from + kDim);
    for (Index d = 0; d < kDim; ++d)  // + U N U_a^T
      add_noise(noise_left_, noise_right_ + from + d, ld_, n, to + d * ld_);
  }
}

template <class Pose>
bool Ekf<Pose>::commit() {
  constexpr double kLeast = 1e-14;
  const Index n = states(), m = batch_.rows();
  // P H^T of the last linearisation becomes W = P H^T L^-T; the error xi = W L^-1 r, and what P_new = P - W W^T (Mars
  // paper, eq. 13) takes off the diagonal, before anything is changed.
  const RowSums sums{innovation_, shrunk_, error_state_};
  solve_right_transposed(S_, m, m, W_, ld_, n + mount_, scratch_, &sums);

  for (Index i = 0; i < n; ++i) diagonal_[i] = i < kDof ? columns_[i * ld_ + i] : P(i, i);
  for (Index t = 0; t < noise_rank_; ++t)
    for (Index i = kDof; i < n; ++i) diagonal_[i] += noise_left_[t * ld_ + i] * noise_right_[t * ld_ + i];
  for (Index i = 0; i < n; ++i) {
    if (!std::isfinite(error_state_[i])) return false;
    // What is left of a variance must stand above the rounding of what it was; one that was zero stays so.
    if (!(diagonal_[i] - shrunk_[i] >= kLeast * diagonal_[i] && diagonal_[i] >= 0.0)) return false;
  }

  if (mount_ != 0) {
    for (Index c = 0; c < kMount; ++c) std::fill_n(mount_cross_ + c * ld_, n, 0.0);
    for (Index j = 0; j < m; ++j) {
      const double* W = W_ + j * ld_;
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
        mover(local(slot), Eigen::Map<const Point>(error_state_ + state(slot)));
  retract(error, pose_);
  for (Index k = 0; k < companions_; ++k) {
    const typename Rotation::Tangent turn = Eigen::Map<const typename Rotation::Tangent>(error_state_ + heading(k));
    companion_rotations_[k] = Rotation::exp(turn) * companion_rotations_[k];
  }
  return true;
}

}  // namespace cairn
