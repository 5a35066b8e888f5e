// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_map.hpp"

#include "core/error.hpp"
#include "map/join/sparse/sparse_merger.hpp"
#include "map/join/sparse/sparse_transaction.hpp"

namespace cairn {

template <class Pose>
SparseMap<Pose>::SparseMap(const MapOptions<Pose>& options)
    : state_(options), index_([this](std::size_t i) { return position(i); }) {}

template <class Pose>
SparseMap<Pose>::SparseMap(const SparseMap& other)
    : state_(other.state_), index_([this](std::size_t i) { return position(i); }) {
  for (std::size_t i = 0; i < size(); ++i) index_.add(i);
}

template <class Pose>
std::unique_ptr<MapTransaction<Pose>> SparseMap<Pose>::begin() {
  this->change();
  return std::make_unique<SparseTransaction<Pose>>(state_, index_);
}

template <class Pose>
void SparseMap<Pose>::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t size = Pose::kDof + Pose::kDim * count;
  std::vector<double> joint(size * size);
  base_joint_covariance(indices, count, joint.data());
  without_pose<Pose>(joint.data(), count, matrix);
}

template <class Pose>
void SparseMap<Pose>::remove(std::uint64_t id) {
  const auto found = state_.ids.find(id);
  if (found == state_.ids.end()) return;
  this->change();
  const auto slot = state_.hide(found);
  index_.remove(state_.visible.size());
  if (slot < state_.visible.size()) index_.moved(slot);
}

template <>
void SparseMap<SE3>::append(const SparseMap& other, const MergePlan& plan, const MergeOptions& options,
                            MergeReport& report) {
  if (state_.error_points.count() + other.state_.error_points.count() > 0)
    throw Error(ErrorCode::argument,
                "map: its submaps share systematic errors, and such sparse maps cannot be merged; use dense joining");
  this->change();
  SparseMerger(state_, index_, other.state_, plan, options).append(report);
}

template class SparseMap<SE2>;
template class SparseMap<SE3>;

}  // namespace cairn
