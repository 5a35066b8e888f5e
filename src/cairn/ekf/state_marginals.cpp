// SPDX-License-Identifier: BSD-3-Clause
// Marginal covariances of a state: of the pose and of chosen points.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ekf/ekf_update.hpp"
#include "ekf/state.hpp"

namespace cairn {
namespace {

// error^T covariance^-1 error, negative if the covariance is singular: if what is left of it in some direction is no
// more than rounding. `rounded` holds the sizes of the numbers of which the variances are sums: they carry its
// rounding.
template <class Pose>
double normalised(const typename Pose::Square& covariance, const typename Pose::Tangent& rounded,
                  const typename Pose::Tangent& error) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
  using Square = typename Pose::Square;
  // The covariance is scaled to unit diagonal first: units (metres, radians) must not decide whether it is singular.
  const typename Pose::Tangent variances = covariance.diagonal();
  if (!(variances.array() > 0.0).all()) return -1.0;
  const typename Pose::Tangent scale = variances.cwiseSqrt().cwiseInverse();
  // Rounding moves no eigenvalue by more than its own norm, however many directions are singular (Weyl). Pivots of a
  // Cholesky factor have no such bound: a small one makes the rounding of the next larger.
  const Eigen::SelfAdjointEigenSolver<Square> eigen((scale.asDiagonal() * covariance * scale.asDiagonal()).eval());
  const double own = std::max(1.0, rounded.cwiseQuotient(variances).maxCoeff());
  if (!(eigen.eigenvalues()(0) > rounding * own)) return -1.0;
  const typename Pose::Tangent along = eigen.eigenvectors().transpose() * scale.cwiseProduct(error);
  return along.cwiseAbs2().cwiseQuotient(eigen.eigenvalues()).sum();
}

}  // namespace

template <class Pose>
typename State<Pose>::PointByMotion State<Pose>::with_motion_states(Index row) const {
  PointByMotion cross = PointByMotion::Zero();
  for (Index i = 0; i < motion_.motion(); ++i)
    for (Index r = 0; r < kDim; ++r) cross(r, i) = P_(row + r, kDof + i);
  return cross;
}

// What the pending motion's systematic errors and noise turned: D s + n_R.
template <class Pose>
typename State<Pose>::PendingTurn State<Pose>::pending_turn() const {
  Eigen::Matrix<double, kTurn, kDof + kMotionStates> rows;
  rows.setZero();
  Eigen::Matrix<double, kMotionStates, kMotionStates> own;
  own.setZero();
  for (Index i = 0; i < motion_.motion(); ++i)
    for (Index j = 0; j < motion_.motion(); ++j) own(i, j) = P_.symmetric(kDof + i, kDof + j);
  Eigen::Matrix<double, kMotionStates, kDof> with_pose;
  with_pose.setZero();
  for (Index i = 0; i < motion_.motion(); ++i)
    for (Index c = 0; c < kDof; ++c) with_pose(i, c) = P_(kDof + i, c);
  const auto D = motion_.C().template bottomRows<kTurn>();
  const Eigen::Matrix<double, kTurn, kMotionStates> turned = D * own;
  PendingTurn out;
  out.with_pose = motion_.N().template bottomRows<kTurn>() + D * with_pose * motion_.F().transpose() +
                  turned * motion_.C().transpose();
  out.own = motion_.N().template bottomRightCorner<kTurn, kTurn>() + turned * D.transpose();
  return out;
}

// Change of the covariance of xi_l - xi_p by systematic errors of the pending motion: they add J C s to it.
template <class Pose>
typename State<Pose>::PointSquare State<Pose>::relative_change(Index row, const PointByPose& J) const {
  const PointByMotion L = J * motion_.C();
  PointByMotion across = with_motion_states(row);  // covariance of xi_l - xi_p with s
  PointSquare own = PointSquare::Zero();
  for (Index i = 0; i < motion_.motion(); ++i) {
    for (Index r = 0; r < kDim; ++r) across(r, i) -= P_(kDof + i, r);
    for (Index j = 0; j < motion_.motion(); ++j)
      own += P_.symmetric(kDof + i, kDof + j) * L.col(i) * L.col(j).transpose();
  }
  const PointSquare mixed = across * L.transpose();
  return mixed + mixed.transpose() + own;
}

template <class Pose>
void State<Pose>::systematic_covariance(double* out) const {
  const Index count = systematic();
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j < count; ++j)
      out[i * count + j] = P_.symmetric(kDof + i, kDof + j) + (i == j ? motion_.walked(i) : 0.0);
}

template <class Pose>
void State<Pose>::gather(const Index* slots, Index count, double* out, Index ld) const {
  using Arm = typename ErrorModel<Pose>::Arm;
  const Square pose = pose_block();
  for (Index c = 0; c < kDof; ++c)
    for (Index r = 0; r < kDof; ++r) out[c * ld + r] = pose(r, c);
  const bool noisy = motion_.reaches_points();
  Eigen::Matrix<double, kTurn, kDof> N_turn = motion_.N().template bottomRows<kTurn>();
  Eigen::Matrix<double, kTurn, kTurn> N_points = N_turn.template rightCols<kTurn>();
  const PendingTurn turned = motion_.turns() ? pending_turn() : PendingTurn();
  if (motion_.turns()) {
    N_turn = turned.with_pose;
    N_points = turned.own;
  }
  for (Index a = 0; a < count; ++a) {
    const Index row = layout_.point(slots[a]).offset;
    PointByPose cross;
    for (Index c = 0; c < kDof; ++c)
      for (Index r = 0; r < kDim; ++r) cross(r, c) = P_(row + r, c);
    Arm U = Arm::Zero();
    if (noisy) {
      U = -model_.arm(local(slots[a]));
      cross += U * N_turn;
    } else if (motion_.any()) {
      cross = (cross * motion_.F().transpose()).eval();
    }
    if (motion_.motion() > 0 && motion_.any()) cross += with_motion_states(row) * motion_.C().transpose();
    const Index at = kDof + kDim * a;
    for (Index c = 0; c < kDof; ++c)
      for (Index r = 0; r < kDim; ++r) out[c * ld + at + r] = out[(at + r) * ld + c] = cross(r, c);
    const Arm UN = U * N_points;
    for (Index b = 0; b <= a; ++b) {
      const Index column = layout_.point(slots[b]).offset;
      PointSquare block;
      for (Index c = 0; c < kDim; ++c)
        for (Index r = 0; r < kDim; ++r) block(r, c) = P_.symmetric(row + r, column + c);
      if (noisy) block -= UN * model_.arm(local(slots[b])).transpose();
      if (motion_.turns()) {  // V U^T + U V^T
        const auto D = motion_.C().template bottomRows<kTurn>().transpose();
        block -= with_motion_states(row) * D * model_.arm(local(slots[b])).transpose();
        block += U * (with_motion_states(column) * D).transpose();
      }
      for (Index c = 0; c < kDim; ++c)
        for (Index r = 0; r < kDim; ++r) {
          out[(kDof + kDim * b + c) * ld + at + r] = block(r, c);
          out[(at + r) * ld + kDof + kDim * b + c] = block(r, c);
        }
    }
  }
}

template <class Pose>
void State<Pose>::gather_systematic(const Index* slots, Index count, double* out, Index ld, bool ordinary) const {
  const Index own = systematic(), moving = layout_.moving(), n = moving + kDim * count;
  std::vector<double> plain(static_cast<std::size_t>((n - own) * (n - own)));
  gather(slots, count, plain.data(), n - own);
  const auto at = [&](Index i) { return i < kDof ? i : i + own; };
  for (Index c = 0; c < n - own; ++c)
    for (Index r = 0; r < n - own; ++r) out[at(c) * ld + at(r)] = plain[static_cast<std::size_t>(c * (n - own) + r)];
  std::vector<double> turned(static_cast<std::size_t>(kTurn * moving)), row(static_cast<std::size_t>(moving));
  motion_.turn_rows(P_, turned.data());
  for (Index i = 0; i < own; ++i) {
    double* column = out + (kDof + i) * ld;
    motion_.systematic_row(P_, i, row.data());
    std::copy(row.begin(), row.end(), column);
    for (Index a = 0; a < count; ++a) {
      Point cross;
      for (Index r = 0; r < kDim; ++r) cross[r] = P_(layout_.point(slots[a]).offset + r, kDof + i);
      if (motion_.reaches_points())
        cross -= model_.arm(local(slots[a])) *
                 Eigen::Map<const typename Rotation::Tangent>(turned.data() + (kDof + i) * kTurn);
      Eigen::Map<Point>(column + moving + kDim * a) = cross;
    }
  }
  if (ordinary && model_.invariant()) {
    model_.to_ordinary(
        count, [&](Index x) -> Point { return x < 0 ? pose_.translation() : local(slots[x]); }, plain.data(), n - own);
    for (Index c = 0; c < n - own; ++c)
      for (Index r = 0; r < n - own; ++r) out[at(c) * ld + at(r)] = plain[static_cast<std::size_t>(c * (n - own) + r)];
    for (Index i = 0; i < own; ++i) {
      double* column = out + (kDof + i) * ld;
      const typename Rotation::Tangent turn = Eigen::Map<const typename Rotation::Tangent>(column + kDim);
      Eigen::Map<Point>(column) += model_.arm(pose_.translation()) * turn;
      for (Index a = 0; a < count; ++a)
        Eigen::Map<Point>(column + moving + kDim * a) += model_.arm(local(slots[a])) * turn;
    }
  }
  for (Index i = 0; i < own; ++i)
    for (Index r = 0; r < n; ++r) out[r * ld + kDof + i] = out[(kDof + i) * ld + r];
}

template <class Pose>
void State<Pose>::gather_ordinary(const Index* slots, Index count, double* out, Index ld) const {
  gather(slots, count, out, ld);
  model_.to_ordinary(
      count, [&](Index x) -> Point { return x < 0 ? pose_.translation() : local(slots[x]); }, out, ld);
}

template <class Pose>
typename State<Pose>::Square State<Pose>::pose_covariance() const {
  Square covariance;
  gather_ordinary(nullptr, 0, covariance.data(), kDof);
  return covariance;
}

template <class Pose>
typename State<Pose>::PointSquare State<Pose>::landmark_covariance(Index slot) const {
  Eigen::Matrix<double, kDof + kDim, kDof + kDim> joint;
  gather_ordinary(&slot, 1, joint.data(), kDof + kDim);
  return joint.template bottomRightCorner<kDim, kDim>();
}

template <class Pose>
typename State<Pose>::PointSquare State<Pose>::relative_covariance(Index slot) const {
  const Index row = layout_.point(slot).offset;
  const Index dofs = model_.invariant() ? kDim : kDof;  // that the error depends on
  Eigen::Matrix<double, kDim, kDof> J = Eigen::Matrix<double, kDim, kDof>::Zero();
  J.template leftCols<kDim>() = -PointSquare::Identity();
  PointByPose cross = PointByPose::Zero();
  PointSquare own;
  for (Index c = 0; c < dofs; ++c)
    for (Index r = 0; r < kDim; ++r) cross(r, c) = P_(row + r, c);
  for (Index c = 0; c < kDim; ++c)
    for (Index r = c; r < kDim; ++r) own(r, c) = own(c, r) = P_(row + r, row + c);
  PointSquare sum;
  if (model_.invariant()) {
    const PointSquare across = cross.template leftCols<kDim>();
    for (Index c = 0; c < kDim; ++c)
      for (Index r = c; r < kDim; ++r) sum(r, c) = sum(c, r) = P_(r, c);
    sum += own - across - across.transpose();
    if (!motion_.any()) return sum;
    J.template rightCols<kTurn>() = -model_.arm(local(slot));  // of the pending motion's error
    sum += J.lazyProduct(motion_.N().lazyProduct(J.transpose()).eval());
    if (motion_.motion() > 0) sum += relative_change(row, J);
    return sum;
  }
  J.template rightCols<kTurn>() = -Rotation::turn(local(slot) - pose_.translation());
  if (motion_.any()) cross = (cross * motion_.F().transpose()).eval();
  if (motion_.any() && motion_.motion() > 0) cross += with_motion_states(row) * motion_.C().transpose();
  const PointSquare across = cross.lazyProduct(J.transpose());
  return own + across + across.transpose() + J * pose_block() * J.transpose();
}

template <class Pose>
double State<Pose>::pose_nees(const Pose& truth) const {
  const Pose local_truth(truth.rotation(), truth.translation() - origin_);
  const Square covariance = pose_block();
  return normalised<Pose>(covariance, covariance.diagonal(), model_.error(local_truth, pose_));
}

template <class Pose>
double State<Pose>::nees(ErrorKind error, const Point& origin, const Pose& truth, const Pose& estimate,
                         const Square& ordinary_covariance) {
  const Pose from_origin(truth.rotation(), truth.translation() - origin);
  const Pose pose(estimate.rotation(), estimate.translation() - origin);
  const ErrorModel<Pose> model(error);
  // e = A xi, so that xi^T (A^-1 P A^-T)^-1 xi = e^T P^-1 e. P itself was a sum with the turn of the arm.
  Tangent rounded = ordinary_covariance.diagonal();
  rounded.template head<kDim>().array() +=
      pose.translation().squaredNorm() * ordinary_covariance.diagonal().template tail<kTurn>().sum();
  Tangent e = model.error(from_origin, pose);
  if (model.invariant())
    e.template head<kDim>() += ErrorModel<Pose>::arm(pose.translation()) * e.template tail<kTurn>();
  return normalised<Pose>(ordinary_covariance, rounded, e);
}

template <class Pose>
double State<Pose>::smallest_pivot() {
  // R^T R = D P D. R is stored in the strict upper triangle of P's storage, its diagonal and D elsewhere: no memory is
  // needed.
  apply_pending();
  const Index n = states();
  // On the scaled diagonal: without it, the rest of a row behind a pivot of rounding size, which is rounding, too, would
  // be divided by almost nothing, and a covariance of low rank would look indefinite.
  const double shift = 16.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  double smallest = 1.0;
  double* const diagonal = workspace_.diagonal;
  double* const pivots = workspace_.error_state;
  for (Index i = 0; i < n; ++i) diagonal[i] = P_(i, i);
  for (Index j = 0; j < n; ++j) {
    double* column = P_.column(j);  // rows 0..j-1: R
    const double variance = diagonal[j];
    double pivot = 1.0 + shift;
    if (variance > 0.0) {
      for (Index i = 0; i < j; ++i) {
        const double* other = P_.column(i);
        double sum = 0.0;
        if (P_(i, i) > 0.0) {
          sum = P_(j, i) / std::sqrt(variance) / std::sqrt(P_(i, i));  // a product of the variances could underflow
          for (Index k = 0; k < i; ++k) sum -= other[k] * column[k];
          sum /= pivots[i];
        }
        column[i] = sum;
        pivot -= sum * sum;
      }
      smallest = std::min(smallest, pivot - shift);
      if (!(pivot > 0.0)) return pivot - shift;
    } else {
      std::fill(column, column + j, 0.0);  // exactly known: left out
      if (variance < 0.0) return variance;
    }
    pivots[j] = std::sqrt(pivot);
  }
  return smallest;
}

template State<SE2>::PointByMotion State<SE2>::with_motion_states(Index) const;
template State<SE2>::PendingTurn State<SE2>::pending_turn() const;
template State<SE2>::PointSquare State<SE2>::relative_change(Index, const PointByPose&) const;
template void State<SE2>::gather(const Index*, Index, double*, Index) const;
template void State<SE2>::gather_ordinary(const Index*, Index, double*, Index) const;
template void State<SE2>::gather_systematic(const Index*, Index, double*, Index, bool) const;
template void State<SE2>::systematic_covariance(double*) const;
template SE2::Square State<SE2>::pose_covariance() const;
template State<SE2>::PointSquare State<SE2>::landmark_covariance(Index) const;
template State<SE2>::PointSquare State<SE2>::relative_covariance(Index) const;
template double State<SE2>::pose_nees(const SE2&) const;
template double State<SE2>::nees(ErrorKind, const Point&, const SE2&, const SE2&, const Square&);
template double State<SE2>::smallest_pivot();

template State<SE3>::PointByMotion State<SE3>::with_motion_states(Index) const;
template State<SE3>::PendingTurn State<SE3>::pending_turn() const;
template State<SE3>::PointSquare State<SE3>::relative_change(Index, const PointByPose&) const;
template void State<SE3>::gather(const Index*, Index, double*, Index) const;
template void State<SE3>::gather_ordinary(const Index*, Index, double*, Index) const;
template void State<SE3>::gather_systematic(const Index*, Index, double*, Index, bool) const;
template void State<SE3>::systematic_covariance(double*) const;
template SE3::Square State<SE3>::pose_covariance() const;
template State<SE3>::PointSquare State<SE3>::landmark_covariance(Index) const;
template State<SE3>::PointSquare State<SE3>::relative_covariance(Index) const;
template double State<SE3>::pose_nees(const SE3&) const;
template double State<SE3>::nees(ErrorKind, const Point&, const SE3&, const SE3&, const Square&);
template double State<SE3>::smallest_pivot();

}  // namespace cairn
