// SPDX-License-Identifier: BSD-3-Clause
// A team's filter with its memory.
#pragma once

#include "core/arena.hpp"
#include "team/team.hpp"

namespace cairn {

struct Team::Box {
  explicit Box(const FilterOptions<SE2>& options)
      : arena(Filter<SE2>::arena_bytes(options)), filter(arena, options) {}

  // With submaps: the filter of a teammate, by what it tells of itself.
  void add_teammate(std::uint64_t, const SE2&, const Matrix3&, const TeamOptions&) {}

  SE2 pose(std::uint64_t vehicle) const { return filter.vehicle_pose(vehicle); }
  Matrix3 covariance(std::uint64_t vehicle) const { return filter.vehicle_covariance(vehicle); }

  Arena arena;
  Filter<SE2> filter;
};

}  // namespace cairn
