// SPDX-License-Identifier: BSD-3-Clause
// What a vehicle makes of the packets of one time, by the team's mode (docs/team.md).
#include <algorithm>
#include <unordered_map>

#include "team/box.hpp"
#include "team/sighting.hpp"
#include "team/team.hpp"

namespace cairn {
namespace {

const Observation* sight_of(const std::vector<Observation>& sights, std::uint64_t vehicle) {
  for (const Observation& o : sights)
    if (o.id == vehicle) return &o;
  return nullptr;
}

void forget(std::vector<Observation>& sights, std::uint64_t vehicle) {
  sights.erase(std::remove_if(sights.begin(), sights.end(), [&](const Observation& o) { return o.id == vehicle; }),
               sights.end());
}

}  // namespace

void Team::move(Filter<SE2>& filter, const Packet& packet) {
  attempt(packet.vehicle == options_.vehicle, [&] {
    for (const Increment<SE2>& motion : packet.motions) filter.propagate(motion);
  });
}

// Takes a scan in; decisions on an own one are kept.
bool Team::scan(Filter<SE2>& filter, int sensor, const std::vector<Observation>& landmarks,
                const std::vector<Observation>& vehicles, bool own) {
  return attempt(own, [&] {
    const std::size_t count = landmarks.size() + vehicles.size();
    if (count > static_cast<std::size_t>(options_.filter.max_observations))
      throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %td", count,
                  options_.filter.max_observations);
    std::vector<Observation> frame(landmarks);
    frame.insert(frame.end(), vehicles.begin(), vehicles.end());
    filter.update(sensor, frame.data(), static_cast<Index>(landmarks.size()), static_cast<Index>(vehicles.size()));
    counts_.matched += static_cast<std::uint64_t>(filter.report().matched);
    counts_.placed += static_cast<std::uint64_t>(filter.report().placed);
    counts_.rejected += static_cast<std::uint64_t>(filter.report().rejected);
    counts_.sightings_used += vehicles.size();
    if (own) decisions_.insert(decisions_.end(), filter.matches(), filter.matches() + count);
  });
}

void Team::take_in(std::vector<Turn>& turns) {
  const auto self = std::find_if(turns.begin(), turns.end(), [&](const Turn& turn) { return turn.member == &own(); });
  if (self != turns.end()) decisions_.clear();
  switch (options_.mode) {
    case TeamMode::mono:
      if (self != turns.end()) take_in_own(*self);
      return;
    case TeamMode::eo_diagonal:
    case TeamMode::eo_full:
      return take_in_extended(turns);
    case TeamMode::joint:
      return take_in_joint(turns);
    case TeamMode::submaps:
      return take_in_submaps(turns);
  }
}

void Team::take_in_own(Turn& turn) {
  move(box_->filter, turn.packet);
  scan(box_->filter, kRadar, turn.packet.landmarks, {}, true);
}

// Every vehicle runs the same filter over all poses and landmarks: what two of them saw is in it once.
void Team::take_in_joint(std::vector<Turn>& turns) {
  Filter<SE2>& filter = box_->filter;
  for (const Turn& turn : turns) {
    if (!turn.member->known) continue;
    filter.look_from(turn.member->id);
    move(filter, turn.packet);
  }
  find_members(turns);
  turns.erase(std::remove_if(turns.begin(), turns.end(), [](const Turn& turn) { return !turn.member->known; }),
              turns.end());

  // A new landmark that several see is placed by the nearest of them: from afar its bearing's arc is the longer, and
  // the first linearisation the worse.
  const bool named = options_.filter.association == AssociationKind::known;
  std::unordered_map<std::uint64_t, std::pair<double, std::uint64_t>> nearest;  // range, vehicle
  std::size_t unused = 0;
  for (std::size_t t = 0; named && turns.size() > 1 && t < turns.size(); ++t)
    for (const Observation& o : turns[t].packet.landmarks)
      if (!filter.local_landmarks().find(o.id, unused)) {
        const auto entry = nearest.emplace(o.id, std::make_pair(o.z[0], turns[t].member->id)).first;
        if (o.z[0] < entry->second.first) entry->second = {o.z[0], turns[t].member->id};
      }

  std::vector<std::vector<Observation>> later(turns.size());
  for (std::size_t t = turns.size(); t-- > 0;) {  // the last one is looked from already
    const std::uint64_t vehicle = turns[t].member->id;
    Packet& packet = turns[t].packet;
    std::vector<Observation> known;
    for (const Observation& o : packet.vehicles) {
      const bool here =
          std::any_of(turns.begin(), turns.end(), [&](const Turn& turn) { return turn.member->id == o.id; });
      if (here)
        known.push_back(o);
      else
        ++counts_.sightings_refused;
    }
    if (!nearest.empty()) {
      const auto waits = [&](const Observation& o) {
        const auto entry = nearest.find(o.id);
        return entry != nearest.end() && entry->second.second != vehicle && !filter.local_landmarks().find(o.id, unused);
      };
      std::copy_if(packet.landmarks.begin(), packet.landmarks.end(), std::back_inserter(later[t]), waits);
      packet.landmarks.erase(std::remove_if(packet.landmarks.begin(), packet.landmarks.end(), waits),
                             packet.landmarks.end());
    }
    if (packet.landmarks.empty() && known.empty()) continue;
    filter.look_from(vehicle);
    scan(filter, kRadar, packet.landmarks, known, vehicle == options_.vehicle);
  }
  for (std::size_t t = 0; t < turns.size(); ++t) {
    if (later[t].empty()) continue;
    filter.look_from(turns[t].member->id);
    scan(filter, kRadar, later[t], {}, turns[t].member->id == options_.vehicle);
  }
}

// Noise of a sighting: its own, or the radar's.
Matrix2 Team::noise_of(const Observation& o) const {
  const Matrix2 given = Eigen::Map<const Matrix2>(o.covariance);
  if (!given.isZero(0.0)) return given;
  return Vector2(options_.radar.range_sigma, options_.radar.bearing_sigma).cwiseAbs2().asDiagonal();
}

// Teammates whose start is not known, from the mutual sightings with those whose is.
void Team::find_members(std::vector<Turn>& turns) {
  const auto find_one = [&] {
    for (Turn& lost : turns)
      for (Turn& from : turns)
        if (!lost.member->known && from.member->known && find_member(lost, from)) return true;
    return false;
  };
  while (find_one()) {
  }
}

// The sightings of each other are consumed, whatever becomes of them.
bool Team::find_member(Turn& lost, Turn& from) {
  const Observation* there = sight_of(from.packet.vehicles, lost.member->id);
  const Observation* back = sight_of(lost.packet.vehicles, from.member->id);
  if (there == nullptr || back == nullptr) return false;
  const MutualSighting seen = mutual_sighting(*there, noise_of(*there), *back, noise_of(*back), true);
  forget(from.packet.vehicles, lost.member->id);
  forget(lost.packet.vehicles, from.member->id);
  box_->filter.look_from(from.member->id);
  lost.member->known = attempt(false, [&] { add_by_sighting(box_->filter, lost.member->id, seen); });
  if (lost.member->known) ++counts_.vehicles_found;
  return lost.member->known;
}

// Where it is is known no more: until it is found again.
void Team::lose_sight(Member& member) {
  if (member.known && options_.mode == TeamMode::joint) {
    box_->filter.look_from(options_.vehicle);
    box_->filter.remove_vehicle(member.id);
  }
  member.known = false;
}

// The teammate's scan, seen through the mutual sighting, is taken in as the own vehicle's (cooperative paper, section
// 2.1). The teammate is no state: the sighting and the scan are all that is used of it.
void Team::take_in_extended(std::vector<Turn>& turns) {
  const auto self = std::find_if(turns.begin(), turns.end(), [&](const Turn& turn) { return turn.member == &own(); });
  if (self == turns.end()) return;
  take_in_own(*self);
  for (const Turn& turn : turns) {
    if (turn.member == &own() || turn.packet.landmarks.empty()) continue;
    const Observation* there = sight_of(self->packet.vehicles, turn.member->id);
    const Observation* back = sight_of(turn.packet.vehicles, options_.vehicle);
    if (there == nullptr || back == nullptr) {
      ++counts_.sightings_refused;
      continue;
    }
    const bool full = options_.mode == TeamMode::eo_full;
    MutualSighting seen = mutual_sighting(*there, noise_of(*there), *back, noise_of(*back), full);
    seen.covariance *= options_.filter.error_persistence;
    box_->filter.set_sighting(kExtended, seen);
    scan(box_->filter, kExtended, turn.packet.landmarks, {}, false);
    counts_.sightings_used += 2;
  }
}

// Submaps are of one vehicle each and share nothing: what closes joins the map of all, over the landmarks that it has
// in common with it. Sightings of each other would tie submaps together, and are left out (cooperative paper, section
// 1).
void Team::take_in_submaps(std::vector<Turn>& turns) {
  for (Turn& turn : turns) {
    if (turn.member == &own()) {
      take_in_own(turn);
      continue;
    }
    const auto teammate = fleet_->teammates.find(turn.member->id);
    if (teammate == fleet_->teammates.end() || !turn.member->known) continue;
    move(teammate->second->filter, turn.packet);
    scan(teammate->second->filter, kRadar, turn.packet.landmarks, {}, false);
  }
}

}  // namespace cairn
