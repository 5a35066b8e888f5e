// SPDX-License-Identifier: BSD-3-Clause
// Other vehicles beside the filter's own. Included by filter.cpp alone.
#pragma once

#include "core/error.hpp"
#include "slam/filter.hpp"

namespace cairn {

template <class Pose>
Index Filter<Pose>::companion(std::uint64_t id) const {
  for (Index k = 0; k < ekf_.companions(); ++k)
    if (ids_[k] == id) return k;
  return -1;
}

template <class Pose>
Index Filter<Pose>::companion_at(std::uint64_t id) const {
  const Index k = companion(id);
  if (k < 0)
    throw Error(ErrorCode::not_found, "vehicle: the filter knows no vehicle %llu", static_cast<unsigned long long>(id));
  return k;
}

template <class Pose>
void Filter<Pose>::add_vehicle(std::uint64_t id, const Pose& pose, const Square& J_pose, const Square& noise) {
  if (map_ != nullptr) throw Error(ErrorCode::state, "vehicle: a filter with submaps holds no other vehicles");
  if (has_vehicle(id))
    throw Error(ErrorCode::argument, "vehicle: there is one of number %llu already",
                static_cast<unsigned long long>(id));
  const Index k = ekf_.companions();
  if (k == options_.max_companions)
    throw Error(ErrorCode::capacity, "vehicle: there is room for %td beside the own", options_.max_companions);
  const Index last = ekf_.size();
  if (!ekf_.add_companion(pose, J_pose, noise))
    throw Error(ErrorCode::numerical, "vehicle: its pose or covariance would not be finite; nothing was changed");
  if (last > k) {
    move_slot(k, last);
    // Among those that count, if it does.
    if (deferred_ > 0 && counting() > 0) exchange_slots(last, first_deferred() - 1);
  }
  ids_[k] = id;
  counts_[k] = 0;
}

template <class Pose>
void Filter<Pose>::remove_vehicle(std::uint64_t id) {
  const Index k = companion_at(id), last = ekf_.companions() - 1, end = ekf_.size() - 1;
  ekf_.remove_companion(k);
  ids_[k] = ids_[last];
  counts_[k] = counts_[last];
  if (end > last) {
    move_slot(end, last);
    if (deferred_ > 0) exchange_slots(last, first_deferred());
  }
}

template <class Pose>
void Filter<Pose>::look_from(std::uint64_t id) {
  if (id == vehicle_) return;
  const Index k = companion_at(id);
  ekf_.activate(k);
  std::swap(ids_[k], vehicle_);
}

template <class Pose>
Pose Filter<Pose>::vehicle_pose(std::uint64_t id) const {
  return id == vehicle_ ? pose() : ekf_.companion(companion_at(id));
}

template <class Pose>
typename Filter<Pose>::Square Filter<Pose>::vehicle_covariance(std::uint64_t id) const {
  return id == vehicle_ ? pose_covariance() : ekf_.companion_covariance(companion_at(id));
}

// Sightings of other vehicles: their positions are seen as landmarks are, and like those they take part in gates and
// batch.
template <class Pose>
void Filter<Pose>::sort_companions(const Sensor<Pose>& sensor, Index first, Index count) {
  for (Index i = first; i < first + count; ++i) {
    const Index k = companion_at(observations_[i].id);
    for (Index other = first; other < i; ++other)
      if (observations_[other].id == observations_[i].id)
        throw Error(ErrorCode::argument, "observations: vehicle %llu comes twice in one frame",
                    static_cast<unsigned long long>(observations_[i].id));
    Match& match = next_matches_[i];
    match.landmark = observations_[i].id;
    Prediction<Pose> prediction;
    if (sensor.predict(ekf_.pose(), ekf_.landmark(k), Mount::Zero(), prediction))
      add_candidate(sensor, i, k, prediction);
    else
      match.reason = Reason::no_image;
  }
}

}  // namespace cairn
