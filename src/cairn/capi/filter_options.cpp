// SPDX-License-Identifier: BSD-3-Clause
// The options of a filter: their defaults, their checks, and their conversion to the options of the core.
#include "capi/convert.hpp"
#include "capi/filter_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

cairn_filter_options default_options() {
  const FilterOptions<SE3> d;
  cairn_filter_options options = {};
  options.struct_size = sizeof options;
  options.error = CAIRN_ERROR_INVARIANT;
  options.max_landmarks = static_cast<std::uint32_t>(d.max_landmarks);
  options.max_observations = static_cast<std::uint32_t>(d.max_observations);
  options.max_sensors = static_cast<std::uint32_t>(d.max_sensors);
  options.iterations = static_cast<std::uint32_t>(d.iterations);
  options.iteration_tolerance = d.iteration_tolerance;
  options.gate_probability = d.gate_probability;
  options.batch_gate_probability = d.batch_gate_probability;
  write_pose(d.initial_pose, &options.initial_pose);
  options.submap_landmarks = 0;
  options.join = CAIRN_JOIN_AUTO;
  options.association = CAIRN_ASSOCIATION_KNOWN;
  options.vehicle = CAIRN_VEHICLE_SPATIAL;
  options.association_distance = CAIRN_DISTANCE_MAHALANOBIS;
  options.deferred_sightings = static_cast<std::uint32_t>(d.deferred_sightings);
  options.deferred_frames = static_cast<std::uint32_t>(d.deferred_frames);
  options.missed_frames = static_cast<std::uint32_t>(d.missed_frames);
  options.association_nodes = static_cast<std::uint32_t>(d.association_nodes);
  options.new_probability = d.new_probability;
  options.error_persistence = d.error_persistence;
  return options;
}

void check_filter_options(const cairn_filter_options& o) {
  if (o.vehicle != CAIRN_VEHICLE_SPATIAL && o.vehicle != CAIRN_VEHICLE_PLANAR)
    throw Error(ErrorCode::argument, "options.vehicle is %d, neither CAIRN_VEHICLE_SPATIAL nor CAIRN_VEHICLE_PLANAR",
                o.vehicle);
  if (o.error != CAIRN_ERROR_INVARIANT && o.error != CAIRN_ERROR_STANDARD)
    throw Error(ErrorCode::argument, "options.error is %d, neither CAIRN_ERROR_INVARIANT nor CAIRN_ERROR_STANDARD",
                o.error);
  if (o.join != CAIRN_JOIN_AUTO && o.join != CAIRN_JOIN_DENSE && o.join != CAIRN_JOIN_SPARSE)
    throw Error(ErrorCode::argument, "options.join is %d, none of CAIRN_JOIN_AUTO, CAIRN_JOIN_DENSE, CAIRN_JOIN_SPARSE",
                o.join);
  const bool sparse = o.submap_landmarks > 0 && o.join != CAIRN_JOIN_DENSE;
  check_range(o.max_landmarks, 1, sparse ? 10000000 : 30000, "options.max_landmarks");
  check_range(o.submap_landmarks, 0, 4096, "options.submap_landmarks");
  check_not_negative(o.submap_distance, "options.submap_distance");
  check_not_negative(o.submap_extent, "options.submap_extent");
  check_not_negative(o.submap_sigma, "options.submap_sigma");
  check_range(o.max_observations, 1, 4096, "options.max_observations");
  check_range(o.max_sensors, 1, 256, "options.max_sensors");
  check_range(o.iterations, 1, 50, "options.iterations");
  check_positive(o.iteration_tolerance, "options.iteration_tolerance");
  check_probability(o.gate_probability, "options.gate_probability");
  check_probability(o.batch_gate_probability, "options.batch_gate_probability");
  if (o.association != CAIRN_ASSOCIATION_KNOWN && o.association != CAIRN_ASSOCIATION_NEAREST &&
      o.association != CAIRN_ASSOCIATION_JOINT)
    throw Error(ErrorCode::argument,
                "options.association is %d, none of CAIRN_ASSOCIATION_KNOWN, CAIRN_ASSOCIATION_NEAREST, "
                "CAIRN_ASSOCIATION_JOINT",
                o.association);
  check_range(o.association_nodes, 1, 1000000, "options.association_nodes");
  if (o.association_distance != CAIRN_DISTANCE_MAHALANOBIS && o.association_distance != CAIRN_DISTANCE_LIKELIHOOD)
    throw Error(ErrorCode::argument,
                "options.association_distance is %d, neither CAIRN_DISTANCE_MAHALANOBIS nor CAIRN_DISTANCE_LIKELIHOOD",
                o.association_distance);
  check_range(o.deferred_sightings, 1, 1000, "options.deferred_sightings");
  check_range(o.deferred_frames, 1, 1000000, "options.deferred_frames");
  check_range(o.missed_frames, 0, 1000000, "options.missed_frames");
  if (!(o.error_persistence >= 1.0 && o.error_persistence <= 1e6))
    throw Error(ErrorCode::argument, "options.error_persistence is %g, and must be from 1 to 1000000",
                o.error_persistence);
  check_probability(o.new_probability, "options.new_probability");
  if (o.new_probability == 1.0)
    throw Error(ErrorCode::argument, "options.new_probability is 1: no observation would ever place a landmark");
}

template <class Pose>
FilterOptions<Pose> options_of(const cairn_filter_options& o) {
  FilterOptions<Pose> options;
  options.error = o.error == CAIRN_ERROR_STANDARD ? ErrorKind::standard : ErrorKind::invariant;
  options.max_landmarks = o.max_landmarks;
  options.max_observations = o.max_observations;
  options.max_sensors = o.max_sensors;
  options.iterations = static_cast<int>(o.iterations);
  options.iteration_tolerance = o.iteration_tolerance;
  options.gate_probability = o.gate_probability;
  options.batch_gate_probability = o.batch_gate_probability;
  options.initial_pose = read_pose_of<Pose>(&o.initial_pose, "options.initial_pose");
  options.initial_covariance = read_pose_covariance<Pose>(o.initial_covariance, "options.initial_covariance");
  options.submap_landmarks = o.submap_landmarks;
  options.join = o.join == CAIRN_JOIN_DENSE    ? JoinKind::dense
                 : o.join == CAIRN_JOIN_SPARSE ? JoinKind::sparse
                                               : JoinKind::automatic;
  options.submap_distance = o.submap_distance;
  options.submap_extent = o.submap_extent;
  options.submap_sigma = o.submap_sigma;
  options.association = o.association == CAIRN_ASSOCIATION_NEAREST ? AssociationKind::nearest
                        : o.association == CAIRN_ASSOCIATION_JOINT ? AssociationKind::joint
                                                                   : AssociationKind::known;
  options.association_nodes = o.association_nodes;
  options.new_probability = o.new_probability;
  options.by_likelihood =
      options.association == AssociationKind::nearest && o.association_distance == CAIRN_DISTANCE_LIKELIHOOD;
  options.deferred_sightings = o.deferred_sightings;
  options.deferred_frames = o.deferred_frames;
  options.missed_frames = o.missed_frames;
  options.error_persistence = o.error_persistence;
  return options;
}

}  // namespace

std::variant<FilterOptions<SE3>, FilterOptions<SE2>> read_filter_options(const cairn_filter_options* user) {
  const cairn_filter_options o = read_options(user, default_options(), "options");
  check_filter_options(o);
  if (o.vehicle == CAIRN_VEHICLE_PLANAR) return options_of<SE2>(o);
  return options_of<SE3>(o);
}

}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_options_init(cairn_filter_options* options, size_t struct_size) {
  return guard([&] { init_options(options, struct_size, default_options(), "options"); });
}

}  // extern "C"
