// SPDX-License-Identifier: BSD-3-Clause
// Creation, sensors, motion and queries of one vehicle's filter.
#include "slam/filter.hpp"

#include <cstdarg>
#include <cstdio>
#include <new>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "slam/filter_absolute.hpp"
#include "slam/filter_association.hpp"
#include "slam/filter_companions.hpp"
#include "slam/filter_landmarks.hpp"
#include "slam/filter_submaps.hpp"
#include "slam/filter_update.hpp"

namespace cairn {

template <class Pose>
Filter<Pose>::Filter(Arena& arena, const FilterOptions<Pose>& options)
    : options_(options),
      ekf_(arena, options.error, {options.slots(), options.max_observations, options.max_companions}),
      slots_(arena, static_cast<std::size_t>(options.local_landmarks())),
      frame_ids_(arena, static_cast<std::size_t>(options.max_observations)),
      ids_(arena.take<std::uint64_t>(options.slots())),
      counts_(arena.take<std::uint64_t>(options.slots())),
      sightings_(arena.take<Sightings>(options.slots())),
      sensor_storage_(arena.take<unsigned char>(options.max_sensors * sizeof(AnySensorSlot))),
      views_(arena.take<View>(options.max_sensors)),
      observations_(arena.take<Observation>(options.max_observations)),
      matches_(arena.take<Match>(options.max_observations)),
      next_matches_(arena.take<Match>(options.max_observations)),
      candidates_(arena.take<Candidate>(options.max_observations)),
      window_slots_(arena.take<Index>(options.max_observations)),
      kept_(arena.take<Index>(options.max_observations)),
      new_ones_(arena.take<Index>(options.max_observations)),
      unknowns_(arena, options),
      residual_(arena.take<double>(kDim * options.max_observations + kDof)),
      thresholds_(arena.take<double>(kDim * options.max_observations + kDof + 1)) {
  static_assert(alignof(AnySensorSlot) <= Arena::kAlignment, "the arena aligns to a cache line");
  if (arena.measuring()) return;
  for (int rows = 1; rows <= 6; ++rows) gate_thresholds_[rows] = chi_square_quantile(rows, options.gate_probability);
  for (int rows = 1; rows <= 3; ++rows) new_thresholds_[rows] = chi_square_quantile(rows, options.new_probability);
  if (options.single_map()) {
    ekf_.start(options.initial_pose, options.initial_covariance);
  } else {
    ekf_.start(Pose(), Square::Zero());
    map_ = make_map(options);
  }
}

template <class Pose>
Filter<Pose>::~Filter() {
  for (int i = 0; i < sensor_count_; ++i) sensor_slot(i).~AnySensorSlot();
}

template <class Pose>
std::size_t Filter<Pose>::arena_bytes(const FilterOptions<Pose>& options) {
  Arena measure;
  const Filter unused(measure, options);
  return measure.used();
}

template <class Pose>
int Filter<Pose>::add_sensor(const AnySensorSlot& sensor) {
  if (sensor_count_ == options_.max_sensors)
    throw Error(ErrorCode::capacity, "sensor: all %d are taken; create the filter with a larger max_sensors",
                sensor_count_);
  new (sensor_storage_ + sensor_count_ * sizeof(AnySensorSlot)) AnySensorSlot(sensor);
  return sensor_count_++;
}

template <class Pose>
typename Filter<Pose>::AnySensorSlot& Filter<Pose>::sensor_slot(int sensor) {
  if (sensor < 0 || sensor >= sensor_count_)
    throw Error(ErrorCode::not_found, "sensor: there is no number %d; %d have been added, counted from 0", sensor,
                sensor_count_);
  return *std::launder(reinterpret_cast<AnySensorSlot*>(sensor_storage_ + sensor * sizeof(AnySensorSlot)));
}

template <class Pose>
const Sensor<Pose>& Filter<Pose>::sensor_at(int sensor) {
  return std::visit([](auto& s) -> const Sensor<Pose>& { return s; }, sensor_slot(sensor));
}

template <class Pose>
void Filter<Pose>::point_head(int sensor, double pan, double stick) {
  StereoHead* head = nullptr;
  if constexpr (kDim == 3)
    head = std::get_if<StereoHead>(&sensor_slot(sensor));
  else
    sensor_slot(sensor);  // there is one of this number
  if (head == nullptr)
    throw Error(ErrorCode::argument, "sensor: number %d is no stereo head and can't be pointed", sensor);
  head->point(pan, stick);
}

template <class Pose>
void Filter<Pose>::set_sighting(int sensor, const MutualSighting& sighting) {
  if constexpr (kDim == 2)
    if (auto* extended = std::get_if<ExtendedObservation>(&sensor_slot(sensor))) return extended->set(sighting);
  throw Error(ErrorCode::argument, "sensor: number %d gives no extended observations", sensor);
}

template <class Pose>
void Filter<Pose>::propagate(const Increment<Pose>& increment) {
  constexpr double kTurnSquared = 39.478417604357432;  // (2 pi)^2
  if (!(increment.covariance.diagonal().template tail<kTurn>().maxCoeff() <= kTurnSquared))
    throw Error(ErrorCode::numerical,
                "prediction: the attitude's noise of this step exceeds a whole turn; nothing was changed");
  if (!ekf_.propagate(increment))
    throw Error(ErrorCode::numerical,
                "prediction: the pose or its covariance would not be finite; nothing was changed");
  driven_ += increment.T_before_after.translation().norm();
}

template <class Pose>
bool Filter<Pose>::find(std::uint64_t id, std::size_t& index) const {
  const std::int32_t slot = slots_.find(id);
  if (slot == IdTable::kAbsent || slot >= first_deferred()) return false;
  index = static_cast<std::size_t>(slot - ekf_.companions());
  return true;
}

template <class Pose>
std::vector<Index> Filter<Pose>::slots_of(const std::size_t* landmarks, std::size_t count) const {
  std::vector<Index> slots;
  for (std::size_t i = 0; i < count; ++i) slots.push_back(slot_of(landmarks[i]));
  return slots;
}

template <class Pose>
void Filter<Pose>::joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::vector<Index> slots = slots_of(indices, count);
  const std::size_t n = kDof + kDim * count;
  std::vector<double> joint(n * n);
  ekf_.gather_ordinary(slots.data(), static_cast<Index>(count), joint.data(), static_cast<Index>(n));
  without_pose<Pose>(joint.data(), count, matrix);
}

template <class Pose>
void Filter<Pose>::say(const char* format, ...) const {
  if (log_ == nullptr) return;
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  log_(log_payload_, line);
}

template MapOptions<SE2> map_options(const FilterOptions<SE2>&);
template MapOptions<SE3> map_options(const FilterOptions<SE3>&);
template class Filter<SE2>;
template class Filter<SE3>;

}  // namespace cairn
