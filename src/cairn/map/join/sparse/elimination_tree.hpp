// SPDX-License-Identifier: BSD-3-Clause
// Sparse Cholesky factor of the map, kept as a tree of fronts over space (multifrontal nested dissection).
//
// Its leaves are submaps: dense blocks of information over the variables that they share with others. A leaf has a key:
// the cell of space where its submap lies, as a Morton code, and its number. The keys' binary trie is the tree: it
// halves space again and again, so that an addition changes one path, and the tree is never rebalanced. A front
// eliminates the variables that no leaf outside its subtree holds, and hands the Schur complement over the others, its
// boundary, up to its parent. Parts of the map that are far apart have small boundaries in common.
//
// Fronts are immutable and shared: an update makes new ones on the paths that it touches and leaves the rest, so that a
// tree is copied, or taken back, by copying a pointer.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "map/join/sparse/elimination_front.hpp"
#include "map/join/sparse/elimination_rests.hpp"
#include "map/join/sparse/elimination_visitors.hpp"
#include "map/join/sparse/tree_key.hpp"

namespace cairn {

struct TreeChanges {
  std::vector<TreeKey> leaves;  // new, or with other variables or information
  // Variables that were eliminated before and are now held by more leaves, each with a leaf that held it.
  std::vector<std::pair<Variable, TreeKey>> variables;
  std::vector<TreeKey> removed;  // leaves that the tree loses
};

// Over the poses of one kind of map.
template <class Pose>
class EliminationTree {
 public:
  using Changes = TreeChanges;
  using Touch = TreeTouch;
  using Relaxation = TreeRelaxation<Pose>;
  using RigidMotion = cairn::RigidMotion<Pose>;
  using Covariances = TreeCovariances;

  // The number of leaves that hold a variable. A variable that more leaves hold than there are in the tree is
  // eliminated last.
  void set_degree(Variable v, std::int32_t degree);
  // Nothing holds the variable any more. Its number may be used again.
  void forget(Variable v);
  // The base that is eliminated last; more leaves must hold it than there are in the tree.
  void set_last(Variable v) { last_ = v; }

  // Returns false, with nothing changed, if a pivot is not positive. `refactored` and `assembled` get the fronts and
  // the leaves whose information was requested.
  bool update(const LeafSource& source, const Changes& changes, std::size_t& refactored,
              std::vector<std::uint32_t>& assembled);

  // Where a path to the crown begins: at a leaf, or where a variable was eliminated.
  Touch touch(const TreeKey& leaf) const { return {leaf, TreeKey::kBits}; }
  Touch touch(Variable v, const TreeKey& leaf_that_holds_it) const { return {leaf_that_holds_it, eliminated_at(v)}; }
  // Joint covariance of combinations of errors, in the order in which they are given.
  Eigen::MatrixXd covariance(const std::vector<TreeCombinations>& combinations) const;

  // One step of an iteration whose right-hand side is the force at the values that each leaf was evaluated at. A front
  // is not visited if its boundary hardly moves and the forces inside hardly move it. The front keeps the motion and
  // the forces, and every later step includes their force on the boundary, until they have added up to something that
  // matters. So the parts of a map that a step only shifts a little cost nothing, and all forces stay in balance. (A
  // kept force is small but has a counterpart elsewhere: if only one of the two were dropped, the other would bend a
  // long chain of submaps by metres.) If the boundary moves far, but almost as a rigid body, all fronts below are
  // carried along, and the remainder of the motion is kept: forces between carried leaves do not change, so that none
  // of these leaves is visited either. `touches` must contain every leaf that was evaluated since the last step, and
  // every leaf that a change named since. Returns the decrease of the cost if the cost is quadratic.
  double relax(std::vector<Touch> touches, Relaxation& system);
  // Hands down the kept motions and forces on the way to the leaves that are about to change; to be called before
  // update().
  void settle(const Changes& changes, Relaxation& system);

  // Covariances by selected inversion: of all variables of each requested leaf, in their order.
  void covariances(std::vector<TreeKey> leaves, Covariances& visitor) const;
  // Covariance of the variable that is eliminated last.
  Eigen::MatrixXd last_covariance() const;

  std::size_t memory_bytes() const;  // of the fronts

 private:
  int eliminated_at(Variable v) const { return eliminated_at_[v]; }

  FrontPointer crown_;  // above the trie: eliminates the remaining variables
  TreeRests rests_;
  Variable last_ = 0;
  std::vector<std::int32_t> degree_;
  std::vector<std::int16_t> eliminated_at_;  // bit of the front that eliminates a variable; EliminationBuilder::kNever
};

extern template class EliminationTree<SE2>;
extern template class EliminationTree<SE3>;

}  // namespace cairn
