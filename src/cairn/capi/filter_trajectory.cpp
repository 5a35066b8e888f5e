// SPDX-License-Identifier: BSD-3-Clause
// The poses that a filter keeps.
#include <cairn/trajectory.h>

#include "capi/filter_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

// The trajectory of a filter that keeps poses.
template <class AnyFilter>
const auto& read_trajectory(const AnyFilter& filter) {
  if (filter.trajectory().capacity() == 0)
    throw Error(ErrorCode::state,
                "filter: it keeps no poses, because options.trajectory_poses is 0; create it with the number of poses "
                "to keep");
  return filter.trajectory();
}

unsigned long long printable(std::uint64_t number) {
  return number;
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_keep_pose(cairn_filter* filter, uint64_t* number, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      const auto& trajectory = read_trajectory(f);
      f.keep_pose();
      if (number != nullptr) *number = trajectory.end() - 1;
    });
  });
}

cairn_status cairn_filter_trajectory_range(const cairn_filter* filter, uint64_t* first, uint64_t* end,
                                           cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const auto& trajectory = read_trajectory(f);
      if (first != nullptr) *first = trajectory.first();
      if (end != nullptr) *end = trajectory.end();
    });
  });
}

cairn_status cairn_filter_trajectory(const cairn_filter* filter, uint64_t first, cairn_pose* poses, size_t capacity,
                                     size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const auto& trajectory = read_trajectory(f);
      if (first > trajectory.end())
        throw Error(ErrorCode::not_found, "first is %llu, and the trajectory has %llu poses", printable(first),
                    printable(trajectory.end()));
      if (first < trajectory.first())
        throw Error(ErrorCode::capacity,
                    "first: pose %llu was dropped, because options.trajectory_poses is %llu; the oldest pose that is "
                    "kept is %llu",
                    printable(first), printable(trajectory.capacity()), printable(trajectory.first()));
      const auto count = static_cast<std::size_t>(trajectory.end() - first);
      if (!check_room(poses, capacity, count, needed, "poses")) return;
      const auto open = f.open_submap();
      for (std::size_t i = 0; i < count; ++i)
        write_pose(Embedding<PoseOf<decltype(f)>>::up(f.trajectory_pose(first + i, open)), poses + i);
    });
  });
}

}  // extern "C"
