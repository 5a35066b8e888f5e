// SPDX-License-Identifier: BSD-3-Clause
// Damped Gauss-Newton on a sparse map's factor (docs/submaps.md). The factor may belong to older linearisation points,
// but the gradient is always current, so that the steps converge to the minimum.
#pragma once

#include <vector>

#include "map/join/sparse/sparse_change.hpp"
#include "map/join/sparse/sparse_step.hpp"

namespace cairn {

// Solves within one change, which saves everything that the solver moves.
template <class Pose>
class SparseSolver {
 public:
  SparseSolver(SparseState<Pose>& state, SparseChange<Pose>& change) : state_(state), change_(change) {}

  // Hands down motions that the tree keeps above what is about to change.
  void settle(const TreeChanges& changes);
  // Makes the affected parts of the tree anew: those of `changes` and of stale leaves.
  void refactor(TreeChanges changes, JoinReport& report);
  // Those of `changes` only.
  void remake(const TreeChanges& changes, JoinReport& report);
  // Iterates until it converges, or until the limit of iterations of a closing (Solution::settled tells which).
  void optimise(JoinReport& report);

 private:
  using State = SparseState<Pose>;
  using Step = SparseStep<Pose>;
  using Number = typename State::Number;
  static constexpr int kDim = Pose::kDim;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Tangent = typename Rotation::Tangent;
  using PointSquare = typename Rotation::Matrix;

  // The values that a step starts from.
  struct Before {
    std::vector<Pose> bases;
    std::vector<Point> positions;
    std::vector<Rotation> turned;  // of the leaves that it carries
    struct Evaluation {
      double cost;
      Eigen::VectorXd gradient;
      Rotation turned;
    };
    std::vector<Evaluation> evaluations;  // of the leaves that it visits
  };

  Before save(const Step& step);
  void place(const Step& step, double factor, const Before& from);
  double take_step(const Step& step, double factor, const Before& from);
  void take_back(const Step& step, Before& from);

  State& state_;
  SparseChange<Pose>& change_;
};

extern template class SparseSolver<SE2>;
extern template class SparseSolver<SE3>;

}  // namespace cairn
