// SPDX-License-Identifier: BSD-3-Clause
// Landmarks and companions come, go and change slots: values in the state, names in the table.
#include "slam/local_map.hpp"

#include "core/error.hpp"

namespace cairn {

template <class Pose>
LocalMap<Pose>::LocalMap(Arena& arena, const FilterOptions<Pose>& options)
    : options_(options),
      systematic_(options.systematic, !options.single_map()),
      state_(arena, options.error,
             {options.slots(), options.max_observations, options.max_companions,
              systematic_.states() + (options.single_map() ? 1 : 2) * options.max_sensor_errors +
                  (options.single_map() ? 0 : kDof)}),
      table_(arena, options.slots(), options.local_landmarks()) {}

template <class Pose>
void LocalMap<Pose>::start(const Pose& pose, const Square& covariance) {
  start(pose, covariance, systematic_.initial_values().data(), systematic_.initial_covariance().data());
}

template <class Pose>
void LocalMap<Pose>::start(const Pose& pose, const Square& covariance, const double* values, const double* errors,
                           const Square* base) {
  systematic_.start(state_, pose, covariance, values, errors, base);
  table_.clear();
  ++starts_;
}

template <class Pose>
void LocalMap<Pose>::exchange(Index a, Index b) {
  if (a == b) return;
  state_.exchange_landmarks(a, b);
  table_.exchange(a, b);
}

template <class Pose>
void LocalMap<Pose>::name_placed(std::uint64_t id, bool in_doubt) {
  const bool deferred = in_doubt || options_.deferred_sightings > 1;
  table_.append(id, deferred);
  if (in_doubt) table_.sightings(table_.size() - 1).elsewhere = 1;
  if (!deferred && table_.deferred() > 0) exchange(table_.size() - 1, table_.first_deferred() - 1);
}

template <class Pose>
void LocalMap<Pose>::count_from_now(Index deferred_slot) {
  exchange(deferred_slot, table_.first_deferred());
  table_.count_first_deferred();
}

template <class Pose>
void LocalMap<Pose>::contest(Index slot, std::uint64_t elsewhere) {
  table_.sightings(slot).elsewhere = elsewhere;
  if (!table_.counts(slot)) return;
  exchange(slot, table_.first_deferred() - 1);
  table_.defer_last_counting();
}

// The landmarks that count must stay contiguous. The last landmark that counts moves to the slot of the removed
// landmark, and the last one of all landmarks moves to the slot that this leaves.
template <class Pose>
void LocalMap<Pose>::forget(Index slot) {
  Index at = slot;
  if (table_.counts(slot)) {
    at = table_.first_deferred() - 1;
    exchange(slot, at);
  }
  state_.remove(at);
  table_.remove(at);
}

template <class Pose>
Index LocalMap<Pose>::slot_at(std::uint64_t id) const {
  const std::optional<Index> slot = table_.find(id);
  if (!slot)
    throw Error(ErrorCode::not_found, "id: there is no landmark %llu here", static_cast<unsigned long long>(id));
  return *slot;
}

template <class Pose>
void LocalMap<Pose>::split(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance) {
  const Index slot = slot_at(id);
  if (table_.find(fresh))
    throw Error(ErrorCode::argument, "fresh: there is a landmark %llu already", static_cast<unsigned long long>(fresh));
  if (table_.landmarks() >= options_.local_landmarks())
    throw Error(ErrorCode::capacity, "fresh: the map holds %td landmarks already", table_.landmarks());
  const bool counts = table_.counts(slot);
  state_.duplicate(slot, covariance);
  name_placed(fresh);
  // The new landmark counts if the landmark from which it is split counts.
  const Index placed = slot_at(fresh);
  if (counts && !table_.counts(placed)) count_from_now(placed);
}

template <class Pose>
bool LocalMap<Pose>::has_vehicle(std::uint64_t id) const {
  return id == table_.vehicle() || table_.find_companion(id).has_value();
}

template <class Pose>
Index LocalMap<Pose>::companion_at(std::uint64_t id) const {
  const std::optional<Index> k = table_.find_companion(id);
  if (!k)
    throw Error(ErrorCode::not_found, "vehicle: the filter knows no vehicle %llu", static_cast<unsigned long long>(id));
  return *k;
}

template <class Pose>
void LocalMap<Pose>::add_vehicle(std::uint64_t id, const Pose& pose, const Square& J_pose, const Square& noise) {
  if (has_vehicle(id))
    throw Error(ErrorCode::argument, "vehicle: number %llu already exists", static_cast<unsigned long long>(id));
  if (table_.companions() == options_.max_companions)
    throw Error(ErrorCode::capacity,
                "vehicle: there is room for %td others, and all are taken; create the filter with more",
                options_.max_companions);
  if (!state_.add_companion(pose, J_pose, noise))
    throw Error(ErrorCode::numerical, "vehicle: its pose or covariance would not be finite; nothing was changed");
  table_.add_companion(id);
  // The landmark that moved behind the last one goes back among those that count, if it counts.
  if (table_.deferred() > 0 && table_.counting() > 0) exchange(table_.size() - 1, table_.first_deferred() - 1);
}

template <class Pose>
void LocalMap<Pose>::remove_vehicle(std::uint64_t id) {
  const Index k = companion_at(id);
  state_.remove_companion(k);
  table_.remove_companion(k);
  // The last landmark moved before the first one: a deferred one goes back among the deferred ones.
  if (table_.deferred() > 0) exchange(table_.companions(), table_.first_deferred());
}

template <class Pose>
void LocalMap<Pose>::look_from(std::uint64_t id) {
  if (id == table_.vehicle()) return;
  const Index k = companion_at(id);
  state_.activate(k);
  table_.look_from(k);
}

template <class Pose>
bool LocalMap<Pose>::find(std::uint64_t id, std::size_t& index) const {
  const std::optional<Index> slot = table_.find(id);
  if (!slot || !table_.counts(*slot)) return false;
  index = static_cast<std::size_t>(*slot - table_.companions());
  return true;
}

template <class Pose>
void LocalMap<Pose>::pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  std::vector<Index> slots;
  for (std::size_t i = 0; i < count; ++i) slots.push_back(slot_of(indices[i]));
  state_.gather_ordinary(slots.data(), static_cast<Index>(count), matrix, static_cast<Index>(kDof + kDim * count));
}

template <class Pose>
void LocalMap<Pose>::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t n = kDof + kDim * count;
  std::vector<double> joint(n * n);
  pose_joint_covariance(indices, count, joint.data());
  without_pose<Pose>(joint.data(), count, matrix);
}

template class LocalMap<SE2>;
template class LocalMap<SE3>;

}  // namespace cairn
