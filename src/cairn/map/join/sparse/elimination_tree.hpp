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

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "linear/small_algebra.hpp"
#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

// Bases are even, landmarks odd.
using Variable = std::int32_t;
inline Variable base_variable(std::size_t base) {
  return static_cast<Variable>(2 * base);
}
inline Variable landmark_variable(std::size_t landmark) {
  return static_cast<Variable>(2 * landmark + 1);
}
inline bool is_landmark(Variable v) {
  return (v & 1) != 0;
}
template <class Pose>
Index dimension(Variable v) {
  return is_landmark(v) ? Pose::kDim : Pose::kDof;
}
template <class Pose>
Index dimension(const std::vector<Variable>& variables) {
  Index sum = 0;
  for (const Variable v : variables) sum += dimension<Pose>(v);
  return sum;
}

// Where in the tree a leaf stands.
struct TreeKey {
  static constexpr int kBits = 96;
  std::uint64_t place = 0;  // Morton code
  std::uint32_t leaf = 0;

  TreeKey() = default;
  // Cells are 1 m wide; `offset` counts from a point that stays the same for all of a tree's life.
  TreeKey(const Vector3& offset, std::uint32_t leaf_number);
  bool bit(int i) const { return i < 64 ? (place >> (63 - i)) & 1 : (leaf >> (95 - i)) & 1; }
  // The first bit in which two keys differ, kBits where there is none.
  int split(const TreeKey& other) const;
  bool operator<(const TreeKey& other) const { return place != other.place ? place < other.place : leaf < other.leaf; }
};

// What the tree asks of its owner. Leaves have ascending variables.
class LeafSource {
 public:
  virtual ~LeafSource() = default;
  virtual const std::vector<Variable>& variables(std::uint32_t leaf) const = 0;
  // Lower triangle of its information, in the order of its variables; H comes zeroed.
  virtual void information(std::uint32_t leaf, double* H, Index ld) const = 0;
  // Whether it tells where its variables stand, not only how they stand to each other.
  virtual bool absolute(std::uint32_t leaf) const = 0;
};

struct TreeFront;  // elimination_front.hpp

struct TreeChanges {
  std::vector<TreeKey> leaves;  // new, or with other variables or information
  // Variables that were eliminated before and are now held by more leaves, each with a leaf that held it.
  std::vector<std::pair<Variable, TreeKey>> variables;
};

// Down to which front on the path to a leaf.
struct TreeTouch {
  TreeKey key;
  int bit;
};

// Over the poses of one kind of map.
template <class Pose>
class EliminationTree {
 public:
  using Front = TreeFront;
  using FrontPointer = std::shared_ptr<const Front>;
  using Changes = TreeChanges;
  using Touch = TreeTouch;

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
  class System {
   public:
    virtual ~System() = default;
    // Adds to the right-hand side of a variable, dimension<Pose>(v) x columns.
    virtual void right_hand_side(Variable v, double* b, Index ld) const = 0;
    // Takes the solution of a variable. False: whoever hangs on this variable alone needs no visit.
    virtual bool solution(Variable v, const double* x, Index ld) = 0;
  };
  void solve(std::vector<Touch> touches, Index columns, System& system) const;

  // One step of an iteration whose right-hand side is the force at the values that each leaf was evaluated at. A front
  // whose boundary hardly moves, and which the forces within hardly stir, is not visited: the motion and the forces
  // rest there, and what both exert on the boundary is counted in from then on, until they have added up to something.
  // So the parts of a map that a step only shifts a little cost nothing, and yet no force is ever out of balance. (One
  // that is forgotten is small, but has its counterpart elsewhere: alone it bends a long chain of submaps by metres.)
  // Where the boundary moves far, but almost as a rigid whole, all below is carried along, and what remains of the
  // motion rests: no force among leaves that are carried changes, so that none of them is visited either.
  // To be touched: every leaf that was evaluated since the last step, and every one that a change named since.
  struct RigidMotion {  // a point p goes by move + turn x (p - centre), to first order
    typename Pose::Point centre, move;
    typename Pose::Rotation::Tangent turn;
  };
  class Relaxation : public System {
   public:
    // Whether a motion of this variable is worth handing down.
    virtual bool matters(Variable v, const double* x) const = 0;
    // The rigid motion nearest to that of some variables, which is left with what remains of it.
    virtual RigidMotion take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const = 0;
    // A variable goes along with a rigid motion.
    virtual void carry(Variable v, const RigidMotion& motion) = 0;
    // All of the leaf's variables do, or rest; whatever hangs on the leaf alone has to go along.
    virtual void carry_leaf(std::uint32_t leaf, const RigidMotion& motion) = 0;
    // All of the leaf's variables stand at their new values now.
    virtual void visit(std::uint32_t leaf) = 0;
  };
  // Returns by how much the cost falls if it is quadratic.
  double relax(std::vector<Touch> touches, Relaxation& system);
  // Hands down what is kept on the way to the leaves that are about to change; before update().
  void settle(const Changes& changes, Relaxation& system);

  // Covariances by selected inversion: of all variables of each leaf asked for, in their order.
  class Covariances {
   public:
    virtual ~Covariances() = default;
    virtual void leaf(std::uint32_t leaf, const Eigen::MatrixXd& covariance) = 0;
  };
  void covariances(std::vector<TreeKey> leaves, Covariances& visitor) const;
  // Of the variable that was eliminated last.
  Eigen::MatrixXd last_covariance() const;

  std::size_t memory_bytes() const;  // of the fronts

 private:
  class Relaxer;
  struct Rest {  // what a front keeps back
    FrontPointer front;
    Eigen::VectorXd motion;  // of its boundary, not handed down; empty: none
    Eigen::VectorXd y;       // L_EE^-1 times the forces on what it eliminates, not followed yet; empty: none
    Eigen::VectorXd force;   // what both exert on the boundary
  };
  void keep_rest(const FrontPointer& front, Eigen::VectorXd motion, Eigen::VectorXd y);
  Rest take_rest(const Front& front);
  int eliminated_at(Variable v) const { return eliminated_at_[v]; }

  FrontPointer crown_;  // above the trie: eliminates what is left
  // By key and bit: sums must not depend on where fronts lie in memory.
  std::map<std::pair<TreeKey, int>, std::shared_ptr<const Rest>> rests_;
  // Fronts with a child that was carried in the last step. The factor is of older linearisation points, and would have
  // the rigid motion raise a force that does not exist: the next step counts these fronts' forces anew.
  std::vector<Touch> carried_;
  std::vector<std::int32_t> degree_;
  std::vector<std::int16_t> eliminated_at_;  // bit of the front that eliminates a variable; kNever
};

extern template class EliminationTree<SE2>;
extern template class EliminationTree<SE3>;

}  // namespace cairn
