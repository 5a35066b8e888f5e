// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/dense/dense_map.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "map/join/dense/dense_transaction.hpp"

namespace cairn {
namespace {

template <class Pose>
StateCapacity<Pose> capacity_of(const MapOptions<Pose>& options) {
  return {static_cast<Index>(options.max_landmarks + options.max_companions),
          static_cast<Index>(std::min(options.submap_capacity, options.max_landmarks)),
          static_cast<Index>(options.max_companions), options.errors.count()};
}

}  // namespace

template <class Pose>
DenseMap<Pose>::DenseMap(const MapOptions<Pose>& options) : DenseMap(options, required_bytes(options)) {}

template <class Pose>
DenseMap<Pose>::DenseMap(const MapOptions<Pose>& options, std::size_t bytes)
    : options_(options),
      arena_(bytes),
      state_(arena_, options.error, capacity_of(options)),
      indices_(arena_, options.max_landmarks),
      ids_(arena_.take<std::uint64_t>(options.max_landmarks)),
      counts_(arena_.take<std::uint64_t>(options.max_landmarks)) {
  const auto errors = static_cast<std::size_t>(options.errors.count());
  std::vector<double> values(errors, 0.0), covariance(errors * errors, 0.0);
  for (std::size_t i = 0; i < errors; ++i)
    covariance[i * (errors + 1)] = options.errors.sigma[i] * options.errors.sigma[i];
  state_.start(options.initial_pose, options.initial_covariance,
               {options.errors.count(), 0, values.data(), values.data(), covariance.data()});
}

template <class Pose>
std::size_t DenseMap<Pose>::required_bytes(const MapOptions<Pose>& options) {
  Arena measure;
  const State<Pose> state(measure, options.error, capacity_of(options));
  const IdTable slots(measure, options.max_landmarks);
  measure.take<std::uint64_t>(options.max_landmarks);
  measure.take<std::uint64_t>(options.max_landmarks);
  return measure.used();
}

template <class Pose>
std::unique_ptr<MapTransaction<Pose>> DenseMap<Pose>::begin() {
  this->change();
  return std::make_unique<DenseTransaction<Pose>>(*this);
}

template <class Pose>
void DenseMap<Pose>::append(std::uint64_t id, std::uint64_t count, std::size_t index) {
  ids_[index] = id;
  counts_[index] = count;
  indices_.set(id, static_cast<std::int32_t>(index));
}

template <class Pose>
void DenseMap<Pose>::remove(std::uint64_t id) {
  this->change();
  const std::int32_t index = indices_.find(id);
  if (index != IdTable::kAbsent) remove_at(static_cast<std::size_t>(index));
}

template <class Pose>
void DenseMap<Pose>::remove_at(std::size_t index) {
  const std::size_t last = size() - 1;
  state_.remove(slot_of(index));
  if (indices_.find(ids_[index]) == static_cast<std::int32_t>(index)) indices_.erase(ids_[index]);
  if (index != last) append(ids_[last], counts_[last], index);
}

template <class Pose>
bool DenseMap<Pose>::find(std::uint64_t id, std::size_t& index) const {
  const std::int32_t found = indices_.find(id);
  if (found == IdTable::kAbsent) return false;
  index = static_cast<std::size_t>(found);
  return true;
}

template <class Pose>
Index DenseMap<Pose>::companion(std::uint64_t id) const {
  const auto found = std::find(companions_.begin(), companions_.end(), id);
  if (found == companions_.end())
    throw Error(ErrorCode::not_found, "vehicle: the map knows no vehicle %llu", static_cast<unsigned long long>(id));
  return found - companions_.begin();
}

template <class Pose>
void DenseMap<Pose>::add_vehicle(std::uint64_t id, const Pose& pose, const typename Pose::Square& covariance) {
  if (id == vehicle_ || std::find(companions_.begin(), companions_.end(), id) != companions_.end())
    throw Error(ErrorCode::argument, "vehicle: the map has the number %llu already",
                static_cast<unsigned long long>(id));
  if (!closed_.empty())
    throw Error(ErrorCode::state,
                "vehicle: the map already holds %zu submaps; add all vehicles before the first submap is closed",
                closed_.size());
  if (companions_.size() == options_.max_companions)
    throw Error(ErrorCode::capacity, "vehicle: the map has room for %zu other vehicles, and all are taken",
                options_.max_companions);
  companions_.reserve(companions_.size() + 1);
  if (!state_.add_companion(pose, Pose::Square::Zero(), covariance))
    throw Error(ErrorCode::numerical, "vehicle: its pose or covariance is not finite; nothing was changed");
  companions_.push_back(id);
}

template <class Pose>
void DenseMap<Pose>::look_from(std::uint64_t id) {
  if (id == vehicle_) return;
  const Index k = companion(id);
  this->change();
  state_.activate(k);
  std::swap(companions_[static_cast<std::size_t>(k)], vehicle_);
}

template <class Pose>
void DenseMap<Pose>::base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  std::vector<Index> slots;
  for (std::size_t i = 0; i < count; ++i) slots.push_back(slot_of(indices[i]));
  state_.gather_ordinary(slots.data(), static_cast<Index>(count), matrix, static_cast<Index>(kDof + kDim * count));
}

template <class Pose>
Eigen::VectorXd DenseMap<Pose>::errors() const {
  Eigen::VectorXd errors(state_.systematic());
  for (Index i = 0; i < errors.size(); ++i) errors(i) = state_.systematic(i);
  return errors;
}

template <class Pose>
Eigen::MatrixXd DenseMap<Pose>::joint_with_errors(const std::size_t* indices, std::size_t count) const {
  std::vector<Index> slots;
  for (std::size_t i = 0; i < count; ++i) slots.push_back(slot_of(indices[i]));
  const Index n = kDof + state_.systematic() + static_cast<Index>(kDim * count);
  Eigen::MatrixXd joint(n, n);
  state_.gather_systematic(slots.data(), static_cast<Index>(count), joint.data(), n, true);
  return joint;
}

template <class Pose>
void DenseMap<Pose>::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t size = kDof + kDim * count;
  std::vector<double> joint(size * size);
  base_joint_covariance(indices, count, joint.data());
  without_pose<Pose>(joint.data(), count, matrix);
}

template class DenseMap<SE2>;
template class DenseMap<SE3>;

}  // namespace cairn
