// SPDX-License-Identifier: BSD-3-Clause
// Submaps of a filter: closing, reports, poses and contents.
#include "capi/filter_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

std::int32_t reason_of(ClosedBy reason) {
  switch (reason) {
    case ClosedBy::none:
      break;
    case ClosedBy::caller:
      return CAIRN_CLOSED_BY_CALLER;
    case ClosedBy::landmarks:
      return CAIRN_CLOSED_BY_LANDMARKS;
    case ClosedBy::distance:
      return CAIRN_CLOSED_BY_DISTANCE;
    case ClosedBy::extent:
      return CAIRN_CLOSED_BY_EXTENT;
    case ClosedBy::sigma:
      return CAIRN_CLOSED_BY_SIGMA;
    case ClosedBy::fix:
      return CAIRN_CLOSED_BY_FIX;
  }
  return CAIRN_CLOSED_BY_NONE;
}

cairn_status closing_status(const ClosingReport& closing) {
  if (!closing.failed) return CAIRN_OK;
  return closing.no_memory ? CAIRN_ERROR_MEMORY : status_of(closing.error);
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_close_submap(cairn_filter* filter, cairn_error* error) {
  return guard(error, [&] { with_filter(filter, [&](auto& f) { f.close_submap(); }); });
}

cairn_status cairn_filter_last_closing(const cairn_filter* filter, cairn_closing_report* report, cairn_error* error) {
  return guard(error, [&] {
    ClosingReport c;
    with_filter(filter, [&](const auto& f) { c = f.closing(); });
    cairn_closing_report out = {};
    out.status = closing_status(c);
    out.submaps = static_cast<std::uint32_t>(c.submaps);
    out.reason = reason_of(c.reason);
    out.landmarks = static_cast<std::uint32_t>(c.landmarks);
    out.landmarks_new = static_cast<std::uint32_t>(c.join.fresh);
    out.landmarks_fused = static_cast<std::uint32_t>(c.join.fused);
    out.landmarks_refused = static_cast<std::uint32_t>(c.join.refused);
    out.relinearised = static_cast<std::uint32_t>(c.join.relinearised);
    out.refactored = static_cast<std::uint32_t>(c.join.refactored);
    out.iterations = static_cast<std::uint32_t>(c.join.iterations);
    out.rows = static_cast<std::uint32_t>(c.join.rows);
    out.distance = c.join.distance;
    out.threshold = c.join.threshold;
    out.seconds = c.seconds;
    out.moved_max = c.join.moved_max;
    out.moved_rms = c.join.moved_rms;
    out.landmarks_ambiguous = static_cast<std::uint32_t>(c.naming.ambiguous);
    out.association_nodes = static_cast<std::uint32_t>(c.naming.nodes);
    out.association_exhausted = c.naming.exhausted ? 1 : 0;
    out.widened_position = c.widened_position;
    out.widened_attitude = c.widened_attitude;
    write_report(out, report);
  });
}

cairn_status cairn_filter_local_pose(const cairn_filter* filter, cairn_pose* pose, double covariance[36],
                                     cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter,
                [&](const auto& f) { write_estimate(f.local_pose(), f.local_pose_covariance(), pose, covariance); });
  });
}

cairn_status cairn_filter_base_pose(const cairn_filter* filter, cairn_pose* pose, double covariance[36],
                                    cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      using Pose = PoseOf<decltype(f)>;
      const typename Pose::Square known = Pose::Square::Zero();
      const GlobalMap<Pose>* map = f.map();
      write_estimate(map != nullptr ? map->base() : Pose(), map != nullptr ? map->base_covariance() : known, pose,
                     covariance);
    });
  });
}

const cairn_map* cairn_filter_local_map(const cairn_filter* filter) {
  return filter != nullptr ? &filter->local_map : nullptr;
}

cairn_status cairn_filter_submap_count(const cairn_filter* filter, size_t* count, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      check_pointer(count, "count");
      *count = f.map() != nullptr ? f.map()->submap_count() : 0;
    });
  });
}

cairn_status cairn_filter_submap(const cairn_filter* filter, size_t index, cairn_pose* base, uint64_t* ids,
                                 size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const auto* map = f.map();
      const std::size_t count = map != nullptr ? map->submap_count() : 0;
      if (index >= count)
        throw Error(ErrorCode::not_found, "index: there is no submap %zu; %zu are closed, counted from 0", index,
                    count);
      const std::vector<std::uint64_t>& source = map->submap_ids(index);
      const bool room = check_room(ids, capacity, source.size(), needed, "ids");
      if (room) std::copy(source.begin(), source.end(), ids);
      if (base != nullptr) write_pose(Embedding<PoseOf<decltype(f)>>::up(map->submap_base(index)), base);
    });
  });
}

}  // extern "C"
