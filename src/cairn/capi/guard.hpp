// SPDX-License-Identifier: BSD-3-Clause
// The handles of maps and filters, which the files of the C boundary share.
#pragma once

#include <cairn/cairn.h>

#include <variant>

#include "capi/boundary.hpp"
#include "core/arena.hpp"
#include "map/owned_map.hpp"
#include "slam/filter.hpp"

namespace cairn {
namespace capi {

std::uint64_t next_filter_number() noexcept;  // 1, 2, 3, ...

}  // namespace capi
}  // namespace cairn

struct cairn_map {
  const cairn::Landmarks* landmarks;
  std::uint64_t filter = 0;                // number of the filter that owns the map
  std::unique_ptr<cairn::OwnedMap> owned;  // null if a filter owns the map
};

// The filter of a vehicle in space or in the plane.
struct cairn_filter {
  template <class Pose>
  cairn_filter(std::size_t arena_bytes, const cairn::FilterOptions<Pose>& options)
      : arena(arena_bytes),
        filter(std::in_place_type<cairn::Filter<Pose>>, arena, options),
        number(cairn::capi::next_filter_number()),
        map{&std::get<cairn::Filter<Pose>>(filter).landmarks(), number, nullptr},
        local_map{&std::get<cairn::Filter<Pose>>(filter), number, nullptr} {}
  cairn::Arena arena;
  std::variant<cairn::Filter<cairn::SE3>, cairn::Filter<cairn::SE2>> filter;
  std::uint64_t number;  // identifies this filter in maps, so that no information is merged twice
  cairn_map map;
  cairn_map local_map;
};

namespace cairn {
namespace capi {

// Checks that a row-major matrix of size x size is finite, symmetric and positive definite (`semi`: semidefinite). For
// a size above 6 it needs a workspace of size^2 + cholesky_workspace(size) doubles.
void check_covariance(const double* matrix, std::size_t size, bool semi, const char* name, double* workspace = nullptr);

}  // namespace capi
}  // namespace cairn
