// SPDX-License-Identifier: BSD-3-Clause
#include "map/owned_map.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/error.hpp"
#include "map/dense_landmarks.hpp"
#include "map/join/sparse/sparse_map.hpp"

namespace cairn {
namespace {

// The largest number of common landmarks whose joint covariance a sparse map computes: the map does not store this
// covariance, and the test costs O(k^3).
constexpr std::size_t kSparseJointAtMost = 300;

bool sparse(const Landmarks& map) {
  return map.kind() == MapKind::sparse;
}

// A sparse map of space: the only sparse Landmarks that are not planar.
const SparseMap<SE3>& as_sparse(const Landmarks& map) {
  return static_cast<const SparseMap<SE3>&>(map);
}

}  // namespace

OwnedMap::OwnedMap(const Landmarks& source, std::vector<std::uint64_t> origins_of_source)
    : landmarks(source.copy()), origins(std::move(origins_of_source)) {}

OwnedMap::OwnedMap(const OwnedMap& map, const Landmarks& other, const std::vector<std::uint64_t>& origins_of_other,
                   const MergeOptions& options, MergeReport& report) {
  const Landmarks& own = *map.landmarks;
  if (own.planar() || other.planar())
    throw Error(ErrorCode::state, "%s: it is of the plane, and maps of the plane can't be merged",
                own.planar() ? "map" : "other");
  if (sparse(own) != sparse(other))
    throw Error(ErrorCode::state, "other: it is %s and the map is %s; maps of one kind merge",
                sparse(other) ? "sparse" : "dense", sparse(own) ? "sparse" : "dense");
  std::set_union(map.origins.begin(), map.origins.end(), origins_of_other.begin(), origins_of_other.end(),
                 std::back_inserter(origins));
  if (origins.size() < map.origins.size() + origins_of_other.size())
    throw Error(ErrorCode::state,
                "other: the map already holds landmarks of the same filter; shared information would count twice");
  const MergePlan plan = plan_merge(own, other, options,
                                    sparse(own) ? kSparseJointAtMost : std::numeric_limits<std::size_t>::max(), report);
  merged = merged_ids(other, plan);
  if (sparse(own)) {
    auto both = std::make_unique<SparseMap<SE3>>(as_sparse(own));
    both->append(as_sparse(other), plan, options, report);
    landmarks = std::move(both);
    return;
  }
  // copy() turns every dense map into DenseLandmarks.
  landmarks = std::make_unique<DenseLandmarks>(static_cast<const DenseLandmarks&>(own), DenseLandmarks(other), plan);
}

}  // namespace cairn
