// SPDX-License-Identifier: BSD-3-Clause
// Motion of the boats and their sightings.
#include "sim/fleet.hpp"

#include <cmath>

#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "sim/fleet_options.hpp"

namespace cairn::sim {
namespace {

// Index of the random draws of a boat at a step, and of each of its sightings. All indices differ.
std::uint64_t draw_index(std::uint64_t step, std::uint64_t boat) {
  static_assert(kMostBoats <= 1 << 6, "the boat's number has six bits");
  return step << 6 | boat;
}
std::uint64_t draw_index(std::uint64_t step, std::uint64_t boat, std::uint64_t id) {
  static_assert(kMostFeatures < 1 << 20 && kMostBoats < 1 << 20, "the id has twenty bits");
  return draw_index(step, boat) << 20 | id;
}

}  // namespace

Fleet::Fleet(const cairn_fleet_options& options)
    : options_(options),
      scene_(make_scene(options)),
      steps_(steps_of(options)),
      speed_(options.course_length / options.duration),
      rate_(2 * kPi / options.duration),
      poses_(scene_.starts),
      moved_(scene_.starts),
      vehicles_(options.vehicles) {}

void Fleet::rewind() {
  step_ = 0;
  sightings_.clear();
}

const cairn_fleet_sighting* Fleet::features_of(std::size_t boat) const {
  const cairn_fleet_sighting* sighting = sightings_.data();
  for (std::size_t before = 0; before < boat; ++before)
    sighting += vehicles_[before].feature_count + vehicles_[before].vehicle_count;
  return sighting;
}

void Fleet::next(cairn_fleet_step& step) {
  if (step_ >= steps_)
    throw Error(ErrorCode::state, "all %zu steps of the fleet were handed out; rewind it or create another one",
                steps_);
  // Everything that can fail comes before the state changes.
  for (std::size_t boat = 0; boat < moved_.size(); ++boat)
    moved_[boat] = step_ == 0 ? scene_.starts[boat] : moved(poses_[boat], boat);
  sightings_.clear();
  for (std::size_t boat = 0; boat < moved_.size(); ++boat) look(boat);
  poses_.swap(moved_);
  step.number = step_;
  step.time = static_cast<double>(step_) * options_.period;
  step.dt = step_ == 0 ? 0 : options_.period;
  step.vehicle_count = vehicles_.size();
  ++step_;
}

// The pose one period later: the executed speed and rate are the commanded ones plus noise, constant over the period.
SE2 Fleet::moved(const SE2& T_map_boat, std::size_t boat) const {
  Random random(options_.seed, Stream::boat_motion, draw_index(step_, boat));
  const double speed = speed_ + options_.speed_sigma * random.normal();
  const double rate = rate_ + options_.rate_sigma * random.normal();
  return T_map_boat * SE2::exp(Vector3(speed, 0, rate) * options_.period);
}

void Fleet::look(std::size_t boat) {
  cairn_fleet_vehicle& vehicle = vehicles_[boat];
  const SE2& T_map_boat = moved_[boat];
  vehicle.speed = step_ == 0 ? 0 : speed_;
  vehicle.rate = step_ == 0 ? 0 : rate_;
  vehicle.x = T_map_boat.translation().x();
  vehicle.y = T_map_boat.translation().y();
  vehicle.heading = wrap_angle(T_map_boat.rotation().angle());
  const std::size_t first = sightings_.size();
  for (std::size_t i = 0; i < scene_.features.size(); ++i)
    see(scene_.features[i], boat, i + 1, Stream::feature_sighting);
  vehicle.feature_count = sightings_.size() - first;
  for (std::size_t other = 0; other < moved_.size(); ++other)
    if (other != boat) see(moved_[other].translation(), boat, other + 1, Stream::boat_sighting);
  vehicle.vehicle_count = sightings_.size() - first - vehicle.feature_count;
}

void Fleet::see(const Vector2& place, std::size_t boat, std::uint64_t id, Stream stream) {
  const Vector2 m = moved_[boat].rotation().inverse() * (place - moved_[boat].translation());
  const double distance = m.norm();
  if (!(distance > 0 && distance <= options_.radar_range)) return;
  Random random(options_.seed, stream, draw_index(step_, boat, id));
  cairn_fleet_sighting sighting = {};
  sighting.id = id;
  sighting.bearing = wrap_angle(std::atan2(m.y(), m.x()) + options_.bearing_sigma * random.normal());
  // Draw again until the range is positive. The distance is positive, so more than half of all draws succeed.
  do sighting.range = distance + options_.range_sigma * random.normal();
  while (!(sighting.range > 0));
  sightings_.push_back(sighting);
}

}  // namespace cairn::sim
