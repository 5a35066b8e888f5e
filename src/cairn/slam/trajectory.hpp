// SPDX-License-Identifier: BSD-3-Clause
// The poses of the vehicle at its last updates, as they are known now (docs/trajectory.md). A pose is kept relative to
// the base of the submap that was open, so a later correction of this base corrects the pose, too.
#pragma once

#include "core/arena.hpp"
#include "map/global_map.hpp"

namespace cairn {

// Poses are numbered from 0 in the order in which they were added. The newest `capacity` poses are kept.
template <class Pose>
class Trajectory {
 public:
  using Square = typename Pose::Square;

  Trajectory(Arena& arena, Index capacity);

  std::uint64_t capacity() const { return capacity_; }
  std::uint64_t first() const { return end_ > capacity_ ? end_ - capacity_ : 0; }  // the oldest pose that is kept
  std::uint64_t end() const { return end_; }                                       // one behind the newest pose

  // A pose in the open submap, with its ordinary covariance.
  void add(std::uint64_t submap, const Pose& T_base_body, const Square& covariance);
  // The pose at which a submap was closed. Submaps are closed in their order.
  void end_submap(std::uint64_t submap, const Pose& T_base_end, const Square& covariance);

  class Open;
  // A kept pose in the map that the caller sees. `map` is null with a single map; `open` is then not used.
  Pose pose(std::uint64_t number, const GlobalMap<Pose>* map, const Open& open) const;

 private:
  static constexpr int kDof = Pose::kDof;

  // The covariance is that of the error xi of Exp(xi) T_base_body: its lower triangle by rows.
  struct Local {
    std::uint64_t submap;
    Pose T_base_body;
    double covariance[kDof * (kDof + 1) / 2];
  };
  static Local pack(std::uint64_t submap, const Pose& T_base_body, const Square& covariance);
  static Square covariance_of(const Local& local);
  static Square gain(const Local& local, const Local& end);

  std::uint64_t capacity_;
  std::uint64_t end_ = 0;
  Local* poses_;  // by number modulo capacity
  // By submap modulo capacity. A call that closes a submap also adds a pose, or the submap holds a landmark and so at
  // least one pose. The kept poses therefore span at most `capacity` ends.
  Local* ends_;
};

// The open submap, as it would be closed now: its base and its end, which is the vehicle's pose, in the map, and the
// vehicle in the submap with its ordinary covariance.
template <class Pose>
class Trajectory<Pose>::Open {
 public:
  Open() = default;
  Open(const Pose& T_map_base, const Pose& T_map_end, const Pose& T_base_end, const Square& covariance)
      : base_(T_map_base), end_(T_map_end), local_(pack(0, T_base_end, covariance)) {}

 private:
  friend class Trajectory;
  Pose base_, end_;
  Local local_ = {};
};

extern template class Trajectory<SE2>;
extern template class Trajectory<SE3>;

}  // namespace cairn
