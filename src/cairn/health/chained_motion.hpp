// SPDX-License-Identifier: BSD-3-Clause
// A motion over several steps, and the covariance of its error in the axes of the body after it.
#pragma once

#include "health/body_axes.hpp"
#include "motion/motion.hpp"

namespace cairn {

template <class Pose>
struct ChainedMotion {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  using Square = typename Pose::Square;

  ChainedMotion() = default;
  explicit ChainedMotion(const Increment<Pose>& step) : T(step.T_before_after), noise(step.covariance) {
    turn_axes<Pose>(T.rotation().inverse(), noise);
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
    turn_axes<Pose>(next.T.rotation().inverse(), noise);
    noise += next.noise;
    T = T * next.T;
  }

  Pose T;
  Square noise = Square::Zero();
};

}  // namespace cairn
