// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/fleet_drive.hpp"

#include <cmath>

#include "program/library.hpp"

namespace cairn::program {

FleetDrive::FleetDrive(const cairn_fleet_options& options) : options_(options), fleet_(nullptr, &cairn_fleet_destroy) {
  cairn_fleet* fleet = nullptr;
  check_sim(cairn_fleet_create(&options, &fleet, nullptr));
  fleet_.reset(fleet);
  check_sim(cairn_fleet_steps(fleet, &steps_, nullptr));
  std::size_t count = 0;
  check_sim(cairn_fleet_features(fleet, nullptr, 0, &count, nullptr));
  features_.resize(2 * count);
  if (count > 0) check_sim(cairn_fleet_features(fleet, features_.data(), count, &count, nullptr));
  step_.struct_size = sizeof step_;
  taken_ = take();
  for (const cairn_fleet_vehicle& boat : boats_) {
    numbers_.push_back(numbers_.size() + 1);
    starts_.push_back(planar_pose(boat.x, boat.y, boat.heading));
  }
}

bool FleetDrive::take() {
  const cairn_status status = cairn_fleet_next(fleet_.get(), &step_, nullptr);
  if (status == CAIRN_ERROR_STATE) return false;
  check_sim(status);
  read_sim_array(boats_, [&](cairn_fleet_vehicle* vehicles, std::size_t capacity, std::size_t* needed) {
    return cairn_fleet_vehicles(fleet_.get(), vehicles, capacity, needed, nullptr);
  });
  return true;
}

std::vector<cairn_observation> FleetDrive::seen(Seen query, std::uint64_t vehicle) const {
  std::vector<cairn_fleet_sighting> sightings;
  read_sim_array(sightings, [&](cairn_fleet_sighting* buffer, std::size_t capacity, std::size_t* needed) {
    return query(fleet_.get(), vehicle, buffer, capacity, needed, nullptr);
  });
  std::vector<cairn_observation> out(sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    out[i].id = sightings[i].id;
    out[i].z[0] = sightings[i].range;
    out[i].z[1] = sightings[i].bearing;
  }
  return out;
}

cairn_range_bearing FleetDrive::radar() const {
  cairn_range_bearing radar;
  check(cairn_range_bearing_init(&radar, sizeof radar, nullptr));
  if (options_.range_sigma > 0) radar.range_sigma = options_.range_sigma;
  if (options_.bearing_sigma > 0) radar.bearing_sigma = options_.bearing_sigma;
  return radar;
}

bool FleetDrive::next(TeamStep& step) {
  if (!taken_ && !take()) return false;
  taken_ = false;
  step.time = step_.time;
  step.vehicles.resize(boats_.size());
  for (std::size_t v = 0; v < boats_.size(); ++v) {
    const cairn_fleet_vehicle& from = boats_[v];
    VehicleStep& to = step.vehicles[v];
    to.motions.clear();
    if (step_.dt > 0)
      to.motions.push_back({step_.dt, from.speed, from.rate, options_.speed_sigma, options_.rate_sigma});
    to.landmarks = seen(&cairn_fleet_seen_features, numbers_[v]);
    to.vehicles = seen(&cairn_fleet_seen_vehicles, numbers_[v]);
    to.truth = planar_pose(from.x, from.y, from.heading);
  }
  return true;
}

bool FleetDrive::true_landmark(std::uint64_t id, double position[2]) const {
  if (id == 0 || 2 * id > features_.size()) return false;
  position[0] = features_[2 * (id - 1)];
  position[1] = features_[2 * (id - 1) + 1];
  return true;
}

}  // namespace cairn::program
