// SPDX-License-Identifier: BSD-3-Clause
// A team's filters with their memory.
#pragma once

#include "core/arena.hpp"
#include "team/shared_map.hpp"
#include "team/team.hpp"

namespace cairn {

// Sensors of a team's filter.
constexpr int kRadar = 0, kExtended = 1;

struct Team::Box {
  Box(const FilterOptions<SE2>& options, std::uint64_t vehicle, const RangeBearingParameters& radar)
      : arena(Filter<SE2>::arena_bytes(options)), filter(arena, options) {
    filter.name_vehicle(vehicle);
    filter.add(RangeBearing(radar));  // kRadar
  }

  Arena arena;
  Filter<SE2> filter;
};

// Submaps of all vehicles in one map: each has a filter of its own, driven by what it tells of itself.
struct Team::Fleet {
  explicit Fleet(const MapOptions<SE2>& options) : map(options) {}

  // A filter whose submaps join the map as those of `vehicle`.
  std::unique_ptr<Box> join(std::uint64_t vehicle, const TeamOptions& options) {
    auto box = std::make_unique<Box>(options.filter, vehicle, options.radar);
    box->filter.use_map(std::make_unique<SharedMap>(map, vehicle));
    return box;
  }

  DenseMap<SE2> map;
  std::map<std::uint64_t, std::unique_ptr<Box>> teammates;
};

}  // namespace cairn
