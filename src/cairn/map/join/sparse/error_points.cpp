// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/error_points.hpp"

#include <algorithm>

namespace cairn {

template <class Pose>
ErrorPoints<Pose>::ErrorPoints(const SharedErrorOptions& options)
    : unit_(options.sigma), at_(options.sigma.size()), walkers_(options.walking) {
  const Index walking = static_cast<Index>(walkers_.size()), constant = options.count() - walking;
  constant_ = (constant + Pose::kDim - 1) / Pose::kDim;
  walking_ = (walking + Pose::kDim - 1) / Pose::kDim;
  Index next_constant = 0, next_walking = Pose::kDim * constant_;
  for (std::size_t i = 0; i < at_.size(); ++i) {
    const bool walks = std::find(walkers_.begin(), walkers_.end(), static_cast<Index>(i)) != walkers_.end();
    at_[i] = walks ? next_walking++ : next_constant++;
  }
}

template <class Pose>
bool ErrorPoints<Pose>::used(Index number) const {
  return std::find(at_.begin(), at_.end(), number) != at_.end();
}

template <class Pose>
FactorErrors factor_errors(const SubmapErrors& errors, const ErrorPoints<Pose>& points, GivenErrors& given) {
  const Index walkers = errors.walked.size(), rows = given.K.rows(), first = rows - walkers;
  FactorErrors out;
  out.walked = errors.walked;
  for (Index w = 0; w < walkers; ++w) {
    const double unit = points.unit(points.walkers()[static_cast<std::size_t>(w)]);
    out.walked(w) /= unit;
    given.K.row(first + w) /= unit;
    given.covariance.row(first + w) /= unit;
    given.covariance.col(first + w) /= unit;
  }
  out.found = found_out(errors);
  const Index base = errors.count() - points.count(), size = points.size() + base;
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(out.found.rows.rows(), size);
  out.value = Eigen::VectorXd::Zero(size);
  out.K = Eigen::MatrixXd::Zero(rows, size);
  out.value.tail(base) = errors.value.tail(base);
  out.K.rightCols(base) = given.K.rightCols(base);
  found.rightCols(base) = out.found.rows.rightCols(base);
  for (Index i = 0; i < points.count(); ++i) {
    out.value(points.at(i)) = errors.value(i) / points.unit(i);
    out.K.col(points.at(i)) = points.unit(i) * given.K.col(i);
    found.col(points.at(i)) = points.unit(i) * out.found.rows.col(i);
  }
  out.found.rows = found;
  return out;
}

template class ErrorPoints<SE2>;
template class ErrorPoints<SE3>;
template FactorErrors factor_errors(const SubmapErrors&, const ErrorPoints<SE2>&, GivenErrors&);
template FactorErrors factor_errors(const SubmapErrors&, const ErrorPoints<SE3>&, GivenErrors&);

}  // namespace cairn
