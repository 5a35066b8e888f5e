// SPDX-License-Identifier: BSD-3-Clause
// The origin from which the arms of the invariant error reach.
#include "ekf/state.hpp"
#include "linear/triangle.hpp"

namespace cairn {

// The attitude's uncertainty moves the vehicle by s on its arm; variances of s^2 cancel in the ordinary error. At the
// limit their rounding error is below a square millimetre.
template <class Pose>
bool State<Pose>::far_from_origin() const {
  constexpr double kLongest = 1e4, kNear = 1e3;  // m
  const double distance = pose_.translation().squaredNorm();
  if (!model_.invariant() || distance <= kNear * kNear) return false;
  return distance * pose_block().template bottomRightCorner<kTurn, kTurn>().trace() > kLongest * kLongest;
}

// With the origin moved by d, x' = x - d and xi_x' = e_x - G(x - d) xi_R = xi_x + G(d) xi_R for every point x.
template <class Pose>
void State<Pose>::move_origin() {
  apply_pending();
  const Point by = pose_.translation();
  const Index n = states();
  const typename ErrorModel<Pose>::Arm G = model_.arm(by);
  typename Rotation::Jacobian pivot;
  for (Index c = 0; c < kTurn; ++c)
    for (Index r = 0; r < kTurn; ++r) pivot(r, c) = P_.symmetric(kDim + r, kDim + c);
  // L = G in the rows of every point, and P_R + L P_RR / 2: P' = P + L P_R^T + P_R L^T + L P_RR L^T
  const typename ErrorModel<Pose>::Arm half = 0.5 * G * pivot;
  double *left = motion_.scratch_left(), *right = motion_.scratch_right();
  for (Index t = 0; t < kTurn; ++t) {
    std::fill_n(left + t * ld_, n, 0.0);
    for (Index i = 0; i < n; ++i) right[t * ld_ + i] = P_.symmetric(i, kDim + t);
  }
  const auto add_point = [&](Index row) {
    for (Index t = 0; t < kTurn; ++t)
      for (Index d = 0; d < kDim; ++d) {
        left[t * ld_ + row + d] = G(d, t);
        right[t * ld_ + row + d] += half(d, t);
      }
  };
  add_point(layout_.pose().offset);
  for (Index slot = 0; slot < size(); ++slot) add_point(layout_.point(slot).offset);
  const TriangleTerm terms[] = {{left, ld_, right, ld_, kTurn, 1.0}, {right, ld_, left, ld_, kTurn, 1.0}};
  update_triangle(P_.column(0), ld_, n, terms, 2, workspace_.scratch);
  for (Index slot = 0; slot < size(); ++slot) place_of(slot) -= by;
  pose_ = Pose(pose_.rotation(), Point::Zero());
  origin_ += by;
  double* const diagonal = workspace_.diagonal;
  for (Index i = 0; i < n; ++i) diagonal[i] = P_(i, i);
  raise_variances(diagonal, pivot.trace());
}

// With the invariant error the ordinary variance of a point on a long arm is a small difference of large variances.
// Less than 1e-14 of them is rounding error. The variance is raised to that: less is known, but nothing wrong.
template <class Pose>
void State<Pose>::raise_variances(const double* before, double turn) {
  constexpr double kLongest = 1e3;  // m that one standard deviation of the attitude moves a point
  constexpr double kLeast = 1e-14;
  if (!model_.invariant()) return;
  const auto raise = [&](const Point& x, Index at) {
    if (x.squaredNorm() * turn <= kLongest * kLongest) return;
    const typename ErrorModel<Pose>::Arm G = model_.arm(x);
    for (Index d = 0; d < kDim; ++d) {
      double variance = P_(at + d, at + d), terms = before[at + d];
      for (Index t = 0; t < kTurn; ++t) {
        variance += 2.0 * G(d, t) * P_.symmetric(at + d, kDim + t);
        terms += G(d, t) * G(d, t) * turn;
        for (Index u = 0; u < kTurn; ++u) variance += G(d, t) * G(d, u) * P_.symmetric(kDim + t, kDim + u);
      }
      if (!(variance >= kLeast * terms)) P_(at + d, at + d) += kLeast * terms - variance;
    }
  };
  raise(pose_.translation(), layout_.pose().offset);
  for (Index slot = 0; slot < size(); ++slot) raise(local(slot), layout_.point(slot).offset);
}

template bool State<SE2>::far_from_origin() const;
template void State<SE2>::move_origin();
template void State<SE2>::raise_variances(const double*, double);
template bool State<SE3>::far_from_origin() const;
template void State<SE3>::move_origin();
template void State<SE3>::raise_variances(const double*, double);

}  // namespace cairn
