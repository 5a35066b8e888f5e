// SPDX-License-Identifier: BSD-3-Clause
// The layout of a filter's state. A variable is a block: its offset, its size, and its retraction (how an error moves
// it). This is the only file that computes offsets.
//
// The order is [pose; attitudes of companions; points], that is [xi_p; xi_R; theta_1; theta_2; ...; xi_1; xi_2; ...].
// A point is the position of a companion (the first slots) or a landmark (all later slots). A new kind of variable
// (a bias, a clone, a calibration) goes between the pose and the points: it adds to lead() and gets a Retraction.
#pragma once

#include "linear/small_algebra.hpp"

namespace cairn {

enum class Retraction {
  pose,      // ErrorModel::retract
  attitude,  // R <- Exp(theta) R, theta the ordinary error, with either error model
  point      // ErrorModel::PointRetraction
};

struct Block {
  Index offset, size;
  Retraction retraction;
  Index number;  // of the companion or the slot; 0 for the pose
};

template <class Pose>
class StateLayout {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;

  Index companions() const { return companions_; }
  Index points() const { return points_; }
  Index blocks() const { return 1 + companions_ + points_; }
  Index states() const { return lead() + kDim * points_; }
  static Index states(Index companions, Index points) { return kDof + kTurn * companions + kDim * points; }
  Index lead() const { return kDof + kTurn * companions_; }  // states before the first point

  static Block pose() { return {0, kDof, Retraction::pose, 0}; }
  static Block attitude(Index companion) { return {kDof + kTurn * companion, kTurn, Retraction::attitude, companion}; }
  Block point(Index slot) const { return {lead() + kDim * slot, kDim, Retraction::point, slot}; }
  Block block(Index number) const {
    if (number == 0) return pose();
    return number <= companions_ ? attitude(number - 1) : point(number - 1 - companions_);
  }

  void clear() { companions_ = points_ = 0; }
  void add_points(Index count) { points_ += count; }
  void remove_last_point() { --points_; }
  void add_companion() { ++companions_; }
  void remove_last_companion() { --companions_; }

 private:
  Index companions_ = 0, points_ = 0;
};

// The layout of an update's window: [pose; mount; chosen points].
template <class Pose>
class WindowLayout {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;

  WindowLayout() = default;
  WindowLayout(Index mount, Index points) : mount_(mount), points_(points) {}

  Index mount_size() const { return mount_; }
  Index points() const { return points_; }
  Index columns() const { return point(points_); }
  static Index mount() { return kDof; }
  Index point(Index number) const { return kDof + mount_ + kDim * number; }

 private:
  Index mount_ = 0, points_ = 0;
};

}  // namespace cairn
