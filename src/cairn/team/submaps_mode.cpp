// SPDX-License-Identifier: BSD-3-Clause
#include "team/submaps_mode.hpp"

#include <new>

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
  std::map<std::uint64_t, Teammate> made;
  made.emplace(vehicle, Teammate{make_filter(vehicle), true});
  map_.add_vehicle(vehicle, start, covariance);
  teammates_.merge(made);
}

void SubmapsMode::lose_sight(std::uint64_t vehicle) noexcept {
  const auto teammate = teammates_.find(vehicle);
  if (teammate != teammates_.end()) teammate->second.in_sight = false;
}

VehicleEstimate SubmapsMode::estimate(std::uint64_t vehicle) const {
  const auto teammate = teammates_.find(vehicle);
  const Filter<SE2>& filter = teammate != teammates_.end() ? teammate->second.filter->filter() : own_->filter();
  return {filter.vehicle_pose(vehicle), filter.vehicle_covariance(vehicle)};
}

VehicleFilter* SubmapsMode::filter_of(const Packet& packet) {
  if (is_own(packet)) return own_.get();
  const auto teammate = teammates_.find(packet.vehicle);
  return teammate != teammates_.end() && teammate->second.in_sight ? teammate->second.filter.get() : nullptr;
}

// A closing allocates. The order of the closings is the same at every vehicle. Hence, if memory runs out in one, all
// later packets wait until it was made up for.
bool SubmapsMode::take_turn(std::vector<Packet>& packets) noexcept {
  while (taken_ < packets.size()) {
    if (!close_open()) return false;
    const Packet& packet = packets[taken_];
    ++taken_;
    VehicleFilter* const vehicle = filter_of(packet);
    if (vehicle == nullptr) continue;
    move_and_scan(*vehicle, packet);
    if (vehicle->filter().closing().no_memory) open_ = vehicle;
  }
  if (!close_open()) return false;
  taken_ = 0;
  return true;
}

bool SubmapsMode::close_open() noexcept {
  if (open_ == nullptr) return true;
  try {
    open_->filter().close_submap();
  } catch (const std::bad_alloc&) {
    return false;
  } catch (const Error&) {  // for another reason: the filter tries again, as after any frame
  }
  open_ = nullptr;
  return true;
}

}  // namespace cairn
