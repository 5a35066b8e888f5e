// SPDX-License-Identifier: BSD-3-Clause
// Makes one leaf of submaps of one place, so that a sparse map grows with the area that it covers, not with the time
// driven (docs/submaps.md, "A map that does not grow").
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "map/join/sparse/sparse_change.hpp"
#include "map/join/sparse/sparse_solver.hpp"

namespace cairn {

// A change of its own between two closings.
template <class Pose>
class SparseFuser {
 public:
  // The newest submaps stay as they are. Several older ones are fused together: it costs hardly more than one.
  static constexpr std::size_t kNewest = 2, kTogether = 3;
  // Landmarks of a place at most: this many times those of the largest submap, or this number if that is more.
  static constexpr std::size_t kLargest = 4, kFew = 64;
  // Poses that a place has in common with other leaves, at most, where these leaves can do without.
  static constexpr std::size_t kPoses = 6;

  SparseFuser(SparseState<Pose>& state, SpatialIndex& index) : state_(state), index_(index) {}

  // Fuses each submap that is old enough, and each place that has grown, with the leaf that holds most of its
  // landmarks, if that leaf covers the same place. Unless it returns, the state is as it was.
  void run();

 private:
  using State = SparseState<Pose>;
  using Number = typename State::Number;
  using Leaf = typename State::Leaf;
  using Numbers = std::vector<Number>;
  using Errors = std::vector<Index>;
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  struct Pair {
    Number older, younger;  // leaves; the older one stays
  };

  // The poses and landmarks of two leaves that become one, but for the base of the older one; and their errors, those
  // of the poses first.
  struct Union {
    Numbers poses, landmarks;
    Numbers kept_poses, kept_landmarks;  // that the new place holds
    Errors gone, kept;

    Index error_of_pose(std::size_t i) const { return static_cast<Index>(kDof * i); }
    Index error_of_landmark(std::size_t i) const { return static_cast<Index>(kDof * poses.size() + kDim * i); }
  };

  std::vector<Pair> plan();
  bool fusible(Number leaf) const;
  Number partner_of(Number leaf, const Numbers& leaving) const;
  bool fits(const Pair& pair) const;
  bool stands_by_itself(Number leaf) const;
  Errors held(const Leaf& leaf) const;
  Union unite(const Pair& pair) const;
  Numbers poses_to_cut(const Pair& pair, const Numbers& poses) const;
  Quadratic cost_of(const Leaf& leaf, const typename Pose::Rotation& axes) const;
  void add_cost(const Leaf& leaf, const Leaf& older, const Union& both, Quadratic& sum) const;
  void fuse(SparseChange<Pose>& change, const Pair& pair, TreeChanges& changes);
  void hand_over_poses(SparseChange<Pose>& change, const Pair& pair, const Union& both);
  void hand_over_landmarks(SparseChange<Pose>& change, const Pair& pair, const Union& both, TreeChanges& changes);
  void hand_over_submaps(SparseChange<Pose>& change, const Pair& pair);

  SparseState<Pose>& state_;
  SpatialIndex& index_;
};

extern template class SparseFuser<SE2>;
extern template class SparseFuser<SE3>;

}  // namespace cairn
