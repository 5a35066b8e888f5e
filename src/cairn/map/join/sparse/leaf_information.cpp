// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/leaf_information.hpp"

#include <Eigen/Cholesky>
#include <type_traits>

namespace cairn {

template <class Pose>
void LeafInformation<Pose>::information(std::uint32_t number, double* H, Index ld) const {
  const typename SparseState<Pose>::Leaf& leaf = state_.leaves[number];
  const SparseAnchors<Pose>& anchors = state_.solution.anchors;
  std::vector<Rotation> R{state_.axes(base_variable(number)), state_.axes(base_variable(number + 1))};
  for (const Index i : leaf.factor->shared()) R.push_back(state_.axes(landmark_variable(leaf.landmarks[i])));
  Eigen::MatrixXd own = leaf.factor->hessian(state_.values(number), R);
  if (number == 0)  // the prior of the systematic errors
    own.diagonal().segment(Factor::column(leaf.factor->shared_count()), state_.error_points.size()).array() += 1.0;
  // The information on a single base (its prior or its fixes) is added to the submap that ends there; that of the first
  // base to the submap that begins there.
  const auto add = [&](Index base, Eigen::MatrixXd J, const Eigen::MatrixXd& information) {
    J.middleCols<kDim>(0) = (J.middleCols<kDim>(0) * R[base].matrix()).eval();
    J.middleCols<kTurn>(kDim) = (J.middleCols<kTurn>(kDim) * R[base].adjoint()).eval();
    own.block<kDof, kDof>(kDof * base, kDof * base) += J.transpose() * information * J;
  };
  if (number == 0) add(0, anchors.prior_jacobian(state_.bases[0]), anchors.prior_information());
  if (const auto* fixes = anchors.fixes_of(number + 1))
    for (const AbsoluteFix<Pose>& fix : *fixes) {
      const Eigen::MatrixXd noise = fix.covariance().topLeftCorner(fix.rows(), fix.rows());
      add(1, fix.jacobian(state_.bases[number + 1]).topRows(fix.rows()),
          noise.ldlt().solve(Eigen::MatrixXd::Identity(fix.rows(), fix.rows())));
    }
  // Copies the information to the tree's order, by blocks of poses and of landmarks.
  const auto put = [&](Index i, Index j, auto rows, auto columns) {
    using Block = Eigen::Matrix<double, decltype(rows)::value, decltype(columns)::value>;
    using Transposed = Eigen::Matrix<double, decltype(columns)::value, decltype(rows)::value>;
    const Index row = leaf.order[i], column = leaf.order[j];
    const auto block = own.block<Block::RowsAtCompileTime, Block::ColsAtCompileTime>(i, j);
    if (row >= column)
      Eigen::Map<Block, 0, Eigen::OuterStride<>>(H + column * ld + row, Eigen::OuterStride<>(ld)) = block;
    else
      Eigen::Map<Transposed, 0, Eigen::OuterStride<>>(H + row * ld + column, Eigen::OuterStride<>(ld)) =
          block.transpose();
  };
  const std::integral_constant<int, kDof> pose;
  const std::integral_constant<int, kDim> point;
  for (const Index j : {Index{0}, Index{kDof}}) {
    for (Index i = j; i < 2 * kDof; i += kDof) put(i, j, pose, pose);
    for (Index i = Factor::column(0); i < own.rows(); i += kDim) put(i, j, point, pose);
  }
  for (Index j = Factor::column(0); j < own.cols(); j += kDim)
    for (Index i = j; i < own.rows(); i += kDim) put(i, j, point, point);
}

template class LeafInformation<SE2>;
template class LeafInformation<SE3>;

}  // namespace cairn
