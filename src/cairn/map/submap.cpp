// SPDX-License-Identifier: BSD-3-Clause
#include "map/submap.hpp"

namespace cairn {

template <class Pose>
void to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& covariance) {
  if (submap.error == ErrorKind::standard) return;
  for (const Eigen::Index i : landmarks) {
    const typename Pose::Rotation::Turn G = Pose::Rotation::turn(submap.landmarks[i]);
    const Eigen::Index at = Pose::kDof + Pose::kDim * i;
    covariance.middleRows<Pose::kDim>(at) += G * covariance.middleRows<Pose::kTurn>(Pose::kDim);
    covariance.middleCols<Pose::kDim>(at) += covariance.middleCols<Pose::kTurn>(Pose::kDim) * G.transpose();
  }
}

template void to_ordinary<SE2>(const Submap<SE2>&, const std::vector<Eigen::Index>&, Eigen::MatrixXd&);
template void to_ordinary<SE3>(const Submap<SE3>&, const std::vector<Eigen::Index>&, Eigen::MatrixXd&);

}  // namespace cairn
