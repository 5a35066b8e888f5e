// SPDX-License-Identifier: BSD-3-Clause
// Composition of a submap with the state of the whole map (docs/submaps.md).
#include "ekf/ekf_update.hpp"
#include "ekf/state.hpp"
#include "linear/triangle.hpp"

namespace cairn {

// Composition of eq. 17-26 of the Mars paper with the group's product in place of its sum of Euler angles. In errors:
//   invariant  xi_R' = xi_RS + R_S xi_RL
//              xi_x' = xi_pS + R_S xi_xL + hat(p_S) R_S xi_RL       new pose and new landmarks
//              xi_l' = xi_l + hat(l) R_S xi_RL                      old landmarks: the reference turns
//   standard   e_R' = e_RS + R_S e_RL,  e_x' = e_pS + G(R_S x_L) e_RS + R_S e_xL,  e_l' = e_l
// where the submap's errors are K y + w, y the errors of the systematic errors, of the base if fixes in the submap told
// about it, and of the fused landmarks as seen from the base, and w ~ N(0, W). A systematic error that walked changes
// by s' = s + d.
template <class Pose>
void State<Pose>::compose(const Handover& handover) {
  using Matrix = Eigen::MatrixXd;
  using Eigen::all;
  const bool invariant = model_.invariant();
  const Index fused = handover.fused_count, fresh = handover.fresh_count;
  const Index own = systematic(), moving = kDof + own, walked = handover.walking_count;
  const Index rest = kDof + walked + kDim * fresh, q = moving + kDim * fused, n = states();
  const Index out = moving + kDim * fresh;  // rows that become new
  const PointSquare R = pose_.rotation().matrix();
  const Point p = pose_.translation();
  apply_pending();

  // Columns of P of the base and the fused landmarks, all rows.
  std::vector<Index> chosen(q);
  for (Index c = 0; c < moving; ++c) chosen[c] = c;
  for (Index a = 0; a < fused; ++a)
    for (Index d = 0; d < kDim; ++d) chosen[moving + kDim * a + d] = layout_.point(handover.fused[a]).offset + d;
  Matrix columns(n, q);
  for (Index c = 0; c < q; ++c)
    for (Index r = 0; r < n; ++r) columns(r, c) = P_.symmetric(r, chosen[c]);

  // Jacobian of the systematic errors, the base's ordinary error, and y = R_S^T (l - p_S) of the fused landmarks by the
  // errors of base, systematic errors and landmarks.
  const Index first_fused = own + (handover.by_base ? kDof : 0);
  Matrix Y = Matrix::Zero(first_fused + kDim * fused, q);
  Y.block(0, kDof, own, own).setIdentity();
  if (handover.by_base) {
    Y.block(own, 0, kDof, kDof).setIdentity();
    if (invariant) Y.block(own, kDim, kDim, kTurn) = model_.arm(p);
  }
  for (Index a = 0; a < fused; ++a) {
    const Index row = first_fused + kDim * a;
    Y.block(row, 0, kDim, kDim) = -R.transpose();
    Y.block(row, moving + kDim * a, kDim, kDim) = R.transpose();
    if (!invariant) Y.block(row, kDim, kDim, kTurn) = -R.transpose() * Rotation::turn(local(handover.fused[a]) - p);
  }
  const Matrix KY = handover.K * Y;

  // Jacobians of the new pose, systematic errors and landmarks by (base, systematic errors, fused) and by w.
  Matrix A = Matrix::Zero(out, q), B = Matrix::Zero(out, rest);
  const auto set_point = [&](Index row, Index from, const Point& arm) {  // `from`: its row in the rest
    A.middleRows(row, kDim) = R * KY.middleRows(from, kDim);
    A.block(row, 0, kDim, kDim) += PointSquare::Identity();
    B.block(row, from, kDim, kDim) = R;
    if (!invariant) A.block(row, kDim, kDim, kTurn) += Rotation::turn(arm);
  };
  const Matrix J_turn = pose_.rotation().adjoint();
  A.middleRows(kDim, kTurn) = J_turn * KY.middleRows(kDim, kTurn);
  const Matrix C = A.middleRows(kDim, kTurn);  // R_S xi_RL without its own noise
  A.block(kDim, kDim, kTurn, kTurn) += Eigen::Matrix<double, kTurn, kTurn>::Identity();
  B.block(kDim, kDim, kTurn, kTurn) = J_turn;
  set_point(0, 0, R * handover.T_base_end.translation());
  for (Index a = 0; a < fresh; ++a) set_point(moving + kDim * a, kDof + walked + kDim * a, R * handover.fresh[a]);
  A.block(kDof, kDof, own, own).setIdentity();
  for (Index k = 0; k < walked; ++k) {
    A.row(kDof + handover.walking[k]) += KY.row(kDof + k);
    B(kDof + handover.walking[k], kDof + k) = 1.0;
  }
  if (invariant) {
    const typename ErrorModel<Pose>::Arm arm = -model_.arm(p);
    for (Index row = 0; row < out; row += row == 0 ? moving : kDim) {
      A.middleRows(row, kDim) += arm * C;
      B.block(row, kDim, kDim, kTurn) += arm * J_turn;
    }
  }
  const Matrix noise = B * handover.W * B.transpose();
  Matrix across = A * columns.transpose();  // new by old states, before the old ones' reference turns
  Matrix block = A * columns(chosen, all) * A.transpose() + noise;
  block = (0.5 * (block + block.transpose())).eval();
  // Beside a base that is hardly known, the submap's own noise would be lost to rounding: it is raised (augment()).
  for (Index i = 0; i < rest; ++i) {
    const double lost = 1e-14 * block(i, i);
    if (lost > 1e-6 * noise(i, i) && (i < kDim || i >= kDof)) block(i, i) += lost;
  }

  if (invariant && size() > 0) {
    const Matrix turned = columns * C.transpose();  // covariance of all states with R_S xi_RL
    const Matrix pivot = C * turned(chosen, all) + noise.block(kDim, kDim, kTurn, kTurn);
    Matrix new_turned = A * turned(chosen, all) + noise.middleCols(kDim, kTurn);
    Matrix left = Matrix::Zero(n, kTurn), right = turned;  // an attitude of a companion keeps its error: it has no U
    for (Index slot = 0; slot < size(); ++slot) {
      const typename ErrorModel<Pose>::Arm U = -model_.arm(local(slot));
      const Index row = layout_.point(slot).offset;
      left.middleRows(row, kDim) = U;
      right.middleRows(row, kDim) += 0.5 * U * pivot;
    }
    across += new_turned * left.transpose();
    std::vector<double> workspace(update_triangle_workspace(n, 2 * kTurn));
    const TriangleTerm terms[] = {{left.data(), n, right.data(), n, kTurn, 1.0},
                                  {right.data(), n, left.data(), n, kTurn, 1.0}};
    update_triangle(P_.column(0), ld_, n, terms, 2, workspace.data());
  }
  for (Index c = 0; c < moving; ++c) {
    for (Index r = c; r < moving; ++r) P_(r, c) = block(r, c);
    for (Index r = moving; r < n; ++r) P_(r, c) = across(c, r);
  }
  for (Index r = 0; r < kDim * fresh; ++r) {
    for (Index c = 0; c < moving; ++c) P_(n + r, c) = block(moving + r, c);
    for (Index c = moving; c < n; ++c) P_(n + r, c) = across(moving + r, c);
    for (Index c = 0; c <= r; ++c) P_(n + r, n + c) = block(moving + r, moving + c);
  }
  for (Index k = 0; k < walked; ++k) systematic_[handover.walking[k]] += handover.walked(k);
  for (Index a = 0; a < fresh; ++a) place_of(size() + a) = p + R * handover.fresh[a];
  layout_.add_points(fresh);
  pose_ = pose_ * handover.T_base_end;
  if (far_from_origin()) return move_origin();
  double turn = 0.0;
  for (Index i = 0; i < states(); ++i) workspace_.diagonal[i] = P_(i, i);
  for (Index t = kDim; t < kDof; ++t) turn += P_(t, t);
  raise_variances(workspace_.diagonal, turn);
}

template void State<SE2>::compose(const Handover&);
template void State<SE3>::compose(const Handover&);

}  // namespace cairn
