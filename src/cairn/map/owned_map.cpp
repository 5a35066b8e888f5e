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

// Common landmarks whose joint covariance a sparse map is asked for: it does not hold it, and the test takes k^3.
constexpr std::size_t kSparseJointAtMost = 300;

template <class Pose>
const SparseMap<Pose>* as_sparse(const Landmarks& map) {
  return dynamic_cast<const SparseMap<Pose>*>(&map);
}

std::unique_ptr<const Landmarks> copy_of(const Landmarks& map) {
  if (const SparseMap<SE3>* sparse = as_sparse<SE3>(map)) return std::make_unique<SparseMap<SE3>>(*sparse);
  if (const SparseMap<SE2>* sparse = as_sparse<SE2>(map)) return std::make_unique<SparseMap<SE2>>(*sparse);
  return std::make_unique<DenseLandmarks>(map);
}

}  // namespace

bool is_sparse(const Landmarks& map) {
  return as_sparse<SE3>(map) != nullptr || as_sparse<SE2>(map) != nullptr;
}

OwnedMap::OwnedMap(const Landmarks& source, std::vector<std::uint64_t> origins_of_source)
    : landmarks(copy_of(source)), origins(std::move(origins_of_source)) {}

OwnedMap::OwnedMap(const OwnedMap& map, const Landmarks& other, const std::vector<std::uint64_t>& origins_of_other,
                   const MergeOptions& options, MergeReport& report) {
  const Landmarks& own = *map.landmarks;
  if (own.planar() || other.planar())
    throw Error(ErrorCode::state, "%s: it is of the plane, and maps of the plane can't be merged",
                own.planar() ? "map" : "other");
  if (is_sparse(own) != is_sparse(other))
    throw Error(ErrorCode::state, "other: it is %s and the map is %s; maps of one kind merge",
                is_sparse(other) ? "sparse" : "dense", is_sparse(own) ? "sparse" : "dense");
  std::set_union(map.origins.begin(), map.origins.end(), origins_of_other.begin(), origins_of_other.end(),
                 std::back_inserter(origins));
  if (origins.size() < map.origins.size() + origins_of_other.size())
    throw Error(ErrorCode::state,
                "other: the map holds landmarks of the same filter already; what both know would count twice");
  const bool sparse = is_sparse(own);
  const MergePlan plan =
      plan_merge(own, other, options, sparse ? kSparseJointAtMost : std::numeric_limits<std::size_t>::max(), report);
  merged = merged_ids(other, plan);
  if (sparse) {
    auto both = std::make_unique<SparseMap<SE3>>(*as_sparse<SE3>(own));
    both->append(*as_sparse<SE3>(other), plan, options, report);
    landmarks = std::move(both);
    return;
  }
  const auto* dense = dynamic_cast<const DenseLandmarks*>(&other);
  const std::unique_ptr<const DenseLandmarks> copy(dense == nullptr ? new DenseLandmarks(other) : nullptr);
  landmarks = std::make_unique<DenseLandmarks>(static_cast<const DenseLandmarks&>(own),
                                               dense != nullptr ? *dense : *copy, plan);
}

}  // namespace cairn
