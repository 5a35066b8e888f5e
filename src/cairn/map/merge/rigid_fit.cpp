// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/rigid_fit.hpp"

#include <Eigen/SVD>
#include <cstddef>

namespace cairn {

bool align_by_weights(const std::vector<Vector3>& a, const std::vector<Vector3>& b, const std::vector<double>& weights,
                      SE3& T_a_b) {
  if (a.size() < 3) return false;
  double sum = 0;
  Vector3 mean_a = Vector3::Zero(), mean_b = Vector3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += weights[i];
    mean_a += weights[i] * a[i];
    mean_b += weights[i] * b[i];
  }
  mean_a /= sum;
  mean_b /= sum;
  Matrix3 H = Matrix3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) H += (weights[i] / sum) * (a[i] - mean_a) * (b[i] - mean_b).transpose();
  const Eigen::JacobiSVD<Matrix3, Eigen::NoQRPreconditioner> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()[1] > 1e-12 * svd.singularValues()[0])) return false;
  Vector3 signs = Vector3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;
  const SO3 R = SO3::from_matrix(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose());
  T_a_b = SE3(R, mean_a - R * mean_b);
  return true;
}

}  // namespace cairn
