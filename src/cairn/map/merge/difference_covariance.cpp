// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/difference_covariance.hpp"

namespace cairn {

bool DifferenceCovariance::factor(const PairedPoints& pairs, const Matrix3& R) {
  const std::size_t k = pairs.size();
  full_ = !pairs.covariance_a.full.empty() || !pairs.covariance_b.full.empty();
  if (!full_) {
    blocks_.resize(k);
    for (std::size_t i = 0; i < k; ++i) {
      blocks_[i].compute(pairs.covariance_a.blocks[i] + R * pairs.covariance_b.blocks[i] * R.transpose());
      if (blocks_[i].info() != Eigen::Success) return false;
    }
    return true;
  }
  const auto at = row_of_point;
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(at(k), at(k));
  if (!pairs.covariance_b.full.empty()) {
    S = pairs.covariance_b.matrix(k);
    for (std::size_t i = 0; i < k; ++i) S.middleRows<3>(at(i)) = (R * S.middleRows<3>(at(i))).eval();
    for (std::size_t i = 0; i < k; ++i) S.middleCols<3>(at(i)) = (S.middleCols<3>(at(i)) * R.transpose()).eval();
  } else {
    for (std::size_t i = 0; i < k; ++i) S.block<3, 3>(at(i), at(i)) = R * pairs.covariance_b.blocks[i] * R.transpose();
  }
  if (!pairs.covariance_a.full.empty()) {
    S += pairs.covariance_a.matrix(k);
  } else {
    for (std::size_t i = 0; i < k; ++i) S.block<3, 3>(at(i), at(i)) += pairs.covariance_a.blocks[i];
  }
  dense_.compute(S);
  return dense_.info() == Eigen::Success;
}

template <class Matrix>
void DifferenceCovariance::solve(Matrix& X) const {
  if (full_) {
    dense_.solveInPlace(X);
  } else {
    for (std::size_t i = 0; i < blocks_.size(); ++i)
      X.template middleRows<3>(row_of_point(i)) =
          blocks_[i].solve(X.template middleRows<3>(row_of_point(i)).eval()).eval();
  }
}

Eigen::MatrixXd DifferenceCovariance::inverse() const {
  return dense_.solve(Eigen::MatrixXd::Identity(dense_.rows(), dense_.cols()));
}

Matrix3 DifferenceCovariance::inverse_block(std::size_t i) const {
  return blocks_[i].solve(Matrix3::Identity());
}

template void DifferenceCovariance::solve(Eigen::VectorXd&) const;
template void DifferenceCovariance::solve(Eigen::Matrix<double, Eigen::Dynamic, 6>&) const;

}  // namespace cairn
