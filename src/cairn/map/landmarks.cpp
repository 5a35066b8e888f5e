// SPDX-License-Identifier: BSD-3-Clause
#include "map/landmarks.hpp"

#include <algorithm>
#include <limits>

#include "geometry/embedding.hpp"
#include "map/dense_landmarks.hpp"
#include "map/spatial_index.hpp"

namespace cairn {
namespace {

struct Entry {
  double distance;
  std::uint64_t id;
  std::size_t index;
  bool operator<(const Entry& other) const {
    return distance != other.distance ? distance < other.distance : id < other.id;
  }
};

std::vector<Entry> entries_within(const Landmarks& map, const Vector3& centre, double radius) {
  std::vector<Entry> entries;
  if (const SpatialIndex* index = map.spatial_index()) {
    std::vector<SpatialIndex::Hit> hits;
    index->within(centre, radius, hits);
    for (const SpatialIndex::Hit& hit : hits) entries.push_back({hit.distance, map.id(hit.index), hit.index});
    return entries;
  }
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double distance = (map.position(i) - centre).norm();
    if (distance <= radius) entries.push_back({distance, map.id(i), i});
  }
  return entries;
}

std::vector<Entry> entries_nearest(const Landmarks& map, const Vector3& point, std::size_t count) {
  if (const SpatialIndex* index = map.spatial_index()) {
    std::vector<SpatialIndex::Hit> hits;
    index->nearest(point, count, hits);
    std::vector<Entry> entries;
    for (const SpatialIndex::Hit& hit : hits) entries.push_back({hit.distance, map.id(hit.index), hit.index});
    return entries;
  }
  return entries_within(map, point, std::numeric_limits<double>::infinity());
}

std::vector<std::size_t> indices_of(const std::vector<Entry>& entries) {
  std::vector<std::size_t> indices;
  indices.reserve(entries.size());
  for (const Entry& entry : entries) indices.push_back(entry.index);
  return indices;
}

}  // namespace

std::unique_ptr<Landmarks> Landmarks::copy() const {
  return std::make_unique<DenseLandmarks>(*this);
}

namespace {

// The first `first` spatial states are left out.
template <class Pose>
void to_space(const double* joint, std::size_t count, std::size_t first, double* matrix) {
  constexpr std::size_t kDof = Pose::kDof, kDim = Pose::kDim;
  const std::size_t n = kDof + kDim * count, size = 6 + 3 * count - first;
  const auto state = [&](std::size_t i) {
    return i < kDof ? static_cast<std::size_t>(Embedding<Pose>::axis(static_cast<int>(i)))
                    : 6 + 3 * ((i - kDof) / kDim) + (i - kDof) % kDim;
  };
  std::fill_n(matrix, size * size, 0.0);
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t r = 0; r < n; ++r)
      if (state(c) >= first && state(r) >= first)
        matrix[(state(c) - first) * size + state(r) - first] = joint[c * n + r];
}

}  // namespace

template <class Pose>
void with_pose(const double* joint, std::size_t count, double* matrix) {
  to_space<Pose>(joint, count, 0, matrix);
}

template <class Pose>
void without_pose(const double* joint, std::size_t count, double* matrix) {
  to_space<Pose>(joint, count, 6, matrix);
}

template void with_pose<SE2>(const double*, std::size_t, double*);
template void with_pose<SE3>(const double*, std::size_t, double*);
template void without_pose<SE2>(const double*, std::size_t, double*);
template void without_pose<SE3>(const double*, std::size_t, double*);

std::vector<std::size_t> all_by_id(const Landmarks& map) {  // positions play no role
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < map.size(); ++i) entries.push_back({0.0, map.id(i), i});
  std::sort(entries.begin(), entries.end());
  return indices_of(entries);
}

std::vector<std::size_t> within(const Landmarks& map, const Vector3& centre, double radius) {
  std::vector<Entry> entries = entries_within(map, centre, radius);
  std::sort(entries.begin(), entries.end());
  return indices_of(entries);
}

std::vector<std::size_t> nearest(const Landmarks& map, const Vector3& point, std::size_t count) {
  std::vector<Entry> entries = entries_nearest(map, point, count);
  count = std::min(count, entries.size());
  std::partial_sort(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(count), entries.end());
  entries.resize(count);
  return indices_of(entries);
}

std::vector<std::size_t> in_box(const Landmarks& map, const Vector3& lower, const Vector3& upper) {
  std::vector<Entry> entries;
  if (const SpatialIndex* index = map.spatial_index()) {
    std::vector<std::size_t> hits;
    index->in_box(lower, upper, hits);
    for (const std::size_t i : hits) entries.push_back({0.0, map.id(i), i});
    std::sort(entries.begin(), entries.end());
    return indices_of(entries);
  }
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Vector3 p = map.position(i);
    if ((p.array() >= lower.array()).all() && (p.array() <= upper.array()).all())
      entries.push_back({0.0, map.id(i), i});
  }
  std::sort(entries.begin(), entries.end());
  return indices_of(entries);
}

}  // namespace cairn
