// SPDX-License-Identifier: BSD-3-Clause
// One step of an iteration on an elimination tree that does not visit parts which hardly move (see
// EliminationTree::relax()).
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "map/join/sparse/elimination_pass.hpp"
#include "map/join/sparse/elimination_rests.hpp"
#include "map/join/sparse/elimination_visitors.hpp"

namespace cairn {

template <class Pose>
class EliminationRelaxer {
 public:
  // `variables` bounds the numbers of the tree's variables.
  EliminationRelaxer(std::size_t variables, TreeRests& rests, TreeRelaxation<Pose>& system)
      : variables_(variables), rests_(rests), system_(system) {}

  // The whole step; `touches` are sorted by key. Returns by how much the cost falls if it is quadratic.
  double relax(const TreeFront& crown, const std::vector<TreeTouch>& touches);
  // Hands down the kept motions and forces on the way to the touched fronts.
  void settle(const TreeFront& crown, const std::vector<TreeTouch>& touches);

 private:
  using Vector = Eigen::VectorXd;

  // The tolerance for the remainder of a motion after its rigid part was carried on, relative to the tolerance for kept
  // motions. Nearly all parts of a map have such remainders then, and their second-order effects add up.
  static constexpr double kStraight = 0.1;

  void forget(const TreeFront& front, TouchIterator begin, TouchIterator end);
  void gather_rests();
  std::unique_ptr<TreePass> forward(const TreeFront& front, TouchIterator begin, TouchIterator end) const;
  void backward(const TreeFront& front, const Vector& forces, const TreePass* pass, TouchIterator begin,
                TouchIterator end, const Vector& boundary, bool far);
  void carry(const TreeFront& front, const RigidMotion<Pose>& motion);
  void keep_below(const TreeFront& front, const TreePass& pass);
  bool matters(const std::vector<Variable>& variables, const Vector& motion) const;

  std::size_t variables_;
  TreeRests& rests_;
  TreeRelaxation<Pose>& system_;
  std::vector<std::int32_t> slots_;  // by variable: index in forces_, -1: none
  std::vector<typename Pose::Tangent> forces_;
};

extern template class EliminationRelaxer<SE2>;
extern template class EliminationRelaxer<SE3>;

}  // namespace cairn
