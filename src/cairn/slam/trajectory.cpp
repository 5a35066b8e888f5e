// SPDX-License-Identifier: BSD-3-Clause
#include "slam/trajectory.hpp"

#include <algorithm>

namespace cairn {

template <class Pose>
Trajectory<Pose>::Trajectory(Arena& arena, Index capacity)
    : capacity_(static_cast<std::uint64_t>(capacity)),
      poses_(arena.take<Local>(static_cast<std::size_t>(capacity))),
      ends_(arena.take<Local>(static_cast<std::size_t>(capacity))) {}

template <class Pose>
void Trajectory<Pose>::add(std::uint64_t submap, const Pose& T_base_body, double variance) {
  if (capacity_ == 0) return;
  poses_[end_ % capacity_] = {submap, T_base_body, variance};
  ++end_;
}

template <class Pose>
void Trajectory<Pose>::end_submap(std::uint64_t submap, const Pose& T_base_end, double variance) {
  if (capacity_ == 0) return;
  ends_[submap % capacity_] = {submap, T_base_end, variance};
}

template <class Pose>
Pose Trajectory<Pose>::pose(std::uint64_t number, const GlobalMap<Pose>* map) const {
  const Local& local = poses_[number % capacity_];
  if (map == nullptr) return local.T_base_body;
  const std::size_t submap = local.submap, closed = map->submap_count();
  if (submap == closed) return map->base() * local.T_base_body;
  const Pose T_map_base = map->submap_base(submap);
  const Pose T_map_end = submap + 1 == closed ? map->base() : map->submap_base(submap + 1);
  const Local& end = ends_[submap % capacity_];
  // docs/trajectory.md, eq. (2): the correction of the submap's end.
  const typename Pose::Tangent correction = (T_map_base.inverse() * T_map_end * end.T_base_body.inverse()).log();
  // eq. (3): the share of the correction that the pose gets.
  const double share = end.variance > 0.0 ? std::min(1.0, local.variance / end.variance) : 0.0;
  // eq. (4)
  return T_map_base * Pose::exp(share * correction) * local.T_base_body;
}

template class Trajectory<SE2>;
template class Trajectory<SE3>;

}  // namespace cairn
