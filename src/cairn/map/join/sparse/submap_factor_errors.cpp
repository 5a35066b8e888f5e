// SPDX-License-Identifier: BSD-3-Clause
// The part of a submap's factor that depends on systematic errors and, if there were fixes, on the error of its base.
#include "map/join/sparse/submap_factor.hpp"

namespace cairn {

template <class Pose>
Eigen::VectorXd SubmapFactor<Pose>::error_values(const Values& values) const {
  const Eigen::Index size = data_->points.size();
  if (!data_->base) return values.errors.head(size);
  Eigen::VectorXd errors(size + kDof);
  errors << values.errors.head(size), pose_error(values.base, *data_->base);
  return errors;
}

template <class Pose>
Eigen::VectorXd SubmapFactor<Pose>::error_shift(const Values& values) const {
  return error_values(values) - data_->errors.value;
}

template <class Pose>
Eigen::MatrixXd SubmapFactor<Pose>::K() const {
  return data_->errors.K(states(), Eigen::all);
}

// Of the points' numbers, those at the end hold errors where those at the base do.
template <class Pose>
bool SubmapFactor<Pose>::uses(Eigen::Index number) const {
  return data_->points.used(number < data_->points.size() ? number : number - data_->points.from_base_to_end());
}

template <class Pose>
Eigen::MatrixXd SubmapFactor<Pose>::error_jacobian() const {
  Eigen::MatrixXd E = Eigen::MatrixXd::Zero(rows(), error_columns());
  if (E.cols() == 0) return E;
  E.leftCols(data_->points.size()) = -K().leftCols(data_->points.size());
  const Eigen::Index walkers = data_->errors.walked.size();
  for (Eigen::Index w = 0; w < walkers; ++w) {
    const Eigen::Index at = data_->points.at(data_->points.walkers()[static_cast<std::size_t>(w)]);
    E(rows() - walkers + w, at) -= 1.0;
    E(rows() - walkers + w, at + data_->points.from_base_to_end()) += 1.0;
  }
  return E;
}

template <class Pose>
void SubmapFactor<Pose>::add_error_hessian(const Eigen::MatrixXd& information, const Eigen::MatrixXd& weighted_poses,
                                           const std::vector<PointSquare>& landmark_axes, Eigen::MatrixXd& H) const {
  const Eigen::Index first = column(shared_count()), size = data_->points.size();
  const Eigen::MatrixXd E = error_jacobian();
  const Eigen::MatrixXd weighted = information.selfadjointView<Eigen::Lower>() * E;
  H.block(first, 0, E.cols(), 2 * kDof) = E.transpose() * weighted_poses;
  for (Eigen::Index j = 0; j < shared_count(); ++j)
    H.block(first, column(j), E.cols(), kDim) =
        weighted.middleRows<kDim>(kDof + kDim * j).transpose() * landmark_axes[static_cast<std::size_t>(j)];
  H.block(first, first, E.cols(), E.cols()) = E.transpose() * weighted;
  const auto found = data_->errors.found.rows.leftCols(size);
  H.block(first, first, size, size) += found.transpose() * found;
  for (Eigen::Index k = 0; k < E.cols(); ++k)
    if (!uses(k)) H(first + k, first + k) += 1.0;
}

// What fixes told about the base, alone and together with systematic errors.
template <class Pose>
void SubmapFactor<Pose>::add_base_hessian(const Square& error_by_base, Eigen::MatrixXd& H) const {
  const Eigen::Index first = column(shared_count()), size = data_->points.size();
  const Eigen::MatrixXd& found = data_->errors.found.rows;
  const Eigen::MatrixXd by_base = found.rightCols<kDof>() * error_by_base;
  H.topLeftCorner<kDof, kDof>() += by_base.transpose() * by_base;
  if (size > 0) H.block(first, 0, size, kDof) += found.leftCols(size).transpose() * by_base;
}

template Eigen::VectorXd SubmapFactor<SE2>::error_values(const Values&) const;
template Eigen::VectorXd SubmapFactor<SE2>::error_shift(const Values&) const;
template Eigen::MatrixXd SubmapFactor<SE2>::K() const;
template bool SubmapFactor<SE2>::uses(Eigen::Index) const;
template Eigen::MatrixXd SubmapFactor<SE2>::error_jacobian() const;
template void SubmapFactor<SE2>::add_base_hessian(const Square&, Eigen::MatrixXd&) const;
template void SubmapFactor<SE2>::add_error_hessian(const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                                   const std::vector<PointSquare>&, Eigen::MatrixXd&) const;
template Eigen::VectorXd SubmapFactor<SE3>::error_values(const Values&) const;
template Eigen::VectorXd SubmapFactor<SE3>::error_shift(const Values&) const;
template Eigen::MatrixXd SubmapFactor<SE3>::K() const;
template bool SubmapFactor<SE3>::uses(Eigen::Index) const;
template Eigen::MatrixXd SubmapFactor<SE3>::error_jacobian() const;
template void SubmapFactor<SE3>::add_base_hessian(const Square&, Eigen::MatrixXd&) const;
template void SubmapFactor<SE3>::add_error_hessian(const Eigen::MatrixXd&, const Eigen::MatrixXd&,
                                                   const std::vector<PointSquare>&, Eigen::MatrixXd&) const;
}  // namespace cairn
