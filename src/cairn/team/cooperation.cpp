// SPDX-License-Identifier: BSD-3-Clause
#include "team/cooperation.hpp"

#include <algorithm>

#include "team/extended_mode.hpp"
#include "team/joint_mode.hpp"
#include "team/mono_mode.hpp"
#include "team/submaps_mode.hpp"

namespace cairn {

std::unique_ptr<Cooperation> Cooperation::create(const TeamOptions& options) {
  const bool submaps = options.mode == TeamMode::submaps;
  if (submaps == options.filter.single_map())
    throw Error(ErrorCode::argument,
                submaps ? "options.submap_landmarks is 0; a team that fuses submaps needs a limit above 0"
                        : "options.submap_landmarks: this team's filter holds a single map");
  switch (options.mode) {
    case TeamMode::mono:
      return std::make_unique<MonoMode>(options);
    case TeamMode::eo_diagonal:
    case TeamMode::eo_full:
      return std::make_unique<ExtendedMode>(options);
    case TeamMode::submaps:
      return std::make_unique<SubmapsMode>(options);
    case TeamMode::joint:
      break;
  }
  return std::make_unique<JointMode>(options);
}

Cooperation::Cooperation(const TeamOptions& options) : options_(options) {
  own_matches_.reserve(static_cast<std::size_t>(options.filter.max_observations));
}

const Packet* Cooperation::own_packet(const std::vector<Packet>& packets) const {
  const auto own = std::find_if(packets.begin(), packets.end(), [&](const Packet& packet) { return is_own(packet); });
  return own != packets.end() ? &*own : nullptr;
}

// A vehicle that is seen beyond any distance was not seen.
bool Cooperation::take(std::vector<Packet>& packets) noexcept {
  if (own_packet(packets) != nullptr) own_matches_.clear();
  for (Packet& packet : packets) {
    const auto far = std::remove_if(packet.vehicles.begin(), packet.vehicles.end(),
                                    [](const Observation& o) { return o.z[0] > kFarthest; });
    counts_.sightings_refused += static_cast<std::uint64_t>(packet.vehicles.end() - far);
    packet.vehicles.erase(far, packet.vehicles.end());
  }
  return take_turn(packets);
}

VehicleEstimate Cooperation::estimate(std::uint64_t vehicle) const {
  return {filter().vehicle_pose(vehicle), filter().vehicle_covariance(vehicle)};
}

void Cooperation::move(Filter<SE2>& filter, const Packet& packet) {
  attempt(is_own(packet), [&] {
    for (const Increment<SE2>& motion : packet.motions) filter.propagate(motion);
  });
}

void Cooperation::scan(VehicleFilter& vehicle, int sensor, const Scan& scan, bool own) {
  attempt(own, [&] {
    vehicle.update(sensor, scan);
    const Filter<SE2>& filter = vehicle.filter();
    counts_.matched += static_cast<std::uint64_t>(filter.report().matched);
    counts_.placed += static_cast<std::uint64_t>(filter.report().placed);
    counts_.rejected += static_cast<std::uint64_t>(filter.report().rejected);
    counts_.sightings_used += scan.vehicle_count;
    const Match* matches = filter.matches();
    if (own) own_matches_.insert(own_matches_.end(), matches, matches + scan.landmark_count + scan.vehicle_count);
  });
}

void Cooperation::move_and_scan(VehicleFilter& filter, const Packet& packet) {
  move(filter.filter(), packet);
  scan(filter, kRadarSensor, Scan(packet.landmarks), is_own(packet));
}

}  // namespace cairn
