// SPDX-License-Identifier: BSD-3-Clause
// What the files behind the library's headers share: its handles, and the boundary that every call passes.
#pragma once

#include <cairn/cairn.h>

#include "capi/boundary.hpp"
#include "core/arena.hpp"
#include "slam/filter.hpp"

struct cairn_map {
  const cairn::Landmarks* landmarks;
};

struct cairn_filter {
  cairn_filter(std::size_t arena_bytes, const cairn::FilterOptions& options)
      : arena(arena_bytes), filter(arena, options), map{&filter.landmarks()}, local_map{&filter} {}
  cairn::Arena arena;
  cairn::Filter filter;
  cairn_map map;
  cairn_map local_map;
};

namespace cairn {
namespace capi {

// Finite, symmetric, positive definite (`semi`: semidefinite); `size` on a side, row-major. Beyond 6 it takes a
// workspace of size^2 + cholesky_workspace(size) doubles.
void check_covariance(const double* matrix, std::size_t size, bool semi, const char* name, double* workspace = nullptr);

}  // namespace capi
}  // namespace cairn
