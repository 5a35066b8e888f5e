// SPDX-License-Identifier: BSD-3-Clause
// Sparse Cholesky factor of the map, kept as a tree of fronts over space (multifrontal nested dissection).
//
// Its leaves are submaps: dense blocks of information over the variables that they share with others. A leaf has a key:
// the cell of space where its submap lies, as a Morton code, and its number. The keys' binary trie is the tree: it
// halves space again and again, so that an addition changes one path, and nothing is ever balanced anew. A front
// eliminates the variables that no leaf outside its subtree holds, and hands the Schur complement over the others, its
// boundary, up to its parent. What lies apart in space has little boundary in common.
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
};

// Over the poses of one kind of map.
template <class Pose>
class EliminationTree {
 public:
  using Changes = TreeChanges;
  using Touch = TreeTouch;
  using System = TreeSystem;
  using Relaxation = TreeRelaxation<Pose>;
  using RigidMotion = cairn::RigidMotion<Pose>;
  using Covariances = TreeCovariances;

  // How many leaves hold a variable; one that has more than those in the tree is eliminated last of all.
  void set_degree(Variable v, std::int32_t degree);

  // False, with nothing changed, where a pivot is not positive. `refactored` and `assembled` get the fronts and the
  // leaves whose information was asked for.
  bool update(const LeafSource& source, const Changes& changes, std::size_t& refactored,
              std::vector<std::uint32_t>& assembled);

  // Solves H x = b, several columns at a time. `touch` says where b may be not zero (and where x is wanted whatever
  // happens): leaves, or eliminated variables.
  Touch touch(const TreeKey& leaf) const { return {leaf, TreeKey::kBits}; }
  Touch touch(Variable v, const TreeKey& leaf_that_holds_it) const { return {leaf_that_holds_it, eliminated_at(v)}; }
  void solve(std::vector<Touch> touches, Index columns, System& system) const;

  // One step of an iteration whose right-hand side is the force at the values that each leaf was evaluated at. A front
  // whose boundary hardly moves, and which the forces within hardly stir, is not visited: the motion and the forces
  // rest there, and what both exert on the boundary is counted in from then on, until they have added up to something.
  // So the parts of a map that a step only shifts a little cost nothing, and yet no force is ever out of balance. (One
  // that is forgotten is small, but has its counterpart elsewhere: alone it bends a long chain of submaps by metres.)
  // Where the boundary moves far, but almost as a rigid whole, all below is carried along, and what remains of the
  // motion rests: no force among leaves that are carried changes, so that none of them is visited either.
  // To be touched: every leaf that was evaluated since the last step, and every one that a change named since.
  // Returns by how much the cost falls if it is quadratic.
  double relax(std::vector<Touch> touches, Relaxation& system);
  // Hands down what is kept on the way to the leaves that are about to change; before update().
  void settle(const Changes& changes, Relaxation& system);

  // Covariances by selected inversion: of all variables of each leaf asked for, in their order.
  void covariances(std::vector<TreeKey> leaves, Covariances& visitor) const;
  // Of the variable that was eliminated last.
  Eigen::MatrixXd last_covariance() const;

  std::size_t memory_bytes() const;  // of the fronts

 private:
  int eliminated_at(Variable v) const { return eliminated_at_[v]; }

  FrontPointer crown_;  // above the trie: eliminates what is left
  TreeRests rests_;
  std::vector<std::int32_t> degree_;
  std::vector<std::int16_t> eliminated_at_;  // bit of the front that eliminates a variable; EliminationBuilder::kNever
};

extern template class EliminationTree<SE2>;
extern template class EliminationTree<SE3>;

}  // namespace cairn
