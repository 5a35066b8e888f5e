// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/submap_factor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "map/join/sparse/point_blocks.hpp"

namespace cairn {
namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// The smallest variances: a value that a submap knows exactly (it began there, and did not move) must not cause a
// division by zero. They are those of a micrometre and a tenth of a microradian.
constexpr double kLeastPosition = 1e-12, kLeastTurn = 1e-14;

// A covariance scaled to unit diagonal, and its factor. If it is singular, a small independent noise makes it and all
// of its principal submatrices regular.
struct ScaledFactor {
  Vector scale;
  double grain = 0.0;  // the variance of the noise, in parts of each variance
  Eigen::LLT<Matrix> llt;
};

template <class Pose>
ScaledFactor factor(const Matrix& covariance) {
  const Index n = covariance.rows();
  ScaledFactor out;
  out.scale.resize(n);
  for (Index i = 0; i < n; ++i) {
    const bool turn = i >= Pose::kDim && i < Pose::kDof;
    out.scale(i) = 1.0 / std::sqrt(std::max(covariance(i, i), turn ? kLeastTurn : kLeastPosition));
  }
  for (double grain = 0.0; grain < 1e-5; grain = grain == 0.0 ? 1e-12 : 100.0 * grain) {
    out.grain = grain;
    Matrix scaled = out.scale.asDiagonal() * covariance * out.scale.asDiagonal();
    for (Index i = 0; i < n; ++i) scaled(i, i) = std::max(scaled(i, i), 1.0) + grain;
    out.llt.compute(scaled);
    if (out.llt.info() != Eigen::Success || !out.llt.matrixLLT().allFinite()) continue;
    if (out.llt.matrixLLT().diagonal().minCoeff() < 1e-7 && grain < 1e-8)
      continue;  // pivots that are only rounding error
    return out;
  }
  throw Error(ErrorCode::numerical, "submap: its covariance is not positive definite; it stays open");
}

template <class Pose>
Matrix invert(const Matrix& covariance) {
  const ScaledFactor scaled = factor<Pose>(covariance);
  const Index n = covariance.rows();
  const Matrix inverse = scaled.llt.solve(Matrix::Identity(n, n));
  return scaled.scale.asDiagonal() * inverse * scaled.scale.asDiagonal();
}

}  // namespace

template <class Pose>
SubmapData<Pose>::SubmapData(const Submap<Pose>& submap, const ErrorPoints<Pose>& error_points)
    : error(submap.error),
      T_base_end(submap.T_base_end),
      ids(submap.ids),
      landmarks(submap.landmarks),
      points(error_points),
      base(submap.base) {
  GivenErrors given{Matrix(submap.covariance.rows(), 0), submap.covariance};
  if (submap.errors.count() > 0) {
    given = given_errors(submap.covariance, submap.errors);
    errors = factor_errors(submap.errors, points, given);
  }
  // Tests the whole covariance, so that no private landmark can make a later closing fail that shares it. The noise
  // that makes it regular stays in it: the factor of the shared landmarks and what the private ones are given them have
  // to come from one matrix, or a private landmark gets a negative variance.
  const double grain = factor<Pose>(given.covariance).grain;
  if (grain > 0.0) given.covariance.diagonal() *= 1.0 + grain;
  covariance = Packed(given.covariance);
}

// The base's error becomes one that only the fixes know, and is then eliminated: it goes into the covariance.
template <class Pose>
SubmapData<Pose> SubmapData<Pose>::without_base() const {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  constexpr double kFarthest = 1e3, kWidest = 10.0;  // standard deviations where the fixes told nothing: m, rad
  SubmapData out = *this;
  out.base.reset();
  out.errors = FactorErrors();
  const Matrix& K = errors.K;
  typename Pose::Square information = errors.found.rows.transpose() * errors.found.rows;
  for (int d = 0; d < kDof; ++d)
    information(d, d) += d < kDim ? 1.0 / (kFarthest * kFarthest) : 1.0 / (kWidest * kWidest);
  Matrix joint(covariance.size(), covariance.size());
  for (Index c = 0; c < joint.cols(); ++c)
    for (Index r = 0; r < joint.rows(); ++r) joint(r, c) = covariance(r, c);
  joint += K * information.ldlt().solve(Matrix(K.transpose()));
  out.covariance = Packed(joint);
  return out;
}

template <class Pose>
SubmapFactor<Pose>::SubmapFactor(std::shared_ptr<const Data> data, std::vector<Index> shared)
    : data_(std::move(data)), shared_(std::move(shared)) {
  const std::vector<Index> chosen = states();
  information_ = Packed(invert<Pose>(data_->covariance.block(chosen, chosen)));
}

template <class Pose>
std::vector<Index> SubmapFactor<Pose>::states() const {
  std::vector<Index> states;
  for (Index d = 0; d < kDof; ++d) states.push_back(d);
  const std::vector<Index> shared = point_rows<Pose>(shared_, kDof);
  states.insert(states.end(), shared.begin(), shared.end());
  for (Index w = data_->covariance.size() - data_->errors.walked.size(); w < data_->covariance.size(); ++w)
    states.push_back(w);
  return states;
}

template <class Pose>
Vector SubmapFactor<Pose>::residual(const Values& values) const {
  Vector xi = whole_error(values);
  if (data_->shares()) xi -= K() * error_shift(values);
  return xi;
}

template <class Pose>
Vector SubmapFactor<Pose>::whole_error(const Values& values) const {
  Vector xi(rows());
  const Pose T_end = values.base.inverse() * values.end;
  const Tangent turn = (T_end.rotation() * data_->T_base_end.rotation().inverse()).log();
  xi.segment<kTurn>(kDim) = turn;
  const Rotation R = Rotation::exp(turn);
  const PointSquare V_inverse = Rotation::translation_jacobian_inverse(turn);
  const auto error = [&](const Point& x, const Point& estimate) -> Point {
    if (data_->error == ErrorKind::standard) return x - estimate;
    return V_inverse * (x - R * estimate);
  };
  xi.head<kDim>() = error(T_end.translation(), data_->T_base_end.translation());
  const Pose T_base_map = values.base.inverse();
  for (Index i = 0; i < shared_count(); ++i)
    xi.segment<kDim>(kDof + kDim * i) = error(T_base_map * values.shared[i], data_->landmarks[shared_[i]]);
  const Index walkers = data_->errors.walked.size();
  for (Index w = 0; w < walkers; ++w) {
    const Index at = data_->points.at(data_->points.walkers()[static_cast<std::size_t>(w)]);
    xi(rows() - walkers + w) =
        values.errors(at + data_->points.from_base_to_end()) - values.errors(at) - data_->errors.walked(w);
  }
  return xi;
}

// The rows of a point x (the end's position or a shared landmark) with the error e_x: B (e_x - e_p) + base e_R + end
// e_R_end.
template <class Pose>
struct SubmapFactor<Pose>::Jacobian {
  PointSquare B;
  typename Rotation::Jacobian turn;                      // of xi_R by e_R_end; by e_R its negative
  std::vector<typename Rotation::Turn> by_base, by_end;  // the end's position first, then the shared landmarks
};

// X' X_hat^-1 = Exp(tau) Exp(xi) for a change tau of X on the left, so that d xi = J_l(xi)^-1 tau with the group's left
// Jacobian (Barfoot, State Estimation for Robotics, eq. 7.95): V^-1 (tau_x - Q J^-1 tau_R). Here
// tau_R = R^T (e_R_end - e_R) and tau_x = dx + hat(x) tau_R = R^T (e_x - e_p + hat(l - p) e_R_end).
// In the plane hat(x) tau_R also is -turn(x) tau_R.
template <class Pose>
typename SubmapFactor<Pose>::Jacobian SubmapFactor<Pose>::jacobian(const Values& values, const Vector& xi) const {
  using Turn = typename Rotation::Turn;
  Jacobian J;
  const PointSquare R_transposed = values.base.rotation().matrix().transpose();
  const Point p = values.base.translation();
  const Tangent turn = xi.segment<kTurn>(kDim);
  const typename Rotation::Jacobian adjoint_transposed = values.base.rotation().adjoint().transpose();
  J.turn = Rotation::left_jacobian_inverse(turn) * adjoint_transposed;
  const bool standard = data_->error == ErrorKind::standard;
  J.B = standard ? R_transposed : PointSquare(Rotation::translation_jacobian_inverse(turn) * R_transposed);
  const PointSquare V_inverse = Rotation::translation_jacobian_inverse(turn);
  for (Index i = -1; i < shared_count(); ++i) {
    const Point x = i < 0 ? values.end.translation() : values.shared[i];
    const Turn lever = -Rotation::turn(x - p);
    const Turn arm = J.B * lever;
    if (standard) {
      J.by_base.push_back(arm);
      J.by_end.push_back(Turn::Zero());
      continue;
    }
    const Point xi_x = i < 0 ? Point(xi.head<kDim>()) : Point(xi.segment<kDim>(kDof + kDim * i));
    const Turn coupling = V_inverse * Rotation::translation_coupling(xi_x, turn) * J.turn;
    J.by_base.push_back(coupling);
    J.by_end.push_back(arm - coupling);
  }
  return J;
}

template <class Pose>
Vector SubmapFactor<Pose>::weighted(const Vector& xi) const {
  Vector out(rows());
  information_.times(xi.data(), out.data());
  return out;
}

template <class Pose>
typename SubmapFactor<Pose>::Evaluation SubmapFactor<Pose>::evaluate(const Values& values) const {
  Evaluation out;
  const Vector xi = residual(values);
  const Vector weight = weighted(xi);
  out.cost = 0.5 * xi.dot(weight);
  const Jacobian J = jacobian(values, whole_error(values));
  Vector& gradient = out.gradient = Vector::Zero(columns());
  const Tangent turn = J.turn.transpose() * weight.segment<kTurn>(kDim);
  gradient.segment<kTurn>(kDim) -= turn;
  gradient.segment<kTurn>(kDof + kDim) += turn;
  for (Index i = -1; i < shared_count(); ++i) {
    const Point w = i < 0 ? Point(weight.head<kDim>()) : Point(weight.segment<kDim>(kDof + kDim * i));
    const Point force = J.B.transpose() * w;
    gradient.segment<kDim>(0) -= force;
    gradient.segment<kDim>(i < 0 ? kDof : column(i)) += force;
    gradient.segment<kTurn>(kDim) += J.by_base[i + 1].transpose() * w;
    gradient.segment<kTurn>(kDof + kDim) += J.by_end[i + 1].transpose() * w;
  }
  if (!data_->shares()) return out;
  const ErrorRows& found = data_->errors.found;
  const Index size = data_->points.size(), first = column(shared_count());
  const Vector missed = found.rows * error_values(values) - found.values;
  if (size > 0) {
    gradient.tail(error_columns()) += error_jacobian().transpose() * weight;
    gradient.segment(first, size) += found.rows.leftCols(size).transpose() * missed;
  }
  if (data_->base) {
    const Vector force = found.rows.rightCols(kDof).transpose() * missed - K().rightCols(kDof).transpose() * weight;
    gradient.head<kDof>() += base_jacobian(values).transpose() * force;
  }
  out.cost += 0.5 * missed.squaredNorm();
  for (Index k = 0; k < error_columns(); ++k) {
    if (uses(k)) continue;
    gradient(first + k) += values.errors(k);
    out.cost += 0.5 * values.errors(k) * values.errors(k);
  }
  return out;
}

template <class Pose>
Matrix SubmapFactor<Pose>::dense_jacobian(const Values& values) const {
  const Jacobian J = jacobian(values, whole_error(values));
  Matrix D = Matrix::Zero(rows(), columns());
  D.rightCols(error_columns()) = error_jacobian();
  if (data_->base) D.leftCols<kDof>() = -K().rightCols(kDof) * base_jacobian(values);
  D.block<kTurn, kTurn>(kDim, kDim) -= J.turn;
  D.block<kTurn, kTurn>(kDim, kDof + kDim) = J.turn;
  for (Index i = -1; i < shared_count(); ++i) {
    const Index row = i < 0 ? 0 : kDof + kDim * i;
    D.block<kDim, kDim>(row, 0) -= J.B;
    D.block<kDim, kTurn>(row, kDim) += J.by_base[i + 1];
    D.block<kDim, kDim>(row, i < 0 ? kDof : column(i)) = J.B;
    D.block<kDim, kTurn>(row, kDof + kDim) = J.by_end[i + 1];
  }
  return D;
}

template <class Pose>
Matrix SubmapFactor<Pose>::hessian(const Values& values, const std::vector<Rotation>& axes) const {
  const Index n = rows();
  Matrix information(n, n);  // lower triangle; the diagonal blocks of landmarks are complete
  for (Index c = 0; c < n; ++c) {
    std::copy(information_.column(c) + c, information_.column(c) + n, information.col(c).data() + c);
    if (c < kDof) continue;
    for (Index r = c - (c - kDof) % kDim; r < c; ++r) information(r, c) = information(c, r);
  }
  Matrix D = dense_jacobian(values);
  const PointSquare B = D.block<kDim, kDim>(0, kDof);
  auto poses = D.leftCols<2 * kDof>();
  const auto turn = [&](Index first, const auto& R) {
    constexpr int width = std::decay_t<decltype(R)>::ColsAtCompileTime;
    poses.template middleCols<width>(first) = (poses.template middleCols<width>(first) * R).eval();
  };
  for (Index pose = 0; pose < 2; ++pose) {
    turn(kDof * pose, axes[pose].matrix());
    turn(kDof * pose + kDim, axes[pose].adjoint());
  }
  std::vector<PointSquare> own;
  for (Index i = 0; i < shared_count(); ++i) own.push_back(B * axes[2 + i].matrix());

  Matrix H = Matrix::Zero(columns(), columns());
  // The poses' columns are dense, those of a landmark have one block, in its own rows.
  const Matrix weighted = information.selfadjointView<Eigen::Lower>() * poses;
  H.topLeftCorner<2 * kDof, 2 * kDof>().noalias() = poses.transpose() * weighted;
  for (Index j = 0; j < shared_count(); ++j)
    H.block<kDim, 2 * kDof>(column(j), 0).noalias() = own[j].transpose() * weighted.middleRows<kDim>(kDof + kDim * j);
  put_point_blocks(information, kDof, own, column(0), H);
  if (error_columns() > 0) add_error_hessian(information, weighted, own, H);
  if (data_->base) add_base_hessian(base_jacobian(values) * Pose::turn_axes(axes[0]), H);
  return H;
}

template <class Pose>
typename SubmapFactor<Pose>::PointSquare SubmapFactor<Pose>::landmark_information(Index i, const Rotation& base) const {
  const PointSquare R = base.matrix();
  return R * information_.diagonal_block<kDim>(kDof + kDim * i) * R.transpose();
}

template <class Pose>
typename SubmapFactor<Pose>::Points SubmapFactor<Pose>::place_private(const Values& values, const Vector& xi,
                                                                      const Vector& weight) const {
  const std::vector<Index> chosen = states();
  Vector weights = Vector::Zero(data_->covariance.size()), errors(weights.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) weights(chosen[k]) = weight(static_cast<Index>(k));
  data_->covariance.times(weights.data(), errors.data());
  PointSquare R = PointSquare::Identity(), V = R;
  if (data_->error != ErrorKind::standard) {
    Tangent turn = xi.segment<kTurn>(kDim);
    if (data_->shares()) turn = whole_error(values).template segment<kTurn>(kDim);
    R = Rotation::exp(turn).matrix();
    V = Rotation::translation_jacobian(turn);
  }
  if (data_->shares()) errors += data_->errors.K * error_shift(values);
  const PointSquare base = values.base.rotation().matrix();
  Points positions(kDim, static_cast<Index>(data_->landmarks.size()));
  for (Index i = 0; i < positions.cols(); ++i)
    positions.col(i) =
        values.base.translation() + base * (R * data_->landmarks[i] + V * errors.segment<kDim>(kDof + kDim * i));
  return positions;
}

// xi_l = K xi + w with K = Sigma_ls Sigma_ss^-1, and xi = J e. In the frame of the base y = y_hat + xi_l + G(y) xi_R
// (standard: without the last term), and e_l = e_p + G(R y) e_R + R e_y.
template <class Pose>
void SubmapFactor<Pose>::express_private(const std::vector<Index>& landmarks, const Values& values, Matrix& A,
                                         Matrix& W) const {
  const std::vector<Index> rows_of = point_rows<Pose>(landmarks, kDof), chosen = states();
  const auto n = static_cast<Index>(landmarks.size());
  const Vector xi = residual(values);
  const Vector weight = weighted(xi);
  Matrix information(rows(), rows());
  for (Index c = 0; c < rows(); ++c)
    for (Index r = 0; r < rows(); ++r) information(r, c) = information_(r, c);
  const Matrix cross = data_->covariance.block(rows_of, chosen);
  Matrix K = cross * information;
  const Matrix by_errors = K * error_jacobian();
  // What is left of the private landmarks' covariance, from one Cholesky factor: a difference of large covariances, as
  // those of a submap whose base was widened, would lose its sign.
  std::vector<Index> joint = chosen;
  joint.insert(joint.end(), rows_of.begin(), rows_of.end());
  const ScaledFactor whole = factor<Pose>(data_->covariance.block(joint, joint));
  const auto m = static_cast<Index>(rows_of.size());
  const Matrix rest = whole.scale.tail(m).cwiseInverse().asDiagonal() *
                      Matrix(whole.llt.matrixLLT().bottomRightCorner(m, m).template triangularView<Eigen::Lower>());
  W = rest * rest.transpose();
  const PointSquare R = values.base.rotation().matrix();
  const Points placed = place_private(values, xi, weight);
  std::vector<Point> arms;
  const Matrix without_arms = K;
  for (Index a = 0; a < n; ++a) {
    arms.push_back(placed.col(landmarks[a]) - values.base.translation());
    if (data_->error == ErrorKind::invariant)
      K.block<kDim, kTurn>(kDim * a, kDim) += Rotation::turn(R.transpose() * arms[a]);
  }
  A = K * dense_jacobian(values);
  // The arms of the turn do not depend on the errors that the submap shares with the map.
  if (error_columns() > 0) {
    A.rightCols(error_columns()) = by_errors;
    A.middleCols(column(shared_count()), data_->points.size()) +=
        data_->errors.K.leftCols(data_->points.size())(rows_of, Eigen::all);
  }
  if (data_->base) {
    const Matrix own = data_->errors.K.rightCols(kDof)(rows_of, Eigen::all);
    A.leftCols<kDof>() += (own + (K - without_arms) * this->K().rightCols(kDof)) * base_jacobian(values);
  }
  for (Index a = 0; a < n; ++a) {
    A.middleRows<kDim>(kDim * a) = (R * A.middleRows<kDim>(kDim * a)).eval();
    A.block<kDim, kDim>(kDim * a, 0) += PointSquare::Identity();
    A.block<kDim, kTurn>(kDim * a, kDim) += Rotation::turn(arms[a]);
    for (Index b = 0; b < n; ++b)
      W.block<kDim, kDim>(kDim * a, kDim * b) = (R * W.block<kDim, kDim>(kDim * a, kDim * b) * R.transpose()).eval();
  }
  W = (0.5 * (W + W.transpose())).eval();
}

template struct SubmapData<SE2>;
template struct SubmapData<SE3>;
template class SubmapFactor<SE2>;
template class SubmapFactor<SE3>;

}  // namespace cairn
