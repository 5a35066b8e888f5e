// SPDX-License-Identifier: BSD-3-Clause
// Sensors live in the arena and are destroyed with the rack.
#include "slam/sensor_rack.hpp"

#include <new>

#include "core/error.hpp"

namespace cairn {

template <class Pose>
SensorRack<Pose>::SensorRack(Arena& arena, Index max_sensors)
    : max_sensors_(max_sensors), places_(arena.take<Place>(static_cast<std::size_t>(max_sensors))) {
  static_assert(alignof(Place) <= Arena::kAlignment, "the arena aligns to a cache line");
}

template <class Pose>
SensorRack<Pose>::~SensorRack() {
  for (int i = 0; i < count_; ++i) any(i).~Any();
}

template <class Pose>
int SensorRack<Pose>::add(const Any& sensor) {
  if (count_ == max_sensors_)
    throw Error(ErrorCode::capacity, "sensor: all %d are taken; create the filter with a larger max_sensors", count_);
  new (places_[count_].sensor) Any(sensor);
  return count_++;
}

template <class Pose>
void SensorRack<Pose>::check(int number) const {
  if (number < 0 || number >= count_)
    throw Error(ErrorCode::not_found, "sensor: there is no number %d; %d have been added, counted from 0", number,
                count_);
}

template <class Pose>
typename SensorRack<Pose>::Any& SensorRack<Pose>::any(int number) {
  check(number);
  return *std::launder(reinterpret_cast<Any*>(places_[number].sensor));
}

template <class Pose>
const Sensor<Pose>& SensorRack<Pose>::at(int number) {
  return std::visit([](auto& sensor) -> const Sensor<Pose>& { return sensor; }, any(number));
}

template <class Pose>
const View* SensorRack<Pose>::view(int number) const {
  return places_[number].has_view ? &places_[number].view : nullptr;
}

template <class Pose>
void SensorRack<Pose>::set_view(int number, const View& view) {
  any(number);  // throws if there is no sensor of this number
  places_[number].has_view = true;
  places_[number].view = view;
}

template <class Pose>
void SensorRack<Pose>::set_loss(int number, const RobustLoss& loss) {
  any(number);  // throws if there is no sensor of this number
  places_[number].loss = loss;
}

template <class Pose>
void SensorRack<Pose>::point_head(int number, double pan, double stick) {
  StereoHead* head = nullptr;
  if constexpr (Pose::kDim == 3)
    head = std::get_if<StereoHead>(&any(number));
  else
    any(number);  // throws if there is no sensor of this number
  if (head == nullptr)
    throw Error(ErrorCode::argument, "sensor: number %d is no stereo head and can't be pointed", number);
  head->point(pan, stick);
}

template <class Pose>
void SensorRack<Pose>::set_sighting(int number, const MutualSighting& sighting) {
  if constexpr (Pose::kDim == 2)
    if (auto* extended = std::get_if<ExtendedObservation>(&any(number))) return extended->set(sighting);
  throw Error(ErrorCode::argument, "sensor: number %d gives no extended observations", number);
}

template class SensorRack<SE2>;
template class SensorRack<SE3>;

}  // namespace cairn
