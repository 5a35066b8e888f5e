// SPDX-License-Identifier: BSD-3-Clause
#include "team/extended_mode.hpp"

#include "team/sighting.hpp"

namespace cairn {

ExtendedMode::ExtendedMode(const TeamOptions& options)
    : Cooperation(options),
      full_(options.mode == TeamMode::eo_full),
      own_(options.filter, options.mail.vehicle, options.radar),
      extended_sensor_(own_.filter().add(ExtendedObservation(options.radar, {}, full_))) {}

bool ExtendedMode::take_turn(std::vector<Packet>& packets) noexcept {
  const Packet* own = own_packet(packets);
  if (own == nullptr) return true;
  move_and_scan(own_, *own);
  for (const Packet& packet : packets)
    if (!is_own(packet) && !packet.landmarks.empty()) take_teammate(*own, packet);
  return true;
}

void ExtendedMode::take_teammate(const Packet& own, const Packet& teammate) {
  const Observation* there = find_sighting(own.vehicles, teammate.vehicle);
  const Observation* back = find_sighting(teammate.vehicles, own.vehicle);
  if (there == nullptr || back == nullptr) {
    ++tally().sightings_refused;
    return;
  }
  const RangeBearingParameters& radar = options().radar;
  MutualSighting seen =
      mutual_sighting(*there, sighting_noise(*there, radar), *back, sighting_noise(*back, radar), full_);
  seen.covariance *= options().filter.error_persistence;
  own_.filter().set_sighting(extended_sensor_, seen);
  scan(own_, extended_sensor_, Scan(teammate.landmarks), false);
  tally().sightings_used += 2;
}

}  // namespace cairn
