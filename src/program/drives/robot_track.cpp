// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/robot_track.hpp"

#include <algorithm>
#include <cmath>

#include "program/library.hpp"

namespace cairn::program {

void RobotTrack::advance(double time, VehicleStep& step) {
  move(time, step);
  if (started(time)) look(time, step);
}

// A record holds until the next one. Noise is white in time: over dt its mean has a variance of its density over dt.
void RobotTrack::move(double time, VehicleStep& step) {
  const auto& all = robot_.odometry;
  while (time_ < time) {
    while (odometry_ + 1 < all.size() && all[odometry_ + 1].time <= time_) ++odometry_;
    const bool last = odometry_ + 1 == all.size();
    const double until = last ? time : std::min(time, all[odometry_ + 1].time);
    const double dt = until - time_;
    const auto& record = all[odometry_];
    step.motions.push_back({dt, record.speed, record.rate, noise_.speed / std::sqrt(dt), noise_.rate / std::sqrt(dt)});
    time_ = until;
  }
}

// If a subject comes twice at this time, the first one counts.
void RobotTrack::look(double time, VehicleStep& step) {
  const auto& all = robot_.measurements;
  while (measurement_ < all.size() && all[measurement_].time < time) ++measurement_;
  for (; measurement_ < all.size() && all[measurement_].time == time; ++measurement_) {
    const auto& from = all[measurement_];
    const bool post = log_.landmarks.count(from.subject) > 0;
    std::vector<cairn_observation>& to = post ? step.landmarks : step.vehicles;
    if (std::any_of(to.begin(), to.end(), [&](const cairn_observation& o) { return o.id == from.subject; })) continue;
    cairn_observation observation{};
    observation.id = from.subject;
    observation.z[0] = from.range;
    observation.z[1] = from.bearing;
    observation.covariance[0] = std::pow(noise_.range * from.range, 2);  // 2 x 2, packed
    observation.covariance[3] = noise_.bearing * noise_.bearing;
    to.push_back(observation);
  }
}

cairn_range_bearing robot_radar(const MrclamNoise& noise) {
  cairn_range_bearing radar;
  check(cairn_range_bearing_init(&radar, sizeof radar, nullptr));
  radar.range_sigma = noise.range;
  radar.bearing_sigma = noise.bearing;
  return radar;
}

}  // namespace cairn::program
