// SPDX-License-Identifier: BSD-3-Clause
// The drive of the tests that compare submaps with a single map: two rounds on a ring of landmarks that are observed
// directly, with the attitude known at the start.
#pragma once

#include <cmath>
#include <vector>

#include "numerical.hpp"
#include "slam/filter.hpp"

namespace cairn::test {

constexpr int kRingSteps = 120;

template <class Pose>
struct RingVehicle {
  explicit RingVehicle(const FilterOptions<Pose>& options)
      : arena(Filter<Pose>::arena_bytes(options)), filter(arena, options) {
    Cartesian<Pose> sensor;
    filter.add(sensor);
  }
  Arena arena;
  Filter<Pose> filter;
};

template <class Pose>
FilterOptions<Pose> ring_options(ErrorKind error, Index submap_landmarks, JoinKind join) {
  using Space = Embedding<Pose>;
  FilterOptions<Pose> options;
  options.error = error;
  options.max_landmarks = 60;
  options.max_observations = 16;
  options.submap_landmarks = submap_landmarks;
  options.join = join;
  options.gate_probability = 1.0;
  options.batch_gate_probability = 1.0;
  options.step_tolerance = 1e-12;
  options.initial_pose = Space::down(SE3(SO3::exp(Vector3(0.1, -0.2, 0.7)), Vector3(10, -5, 2)));
  options.initial_covariance.template topLeftCorner<Pose::kDim, Pose::kDim>() =
      Space::down(Vector3(0.04, 0.01, 0.09)).asDiagonal();
  return options;
}

template <class Pose>
std::vector<typename Pose::Point> ring_landmarks() {
  std::vector<typename Pose::Point> landmarks;
  for (int i = 0; i < 30; ++i)
    landmarks.push_back(
        Embedding<Pose>::down(Vector3(12 * std::cos(0.21 * i), 12 * std::sin(0.21 * i), 0.5 * std::sin(1.3 * i))));
  return landmarks;
}

// Observations of at most 16 landmarks within 9 m, with a noise of 0.1 m.
template <class Pose>
std::vector<Observation> see_ring(const Pose& truth, const std::vector<typename Pose::Point>& landmarks,
                                  Random& random) {
  constexpr int kDim = Pose::kDim;
  using Point = typename Pose::Point;
  std::vector<Observation> seen;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Point y = truth.inverse() * landmarks[i];
    if (y.norm() > 9.0 || seen.size() == 16) continue;
    Observation observation{i, {}, {}};
    const Point z = y + 0.1 * random.normal_vector<kDim>();
    for (int d = 0; d < kDim; ++d) {
      observation.z[d] = z(d);
      observation.covariance[(kDim + 1) * d] = 0.01;
    }
    seen.push_back(observation);
  }
  return seen;
}

inline double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

}  // namespace cairn::test
