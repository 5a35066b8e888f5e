// SPDX-License-Identifier: BSD-3-Clause
// What two vehicles that see each other know of one another (docs/team.md).
#pragma once

#include "sensor/range_bearing.hpp"
#include "slam/filter.hpp"

namespace cairn {

// Both saw each other at one time: together the two sightings tell where the other stands and whereto it heads. Of both
// ranges the mean, weighted by their variances, or the own one alone.
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

// A vehicle that the one looked from saw so becomes one of the filter's.
inline void add_by_sighting(Filter<SE2>& filter, std::uint64_t id, const MutualSighting& seen) {
  const SE2 T = filter.pose(), T_body_mate = mate_in_body(seen);
  const ProductJacobians J(T, T_body_mate);
  const Matrix3 by_seen = mate_jacobian(seen);
  filter.add_vehicle(id, T * T_body_mate, J.by_a,
                     J.by_b * (by_seen * seen.covariance * by_seen.transpose()) * J.by_b.transpose());
}

}  // namespace cairn
