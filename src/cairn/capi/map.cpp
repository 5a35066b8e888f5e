// SPDX-License-Identifier: BSD-3-Clause
// The C functions of cairn/map.h: size, landmarks, queries, joint covariance.
#include <set>

#include "capi/guard.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {

namespace {

[[noreturn]] void throw_unknown_id(const std::uint64_t* ids, std::size_t i) {
  throw Error(ErrorCode::not_found, "ids[%zu]: the map has no landmark %llu", i,
              static_cast<unsigned long long>(ids[i]));
}

}  // namespace

std::vector<std::size_t> read_ids(const Landmarks& map, const std::uint64_t* ids, std::size_t count) {
  if (count > 0) check_pointer(ids, "ids");
  // More ids than landmarks contain an unknown id or a repeated one. This is found before memory is allocated for them.
  const std::size_t most = map.size();
  std::size_t index = 0;
  for (std::size_t i = 0; count > most && i <= most; ++i)
    if (!map.find(ids[i], index)) throw_unknown_id(ids, i);
  if (count > most)
    throw Error(ErrorCode::argument, "ids: %zu ids were given, and the map holds only %zu landmarks", count, most);
  std::vector<std::size_t> indices(count);
  std::set<std::uint64_t> seen;
  for (std::size_t i = 0; i < count; ++i) {
    if (!map.find(ids[i], indices[i])) throw_unknown_id(ids, i);
    if (!seen.insert(ids[i]).second)
      throw Error(ErrorCode::argument, "ids[%zu]: landmark %llu is named twice; name each landmark once", i,
                  static_cast<unsigned long long>(ids[i]));
  }
  return indices;
}

namespace {

const Landmarks& read_map(const cairn_map* map) {
  check_pointer(map, "map");
  return *map->landmarks;
}

cairn_landmark landmark_at(const Landmarks& map, std::size_t index, const Matrix3& covariance) {
  cairn_landmark landmark;
  landmark.id = map.id(index);
  landmark.observations = map.observations(index);
  const Vector3 position = map.position(index);
  std::copy_n(position.data(), 3, landmark.position);
  write_square<3>(covariance, landmark.covariance);
  return landmark;
}

void write_landmarks(const Landmarks& map, const std::vector<std::size_t>& indices, cairn_landmark* landmarks,
                     std::size_t capacity, std::size_t* needed) {
  if (!check_room(landmarks, capacity, indices.size(), needed, "landmarks")) return;
  map.prepare_covariances(indices);
  for (std::size_t i = 0; i < indices.size(); ++i)
    landmarks[i] = landmark_at(map, indices[i], map.covariance(indices[i]));
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_map_size(const cairn_map* map, size_t* count, cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    check_pointer(count, "count");
    *count = source.size();
  });
}

cairn_status cairn_map_landmark(const cairn_map* map, uint64_t id, cairn_landmark* landmark, cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    check_pointer(landmark, "landmark");
    std::size_t index = 0;
    if (!source.find(id, index))
      throw Error(ErrorCode::not_found, "id: the map has no landmark %llu", static_cast<unsigned long long>(id));
    *landmark = landmark_at(source, index, source.covariance_alone(index));
  });
}

cairn_status cairn_map_landmarks(const cairn_map* map, cairn_landmark* landmarks, size_t capacity, size_t* needed,
                                 cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    write_landmarks(source, all_by_id(source), landmarks, capacity, needed);
  });
}

cairn_status cairn_map_within(const cairn_map* map, const double centre[3], double radius, cairn_landmark* landmarks,
                              size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    check_pointer(centre, "centre");
    check_finite(centre, 3, "centre");
    check_not_negative(radius, "radius");
    write_landmarks(source, within(source, Vector3(centre), radius), landmarks, capacity, needed);
  });
}

cairn_status cairn_map_nearest(const cairn_map* map, const double point[3], size_t count, cairn_landmark* landmarks,
                               size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    check_pointer(point, "point");
    check_finite(point, 3, "point");
    write_landmarks(source, nearest(source, Vector3(point), count), landmarks, capacity, needed);
  });
}

cairn_status cairn_map_in_box(const cairn_map* map, const double lower[3], const double upper[3],
                              cairn_landmark* landmarks, size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    check_pointer(lower, "lower");
    check_pointer(upper, "upper");
    check_finite(lower, 3, "lower");
    check_finite(upper, 3, "upper");
    for (int i = 0; i < 3; ++i)
      if (lower[i] > upper[i])
        throw Error(ErrorCode::argument, "lower[%d] = %g must not exceed upper[%d] = %g", i, lower[i], i, upper[i]);
    write_landmarks(source, in_box(source, Vector3(lower), Vector3(upper)), landmarks, capacity, needed);
  });
}

cairn_status cairn_map_joint_covariance(const cairn_map* map, const uint64_t* ids, size_t count, double* matrix,
                                        size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const Landmarks& source = read_map(map);
    const std::vector<std::size_t> indices = read_ids(source, ids, count);
    if (check_room(matrix, capacity, 9 * count * count, needed, "matrix"))
      source.joint_covariance(indices.data(), count, matrix);
  });
}

}  // extern "C"
