// SPDX-License-Identifier: BSD-3-Clause
#include "ekf/pending_motion.hpp"

namespace cairn {
namespace {

// y += factor x from row `first` to before row `last`.
void add_scaled(double factor, const double* x, Index first, Index last, double* y) {
  for (Index i = first; i < last; ++i) y[i] += factor * x[i];
}

}  // namespace

template <class Pose>
PendingMotion<Pose>::PendingMotion(Arena& arena, const ErrorModel<Pose>& model, Index ld, Index systematic)
    : model_(model),
      ld_(ld),
      left_(arena.take<double>(ld * kTurn)),
      right_(arena.take<double>(ld * kTurn)),
      turn_rows_(arena.take<double>(kTurn * (kDof + systematic))) {}

template <class Pose>
void PendingMotion<Pose>::set_systematic(Index count, Index motion, const double* walk) {
  count_ = count;
  motion_ = motion;
  walk_ = walk;
  C_.setZero();
  N_cross_.setZero();
}

template <class Pose>
void PendingMotion<Pose>::clear() {
  any_ = turns_ = false;
  F_.setIdentity();
  N_.setZero();
  elapsed_ = 0.0;
  if (motion_ == 0) return;
  C_.setZero();
  N_cross_.setZero();
}

template <class Pose>
bool PendingMotion<Pose>::add(const Pose& before, const Pose& next, const Increment<Pose>& increment,
                              const MotionCoupling<Pose>* coupling) {
  using Rotation = typename Pose::Rotation;
  const Square B = model_.by_increment(before, next);
  Square F = F_, N = N_;
  if (!model_.invariant()) {  // e_p += G(R d) e_R; the invariant error itself stays: propagation is the identity
    Square step = Square::Identity();
    step.template topRightCorner<kDim, kTurn>() = Rotation::turn(next.translation() - before.translation());
    F = step * F_;
    N = step * N_ * step.transpose();
  }
  N += B * increment.covariance * B.transpose();
  Coupling C = C_, N_cross = N_cross_;
  const bool coupled = motion_ > 0 && coupling != nullptr;
  if (motion_ > 0 && !model_.invariant()) {
    C.template topRows<kDim>() +=
        Rotation::turn(next.translation() - before.translation()) * C_.template bottomRows<kTurn>();
    N_cross.template topRows<kDim>() +=
        Rotation::turn(next.translation() - before.translation()) * N_cross_.template bottomRows<kTurn>();
  }
  if (coupled) {  // (docs/systematic_errors.md, eq. 5 and 6): the walk so far moves the pose, too
    const Coupling E = B * coupling->J;
    C += E;
    Eigen::Matrix<double, kMotionStates, 1> walked = Eigen::Matrix<double, kMotionStates, 1>::Zero();
    for (Index i = 0; i < motion_; ++i) walked[i] = walk_[i] * elapsed_;
    const Coupling moved = E * walked.asDiagonal();
    const Square across = N_cross * E.transpose();
    N += across + across.transpose() + moved * E.transpose();
    N_cross += moved;
  }
  if (!next.translation().allFinite() || !next.rotation().matrix().allFinite() || !N.allFinite() || !F.allFinite())
    return false;
  if (motion_ > 0) {
    if (!C.allFinite() || !N_cross.allFinite()) return false;
    C_ = C;
    N_cross_ = N_cross;
    turns_ = model_.invariant() && !C_.template bottomRows<kTurn>().isZero(0.0);
  }
  if (coupling != nullptr) elapsed_ += coupling->dt;
  F_ = F;
  N_ = 0.5 * (N + N.transpose());
  any_ = true;
  return true;
}

template <class Pose>
bool PendingMotion<Pose>::widen(const Square& covariance) {
  const Square N = N_ + covariance;
  if (!N.allFinite()) return false;
  N_ = 0.5 * (N + N.transpose());
  any_ = true;
  return true;
}

template <class Pose>
double PendingMotion<Pose>::plain(const LowerTriangle& P, Index i, Index column) const {
  if (column >= kDof) return P.symmetric(kDof + i, column);
  double sum = 0.0;
  for (Index k = 0; k < kDof; ++k) sum += F_(column, k) * P(kDof + i, k);
  for (Index j = 0; j < motion_; ++j) sum += C_(column, j) * P.symmetric(kDof + i, kDof + j);
  return sum;
}

template <class Pose>
void PendingMotion<Pose>::systematic_row(const LowerTriangle& P, Index i, double* row) const {
  for (Index c = 0; c < moving(); ++c) row[c] = plain(P, i, c);
  if (i < motion_)
    for (Index c = 0; c < kDof; ++c) row[c] += N_cross_(c, i);
  if (any_) row[kDof + i] += walk_[i] * elapsed_;
}

template <class Pose>
void PendingMotion<Pose>::turn_rows(const LowerTriangle& P, double* out) const {
  for (Index c = 0; c < moving(); ++c)
    for (Index t = 0; t < kTurn; ++t) {
      double sum = c < kDof ? N_(kDim + t, c) : c - kDof < motion_ ? N_cross_(kDim + t, c - kDof) : 0.0;
      if (turns_)
        for (Index j = 0; j < motion_; ++j) sum += C_(kDim + t, j) * plain(P, j, c);
      out[c * kTurn + t] = sum;
    }
}

template <class Pose>
typename PendingMotion<Pose>::Square PendingMotion<Pose>::pose_block(const LowerTriangle& P) const {
  Square block;
  for (Index c = 0; c < kDof; ++c)
    for (Index r = c; r < kDof; ++r) block(r, c) = block(c, r) = P(r, c);
  if (!any_) return block;
  Square moved = F_ * block * F_.transpose() + N_;
  if (motion_ > 0) {  // + C P_sp F^T + F P_ps C^T + C P_ss C^T
    Coupling with_pose = Coupling::Zero();
    Eigen::Matrix<double, kMotionStates, kMotionStates> own;
    own.setZero();
    for (Index i = 0; i < motion_; ++i) {
      for (Index c = 0; c < kDof; ++c) with_pose(c, i) = P(kDof + i, c);
      for (Index j = 0; j < motion_; ++j) own(i, j) = P.symmetric(kDof + i, kDof + j);
    }
    const Square across = F_ * with_pose * C_.transpose();
    moved += across + across.transpose() + C_ * own * C_.transpose();
  }
  return 0.5 * (moved + moved.transpose());
}

template <class Pose>
void PendingMotion<Pose>::prepare(const StateLayout<Pose>& layout, const double* points, const LowerTriangle& P) {
  rank_ = reaches_points() ? kTurn : 0;
  if (rank_ == 0) return;
  const Eigen::Matrix<double, kTurn, kTurn> N = N_.template bottomRightCorner<kTurn, kTurn>();
  for (Index t = 0; t < kTurn; ++t) {
    std::fill_n(left_ + t * ld_, moving(), 0.0);
    std::fill_n(right_ + t * ld_, layout.lead(), 0.0);
  }
  for (Index slot = 0; slot < layout.points(); ++slot) {
    const typename ErrorModel<Pose>::Arm U = -model_.arm(Eigen::Map<const Point>(points + kDim * slot));
    const Index row = layout.point(slot).offset;
    for (Index t = 0; t < kTurn; ++t)
      for (Index r = 0; r < kDim; ++r) right_[t * ld_ + row + r] = U(r, t);
  }
  // The loop runs down whole columns. One small product per landmark is slower: each product waits until its inputs,
  // which were just written, have left the store buffer.
  const Index n = layout.states();
  for (Index t = 0; t < kTurn; ++t) {
    std::fill(left_ + t * ld_ + moving(), left_ + t * ld_ + n, 0.0);
    add_noise(right_, N.col(t).data(), 1, n, left_ + t * ld_);
  }
  if (turns_) prepare_turn(n, P);
}

// What the systematic errors turned reaches the points with their correlations: U V^T + V U^T + U M U^T with
// V = P_xs D^T, M = D P_ss D^T + N_RR, is U (V + U M / 2)^T and its transpose (docs/systematic_errors.md, eq. 8).
template <class Pose>
void PendingMotion<Pose>::prepare_turn(Index n, const LowerTriangle& P) {
  Eigen::Matrix<double, kTurn, kTurn> M = N_.template bottomRightCorner<kTurn, kTurn>();
  for (Index t = 0; t < kTurn; ++t)
    for (Index u = 0; u < kTurn; ++u)
      for (Index i = 0; i < motion_; ++i)
        for (Index j = 0; j < motion_; ++j)
          M(t, u) += C_(kDim + t, i) * P.symmetric(kDof + i, kDof + j) * C_(kDim + u, j);
  M = (0.25 * (M + M.transpose())).eval();
  for (Index t = 0; t < kTurn; ++t) {
    double* to = left_ + t * ld_;
    std::fill(to + moving(), to + n, 0.0);
    add_noise(right_, M.col(t).data(), 1, n, to);
    for (Index j = 0; j < motion_; ++j) add_scaled(C_(kDim + t, j), P.column(kDof + j), moving(), n, to);
  }
}

template <class Pose>
void PendingMotion<Pose>::add_noise(const double* columns, const double* weights, Index stride, Index n,
                                    double* y) const {
  if (rank_ == 0) return;
  if constexpr (kTurn == 3) {  // one pass
    const double a = weights[0], b = weights[stride], c = weights[2 * stride];
    const double *u = columns, *v = columns + ld_, *w = columns + 2 * ld_;
    for (Index i = moving(); i < n; ++i) y[i] += a * u[i] + b * v[i] + c * w[i];
  } else {
    for (Index t = 0; t < kTurn; ++t) add_scaled(weights[t * stride], columns + t * ld_, moving(), n, y);
  }
}

template <class Pose>
void PendingMotion<Pose>::add_change(Index from, Index n, double* y) const {
  add_noise(left_, right_ + from, ld_, n, y);
  if (turns_) add_noise(right_, left_ + from, ld_, n, y);
}

template <class Pose>
void PendingMotion<Pose>::moving_columns(const LowerTriangle& P, Index n, double* out) const {
  const Square pose = pose_block(P);
  if (rank_ > 0) turn_rows(P, turn_rows_);
  for (Index c = 0; c < kDof; ++c) {
    double* to = out + c * ld_;
    std::copy_n(pose.data() + c * kDof, kDof, to);
    if (!any_ || model_.invariant()) {  // F = I
      std::copy(P.column(c) + kDof, P.column(c) + n, to + kDof);
    } else {
      std::fill(to + kDof, to + n, 0.0);
      for (Index k = 0; k < kDof; ++k) add_scaled(F_(c, k), P.column(k), kDof, n, to);
    }
    for (Index j = 0; any_ && j < motion_; ++j) add_scaled(C_(c, j), P.column(kDof + j), moving(), n, to);
    add_noise(right_, turn_rows_ + c * kTurn, 1, n, to);
  }
  for (Index i = 0; i < count_; ++i) {
    double* to = out + (kDof + i) * ld_;
    systematic_row(P, i, to);
    for (Index c = 0; c < kDof; ++c) out[c * ld_ + kDof + i] = to[c];
    std::copy(P.column(kDof + i) + moving(), P.column(kDof + i) + n, to + moving());
    add_noise(right_, turn_rows_ + (kDof + i) * kTurn, 1, n, to);
  }
}

template class PendingMotion<SE2>;
template class PendingMotion<SE3>;

}  // namespace cairn
