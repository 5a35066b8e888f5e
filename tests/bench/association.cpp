// SPDX-License-Identifier: BSD-3-Clause
// Time of association of observations without ids. Prints one line of JSON:
//
//   association [LANDMARKS [OBSERVATIONS]]      mapped, and of a frame; default 1000 and 20
//
// Landmarks are random in a square, one for each 9 m2. A sensor of points sees in all directions, so every landmark has
// a predicted observation in every frame. A vehicle drives a circle and observes the nearest landmarks. The time is the
// wall clock time that the filter reports, over the frames after all landmarks are mapped.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <vector>

#include "cairn_run.hpp"
#include "samples.hpp"

namespace {

constexpr int kFrames = 60;
constexpr double kArea = 9.0, kSigma = 0.05, kRadius = 5.0, kStep = 0.05;  // m2, m, m, rad

struct Field {
  std::mt19937_64 engine{7};
  std::normal_distribution<double> normal;
  std::vector<double> x, y, z;

  explicit Field(int count) {
    const double side = std::sqrt(kArea * count);
    std::uniform_real_distribution<double> place(-0.5 * side, 0.5 * side);
    for (int i = 0; i < count; ++i) {
      x.push_back(place(engine));
      y.push_back(place(engine));
      z.push_back(0.5 * normal(engine));
    }
  }
  // Observations of the landmarks `order` from the pose.
  std::vector<cairn_observation> see(const cairn_pose& inverse, const int* begin, const int* end) {
    std::vector<cairn_observation> frame;
    for (const int* i = begin; i != end; ++i) {
      const double point[3] = {x[*i], y[*i], z[*i]};
      cairn_observation observation{};
      observation.id = CAIRN_ID_NONE;
      bench::check(cairn_pose_apply(&inverse, point, observation.z, nullptr));
      for (double& value : observation.z) value += kSigma * normal(engine);
      frame.push_back(observation);
    }
    return frame;
  }
};

cairn_pose on_circle(int frame) {
  const double angle = kStep * frame;
  const double turn[3] = {0, 0, angle};
  cairn_pose pose{};
  pose.position[0] = kRadius * std::sin(angle);
  pose.position[1] = kRadius * (1 - std::cos(angle));
  bench::check(cairn_quaternion_exp(turn, pose.quaternion, nullptr));
  return pose;
}

}  // namespace

int main(int argc, char** argv) try {
  const int landmarks = argc > 1 ? std::atoi(argv[1]) : 1000;
  const int seen = argc > 2 ? std::atoi(argv[2]) : 20;
  if (argc > 3 || seen < 1 || landmarks < seen || landmarks > 4096) {
    std::fprintf(stderr, "usage: association [LANDMARKS [OBSERVATIONS]], 4096 at most\n");
    return 2;
  }
  cairn_filter_options options;
  bench::check(cairn_filter_options_init(&options, sizeof options, nullptr));
  options.max_landmarks = static_cast<std::uint32_t>(landmarks + landmarks / 4);
  options.max_observations = static_cast<std::uint32_t>(seen);
  options.association = CAIRN_ASSOCIATION_JOINT;
  cairn_filter* filter = nullptr;
  bench::check(cairn_filter_create(&options, &filter, nullptr));
  cairn_cartesian cartesian;
  bench::check(cairn_cartesian_init(&cartesian, sizeof cartesian, nullptr));
  std::fill_n(cartesian.sigma, 3, kSigma);
  std::int32_t sensor = -1;
  bench::check(cairn_filter_add_cartesian(filter, &cartesian, &sensor, nullptr));

  Field field(landmarks);
  std::vector<int> order(static_cast<std::size_t>(landmarks));
  for (int i = 0; i < landmarks; ++i) order[static_cast<std::size_t>(i)] = i;
  const cairn_pose start = on_circle(0);
  for (int i = 0; i < landmarks; i += seen) {  // all landmarks are placed from the start pose
    const auto frame = field.see(start, order.data() + i, order.data() + std::min(i + seen, landmarks));
    bench::check(cairn_filter_update(filter, sensor, frame.data(), frame.size(), nullptr, nullptr));
  }
  bench::Samples times;
  double paired = 0, nodes = 0;
  for (int f = 1; f <= kFrames; ++f) {
    const cairn_pose before = on_circle(f - 1), pose = on_circle(f);
    cairn_pose inverse, increment;
    bench::check(cairn_pose_inverse(&before, &inverse, nullptr));
    bench::check(cairn_pose_compose(&inverse, &pose, &increment, nullptr));
    double covariance[36] = {};
    for (int i = 0; i < 6; ++i) covariance[7 * i] = i < 3 ? 1e-4 : 1e-6;
    for (double& value : increment.position) value += 1e-2 * field.normal(field.engine);
    bench::check(cairn_filter_predict_increment(filter, &increment, covariance, nullptr));
    bench::check(cairn_pose_inverse(&pose, &inverse, nullptr));
    const auto way = [&](int i) {
      return std::hypot(field.x[static_cast<std::size_t>(i)] - pose.position[0],
                        field.y[static_cast<std::size_t>(i)] - pose.position[1]);
    };
    std::partial_sort(order.begin(), order.begin() + seen, order.end(), [&](int a, int b) { return way(a) < way(b); });
    const auto frame = field.see(inverse, order.data(), order.data() + seen);
    bench::check(cairn_filter_update(filter, sensor, frame.data(), frame.size(), nullptr, nullptr));
    cairn_update_report report{};
    report.struct_size = sizeof report;
    bench::check(cairn_filter_last_update(filter, &report, nullptr));
    times.add(1e3 * report.association_seconds);
    paired += report.matched;
    nodes += report.association_nodes;
  }
  std::size_t mapped = 0;
  bench::check(cairn_map_size(cairn_filter_map(filter), &mapped, nullptr));
  std::printf(
      "{\"program\": \"cairn %s\", \"build\": \"%s\", \"landmarks\": %zu, \"observations\": %d, "
      "\"association_ms\": {\"mean\": %.6g, \"median\": %.6g, \"worst\": %.6g}, \"paired\": %.4g, "
      "\"nodes\": %.4g}\n",
      cairn_version(), cairn_build(), mapped, seen, times.mean(), times.quantile(0.5), times.quantile(1.0),
      paired / kFrames, nodes / kFrames);
  cairn_filter_destroy(filter);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "association: %s\n", error.what());
  return 1;
}
