// SPDX-License-Identifier: BSD-3-Clause
// Sightings of vehicles by each other, and the pose of a teammate that follows from a mutual one (docs/team.md).
#pragma once

#include <algorithm>
#include <vector>

#include "sensor/range_bearing.hpp"
#include "slam/filter.hpp"

namespace cairn {

// The sighting of a vehicle in a list; null if there is none.
inline const Observation* find_sighting(const std::vector<Observation>& sightings, std::uint64_t vehicle) {
  for (const Observation& o : sightings)
    if (o.id == vehicle) return &o;
  return nullptr;
}

inline void remove_sighting(std::vector<Observation>& sightings, std::uint64_t vehicle) {
  sightings.erase(
      std::remove_if(sightings.begin(), sightings.end(), [&](const Observation& o) { return o.id == vehicle; }),
      sightings.end());
}

// Noise of a sighting: its own, or the radar's.
inline Matrix2 sighting_noise(const Observation& o, const RangeBearingParameters& radar) {
  const Matrix2 given = Eigen::Map<const Matrix2>(o.covariance);
  if (!given.isZero(0.0)) return given;
  return Vector2(radar.range_sigma, radar.bearing_sigma).cwiseAbs2().asDiagonal();
}

// Two vehicles saw each other at one time: `there` is this vehicle's sighting, `back` that of the teammate. Together
// they determine the teammate's position and heading. The range is the mean of both, weighted by their variances, or
// only this vehicle's.
inline MutualSighting mutual_sighting(const Observation& there, const Matrix2& noise, const Observation& back,
                                      const Matrix2& noise_back, bool both_ranges) {
  MutualSighting sighting;
  const double weight = both_ranges ? noise_back(0, 0) / (noise(0, 0) + noise_back(0, 0)) : 1.0;
  sighting.range = weight * there.z[0] + (1.0 - weight) * back.z[0];
  sighting.bearing = there.z[1];
  sighting.back = back.z[1];
  Eigen::Matrix<double, 3, 4> J = Eigen::Matrix<double, 3, 4>::Zero();  // by (range, bearing) there and back
  J(0, 0) = weight, J(0, 2) = 1.0 - weight, J(1, 1) = 1.0, J(2, 3) = 1.0;
  sighting.covariance = J.leftCols<2>() * noise * J.leftCols<2>().transpose() +
                        J.rightCols<2>() * noise_back * J.rightCols<2>().transpose();
  return sighting;
}

// Adds a vehicle to the filter, placed by the mutual sighting with the filter's active vehicle.
inline void add_by_sighting(Filter<SE2>& filter, std::uint64_t id, const MutualSighting& seen) {
  const SE2 T = filter.pose(), T_body_teammate = teammate_in_body(seen);
  const ProductJacobians J(T, T_body_teammate);
  const Matrix3 by_seen = teammate_jacobian(seen);
  filter.add_vehicle(id, T * T_body_teammate, J.by_a,
                     J.by_b * (by_seen * seen.covariance * by_seen.transpose()) * J.by_b.transpose());
}

}  // namespace cairn
