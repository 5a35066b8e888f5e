// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/place_factor.hpp"

#include <algorithm>
#include <utility>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "map/join/sparse/point_blocks.hpp"

namespace cairn {

template <class Pose>
PlaceFactor<Pose>::PlaceFactor(const Values& values, std::vector<std::uint64_t> ids, const Quadratic& cost)
    : ids_(std::move(ids)), information_(cost.information), pull_(cost.gradient), constant_(cost.constant) {
  const Pose T_base_map = values.base.inverse();
  for (const Pose& pose : values.poses) poses_.push_back(T_base_map * pose);
  for (const Point& landmark : values.landmarks) landmarks_.push_back(T_base_map * landmark);
}

template <class Pose>
Index PlaceFactor<Pose>::row(std::size_t number) const {
  const std::size_t poses = std::min(number, poses_.size());
  return static_cast<Index>(kDof * poses + kDim * (number - poses));
}

// Errors in the frame of the base: R' = Exp(d_R) R, x' = x + d_x.
template <class Pose>
typename PlaceFactor<Pose>::Vector PlaceFactor<Pose>::residual(const Values& values) const {
  Vector d(information_.size());
  const Pose T_base_map = values.base.inverse();
  for (std::size_t k = 0; k < poses_.size(); ++k)
    d.segment<kDof>(row(k)) = pose_error(T_base_map * values.poses[k], poses_[k]);
  for (std::size_t i = 0; i < landmarks_.size(); ++i)
    d.segment<kDim>(row(poses_.size() + i)) = T_base_map * values.landmarks[i] - landmarks_[i];
  return d;
}

// d_x changes by R^T (e_x - e_p - turn(x - p) e_R), and d_R by J_l(d_R)^-1 R^T (e_R' - e_R).
template <class Pose>
typename PlaceFactor<Pose>::Jacobian PlaceFactor<Pose>::jacobian(const Values& values, const Vector& d) const {
  Jacobian J;
  const PointSquare R_transposed = values.base.rotation().matrix().transpose();
  const typename Rotation::Jacobian adjoint_transposed = values.base.rotation().adjoint().transpose();
  const auto lever = [&](const Point& x) {
    J.lever.push_back(-R_transposed * Rotation::turn(x - values.base.translation()));
  };
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    lever(values.poses[k].translation());
    J.turn.push_back(Rotation::left_jacobian_inverse(d.segment<kTurn>(row(k) + kDim)) * adjoint_transposed);
  }
  for (const Point& landmark : values.landmarks) lever(landmark);
  return J;
}

template <class Pose>
typename PlaceFactor<Pose>::Evaluation PlaceFactor<Pose>::evaluate(const Values& values) const {
  const Vector d = residual(values);
  Vector weight(d.size());
  information_.times(d.data(), weight.data());
  Evaluation out;
  out.cost = constant_ + d.dot(pull_) + 0.5 * d.dot(weight);
  weight += pull_;
  const Jacobian J = jacobian(values, d);
  Vector& gradient = out.gradient = Vector::Zero(columns());
  for (std::size_t i = 0; i < J.lever.size(); ++i) {
    const Point w = weight.segment<kDim>(row(i)), force = values.base.rotation() * w;
    gradient.segment<kDim>(0) -= force;
    gradient.segment<kDim>(kDof + row(i)) += force;
    gradient.segment<kTurn>(kDim) += J.lever[i].transpose() * w;
    if (i >= poses_.size()) continue;
    const Tangent moment = J.turn[i].transpose() * weight.segment<kTurn>(row(i) + kDim);
    gradient.segment<kTurn>(kDim) -= moment;
    gradient.segment<kTurn>(kDof + row(i) + kDim) += moment;
  }
  return out;
}

// The base's columns are dense; each other variable has a block in its own rows.
template <class Pose>
typename PlaceFactor<Pose>::Matrix PlaceFactor<Pose>::hessian(const Values& values,
                                                              const std::vector<Rotation>& axes) const {
  const Index n = information_.size();
  const Jacobian J = jacobian(values, residual(values));
  const PointSquare R_transposed = values.base.rotation().matrix().transpose();
  Matrix by_base(n, kDof), information(n, n);
  for (Index c = 0; c < n; ++c) {
    std::copy(information_.column(c) + c, information_.column(c) + n, information.col(c).data() + c);
    for (Index r = c + 1; r < n; ++r) information(c, r) = information(r, c);
  }
  std::vector<PointSquare> own;
  std::vector<typename Rotation::Jacobian> turn;
  for (std::size_t i = 0; i < J.lever.size(); ++i) {
    own.push_back(R_transposed * axes[1 + i].matrix());
    by_base.block<kDim, kDim>(row(i), 0) = -R_transposed * axes[0].matrix();
    by_base.block<kDim, kTurn>(row(i), kDim) = J.lever[i] * axes[0].adjoint();
    if (i >= poses_.size()) continue;
    turn.push_back(J.turn[i] * axes[1 + i].adjoint());
    by_base.block<kTurn, kDim>(row(i) + kDim, 0).setZero();
    by_base.block<kTurn, kTurn>(row(i) + kDim, kDim) = -J.turn[i] * axes[0].adjoint();
  }
  // D^T M for columns M, from row `first` on, where D has the blocks of poses and landmarks.
  const auto own_rows = [&](Matrix& M, std::size_t first) {
    for (std::size_t i = first; i < own.size(); ++i) {
      const Index at = row(i) - row(first);
      M.middleRows<kDim>(at) = (own[i].transpose() * M.middleRows<kDim>(at)).eval();
      if (i < poses_.size())
        M.middleRows<kTurn>(at + kDim) = (turn[i].transpose() * M.middleRows<kTurn>(at + kDim)).eval();
    }
  };
  Matrix H = Matrix::Zero(columns(), columns());
  Matrix weighted = information * by_base;
  H.topLeftCorner<kDof, kDof>().noalias() = by_base.transpose() * weighted;
  own_rows(weighted, 0);
  H.bottomLeftCorner(n, kDof) = weighted;
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    const Index first = row(k), below = n - first;
    Matrix columns_of_pose(below, kDof);
    columns_of_pose.leftCols<kDim>() = information.block(first, first, below, kDim) * own[k];
    columns_of_pose.rightCols<kTurn>() = information.block(first, first + kDim, below, kTurn) * turn[k];
    own_rows(columns_of_pose, k);
    H.block(kDof + first, kDof + first, below, kDof) = columns_of_pose;
  }
  const std::vector<PointSquare> points(own.begin() + static_cast<std::ptrdiff_t>(poses_.size()), own.end());
  put_point_blocks(information, row(poses_.size()), points, kDof + row(poses_.size()), H);
  return H;
}

template <class Pose>
typename PlaceFactor<Pose>::PointSquare PlaceFactor<Pose>::landmark_information(Index i, const Rotation& base) const {
  const PointSquare R = base.matrix();
  return R * information_.diagonal_block<kDim>(row(poses_.size() + static_cast<std::size_t>(i))) * R.transpose();
}

template class PlaceFactor<SE2>;
template class PlaceFactor<SE3>;

}  // namespace cairn
