// SPDX-License-Identifier: BSD-3-Clause
// The interfaces through which the elimination tree gets numbers from its owner and returns results.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "map/join/sparse/variable.hpp"

namespace cairn {

// The submaps, as the tree's leaves. A leaf has ascending variables.
class LeafSource {
 public:
  virtual ~LeafSource() = default;
  virtual const std::vector<Variable>& variables(std::uint32_t leaf) const = 0;
  // Lower triangle of its information, in the order of its variables; H comes zeroed.
  virtual void information(std::uint32_t leaf, double* H, Index ld) const = 0;
  // Whether the tree keeps this information, which is expensive to form, until the leaf changes.
  virtual bool kept(std::uint32_t) const { return false; }
  // Whether it has information on the absolute positions of its variables, not only on their relative positions.
  virtual bool absolute(std::uint32_t leaf) const = 0;
};

// A point p moves by move + turn x (p - centre), to first order.
template <class Pose>
struct RigidMotion {
  typename Pose::Point centre, move;
  typename Pose::Rotation::Tangent turn;
};

// One step of an iteration; see EliminationTree::relax().
template <class Pose>
class TreeRelaxation {
 public:
  virtual ~TreeRelaxation() = default;
  // Adds the force on a variable to the right-hand side.
  virtual void right_hand_side(Variable v, double* b) const = 0;
  // Receives the motion of a variable.
  virtual void solution(Variable v, const double* x) = 0;
  // Whether a motion of this variable is large enough to be handed down.
  virtual bool matters(Variable v, const double* x) const = 0;
  // The rigid motion nearest to that of some variables; subtracts it from their motion.
  virtual RigidMotion<Pose> take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const = 0;
  // A variable follows a rigid motion.
  virtual void carry(Variable v, const RigidMotion<Pose>& motion) = 0;
  // All of the leaf's variables follow the motion or hardly move otherwise. Everything that depends only on the leaf
  // must follow, too.
  virtual void carry_leaf(std::uint32_t leaf, const RigidMotion<Pose>& motion) = 0;
  // All of the leaf's variables have their new values now.
  virtual void visit(std::uint32_t leaf) = 0;
};

// Combinations of the errors of variables that one leaf holds, or of one variable.
struct TreeCombinations {
  TreeTouch touch;
  std::vector<Variable> variables;
  Eigen::MatrixXd weights;  // by state of the variables; a column for each combination
};

// Receives covariances: of all variables of a leaf, in their order.
class TreeCovariances {
 public:
  virtual ~TreeCovariances() = default;
  virtual void leaf(std::uint32_t leaf, const Eigen::MatrixXd& covariance) = 0;
};

}  // namespace cairn
