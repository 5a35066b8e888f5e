// SPDX-License-Identifier: BSD-3-Clause
// A filter without slots, companions, pending motion and the invariant error: all poses and landmarks are in one dense
// covariance of ordinary errors, and each step multiplies by its full matrix.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "linear/small_algebra.hpp"
#include "motion/motion.hpp"

namespace cairn::test {

// The state is [poses; landmarks].
template <class Pose>
struct DenseState {
  using Dynamic = Eigen::MatrixXd;
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Square = typename Pose::Square;

  std::vector<Pose> poses;
  std::vector<Point> points;
  Dynamic P;

  Index pose_at(std::size_t n) const { return kDof * static_cast<Index>(n); }
  Index point_at(std::size_t n) const { return kDof * static_cast<Index>(poses.size()) + kDim * static_cast<Index>(n); }

  void propagate(std::size_t n, const Increment<Pose>& increment) {
    const typename Pose::Rotation::Matrix R = poses[n].rotation().matrix();
    Dynamic F = Dynamic::Identity(P.rows(), P.rows());
    F.block(pose_at(n), pose_at(n) + kDim, kDim, kTurn) =
        Pose::Rotation::turn(R * increment.T_before_after.translation());
    Square B = Square::Zero();
    B.template topLeftCorner<kDim, kDim>() = R;
    B.template bottomRightCorner<kTurn, kTurn>() = poses[n].rotation().adjoint();
    P = (F * P * F.transpose()).eval();
    P.template block<kDof, kDof>(pose_at(n), pose_at(n)) += B * increment.covariance * B.transpose();
    poses[n] = poses[n] * increment.T_before_after;
  }

  // Inserts the rows of a new state before row `at`. Its error is J times the error of pose n, plus independent noise.
  void insert(Index at, std::size_t n, const Dynamic& J, const Dynamic& noise) {
    const Index size = P.rows(), more = J.rows();
    Dynamic T = Dynamic::Zero(size + more, size);
    T.topLeftCorner(at, at).setIdentity();
    T.bottomRightCorner(size - at, size - at).setIdentity();
    T.block(at, pose_at(n), more, kDof) = J;
    P = (T * P * T.transpose()).eval();
    P.block(at, at, more, more) += noise;
  }
  void add_pose(const Pose& pose, std::size_t n, const Square& J, const Square& noise) {
    insert(pose_at(poses.size()), n, J, noise);
    poses.push_back(pose);
  }
  void add_point(const Point& point, std::size_t n, const Dynamic& J, const Dynamic& noise) {
    insert(P.rows(), n, J, noise);
    points.push_back(point);
  }
  void erase(Index at, Index count) {
    const Index size = P.rows();
    Dynamic T = Dynamic::Zero(size - count, size);
    T.topLeftCorner(at, at).setIdentity();
    T.bottomRightCorner(size - count - at, size - count - at).setIdentity();
    P = (T * P * T.transpose()).eval();
  }
  void remove_pose(std::size_t n) {
    erase(pose_at(n), kDof);
    poses.erase(poses.begin() + static_cast<Index>(n));
  }
  void remove_point(std::size_t n) {
    erase(point_at(n), kDim);
    points.erase(points.begin() + static_cast<Index>(n));
  }

  void update(const Dynamic& H, const Eigen::VectorXd& residual, const Dynamic& noise) {
    const Dynamic S = H * P * H.transpose() + noise;
    const Dynamic K = P * H.transpose() * S.inverse();
    const Dynamic A = Dynamic::Identity(P.rows(), P.rows()) - K * H;
    P = (A * P * A.transpose() + K * noise * K.transpose()).eval();
    const Eigen::VectorXd error = K * residual;
    for (std::size_t n = 0; n < poses.size(); ++n) {
      const typename Pose::Tangent e = error.segment<kDof>(pose_at(n));
      poses[n] = retract(poses[n], e);
    }
    for (std::size_t n = 0; n < points.size(); ++n) points[n] += error.segment<kDim>(point_at(n));
  }
};

}  // namespace cairn::test
