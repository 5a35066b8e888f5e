// SPDX-License-Identifier: BSD-3-Clause
// One linear solution of a sparse map: the motion of its variables.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "map/join/sparse/sparse_state.hpp"

namespace cairn {

// Reads the forces from the state and collects the step; the state does not change. Lengths and turns are measured by
// one scale of the whole map.
template <class Pose>
class SparseStep final : public TreeRelaxation<Pose> {
 public:
  using Number = typename SparseState<Pose>::Number;
  using Tangent = typename Pose::Rotation::Tangent;  // of a turn
  struct Entry {                                     // of one variable, ordinary error in map axes
    Variable variable;
    double value[Pose::kDof];
  };

  // Motions below the tolerance are kept in the tree.
  SparseStep(const SparseState<Pose>& state, double tolerance) : state_(state), tolerance_(tolerance) {}

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Number>& visited() const { return visited_; }
  // Leaves that were carried along, and their turns.
  const std::vector<std::pair<Number, Tangent>>& carried() const { return carried_; }
  double largest() const { return largest_; }  // in the map's scales, of the variables that were solved for

  // TreeRelaxation
  void right_hand_side(Variable v, double* b) const override;
  void solution(Variable v, const double* x) override;
  bool matters(Variable v, const double* x) const override { return !(size(v, x) < tolerance_); }
  RigidMotion<Pose> take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const override;
  void carry(Variable v, const RigidMotion<Pose>& motion) override;
  void carry_leaf(std::uint32_t leaf, const RigidMotion<Pose>& motion) override;
  void visit(std::uint32_t leaf) override { visited_.push_back(leaf); }

 private:
  using State = SparseState<Pose>;
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Jacobian = typename Rotation::Jacobian;
  using PointSquare = typename Rotation::Matrix;

  double size(Variable v, const double* x) const {
    if (state_.is_error(v)) return Eigen::Map<const Point>(x).norm() / state_.solution.error_scale;
    const double way = Eigen::Map<const Point>(x).norm() / state_.solution.length_scale;
    return is_landmark(v) ? way
                          : std::max(way, Eigen::Map<const Tangent>(x + kDim).norm() / state_.solution.turn_scale);
  }

  const SparseState<Pose>& state_;
  double tolerance_;
  std::vector<Entry> entries_;
  std::vector<Number> visited_;
  std::vector<std::pair<Number, Tangent>> carried_;
  double largest_ = 0.0;
};

extern template class SparseStep<SE2>;
extern template class SparseStep<SE3>;

}  // namespace cairn
