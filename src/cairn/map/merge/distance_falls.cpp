// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/distance_falls.hpp"

#include <Eigen/Eigenvalues>
#include <cstddef>

namespace cairn {

double fall_of(const Matrix3& M, const Vector3& lambda, double scale) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(M);
  double fall = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = eigen.eigenvectors().col(axis).dot(lambda);
    if (eigen.eigenvalues()[axis] > 1e-9 * scale) fall += along * along / eigen.eigenvalues()[axis];
  }
  return fall;
}

void find_falls(const PairedPoints& pairs, AlignmentSolution& solution) {
  const LinearisedPairs& now = solution.linearised;
  const DifferenceCovariance& S = now.covariance();
  const Eigen::MatrixXd S_inverse = S.full() ? S.inverse() : Eigen::MatrixXd();
  solution.alignment.falls.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Index at = row_of_point(i);
    const Matrix3 own = S.full() ? Matrix3(S_inverse.block<3, 3>(at, at)) : S.inverse_block(i);
    const auto V = now.V().middleRows<3>(at);
    const Matrix3 M = own - V * solution.centred_covariance * V.transpose();
    solution.alignment.falls.push_back(fall_of(M, now.lambda().segment<3>(at), own.trace()));
  }
}

}  // namespace cairn
