// SPDX-License-Identifier: BSD-3-Clause
#include "team/joint_mode.hpp"

#include <algorithm>
#include <unordered_map>

#include "team/sighting.hpp"

namespace cairn {
namespace {

FilterOptions<SE2> with_companions(const TeamOptions& options) {
  FilterOptions<SE2> filter = options.filter;
  filter.max_companions = static_cast<Index>(options.mail.max_vehicles) - 1;
  return filter;
}

// A new landmark that several vehicles see at one time is placed by the nearest of them: the arc of a bearing grows
// with the range, and with it the error of the first linearisation.
class NearestObservers {
 public:
  NearestObservers(const Filter<SE2>& filter, const std::vector<Packet>& packets) : filter_(filter) {
    if (packets.size() < 2 || filter.options().association != AssociationKind::known) return;
    std::size_t unused = 0;
    for (const Packet& packet : packets)
      for (const Observation& o : packet.landmarks)
        if (!filter.local_landmarks().find(o.id, unused)) {
          const auto entry = nearest_.emplace(o.id, Observer{o.z[0], packet.vehicle}).first;
          if (o.z[0] < entry->second.range) entry->second = {o.z[0], packet.vehicle};
        }
  }

  // Moves observations out of the packet if they have to wait until the nearest vehicle has placed the landmark.
  std::vector<Observation> defer(Packet& packet) const {
    std::vector<Observation> deferred;
    if (nearest_.empty()) return deferred;
    std::size_t unused = 0;
    const auto waits = [&](const Observation& o) {
      const auto entry = nearest_.find(o.id);
      return entry != nearest_.end() && entry->second.vehicle != packet.vehicle &&
             !filter_.local_landmarks().find(o.id, unused);
    };
    std::copy_if(packet.landmarks.begin(), packet.landmarks.end(), std::back_inserter(deferred), waits);
    packet.landmarks.erase(std::remove_if(packet.landmarks.begin(), packet.landmarks.end(), waits),
                           packet.landmarks.end());
    return deferred;
  }

 private:
  struct Observer {
    double range;
    std::uint64_t vehicle;
  };
  const Filter<SE2>& filter_;
  std::unordered_map<std::uint64_t, Observer> nearest_;  // by landmark; new ones only
};

}  // namespace

JointMode::JointMode(const TeamOptions& options)
    : Cooperation(options), team_(with_companions(options), options.mail.vehicle, options.radar) {}

void JointMode::add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) {
  team_.filter().add_vehicle(vehicle, start, covariance);
}

void JointMode::lose_sight(std::uint64_t vehicle) {
  if (!team_.filter().has_vehicle(vehicle)) return;
  team_.filter().look_from(options().mail.vehicle);
  team_.filter().remove_vehicle(vehicle);
}

void JointMode::take_turn(std::vector<Packet>& packets) {
  Filter<SE2>& filter = team_.filter();
  move_all(packets);
  find_teammates(packets);
  packets.erase(std::remove_if(packets.begin(), packets.end(),
                               [&](const Packet& packet) { return !filter.has_vehicle(packet.vehicle); }),
                packets.end());

  const NearestObservers observers(filter, packets);
  std::vector<std::vector<Observation>> deferred(packets.size());
  for (std::size_t t = packets.size(); t-- > 0;) {  // the last vehicle is already the active one
    Packet& packet = packets[t];
    const std::vector<Observation> vehicles = usable_sightings(packet, packets);
    deferred[t] = observers.defer(packet);
    if (packet.landmarks.empty() && vehicles.empty()) continue;
    filter.look_from(packet.vehicle);
    scan(team_, kRadarSensor, packet.landmarks, vehicles, is_own(packet));
  }
  for (std::size_t t = 0; t < packets.size(); ++t) {
    if (deferred[t].empty()) continue;
    filter.look_from(packets[t].vehicle);
    scan(team_, kRadarSensor, deferred[t], {}, is_own(packets[t]));
  }
}

void JointMode::move_all(const std::vector<Packet>& packets) {
  Filter<SE2>& filter = team_.filter();
  for (const Packet& packet : packets) {
    if (!filter.has_vehicle(packet.vehicle)) continue;
    filter.look_from(packet.vehicle);
    move(filter, packet);
  }
}

// Sightings of vehicles that have no packet of this time are refused: the poses of these vehicles at this time are
// unknown.
std::vector<Observation> JointMode::usable_sightings(const Packet& packet, const std::vector<Packet>& packets) {
  std::vector<Observation> usable;
  for (const Observation& o : packet.vehicles) {
    const bool here =
        std::any_of(packets.begin(), packets.end(), [&](const Packet& other) { return other.vehicle == o.id; });
    if (here)
      usable.push_back(o);
    else
      ++tally().sightings_refused;
  }
  return usable;
}

// Teammates whose pose is not known are placed by mutual sightings with vehicles whose pose is known.
void JointMode::find_teammates(std::vector<Packet>& packets) {
  const Filter<SE2>& filter = team_.filter();
  const auto find_one = [&] {
    for (Packet& lost : packets)
      for (Packet& from : packets)
        if (!filter.has_vehicle(lost.vehicle) && filter.has_vehicle(from.vehicle) && find_teammate(lost, from))
          return true;
    return false;
  };
  while (find_one()) {
  }
}

// The two sightings are consumed, even if they are refused.
bool JointMode::find_teammate(Packet& lost, Packet& from) {
  const Observation* there = find_sighting(from.vehicles, lost.vehicle);
  const Observation* back = find_sighting(lost.vehicles, from.vehicle);
  if (there == nullptr || back == nullptr) return false;
  const RangeBearingParameters& radar = options().radar;
  const MutualSighting seen =
      mutual_sighting(*there, sighting_noise(*there, radar), *back, sighting_noise(*back, radar), true);
  remove_sighting(from.vehicles, lost.vehicle);
  remove_sighting(lost.vehicles, from.vehicle);
  team_.filter().look_from(from.vehicle);
  const bool found = attempt(false, [&] { add_by_sighting(team_.filter(), lost.vehicle, seen); });
  if (found) ++tally().vehicles_found;
  return found;
}

}  // namespace cairn
