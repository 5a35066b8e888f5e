// SPDX-License-Identifier: BSD-3-Clause
#include "map/submap_factor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace cairn {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Variances below these count as these: what a submap knows exactly (it began there, and did not move) must not divide
// by zero. A micrometre and a tenth of a microradian.
constexpr double kLeastPosition = 1e-12, kLeastTurn = 1e-14;

// A covariance scaled to unit diagonal, and its factor. Where it is singular, a grain of independent noise makes it
// regular; so does the same grain all of its principal parts.
struct ScaledFactor {
  Vector scale;
  Eigen::LLT<Matrix> llt;
};

ScaledFactor factor(const Matrix& covariance) {
  const Index n = covariance.rows();
  ScaledFactor out;
  out.scale.resize(n);
  for (Index i = 0; i < n; ++i)
    out.scale(i) = 1.0 / std::sqrt(std::max(covariance(i, i), i >= 3 && i < 6 ? kLeastTurn : kLeastPosition));
  for (double grain = 0.0; grain < 1e-5; grain = grain == 0.0 ? 1e-12 : 100.0 * grain) {
    Matrix scaled = out.scale.asDiagonal() * covariance * out.scale.asDiagonal();
    for (Index i = 0; i < n; ++i) scaled(i, i) = std::max(scaled(i, i), 1.0) + grain;
    out.llt.compute(scaled);
    if (out.llt.info() != Eigen::Success || !out.llt.matrixLLT().allFinite()) continue;
    if (out.llt.matrixLLT().diagonal().minCoeff() < 1e-7 && grain < 1e-8) continue;  // pivots of rounding alone
    return out;
  }
  throw Error(ErrorCode::numerical, "submap: its covariance is not positive definite; it stays open");
}

Matrix invert(const Matrix& covariance) {
  const ScaledFactor scaled = factor(covariance);
  const Index n = covariance.rows();
  const Matrix inverse = scaled.llt.solve(Matrix::Identity(n, n));
  return scaled.scale.asDiagonal() * inverse * scaled.scale.asDiagonal();
}

}  // namespace

SubmapData::SubmapData(const Submap<SE3>& submap)
    : error(submap.error),
      T_base_end(submap.T_base_end),
      ids(submap.ids),
      landmarks(submap.landmarks),
      covariance(submap.covariance) {
  // The whole, so that no landmark that is private today can stop a closing some day, when another submap sees it.
  factor(submap.covariance);
}

SubmapFactor::SubmapFactor(std::shared_ptr<const SubmapData> data, std::vector<Index> shared)
    : data_(std::move(data)), shared_(std::move(shared)) {
  const std::vector<Index> chosen = states();
  information_ = Packed(invert(data_->covariance.block(chosen, chosen)));
}

std::vector<Index> SubmapFactor::states() const {
  std::vector<Index> states{0, 1, 2, 3, 4, 5};
  for (const Index i : shared_)
    for (Index d = 0; d < 3; ++d) states.push_back(6 + 3 * i + d);
  return states;
}

Vector SubmapFactor::residual(const FactorValues& values) const {
  Vector xi(rows());
  const SE3 T_end = values.base.inverse() * values.end;
  const Vector3 turn = (T_end.rotation() * data_->T_base_end.rotation().inverse()).log();
  xi.segment<3>(3) = turn;
  const SO3 R = SO3::exp(turn);
  const Matrix3 V_inverse = SO3::left_jacobian_inverse(turn);
  const auto error = [&](const Vector3& x, const Vector3& estimate) -> Vector3 {
    if (data_->error == ErrorKind::standard) return x - estimate;
    return V_inverse * (x - R * estimate);
  };
  xi.head<3>() = error(T_end.translation(), data_->T_base_end.translation());
  const SE3 T_base_map = values.base.inverse();
  for (Index i = 0; i < shared_count(); ++i)
    xi.segment<3>(6 + 3 * i) = error(T_base_map * values.shared[i], data_->landmarks[shared_[i]]);
  return xi;
}

// Of a point x (the end's position or a shared landmark), whose own error is e_x: B (e_x - e_p) + base e_R + end
// e_R_end.
struct SubmapFactor::Jacobian {
  Matrix3 B;
  Matrix3 turn;                          // of xi_R by e_R_end; by e_R its negative
  std::vector<Matrix3> by_base, by_end;  // the end's position first, then the shared landmarks
};

// X' X_hat^-1 = Exp(tau) Exp(xi) for a change tau of X on the left, so that d xi = J_l(xi)^-1 tau with the group's left
// Jacobian (Barfoot, State Estimation for Robotics, eq. 7.95): V^-1 (tau_x - Q J^-1 tau_R). Here
// tau_R = R^T (e_R_end - e_R) and tau_x = dx + hat(x) tau_R = R^T (e_x - e_p + hat(l - p) e_R_end).
SubmapFactor::Jacobian SubmapFactor::jacobian(const FactorValues& values, const Vector& xi) const {
  Jacobian J;
  const Matrix3 R_transposed = values.base.rotation().matrix().transpose();
  const Vector3 p = values.base.translation(), turn = xi.segment<3>(3);
  J.turn = SO3::left_jacobian_inverse(turn) * R_transposed;
  const bool standard = data_->error == ErrorKind::standard;
  J.B = standard ? R_transposed : Matrix3(SO3::translation_jacobian_inverse(turn) * R_transposed);
  const Matrix3 V_inverse = SO3::translation_jacobian_inverse(turn);
  for (Index i = -1; i < shared_count(); ++i) {
    const Vector3 x = i < 0 ? values.end.translation() : values.shared[i];
    const Matrix3 arm = J.B * hat(x - p);
    if (standard) {
      J.by_base.push_back(arm);
      J.by_end.push_back(Matrix3::Zero());
      continue;
    }
    const Vector3 xi_x = i < 0 ? Vector3(xi.head<3>()) : Vector3(xi.segment<3>(6 + 3 * i));
    const Matrix3 coupling = V_inverse * SO3::translation_coupling(xi_x, turn) * J.turn;
    J.by_base.push_back(coupling);
    J.by_end.push_back(arm - coupling);
  }
  return J;
}

Vector SubmapFactor::weighted(const Vector& xi) const {
  Vector out(rows());
  information_.times(xi.data(), out.data());
  return out;
}

SubmapFactor::Evaluation SubmapFactor::evaluate(const FactorValues& values) const {
  Evaluation out;
  const Vector xi = residual(values);
  const Vector weight = weighted(xi);
  out.cost = 0.5 * xi.dot(weight);
  const Jacobian J = jacobian(values, xi);
  out.gradient = Vector::Zero(columns());
  const Vector3 turn = J.turn.transpose() * weight.segment<3>(3);
  out.gradient.segment<3>(3) -= turn;
  out.gradient.segment<3>(9) += turn;
  for (Index i = -1; i < shared_count(); ++i) {
    const Vector3 w = i < 0 ? Vector3(weight.head<3>()) : Vector3(weight.segment<3>(6 + 3 * i));
    const Vector3 force = J.B.transpose() * w;
    out.gradient.segment<3>(0) -= force;
    out.gradient.segment<3>(i < 0 ? 6 : 12 + 3 * i) += force;
    out.gradient.segment<3>(3) += J.by_base[i + 1].transpose() * w;
    out.gradient.segment<3>(9) += J.by_end[i + 1].transpose() * w;
  }
  return out;
}

Matrix SubmapFactor::dense_jacobian(const FactorValues& values) const {
  const Jacobian J = jacobian(values, residual(values));
  Matrix D = Matrix::Zero(rows(), columns());
  D.block<3, 3>(3, 3) = -J.turn;
  D.block<3, 3>(3, 9) = J.turn;
  for (Index i = -1; i < shared_count(); ++i) {
    const Index row = i < 0 ? 0 : 6 + 3 * i;
    D.block<3, 3>(row, 0) = -J.B;
    D.block<3, 3>(row, 3) = J.by_base[i + 1];
    D.block<3, 3>(row, i < 0 ? 6 : 12 + 3 * i) = J.B;
    D.block<3, 3>(row, 9) = J.by_end[i + 1];
  }
  return D;
}

Matrix SubmapFactor::hessian(const FactorValues& values, const std::vector<Matrix3>& axes) const {
  const Index n = rows();
  Matrix information(n, n);  // lower triangle, its diagonal 3-blocks whole
  for (Index c = 0; c < n; ++c) {
    std::copy(information_.column(c) + c, information_.column(c) + n, information.col(c).data() + c);
    for (Index r = c / 3 * 3; r < c; ++r) information(r, c) = information(c, r);
  }
  Matrix D = dense_jacobian(values);
  const Matrix3 B = D.block<3, 3>(0, 6);
  auto poses = D.leftCols<12>();
  for (Index block = 0; block < 4; ++block)
    poses.middleCols<3>(3 * block) = (poses.middleCols<3>(3 * block) * axes[block / 2]).eval();
  std::vector<Matrix3> own;
  for (Index i = 0; i < shared_count(); ++i) own.push_back(B * axes[2 + i]);

  Matrix H = Matrix::Zero(columns(), columns());
  // The poses' columns are dense, those of a landmark have one block in its own rows alone.
  const Matrix weighted = information.selfadjointView<Eigen::Lower>() * poses;
  H.topLeftCorner<12, 12>().noalias() = poses.transpose() * weighted;
  Matrix column(n, 3);
  for (Index j = 0; j < shared_count(); ++j) {
    H.block<3, 12>(12 + 3 * j, 0).noalias() = own[j].transpose() * weighted.middleRows<3>(6 + 3 * j);
    const Index below = n - 6 - 3 * j;
    column.topRows(below).noalias() = information.block(6 + 3 * j, 6 + 3 * j, below, 3).lazyProduct(own[j]);
    for (Index i = j; i < shared_count(); ++i)
      H.block<3, 3>(12 + 3 * i, 12 + 3 * j).noalias() = own[i].transpose() * column.middleRows<3>(3 * (i - j));
  }
  return H;
}

Matrix3 SubmapFactor::landmark_information(Index i, const SO3& base) const {
  Matrix3 block;
  for (Index c = 0; c < 3; ++c)
    for (Index r = 0; r < 3; ++r) block(r, c) = information_(6 + 3 * i + r, 6 + 3 * i + c);
  const Matrix3 R = base.matrix();
  return R * block * R.transpose();
}

Eigen::Matrix3Xd SubmapFactor::place_private(const FactorValues& values, const Vector& xi, const Vector& weight) const {
  const std::vector<Index> chosen = states();
  Vector weights = Vector::Zero(data_->covariance.size()), errors(weights.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) weights(chosen[k]) = weight(static_cast<Index>(k));
  data_->covariance.times(weights.data(), errors.data());
  Matrix3 R = Matrix3::Identity(), V = R;
  if (data_->error != ErrorKind::standard) {
    R = SO3::exp(xi.segment<3>(3)).matrix();
    V = SO3::left_jacobian(xi.segment<3>(3));
  }
  const Matrix3 base = values.base.rotation().matrix();
  Eigen::Matrix3Xd positions(3, static_cast<Index>(data_->landmarks.size()));
  for (Index i = 0; i < positions.cols(); ++i)
    positions.col(i) = values.base.translation() + base * (R * data_->landmarks[i] + V * errors.segment<3>(6 + 3 * i));
  return positions;
}

// xi_l = K xi + w with K = Sigma_ls Sigma_ss^-1, and xi = J e. In the frame of the base y = y_hat + xi_l + G(y) xi_R
// (standard: without the last term), and e_l = e_p + G(R y) e_R + R e_y.
void SubmapFactor::express_private(const std::vector<Index>& landmarks, const FactorValues& values, Matrix& A,
                                   Matrix& W) const {
  std::vector<Index> rows_of, chosen = states();
  for (const Index i : landmarks)
    for (Index d = 0; d < 3; ++d) rows_of.push_back(6 + 3 * i + d);
  const auto n = static_cast<Index>(landmarks.size());
  const Vector xi = residual(values);
  const Vector weight = weighted(xi);
  Matrix information(rows(), rows());
  for (Index c = 0; c < rows(); ++c)
    for (Index r = 0; r < rows(); ++r) information(r, c) = information_(r, c);
  const Matrix cross = data_->covariance.block(rows_of, chosen);
  Matrix K = cross * information;
  W = data_->covariance.block(rows_of, rows_of);
  W -= K * cross.transpose();
  const Matrix3 R = values.base.rotation().matrix();
  const Eigen::Matrix3Xd placed = place_private(values, xi, weight);
  std::vector<Vector3> arms;
  for (Index a = 0; a < n; ++a) {
    arms.push_back(placed.col(landmarks[a]) - values.base.translation());
    if (data_->error == ErrorKind::invariant) K.block<3, 3>(3 * a, 3) += SO3::turn(R.transpose() * arms[a]);
  }
  A = K * dense_jacobian(values);
  for (Index a = 0; a < n; ++a) {
    A.middleRows<3>(3 * a) = (R * A.middleRows<3>(3 * a)).eval();
    A.block<3, 3>(3 * a, 0) += Matrix3::Identity();
    A.block<3, 3>(3 * a, 3) += SO3::turn(arms[a]);
    for (Index b = 0; b < n; ++b)
      W.block<3, 3>(3 * a, 3 * b) = (R * W.block<3, 3>(3 * a, 3 * b) * R.transpose()).eval();
  }
  W = (0.5 * (W + W.transpose())).eval();
}

}  // namespace cairn
