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
PendingMotion<Pose>::PendingMotion(Arena& arena, const ErrorModel<Pose>& model, Index ld)
    : model_(model), ld_(ld), left_(arena.take<double>(ld * kTurn)), right_(arena.take<double>(ld * kTurn)) {}

template <class Pose>
void PendingMotion<Pose>::clear() {
  any_ = false;
  F_.setIdentity();
  N_.setZero();
}

template <class Pose>
bool PendingMotion<Pose>::add(const Pose& before, const Pose& next, const Increment<Pose>& increment) {
  using Rotation = typename Pose::Rotation;
  // The increment's ordinary error turned into the map's axes: e_p += R dp + G(R d) e_theta, e_theta += R dtheta.
  Square B = Square::Zero();
  B.template topLeftCorner<kDim, kDim>() = before.rotation().matrix();
  B.template bottomRightCorner<kTurn, kTurn>() = before.rotation().adjoint();
  Square F = F_, N = N_;
  if (model_.invariant()) {
    // xi_p = e_p - G(p) e_theta at the new position; the error itself stays: propagation is the identity.
    B.template topRightCorner<kDim, kTurn>() =
        -model_.arm(next.translation()) * B.template bottomRightCorner<kTurn, kTurn>();
  } else {
    Square step = Square::Identity();
    step.template topRightCorner<kDim, kTurn>() = Rotation::turn(next.translation() - before.translation());
    F = step * F_;
    N = step * N_ * step.transpose();
  }
  N += B * increment.covariance * B.transpose();
  if (!next.translation().allFinite() || !next.rotation().matrix().allFinite() || !N.allFinite() || !F.allFinite())
    return false;
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
typename PendingMotion<Pose>::Square PendingMotion<Pose>::pose_block(const LowerTriangle& P) const {
  Square block;
  for (Index c = 0; c < kDof; ++c)
    for (Index r = c; r < kDof; ++r) block(r, c) = block(c, r) = P(r, c);
  if (!any_) return block;
  const Square moved = F_ * block * F_.transpose() + N_;
  return 0.5 * (moved + moved.transpose());
}

template <class Pose>
void PendingMotion<Pose>::prepare(const StateLayout<Pose>& layout, const double* points) {
  rank_ = reaches_points() ? kTurn : 0;
  if (rank_ == 0) return;
  const Eigen::Matrix<double, kTurn, kTurn> N = N_.template bottomRightCorner<kTurn, kTurn>();
  for (Index t = 0; t < kTurn; ++t) {
    std::fill_n(left_ + t * ld_, kDof, 0.0);
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
    std::fill(left_ + t * ld_ + kDof, left_ + t * ld_ + n, 0.0);
    add_noise(right_, N.col(t).data(), 1, n, left_ + t * ld_);
  }
}

template <class Pose>
void PendingMotion<Pose>::add_noise(const double* columns, const double* weights, Index stride, Index n,
                                    double* y) const {
  if (rank_ == 0) return;
  if constexpr (kTurn == 3) {  // one pass
    const double a = weights[0], b = weights[stride], c = weights[2 * stride];
    const double *u = columns, *v = columns + ld_, *w = columns + 2 * ld_;
    for (Index i = kDof; i < n; ++i) y[i] += a * u[i] + b * v[i] + c * w[i];
  } else {
    for (Index t = 0; t < kTurn; ++t) add_scaled(weights[t * stride], columns + t * ld_, kDof, n, y);
  }
}

template <class Pose>
void PendingMotion<Pose>::pose_columns(const LowerTriangle& P, Index n, double* out) const {
  const Square pose = pose_block(P);
  for (Index c = 0; c < kDof; ++c) {
    double* to = out + c * ld_;
    std::copy_n(pose.data() + c * kDof, kDof, to);
    if (!any_ || model_.invariant()) {  // F = I
      std::copy(P.column(c) + kDof, P.column(c) + n, to + kDof);
    } else {
      std::fill(to + kDof, to + n, 0.0);
      for (Index k = 0; k < kDof; ++k) add_scaled(F_(c, k), P.column(k), kDof, n, to);
    }
    double weights[kTurn];
    for (Index t = 0; t < kTurn; ++t) weights[t] = N_(kDim + t, c);
    add_noise(right_, weights, 1, n, to);
  }
}

template class PendingMotion<SE2>;
template class PendingMotion<SE3>;

}  // namespace cairn
