// SPDX-License-Identifier: BSD-3-Clause
#include "team/joint_mode.hpp"

#include <algorithm>
#include <limits>

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
  NearestObservers(const Filter<SE2>& filter, const std::vector<Packet>& packets)
      : filter_(filter),
        packets_(packets),
        used_(packets.size() >= 2 && filter.options().association == AssociationKind::known) {}

  // Moves observations to the end of the packet's landmarks if they have to wait until the nearest vehicle has placed
  // the landmark, and returns the number of the others. Turns allocate nothing: each observation searches the packets.
  std::size_t defer(Packet& packet) const {
    std::vector<Observation>& landmarks = packet.landmarks;
    if (!used_) return landmarks.size();
    const auto stays = [&](const Observation& o) { return !waits(o, packet.vehicle); };
    return static_cast<std::size_t>(std::stable_partition(landmarks.begin(), landmarks.end(), stays) -
                                    landmarks.begin());
  }

 private:
  bool waits(const Observation& o, std::uint64_t vehicle) const {
    std::size_t unused = 0;
    if (filter_.local_landmarks().find(o.id, unused)) return false;
    double range = std::numeric_limits<double>::infinity();
    std::uint64_t nearest = vehicle;
    for (const Packet& packet : packets_)
      for (const Observation& other : packet.landmarks)
        if (other.id == o.id && other.z[0] < range) {
          range = other.z[0];
          nearest = packet.vehicle;
        }
    return nearest != vehicle;
  }

  const Filter<SE2>& filter_;
  const std::vector<Packet>& packets_;
  bool used_;
};

}  // namespace

JointMode::JointMode(const TeamOptions& options)
    : Cooperation(options),
      team_(with_companions(options), options.mail.vehicle, options.radar),
      at_once_(options.mail.max_vehicles) {}

void JointMode::add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) {
  team_.filter().add_vehicle(vehicle, start, covariance);
}

void JointMode::lose_sight(std::uint64_t vehicle) noexcept {
  if (!team_.filter().has_vehicle(vehicle)) return;
  team_.filter().look_from(options().mail.vehicle);
  team_.filter().remove_vehicle(vehicle);
}

bool JointMode::take_turn(std::vector<Packet>& packets) noexcept {
  Filter<SE2>& filter = team_.filter();
  move_all(packets);
  find_teammates(packets);
  packets.erase(std::remove_if(packets.begin(), packets.end(),
                               [&](const Packet& packet) { return !filter.has_vehicle(packet.vehicle); }),
                packets.end());

  const NearestObservers observers(filter, packets);
  const auto most = static_cast<std::size_t>(options().filter.max_observations);  // the filter refuses larger scans
  for (std::size_t t = packets.size(); t-- > 0;) {  // the last vehicle is already the active one
    Packet& packet = packets[t];
    drop_unusable_sightings(packet, packets);
    const std::size_t now = most >= packet.landmarks.size() ? observers.defer(packet) : packet.landmarks.size();
    at_once_[t] = now;
    if (now == 0 && packet.vehicles.empty()) continue;
    filter.look_from(packet.vehicle);
    scan(team_, kRadarSensor, Scan(packet.landmarks.data(), now, packet.vehicles), is_own(packet));
  }
  for (std::size_t t = 0; t < packets.size(); ++t) {
    const std::vector<Observation>& landmarks = packets[t].landmarks;
    if (at_once_[t] == landmarks.size()) continue;
    filter.look_from(packets[t].vehicle);
    scan(team_, kRadarSensor, Scan(landmarks.data() + at_once_[t], landmarks.size() - at_once_[t], {}),
         is_own(packets[t]));
  }
  return true;
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
void JointMode::drop_unusable_sightings(Packet& packet, const std::vector<Packet>& packets) {
  const auto absent = [&](const Observation& o) {
    return std::none_of(packets.begin(), packets.end(), [&](const Packet& other) { return other.vehicle == o.id; });
  };
  const auto unusable = std::remove_if(packet.vehicles.begin(), packet.vehicles.end(), absent);
  tally().sightings_refused += static_cast<std::uint64_t>(packet.vehicles.end() - unusable);
  packet.vehicles.erase(unusable, packet.vehicles.end());
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
