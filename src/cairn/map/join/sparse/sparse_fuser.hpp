// SPDX-License-Identifier: BSD-3-Clause
// Makes one leaf of submaps of one place, so that a sparse map grows with the area that it covers, not with the time
// driven (docs/submaps.md, "A map that does not grow").
#pragma once

#include <cstddef>
#include <vector>

#include "map/join/sparse/sparse_change.hpp"
#include "map/join/sparse/sparse_solver.hpp"

namespace cairn {

// A change of its own between two closings.
template <class Pose>
class SparseFuser {
 public:
  // The newest submaps stay as they are. Several older ones are fused together: it costs hardly more than one.
  static constexpr std::size_t kNewest = 2, kTogether = 5;
  // Landmarks of a place at most: this many times those of the largest submap, or this number if that is more.
  static constexpr std::size_t kLargest = 4, kFew = 64;
  // Poses that a place has in common with other leaves, at most, where these leaves can do without.
  static constexpr std::size_t kPoses = 10;

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
  using Group = Numbers;  // leaves that become one: the oldest comes first, and stays

  // The poses and landmarks of a group, but for the base of the oldest leaf; and their errors, those of the poses
  // first.
  struct Union {
    Numbers poses, landmarks;
    Numbers kept_poses, kept_landmarks;  // that the new place holds
    Errors gone, kept;
    bool cut = false;  // a pose is given up that another leaf holds

    Index error_of_pose(std::size_t i) const { return static_cast<Index>(kDof * i); }
    Index error_of_landmark(std::size_t i) const { return static_cast<Index>(kDof * poses.size() + kDim * i); }
  };

  std::vector<Group> plan();
  bool fusible(Number leaf) const;
  Number partner_of(Number leaf, const Numbers& leaving) const;
  bool of_one_place(Number a, Number b, std::size_t common) const;
  bool has_room(Group group, Number another) const;
  bool stands_by_itself(Number leaf) const;
  Errors held(const Leaf& leaf) const;
  Numbers landmarks_of(const Group& group) const;
  Union unite(const Group& group) const;
  Numbers poses_to_cut(const Group& group, const Numbers& poses) const;
  Quadratic cost_of(const Leaf& leaf, const typename Pose::Rotation& axes) const;
  void add_cost(const Leaf& leaf, const Leaf& oldest, const Union& all, Quadratic& sum) const;
  // Returns whether the minimum may move, for a pose was cut.
  bool fuse(SparseChange<Pose>& change, const Group& group, TreeChanges& changes);
  void hand_over_poses(SparseChange<Pose>& change, const Group& group, const Union& all);
  void hand_over_landmarks(SparseChange<Pose>& change, const Group& group, const Union& all, TreeChanges& changes);
  void hand_over_submaps(SparseChange<Pose>& change, Number from, Number to);

  SparseState<Pose>& state_;
  SpatialIndex& index_;
};

extern template class SparseFuser<SE2>;
extern template class SparseFuser<SE3>;

}  // namespace cairn
