// SPDX-License-Identifier: BSD-3-Clause
#include "map/submap.hpp"

namespace cairn {

template <class Pose>
void to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& covariance) {
  const ErrorModel<Pose> model(submap.error);
  for (const Eigen::Index i : landmarks)
    model.to_ordinary_point(submap.landmarks[i], Pose::kDof + Pose::kDim * i, covariance);
}

template <class Pose>
void rows_to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& rows) {
  const ErrorModel<Pose> model(submap.error);
  if (!model.invariant()) return;
  for (const Eigen::Index i : landmarks)
    rows.middleRows<Pose::kDim>(Pose::kDof + Pose::kDim * i) +=
        model.arm(submap.landmarks[i]) * rows.middleRows<Pose::kTurn>(Pose::kDim);
}

template void rows_to_ordinary<SE2>(const Submap<SE2>&, const std::vector<Eigen::Index>&, Eigen::MatrixXd&);
template void rows_to_ordinary<SE3>(const Submap<SE3>&, const std::vector<Eigen::Index>&, Eigen::MatrixXd&);
template void to_ordinary<SE2>(const Submap<SE2>&, const std::vector<Eigen::Index>&, Eigen::MatrixXd&);
template void to_ordinary<SE3>(const Submap<SE3>&, const std::vector<Eigen::Index>&, Eigen::MatrixXd&);

}  // namespace cairn
