// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/leaf_information.hpp"

#include <Eigen/Cholesky>
#include <type_traits>

namespace cairn {

template <class Pose>
void LeafInformation<Pose>::information(std::uint32_t number, double* H, Index ld) const {
  const typename SparseState<Pose>::Leaf& leaf = state_.leaves[number];
  const SparseAnchors<Pose>& anchors = state_.solution.anchors;
  std::vector<Rotation> R;
  for (const std::uint32_t pose : leaf.poses) R.push_back(state_.axes(base_variable(pose)));
  for (Index i = 0; i < leaf.shared_count(); ++i) R.push_back(state_.axes(landmark_variable(leaf.shared(i))));
  Eigen::MatrixXd own = leaf.place != nullptr ? leaf.place->hessian(state_.place_values(leaf), R)
                                              : leaf.factor->hessian(state_.values(number), R);
  if (number == 0)  // the prior of the systematic errors
    own.diagonal().segment(leaf.state_of_shared(leaf.shared_count()), state_.error_points.size()).array() += 1.0;
  // The information on a single base (its prior or its fixes) is added to the submap that ends there; that of the first
  // base to the submap that begins there.
  const auto add = [&](Index base, Eigen::MatrixXd J, const Eigen::MatrixXd& information) {
    J.middleCols<kDim>(0) = (J.middleCols<kDim>(0) * R[base].matrix()).eval();
    J.middleCols<kTurn>(kDim) = (J.middleCols<kTurn>(kDim) * R[base].adjoint()).eval();
    own.block<kDof, kDof>(kDof * base, kDof * base) += J.transpose() * information * J;
  };
  if (number == 0) add(0, anchors.prior_jacobian(state_.bases[0].pose), anchors.prior_information());
  if (const auto* fixes = anchors.fixes_of(number))
    for (const AbsoluteFix<Pose>& fix : *fixes) {
      const Eigen::MatrixXd noise = fix.covariance().topLeftCorner(fix.rows(), fix.rows());
      add(1, fix.jacobian(state_.bases[leaf.poses[1]].pose).topRows(fix.rows()),
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
  const Index first_point = leaf.state_of_shared(0);
  for (Index j = 0; j < first_point; j += kDof) {
    for (Index i = j; i < first_point; i += kDof) put(i, j, pose, pose);
    for (Index i = first_point; i < own.rows(); i += kDim) put(i, j, point, pose);
  }
  for (Index j = first_point; j < own.cols(); j += kDim)
    for (Index i = j; i < own.rows(); i += kDim) put(i, j, point, point);
}

template class LeafInformation<SE2>;
template class LeafInformation<SE3>;

}  // namespace cairn
