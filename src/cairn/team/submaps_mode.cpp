// SPDX-License-Identifier: BSD-3-Clause
#include "team/submaps_mode.hpp"

namespace cairn {
namespace {

MapOptions<SE2> team_map(const TeamOptions& options) {
  MapOptions<SE2> map = map_options(options.filter);
  map.max_companions = options.mail.max_vehicles - 1;
  return map;
}

}  // namespace

SubmapsMode::SubmapsMode(const TeamOptions& options) : Cooperation(options), map_(team_map(options)) {
  map_.name_vehicle(options.mail.vehicle);
  own_ = make_filter(options.mail.vehicle);
}

// A filter whose submaps join the team's map as those of `vehicle`.
std::unique_ptr<VehicleFilter> SubmapsMode::make_filter(std::uint64_t vehicle) {
  auto made = std::make_unique<VehicleFilter>(options().filter, vehicle, options().radar);
  made->filter().use_map(std::make_unique<SharedMap>(map_, vehicle));
  return made;
}

void SubmapsMode::add(std::uint64_t /*vehicle*/) {
  throw Error(ErrorCode::state, "start: a team that fuses submaps needs the start pose of every teammate");
}

void SubmapsMode::add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) {
  auto made = make_filter(vehicle);
  map_.add_vehicle(vehicle, start, covariance);
  teammates_[vehicle] = {std::move(made), true};
}

void SubmapsMode::lose_sight(std::uint64_t vehicle) {
  const auto teammate = teammates_.find(vehicle);
  if (teammate != teammates_.end()) teammate->second.in_sight = false;
}

VehicleEstimate SubmapsMode::estimate(std::uint64_t vehicle) const {
  const auto teammate = teammates_.find(vehicle);
  const Filter<SE2>& filter = teammate != teammates_.end() ? teammate->second.filter->filter() : own_->filter();
  return {filter.vehicle_pose(vehicle), filter.vehicle_covariance(vehicle)};
}

void SubmapsMode::take_turn(std::vector<Packet>& packets) {
  for (const Packet& packet : packets) {
    if (is_own(packet)) {
      move_and_scan(*own_, packet);
      continue;
    }
    const auto teammate = teammates_.find(packet.vehicle);
    if (teammate != teammates_.end() && teammate->second.in_sight) move_and_scan(*teammate->second.filter, packet);
  }
}

}  // namespace cairn
