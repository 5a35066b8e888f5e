// SPDX-License-Identifier: BSD-3-Clause
// The C functions of cairn/map.h for maps that the caller owns: copies and merges.
#include <atomic>

#include "capi/guard.hpp"
#include "geometry/angle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {

std::uint64_t next_filter_number() noexcept {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

namespace {

const cairn_map& read_handle(const cairn_map* map, const char* name) {
  check_pointer(map, name);
  return *map;
}

std::vector<std::uint64_t> origins_of(const cairn_map& map) {
  return map.owned != nullptr ? map.owned->origins : std::vector<std::uint64_t>{map.filter};
}

cairn_merge_options default_options() {
  cairn_merge_options options = {};
  options.struct_size = sizeof options;
  options.association = CAIRN_MERGE_BY_ID;
  options.gate_probability = 0.9999;
  options.joint_gate_probability = 0.9999;
  write_pose(SE3(), &options.T_map_other);
  options.max_tilt = kPi;
  return options;
}

MergeOptions read_merge_options(const cairn_merge_options* given) {
  const cairn_merge_options o =
      given != nullptr ? read_options(given, default_options(), "options") : default_options();
  MergeOptions options;
  if (o.association != CAIRN_MERGE_BY_ID && o.association != CAIRN_MERGE_BY_GEOMETRY)
    throw Error(ErrorCode::argument, "options.association = %d must be CAIRN_MERGE_BY_ID or CAIRN_MERGE_BY_GEOMETRY",
                static_cast<int>(o.association));
  options.by_geometry = o.association == CAIRN_MERGE_BY_GEOMETRY;
  check_probability(o.gate_probability, "options.gate_probability");
  check_probability(o.joint_gate_probability, "options.joint_gate_probability");
  options.gate_probability = o.gate_probability;
  options.joint_gate_probability = o.joint_gate_probability;
  options.max_landmarks = o.max_landmarks;
  check_range(o.max_tilt, 0.0, kPi, "options.max_tilt");
  options.max_tilt = o.max_tilt;
  check_reserved(o.reserved, "options.reserved");
  if (read_bool(o.has_transform, "options.has_transform")) {
    check_covariance(o.covariance, 6, true, "options.covariance");
    options.prior = TransformPrior{read_pose(&o.T_map_other, "options.T_map_other"), Matrix6(o.covariance)};
  }
  return options;
}

cairn_merge_report report_of(const MergeReport& from, const MergeOptions& options) {
  cairn_merge_report out = {};
  out.association = options.by_geometry ? CAIRN_MERGE_BY_GEOMETRY : CAIRN_MERGE_BY_ID;
  out.common = from.common;
  out.added = from.added;
  write_pose(from.T_map_other, &out.T_map_other);
  write_square<6>(from.covariance, out.covariance);
  out.distance = from.distance;
  out.threshold = from.threshold;
  out.rows = from.rows;
  out.broken_id = from.broken_id;
  out.broken_other_id = from.broken_other_id;
  return out;
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_map_kind(const cairn_map* map, int32_t* kind, cairn_error* error) {
  return guard(error, [&] {
    const cairn_map& source = read_handle(map, "map");
    check_pointer(kind, "kind");
    *kind = source.landmarks->kind() == MapKind::sparse ? CAIRN_MAP_SPARSE : CAIRN_MAP_DENSE;
  });
}

cairn_status cairn_map_copy(const cairn_map* map, cairn_map** copy, cairn_error* error) {
  return guard(error, [&] {
    const cairn_map& source = read_handle(map, "map");
    check_pointer(copy, "copy");
    auto owned = std::make_unique<OwnedMap>(*source.landmarks, origins_of(source));
    if (source.owned != nullptr) owned->merged = source.owned->merged;
    const Landmarks* landmarks = owned->landmarks.get();
    *copy = new cairn_map{landmarks, 0, std::move(owned)};
  });
}

void cairn_map_destroy(cairn_map* map) {
  if (map != nullptr && map->owned != nullptr) delete map;
}

cairn_status cairn_merge_options_init(cairn_merge_options* options, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(options, struct_size, default_options(), "options"); });
}

cairn_status cairn_map_merge(cairn_map* map, const cairn_map* other, const cairn_merge_options* options,
                             cairn_merge_report* report, cairn_error* error) {
  return guard(error, [&] {
    const cairn_map& target = read_handle(map, "map");
    const cairn_map& source = read_handle(other, "other");
    const MergeOptions checked = read_merge_options(options);
    MergeReport found;
    cairn_merge_report out = report_of(found, checked);
    if (report != nullptr) write_report(out, report);
    if (map == other) throw Error(ErrorCode::argument, "other is the same map as map; merge two different maps");
    if (target.owned == nullptr)
      throw Error(ErrorCode::state, "map belongs to a filter; merge into a copy of the map (cairn_map_copy)");
    const auto write_found = [&] {
      if (report == nullptr) return;
      out = report_of(found, checked);
      write_report(out, report);
    };
    std::unique_ptr<OwnedMap> merged;
    try {
      merged = std::make_unique<OwnedMap>(*target.owned, *source.landmarks, origins_of(source), checked, found);
    } catch (const Error&) {
      write_found();
      throw;
    }
    write_found();
    map->landmarks = merged->landmarks.get();
    map->owned = std::move(merged);
  });
}

cairn_status cairn_map_merged_ids(const cairn_map* map, cairn_merged_id* merged, size_t capacity, size_t* needed,
                                  cairn_error* error) {
  return guard(error, [&] {
    const cairn_map& source = read_handle(map, "map");
    const std::size_t count = source.owned != nullptr ? source.owned->merged.size() : 0;
    if (!check_room(merged, capacity, count, needed, "merged")) return;
    for (std::size_t i = 0; i < count; ++i) {
      const MergedId& from = source.owned->merged[i];
      merged[i] = {from.other_id, from.id, from.common ? 1 : 0, 0};
    }
  });
}

}  // extern "C"
