// SPDX-License-Identifier: BSD-3-Clause
#include "team/vehicle_filter.hpp"

#include <algorithm>

namespace cairn {

VehicleFilter::VehicleFilter(const FilterOptions<SE2>& options, std::uint64_t vehicle,
                             const RangeBearingParameters& radar)
    : arena_(Filter<SE2>::arena_bytes(options)),
      filter_(arena_, options),
      scan_(static_cast<std::size_t>(options.max_observations)) {
  filter_.name_vehicle(vehicle);
  filter_.add(RangeBearing(radar));  // kRadarSensor
}

void VehicleFilter::update(int sensor, const Scan& scan) {
  const std::size_t landmarks = scan.landmark_count, vehicles = scan.vehicle_count;
  if (landmarks > scan_.size() || vehicles > scan_.size() - landmarks)
    throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %zu", landmarks + vehicles,
                scan_.size());
  std::copy_n(scan.vehicles, vehicles, std::copy_n(scan.landmarks, landmarks, scan_.begin()));
  filter_.update(sensor, scan_.data(), static_cast<Index>(landmarks), static_cast<Index>(vehicles));
}

}  // namespace cairn
