// SPDX-License-Identifier: BSD-3-Clause
// A motion over several steps, and the covariance of its error in the axes of the body after it.
#pragma once

#include "motion/motion.hpp"

namespace cairn {

template <class Pose>
struct ChainedMotion {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  using Square = typename Pose::Square;

  ChainedMotion() = default;
  explicit ChainedMotion(const Increment<Pose>& step) : T(step.T_before_after), noise(step.covariance) {
    turn_to_end(T);
  }

  // The motion goes on. The ordinary error of a product has an arm (geometry/rigid.hpp, ProductJacobians). In the axes
  // of the body it is [I, turn(p)] by the error before, with the translation p of the next step. The products are those
  // of blocks: a motion is added in every frame.
  void append(const ChainedMotion& next) {
    const typename Pose::Rotation::Turn G = Pose::Rotation::turn(next.T.translation());
    auto P = noise.template topLeftCorner<kDim, kDim>();
    auto C = noise.template topRightCorner<kDim, kTurn>();
    auto Q = noise.template bottomRightCorner<kTurn, kTurn>();
    const typename Pose::Rotation::Turn before = C;
    C.noalias() += G.lazyProduct(Q);
    P.noalias() += G.lazyProduct(before.transpose());
    P.noalias() += C.lazyProduct(G.transpose());
    turn_to_end(next.T);
    noise += next.noise;
    T = T * next.T;
  }

  Pose T;
  Square noise = Square::Zero();

 private:
  // From the axes before a step to those after it. Sets both triangles from the blocks P, C and Q.
  void turn_to_end(const Pose& step) {
    const typename Pose::Rotation back = step.rotation().inverse();
    const typename Pose::Rotation::Matrix R = back.matrix();
    const typename Pose::Rotation::Jacobian A = back.adjoint();
    const typename Pose::Rotation::Matrix P = R.lazyProduct(noise.template topLeftCorner<kDim, kDim>());
    const typename Pose::Rotation::Turn C = R.lazyProduct(noise.template topRightCorner<kDim, kTurn>());
    const typename Pose::Rotation::Jacobian Q = A.lazyProduct(noise.template bottomRightCorner<kTurn, kTurn>());
    noise.template topLeftCorner<kDim, kDim>().noalias() = P.lazyProduct(R.transpose());
    noise.template topRightCorner<kDim, kTurn>().noalias() = C.lazyProduct(A.transpose());
    noise.template bottomRightCorner<kTurn, kTurn>().noalias() = Q.lazyProduct(A.transpose());
    noise.template bottomLeftCorner<kTurn, kDim>() = noise.template topRightCorner<kDim, kTurn>().transpose();
  }
};

}  // namespace cairn
