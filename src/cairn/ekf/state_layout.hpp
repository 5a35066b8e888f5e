// SPDX-License-Identifier: BSD-3-Clause
// The layout of a filter's state. A variable is a block: its offset, its size, and its retraction (how an error moves
// it). This is the only file that computes offsets.
//
// The order is [pose; systematic errors; attitudes of companions; points], that is
// [xi_p; xi_R; s; theta_1; theta_2; ...; xi_1; xi_2; ...]. A systematic error is a number, and a point is the position
// of a companion (the first slots) or a landmark (all later slots). Pose and systematic errors are the states that
// motion changes: their columns of P are always written completely. A new kind of variable (a clone) goes between them
// and the points: it adds to lead() and gets a Retraction.
#pragma once

#include <Eigen/Core>

#include "linear/small_algebra.hpp"

namespace cairn {

enum class Retraction {
  pose,      // ErrorModel::retract
  number,    // s <- s + e, with either error model
  attitude,  // R <- Exp(theta) R, theta the ordinary error, with either error model
  point      // ErrorModel::PointRetraction
};

struct Block {
  Index offset, size;
  Retraction retraction;
  Index number;  // of the companion or the slot; 0 for the others
};

template <class Pose>
class StateLayout {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;

  Index companions() const { return companions_; }
  Index points() const { return points_; }
  Index systematic() const { return systematic_; }
  Index blocks() const { return 1 + (systematic_ > 0 ? 1 : 0) + companions_ + points_; }
  Index states() const { return lead() + kDim * points_; }
  static Index states(Index companions, Index points, Index systematic = 0) {
    return kDof + systematic + kTurn * companions + kDim * points;
  }
  Index moving() const { return kDof + systematic_; }            // states of the pose and the systematic errors
  Index lead() const { return moving() + kTurn * companions_; }  // states before the first point

  static Block pose() { return {0, kDof, Retraction::pose, 0}; }
  Block numbers() const { return {kDof, systematic_, Retraction::number, 0}; }  // the systematic errors
  Block attitude(Index companion) const {
    return {moving() + kTurn * companion, kTurn, Retraction::attitude, companion};
  }
  Block point(Index slot) const { return {lead() + kDim * slot, kDim, Retraction::point, slot}; }
  Block block(Index number) const {
    if (number == 0) return pose();
    if (systematic_ > 0 && --number == 0) return numbers();
    return number <= companions_ ? attitude(number - 1) : point(number - 1 - companions_);
  }

  void clear(Index systematic = 0) { companions_ = points_ = 0, systematic_ = systematic; }
  void add_points(Index count) { points_ += count; }
  void remove_last_point() { --points_; }
  void add_companion() { ++companions_; }
  void remove_last_companion() { --companions_; }

 private:
  Index systematic_ = 0, companions_ = 0, points_ = 0;
};

// Columns of a Jacobian by systematic errors that follow each other: at most two states for each number of a sensor's
// calibration.
template <int kRows>
struct ErrorColumns {
  static constexpr Index kMost = 18;
  Eigen::Matrix<double, kRows, kMost> J = Eigen::Matrix<double, kRows, kMost>::Zero();
  Index first = 0, count = 0;
};

// The layout of an update's window: [pose; systematic errors; mount; chosen points].
template <class Pose>
class WindowLayout {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;

  WindowLayout() = default;
  WindowLayout(Index systematic, Index mount, Index points)
      : moving_(kDof + systematic), mount_(mount), points_(points) {}

  Index mount_size() const { return mount_; }
  Index points() const { return points_; }
  Index columns() const { return point(points_); }
  Index moving() const { return moving_; }
  Index mount() const { return moving_; }
  Index point(Index number) const { return moving_ + mount_ + kDim * number; }

 private:
  Index moving_ = kDof, mount_ = 0, points_ = 0;
};

}  // namespace cairn
