// SPDX-License-Identifier: BSD-3-Clause
// Companions: the poses of other vehicles in the state.
#include <algorithm>

#include "ekf/ekf_update.hpp"
#include "ekf/state.hpp"
#include "linear/triangle.hpp"

namespace cairn {

template <class Pose>
typename State<Pose>::Square State<Pose>::companion_covariance(Index k) const {
  // Jacobians by the filter's own errors of the pose, the companion's position and its attitude; then e_x = xi_x + G(x)
  // xi_R.
  constexpr Index kAll = kDof + kDim;
  const Index heading = layout_.attitude(k).offset, position = layout_.point(k).offset;
  Eigen::Matrix<double, kAll, kAll> joint;
  gather(&k, 1, joint.data(), kAll);
  Eigen::Matrix<double, kTurn, kAll> attitude;  // with pose and position; motion held back does not turn it
  for (Index t = 0; t < kTurn; ++t) {
    Eigen::Matrix<double, kDof, 1> with_pose;
    for (Index c = 0; c < kDof; ++c) with_pose[c] = P_(heading + t, c);
    if (motion_.any()) with_pose = (motion_.F() * with_pose).eval();
    attitude.row(t).template head<kDof>() = with_pose;
    for (Index c = 0; c < kDim; ++c) attitude(t, kDof + c) = P_(position + c, heading + t);
  }
  PointByPose J_pose = PointByPose::Zero();
  if (model_.invariant()) J_pose.template rightCols<kTurn>() = model_.arm(local(k));
  Eigen::Matrix<double, kDim, kAll> J;
  J << J_pose, PointSquare::Identity();
  Square out;
  out.template topLeftCorner<kDim, kDim>() = J * joint * J.transpose();
  out.template bottomLeftCorner<kTurn, kDim>() = attitude * J.transpose();
  out.template topRightCorner<kDim, kTurn>() = out.template bottomLeftCorner<kTurn, kDim>().transpose();
  for (Index c = 0; c < kTurn; ++c)
    for (Index r = 0; r < kTurn; ++r) out(kDim + r, kDim + c) = P_.symmetric(heading + r, heading + c);
  return 0.5 * (out + out.transpose());
}

template <class Pose>
bool State<Pose>::add_companion(const Pose& pose, const Square& J_pose, const Square& noise) {
  const Point position = pose.translation() - origin_;
  // Jacobians by the filter's own errors: xi_x = e_x - G(x) xi_R, and e_p = xi_p + G(p) xi_R.
  Square J = J_pose;
  if (model_.invariant()) {
    J.template rightCols<kTurn>() += J_pose.template leftCols<kDim>() * model_.arm(pose_.translation());
    J.template topRightCorner<kDim, kTurn>() -= model_.arm(position);
  }
  const Square block = J * pose_block() * J.transpose() + noise;
  if (!position.allFinite() || !J.allFinite() || !block.allFinite()) return false;
  apply_pending();

  const Index k = companions(), before = layout_.lead(), n = states();
  P_.move_tail(before, n - before, kTurn);
  layout_.add_companion();
  layout_.add_points(1);
  // The companion gets the first landmark's slot, and that landmark's values move to the end.
  const Index last = size() - 1, at = layout_.point(k).offset, end = layout_.point(last).offset;
  const Index heading = layout_.attitude(k).offset;
  place_of(last) = Point(local(k));
  for (Index d = 0; d < kDim; ++d)
    for (Index c = 0; c <= end + d; ++c) P_(end + d, c) = 0.0;
  for (Index d = 0; d < kDim; ++d) P_.exchange(at + d, end + d, states());

  Index rows[kDof];  // of [position; attitude]
  for (Index d = 0; d < kDim; ++d) rows[d] = at + d;
  for (Index t = 0; t < kTurn; ++t) rows[kDim + t] = heading + t;
  const auto is_new = [&](Index i) { return (i >= at && i < at + kDim) || (i >= heading && i < heading + kTurn); };
  for (Index i = 0; i < states(); ++i) {
    if (is_new(i)) continue;
    for (Index r = 0; r < kDof; ++r) {
      double value = 0.0;
      for (Index c = 0; c < kDof; ++c) value += J(r, c) * P_.symmetric(i, c);
      P_.entry(rows[r], i) = value;
    }
  }
  for (Index c = 0; c < kDof; ++c)
    for (Index r = 0; r <= c; ++r) P_.entry(rows[r], rows[c]) = 0.5 * (block(r, c) + block(c, r));
  attitudes_[k] = pose.rotation();
  place_of(k) = position;
  return true;
}

template <class Pose>
void State<Pose>::remove_companion(Index k) {
  apply_pending();
  const Index last = companions() - 1;
  if (k != last) {
    exchange_landmarks(k, last);
    const Index a = layout_.attitude(k).offset, b = layout_.attitude(last).offset;
    for (Index t = 0; t < kTurn; ++t) P_.exchange(a + t, b + t, states());
    attitudes_[k] = attitudes_[last];
  }
  remove(last);  // the last landmark moves into its slot
  const Index before = layout_.lead(), n = states();
  layout_.remove_last_companion();
  P_.move_tail(before, n - before, -kTurn);
}

// After a difference of variances. A vehicle that is known exactly stays so: its attitude has no variance, and what is
// left of its position's is rounding error. For any other variance the rounding error is added, so that it stays
// positive.
template <class Pose>
void State<Pose>::restore_lost_digits(const double* scale) {
  constexpr double kLost = 1e-13;
  const Index n = states();
  const auto lost = [&](Index i) { return P_(i, i) <= kLost * scale[i]; };
  const auto exact = [&](Index attitude, Index position) {
    for (Index t = 0; t < kTurn; ++t)
      if (P_(attitude + t, attitude + t) != 0.0) return false;
    for (Index d = 0; d < kDim; ++d)
      if (!lost(position + d)) return false;
    return true;
  };
  const auto restore = [&](Index position, bool known) {
    for (Index d = 0; d < kDim; ++d) {
      const Index i = position + d;
      if (known)
        for (Index k = 0; k < n; ++k) P_.entry(k, i) = 0.0;
      else if (lost(i))
        P_(i, i) = std::max(P_(i, i), 0.0) + kLost * scale[i];
    }
  };
  restore(0, exact(kDim, 0));
  for (Index slot = 0; slot < size(); ++slot) {
    const Index at = layout_.point(slot).offset;
    restore(at, slot < companions() && exact(layout_.attitude(slot).offset, at));
  }
}

// With x_a the error of the active vehicle's attitude and x_b that of the companion's: xi_x = e_x - G(x) x_a becomes
// e_x - G(x) x_b = xi_x + G(x) (x_a - x_b), for every point x. Then the two vehicles' states change places.
template <class Pose>
void State<Pose>::activate(Index k) {
  apply_pending();
  const Index n = states(), heading = layout_.attitude(k).offset, position = layout_.point(k).offset;
  if (model_.invariant()) {
    // G, and P h + G h^T P h / 2 with h^T e = x_a - x_b
    double *left = motion_.scratch_left(), *right = motion_.scratch_right();
    for (Index t = 0; t < kTurn; ++t) {
      std::fill_n(left + t * ld_, n, 0.0);
      for (Index i = 0; i < n; ++i) right[t * ld_ + i] = P_.symmetric(i, kDim + t) - P_.symmetric(i, heading + t);
    }
    typename Rotation::Jacobian pivot;
    for (Index c = 0; c < kTurn; ++c)
      for (Index r = 0; r < kTurn; ++r) pivot(r, c) = right[c * ld_ + kDim + r] - right[c * ld_ + heading + r];
    const auto add_point = [&](Index row, const Point& x) {
      const typename ErrorModel<Pose>::Arm G = model_.arm(x), half = 0.5 * G * pivot;
      for (Index t = 0; t < kTurn; ++t)
        for (Index d = 0; d < kDim; ++d) {
          left[t * ld_ + row + d] = G(d, t);
          right[t * ld_ + row + d] += half(d, t);
        }
    };
    add_point(0, pose_.translation());
    for (Index slot = 0; slot < size(); ++slot) add_point(layout_.point(slot).offset, local(slot));
    // The variances from whose difference the new ones follow: what is left below their rounding error is not known.
    double* const scale = workspace_.diagonal;
    double turns = 0.0;  // of both attitudes
    for (Index t = 0; t < kTurn; ++t) turns += P_(kDim + t, kDim + t) + P_(heading + t, heading + t);
    for (Index i = 0; i < n; ++i) {
      double arm = 0.0;
      for (Index t = 0; t < kTurn; ++t) arm += left[t * ld_ + i] * left[t * ld_ + i];
      scale[i] = P_(i, i) + arm * turns;
    }
    const TriangleTerm terms[] = {{left, ld_, right, ld_, kTurn, 1.0}, {right, ld_, left, ld_, kTurn, 1.0}};
    update_triangle(P_.column(0), ld_, n, terms, 2, workspace_.scratch);
    restore_lost_digits(scale);
  }
  for (Index d = 0; d < kDim; ++d) P_.exchange(d, position + d, n);
  for (Index t = 0; t < kTurn; ++t) P_.exchange(kDim + t, heading + t, n);
  const Pose other(attitudes_[k], local(k));
  attitudes_[k] = pose_.rotation();
  place_of(k) = pose_.translation();
  pose_ = other;
}

template SE2::Square State<SE2>::companion_covariance(Index) const;
template bool State<SE2>::add_companion(const SE2&, const Square&, const Square&);
template void State<SE2>::remove_companion(Index);
template void State<SE2>::restore_lost_digits(const double*);
template void State<SE2>::activate(Index);

template SE3::Square State<SE3>::companion_covariance(Index) const;
template bool State<SE3>::add_companion(const SE3&, const Square&, const Square&);
template void State<SE3>::remove_companion(Index);
template void State<SE3>::restore_lost_digits(const double*);
template void State<SE3>::activate(Index);

}  // namespace cairn
