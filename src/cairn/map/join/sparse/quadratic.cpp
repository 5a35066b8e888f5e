// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/quadratic.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/error.hpp"
#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

template <class Pose>
Quadratic in_axes(Eigen::MatrixXd hessian, Eigen::VectorXd gradient, double cost, Index poses,
                  const typename Pose::Rotation& axes) {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  hessian.template triangularView<Eigen::StrictlyUpper>() = hessian.transpose();
  const typename Pose::Rotation own = axes.inverse();
  for (Index first = 0; first < gradient.size(); first += first < kDof * poses ? kDof : kDim) {
    const typename Pose::Point force = gradient.segment<kDim>(first);
    gradient.segment<kDim>(first) = own * force;
    if (first >= kDof * poses) continue;
    const typename Pose::Rotation::Tangent moment = gradient.segment<kTurn>(first + kDim);
    gradient.segment<kTurn>(first + kDim) = own.adjoint(moment);
  }
  return {std::move(hessian), std::move(gradient), cost};
}

Quadratic part_of(const Quadratic& cost, const std::vector<Index>& errors) {
  Quadratic part{cost.information(errors, errors), Eigen::VectorXd(static_cast<Index>(errors.size())), cost.constant};
  for (std::size_t i = 0; i < errors.size(); ++i) part.gradient(static_cast<Index>(i)) = cost.gradient(errors[i]);
  return part;
}

// By eigenvectors: the first errors may include a direction without information, such as a turn about the line on which
// all landmarks lie. Its rows are zero up to rounding.
Quadratic without(const Quadratic& cost, Index first) {
  if (first == 0) return cost;
  constexpr double kLeast = 1e-14;  // of the largest eigenvalue of a matrix with unit diagonal
  const Index rest = cost.gradient.size() - first;
  Eigen::VectorXd scale = cost.information.diagonal().head(first);
  for (Index i = 0; i < first; ++i) scale(i) = scale(i) > 0.0 ? 1.0 / std::sqrt(scale(i)) : 1.0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * cost.information.topLeftCorner(first, first) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  if (eigen.info() != Eigen::Success || !eigen.eigenvalues().allFinite())
    throw Error(ErrorCode::numerical, "submap: the information of its place is not finite; it stays as it is");
  const double least = kLeast * eigen.eigenvalues()(first - 1);
  const Eigen::MatrixXd T = scale.asDiagonal() * eigen.eigenvectors() *
                            eigen.eigenvalues().cwiseMax(least).cwiseSqrt().cwiseInverse().asDiagonal();
  const Eigen::MatrixXd X = cost.information.bottomLeftCorner(rest, first) * T;
  const Eigen::VectorXd y = T.transpose() * cost.gradient.head(first);
  Quadratic out{cost.information.bottomRightCorner(rest, rest), cost.gradient.tail(rest) - X * y,
                cost.constant - 0.5 * y.squaredNorm()};
  out.information.noalias() -= X * X.transpose();
  return out;
}

template Quadratic in_axes<SE2>(Eigen::MatrixXd, Eigen::VectorXd, double, Index, const SO2&);
template Quadratic in_axes<SE3>(Eigen::MatrixXd, Eigen::VectorXd, double, Index, const SO3&);

}  // namespace cairn
