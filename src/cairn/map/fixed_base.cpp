// SPDX-License-Identifier: BSD-3-Clause
#include "map/fixed_base.hpp"

#include <Eigen/Cholesky>

namespace cairn {
namespace {

template <class Pose>
SubmapErrors of_base(const SubmapErrors& errors) {
  constexpr int n = Pose::kDof;
  const Eigen::Index first = errors.count() - n;
  SubmapErrors base;
  base.prior = errors.prior.tail<n>();
  base.prior_covariance = errors.prior_covariance.bottomRightCorner<n, n>();
  base.value = errors.value.tail<n>();
  base.covariance = errors.covariance.block<n, n>(first, first);
  return base;
}

}  // namespace

template <class Pose>
FixedBase<Pose>::FixedBase(const Pose& base, const SubmapErrors& errors)
    : at(base),
      value(errors.value.tail<Pose::kDof>()),
      covariance(of_base<Pose>(errors).covariance),
      found(found_out(of_base<Pose>(errors))) {}

template <class Pose>
void FixedBase<Pose>::correct(Pose& base, std::vector<typename Pose::Point>& points, Eigen::MatrixXd& P) const {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  const Eigen::Index rows = found.values.size();
  if (rows == 0) return;
  const Eigen::MatrixXd cross = P.leftCols<kDof>() * found.rows.transpose();
  const Eigen::MatrixXd S = found.rows * cross.topRows<kDof>() + Eigen::MatrixXd::Identity(rows, rows);
  const Eigen::MatrixXd gain = S.ldlt().solve(cross.transpose()).transpose();
  const Eigen::VectorXd correction = gain * (found.values - found.rows * error(base));
  P -= gain * cross.transpose();
  P = (0.5 * (P + P.transpose())).eval();
  base = retract(base, typename Pose::Tangent(correction.head<kDof>()));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] += correction.segment<kDim>(kDof + kDim * static_cast<Eigen::Index>(i));
}

template <class Pose>
Eigen::MatrixXd FixedBase<Pose>::gain(const Eigen::MatrixXd& cross) const {
  // Scaled to unit diagonal: metres and radians.
  const typename Pose::Tangent scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  const typename Pose::Square scaled = scale.asDiagonal() * covariance * scale.asDiagonal();
  const Eigen::MatrixXd right = scale.asDiagonal() * cross.transpose();
  return (scale.asDiagonal() * Eigen::MatrixXd(scaled.ldlt().solve(right))).transpose();
}

template struct FixedBase<SE2>;
template struct FixedBase<SE3>;

}  // namespace cairn
