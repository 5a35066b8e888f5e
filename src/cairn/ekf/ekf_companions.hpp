// SPDX-License-Identifier: BSD-3-Clause
// Poses of other vehicles beside the filter's own. Included by ekf.cpp alone.
#pragma once

#include <algorithm>
#include <cstring>
#include <utility>

#include "ekf/ekf.hpp"
#include "linear/triangle.hpp"

namespace cairn {

// Rows and columns a and b change places.
template <class Pose>
void Ekf<Pose>::exchange(Index a, Index b) {
  if (a == b) return;
  if (a > b) std::swap(a, b);
  for (Index c = 0; c < a; ++c) std::swap(P(a, c), P(b, c));
  for (Index i = a + 1; i < b; ++i) std::swap(P(i, a), P(b, i));
  for (Index r = b + 1; r < states(); ++r) std::swap(P(r, a), P(r, b));
  std::swap(P(a, a), P(b, b));
}

// The last `count` states from `from` on, with all that they have with those before `from`.
template <class Pose>
void Ekf<Pose>::move_states(Index from, Index count, Index by) {
  const auto move_column = [&](Index to_column, Index column, Index row) {
    std::memmove(P_ + to_column * ld_ + row + by, P_ + column * ld_ + row,
                 static_cast<std::size_t>(from + count - row) * sizeof(double));
  };
  if (by > 0)
    for (Index c = from + count; c-- > from;) move_column(c + by, c, c);
  else
    for (Index c = from; c < from + count; ++c) move_column(c + by, c, c);
  for (Index c = 0; c < from + std::min<Index>(by, 0); ++c) move_column(c, c, from);
}

template <class Pose>
typename Ekf<Pose>::Square Ekf<Pose>::companion_covariance(Index k) const {
  // By the filter's own errors of pose, position of the companion and its attitude; then e_x = xi_x + G(x) xi_R.
  constexpr Index kAll = kDof + kDim;
  Eigen::Matrix<double, kAll, kAll> joint;
  gather(&k, 1, joint.data(), kAll);
  Eigen::Matrix<double, kTurn, kAll> attitude;  // with pose and position; motion held back does not turn it
  for (Index t = 0; t < kTurn; ++t) {
    Eigen::Matrix<double, kDof, 1> with_pose;
    for (Index c = 0; c < kDof; ++c) with_pose[c] = P(heading(k) + t, c);
    if (pending_) with_pose = (F_ * with_pose).eval();
    attitude.row(t).template head<kDof>() = with_pose;
    for (Index c = 0; c < kDim; ++c) attitude(t, kDof + c) = P(state(k) + c, heading(k) + t);
  }
  PointByPose J_pose = PointByPose::Zero();
  if (error_ == ErrorKind::invariant) J_pose.template rightCols<kTurn>() = Rotation::turn(local(k));
  Eigen::Matrix<double, kDim, kAll> J;
  J << J_pose, PointSquare::Identity();
  Square out;
  out.template topLeftCorner<kDim, kDim>() = J * joint * J.transpose();
  out.template bottomLeftCorner<kTurn, kDim>() = attitude * J.transpose();
  out.template topRightCorner<kDim, kTurn>() = out.template bottomLeftCorner<kTurn, kDim>().transpose();
  for (Index c = 0; c < kTurn; ++c)
    for (Index r = 0; r < kTurn; ++r) out(kDim + r, kDim + c) = symmetric(heading(k) + r, heading(k) + c);
  return 0.5 * (out + out.transpose());
}

template <class Pose>
bool Ekf<Pose>::add_companion(const Pose& pose, const Square& J_pose, const Square& noise) {
  const Point position = pose.translation() - origin_;
  // By the filter's own errors: xi_x = e_x - G(x) xi_R, and e_p = xi_p + G(p) xi_R.
  Square J = J_pose;
  if (error_ == ErrorKind::invariant) {
    J.template rightCols<kTurn>() += J_pose.template leftCols<kDim>() * Rotation::turn(pose_.translation());
    J.template topRightCorner<kDim, kTurn>() -= Rotation::turn(position);
  }
  const Square block = J * pose_block() * J.transpose() + noise;
  if (!position.allFinite() || !J.allFinite() || !block.allFinite()) return false;
  apply_pending();

  const Index k = companions_, before = lead(), n = states();
  move_states(before, n - before, kTurn);
  ++companions_;
  ++size_;
  // The first landmark's slot is the companion's now, its values go to the end.
  const Index last = size_ - 1, at = state(k), end = state(last);
  std::copy_n(landmarks_ + kDim * k, kDim, landmarks_ + kDim * last);
  for (Index d = 0; d < kDim; ++d)
    for (Index c = 0; c <= end + d; ++c) P(end + d, c) = 0.0;
  for (Index d = 0; d < kDim; ++d) exchange(at + d, end + d);

  Index rows[kDof];  // of [position; attitude]
  for (Index d = 0; d < kDim; ++d) rows[d] = at + d;
  for (Index t = 0; t < kTurn; ++t) rows[kDim + t] = heading(k) + t;
  const auto entry = [&](Index a, Index b) -> double& { return a >= b ? P(a, b) : P(b, a); };
  const auto is_new = [&](Index i) {
    return (i >= at && i < at + kDim) || (i >= heading(k) && i < heading(k) + kTurn);
  };
  for (Index i = 0; i < states(); ++i) {
    if (is_new(i)) continue;
    for (Index r = 0; r < kDof; ++r) {
      double value = 0.0;
      for (Index c = 0; c < kDof; ++c) value += J(r, c) * symmetric(i, c);
      entry(rows[r], i) = value;
    }
  }
  for (Index c = 0; c < kDof; ++c)
    for (Index r = 0; r <= c; ++r) entry(rows[r], rows[c]) = 0.5 * (block(r, c) + block(c, r));
  companion_rotations_[k] = pose.rotation();
  Eigen::Map<Point>(landmarks_ + kDim * k) = position;
  return true;
}

template <class Pose>
void Ekf<Pose>::remove_companion(Index k) {
  apply_pending();
  const Index last = companions_ - 1;
  if (k != last) {
    for (Index d = 0; d < kDim; ++d) exchange(state(k) + d, state(last) + d);
    for (Index t = 0; t < kTurn; ++t) exchange(heading(k) + t, heading(last) + t);
    std::swap_ranges(landmarks_ + kDim * k, landmarks_ + kDim * (k + 1), landmarks_ + kDim * last);
    companion_rotations_[k] = companion_rotations_[last];
  }
  remove(last);  // the last landmark moves into its slot
  const Index before = lead(), n = states();
  --companions_;
  move_states(before, n - before, -kTurn);
}

// With x_a the error of the active vehicle's attitude and x_b that of the companion's: xi_x = e_x - G(x) x_a becomes
// e_x - G(x) x_b = xi_x + G(x) (x_a - x_b), for every point x; then the two vehicles' states change places.
template <class Pose>
void Ekf<Pose>::activate(Index k) {
  apply_pending();
  const Index n = states();
  if (error_ == ErrorKind::invariant) {
    double *left = noise_left_, *right = noise_right_;  // G, and P h + G h^T P h / 2 with h^T e = x_a - x_b
    for (Index t = 0; t < kTurn; ++t) {
      std::fill_n(left + t * ld_, n, 0.0);
      for (Index i = 0; i < n; ++i) right[t * ld_ + i] = symmetric(i, kDim + t) - symmetric(i, heading(k) + t);
    }
    typename Rotation::Jacobian pivot;
    for (Index c = 0; c < kTurn; ++c)
      for (Index r = 0; r < kTurn; ++r) pivot(r, c) = right[c * ld_ + kDim + r] - right[c * ld_ + heading(k) + r];
    const auto add_point = [&](Index row, const Point& x) {
      const typename Rotation::Turn G = Rotation::turn(x), half = 0.5 * G * pivot;
      for (Index t = 0; t < kTurn; ++t)
        for (Index d = 0; d < kDim; ++d) {
          left[t * ld_ + row + d] = G(d, t);
          right[t * ld_ + row + d] += half(d, t);
        }
    };
    add_point(0, pose_.translation());
    for (Index slot = 0; slot < size_; ++slot) add_point(state(slot), local(slot));
    const TriangleTerm terms[] = {{left, ld_, right, ld_, kTurn, 1.0}, {right, ld_, left, ld_, kTurn, 1.0}};
    Point before, rest;
    for (Index d = 0; d < kDim; ++d) before[d] = P(state(k) + d, state(k) + d);
    update_triangle(P_, ld_, n, terms, 2, scratch_);
    // Of a vehicle that stands where it was told exactly nothing is left but rounding.
    for (Index d = 0; d < kDim; ++d) rest[d] = P(state(k) + d, state(k) + d);
    if (rest.cwiseAbs().maxCoeff() <= 1e-13 * before.maxCoeff())
      for (Index d = 0; d < kDim; ++d)
        for (Index i = 0; i < n; ++i) (i >= state(k) + d ? P(i, state(k) + d) : P(state(k) + d, i)) = 0.0;
  }
  for (Index d = 0; d < kDim; ++d) exchange(d, state(k) + d);
  for (Index t = 0; t < kTurn; ++t) exchange(kDim + t, heading(k) + t);
  const Pose other(companion_rotations_[k], local(k));
  companion_rotations_[k] = pose_.rotation();
  Eigen::Map<Point>(landmarks_ + kDim * k) = pose_.translation();
  pose_ = other;
}

}  // namespace cairn
