// SPDX-License-Identifier: BSD-3-Clause
// A team's filters with their memory.
#pragma once

#include "core/arena.hpp"
#include "team/shared_map.hpp"
#include "team/team.hpp"

namespace cairn {

struct Team::Box {
  explicit Box(const FilterOptions<SE2>& options) : arena(Filter<SE2>::arena_bytes(options)), filter(arena, options) {}

  Arena arena;
  Filter<SE2> filter;
};

// Submaps of all vehicles in one map: each has a filter of its own, driven by what it tells of itself.
struct Team::Fleet {
  explicit Fleet(const MapOptions<SE2>& options) : map(options) {}

  // A filter whose submaps join the map as those of `vehicle`.
  std::unique_ptr<Box> join(std::uint64_t vehicle, const TeamOptions& options) {
    auto box = std::make_unique<Box>(options.filter);
    box->filter.use_map(std::make_unique<SharedMap>(map, vehicle));
    box->filter.name_vehicle(vehicle);
    box->filter.add(RangeBearing(options.radar));
    return box;
  }

  DenseMap<SE2> map;
  std::map<std::uint64_t, std::unique_ptr<Box>> teammates;
};

}  // namespace cairn
