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

void add_part(const Quadratic& cost, const std::vector<Index>& from, const std::vector<Index>& to, Quadratic& sum) {
  const std::size_t n = from.size();
  for (std::size_t c = 0; c < n; ++c) {
    const double* column = cost.information.col(from[c]).data();
    double* target = sum.information.col(to[c]).data();
    for (std::size_t r = 0; r < n; ++r) target[to[r]] += column[from[r]];
    sum.gradient(to[c]) += cost.gradient(from[c]);
  }
  sum.constant += cost.constant;
}

namespace {

Quadratic picked(const Quadratic& cost, const std::vector<Index>& errors) {
  const auto n = static_cast<Index>(errors.size());
  Quadratic part{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), cost.constant};
  for (Index c = 0; c < n; ++c) {
    const double* column = cost.information.col(errors[static_cast<std::size_t>(c)]).data();
    double* target = part.information.col(c).data();
    for (std::size_t r = 0; r < errors.size(); ++r) target[r] = column[errors[r]];
    part.gradient(c) = cost.gradient(errors[static_cast<std::size_t>(c)]);
  }
  return part;
}

}  // namespace

// By eigenvectors: what goes may include a direction without information, such as a turn about the line on which all
// landmarks lie. Its rows are zero up to rounding.
Quadratic without(const Quadratic& cost, const std::vector<Index>& gone, const std::vector<Index>& kept) {
  Quadratic out = picked(cost, kept);
  if (gone.empty()) return out;
  constexpr double kLeast = 1e-14;  // of the largest eigenvalue of a matrix with unit diagonal
  const Quadratic own = picked(cost, gone);
  Eigen::VectorXd scale = own.information.diagonal();
  for (Index i = 0; i < scale.size(); ++i) scale(i) = scale(i) > 0.0 ? 1.0 / std::sqrt(scale(i)) : 1.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      Eigen::MatrixXd(scale.asDiagonal() * own.information * scale.asDiagonal()));
  if (eigen.info() != Eigen::Success || !eigen.eigenvalues().allFinite())
    throw Error(ErrorCode::numerical, "submap: the information of its place is not finite; it stays as it is");
  const double least = kLeast * eigen.eigenvalues()(scale.size() - 1);
  const Eigen::MatrixXd T = scale.asDiagonal() * eigen.eigenvectors() *
                            eigen.eigenvalues().cwiseMax(least).cwiseSqrt().cwiseInverse().asDiagonal();
  Eigen::MatrixXd across(out.gradient.size(), own.gradient.size());
  for (std::size_t c = 0; c < gone.size(); ++c)
    for (std::size_t r = 0; r < kept.size(); ++r)
      across(static_cast<Index>(r), static_cast<Index>(c)) = cost.information(kept[r], gone[c]);
  const Eigen::MatrixXd X = across * T;
  const Eigen::VectorXd y = T.transpose() * own.gradient;
  out.information.noalias() -= X * X.transpose();
  out.gradient -= X * y;
  out.constant -= 0.5 * y.squaredNorm();
  return out;
}

template Quadratic in_axes<SE2>(Eigen::MatrixXd, Eigen::VectorXd, double, Index, const SO2&);
template Quadratic in_axes<SE3>(Eigen::MatrixXd, Eigen::VectorXd, double, Index, const SO3&);

}  // namespace cairn
