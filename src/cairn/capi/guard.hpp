// SPDX-License-Identifier: BSD-3-Clause
// The handles of maps and filters, which the files of the C boundary share.
#pragma once

#include <cairn/cairn.h>

#include <utility>
#include <variant>
#include <vector>

#include "capi/boundary.hpp"
#include "core/arena.hpp"
#include "map/owned_map.hpp"
#include "slam/filter.hpp"

namespace cairn {
namespace capi {

std::uint64_t next_filter_number() noexcept;  // 1, 2, 3, ...

// A pointer that the caller gave to a handle, for his callbacks. It goes back by `release`, once.
class Payload {
 public:
  Payload() = default;
  Payload(void* user, cairn_release_fn release) : user_(user), release_(release) {}
  Payload(Payload&& other) noexcept : user_(other.user_), release_(std::exchange(other.release_, nullptr)) {}
  Payload& operator=(Payload&& other) noexcept {
    Payload(std::move(other)).swap(*this);
    return *this;
  }
  ~Payload() {
    if (release_ != nullptr) release_(user_);
  }

 private:
  void swap(Payload& other) noexcept {
    std::swap(user_, other.user_);
    std::swap(release_, other.release_);
  }
  void* user_ = nullptr;
  cairn_release_fn release_ = nullptr;
};

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
  explicit cairn_filter(const cairn::FilterOptions<Pose>& options)
      : arena(cairn::Filter<Pose>::arena_bytes(options) + buffer_bytes(options.max_observations)),
        filter(std::in_place_type<cairn::Filter<Pose>>, arena, options),
        observations(arena.take<cairn::Observation>(static_cast<std::size_t>(options.max_observations))),
        number(cairn::capi::next_filter_number()),
        map{&std::get<cairn::Filter<Pose>>(filter).landmarks(), number, nullptr},
        local_map{&std::get<cairn::Filter<Pose>>(filter).local_landmarks(), number, nullptr} {}
  static std::size_t buffer_bytes(cairn::Index max_observations) {  // of `observations`
    cairn::Arena measure;
    measure.take<cairn::Observation>(static_cast<std::size_t>(max_observations));
    return measure.used();
  }

  // The filter uses them, and is destroyed before them.
  cairn::capi::Payload log;
  std::vector<cairn::capi::Payload> custom;

  cairn::Arena arena;
  std::variant<cairn::Filter<cairn::SE3>, cairn::Filter<cairn::SE2>> filter;
  cairn::Observation* observations;  // buffer for the observations of one frame: max_observations
  std::uint64_t number;              // identifies this filter in maps, so that no information is merged twice
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
