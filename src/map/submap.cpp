// SPDX-License-Identifier: BSD-3-Clause
#include "map/submap.hpp"

namespace cairn {

void to_ordinary(const Submap& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& covariance) {
  if (submap.error == ErrorKind::standard) return;
  for (const Eigen::Index i : landmarks) {
    const Matrix3 G = SO3::turn(submap.landmarks[i]);
    covariance.middleRows<3>(6 + 3 * i) += G * covariance.middleRows<3>(3);
    covariance.middleCols<3>(6 + 3 * i) += covariance.middleCols<3>(3) * G.transpose();
  }
}

}  // namespace cairn
