// SPDX-License-Identifier: BSD-3-Clause
// Queries of a filter and of its map.
#include <benchmark/benchmark.h>

#include <numeric>

#include "course.hpp"

namespace {

using bench::Course;

const cairn_map* map_of(Course& course) {
  return cairn_filter_map(course.handle());
}

void pose(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  cairn_pose estimate;
  double covariance[36];
  for (auto _ : state) {
    bench::check(cairn_filter_pose(course.handle(), &estimate, covariance, nullptr));
    benchmark::DoNotOptimize(covariance);
  }
}
BENCHMARK(pose)->ArgName("landmarks")->Arg(60)->Arg(1000);

void landmark_by_id(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  cairn_landmark landmark;
  uint64_t id = 0;
  for (auto _ : state) {
    bench::check(cairn_map_landmark(map_of(course), id, &landmark, nullptr));
    benchmark::DoNotOptimize(landmark);
    id = (id + 17) % static_cast<uint64_t>(course.landmarks());
  }
}
BENCHMARK(landmark_by_id)->ArgName("landmarks")->Arg(60)->Arg(1000);

void all_landmarks(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  std::vector<cairn_landmark> landmarks(static_cast<std::size_t>(course.landmarks()));
  std::size_t needed = 0;
  for (auto _ : state) {
    bench::check(cairn_map_landmarks(map_of(course), landmarks.data(), landmarks.size(), &needed, nullptr));
    benchmark::DoNotOptimize(landmarks.data());
  }
}
BENCHMARK(all_landmarks)->ArgName("landmarks")->Arg(60)->Arg(1000)->Unit(benchmark::kMicrosecond);

void within(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  std::vector<cairn_landmark> landmarks(static_cast<std::size_t>(course.landmarks()));
  const cairn_pose centre = course.estimate();
  std::size_t needed = 0;
  for (auto _ : state) {
    bench::check(
        cairn_map_within(map_of(course), centre.position, 30.0, landmarks.data(), landmarks.size(), &needed, nullptr));
    benchmark::DoNotOptimize(landmarks.data());
  }
  state.counters["found"] = static_cast<double>(needed);
}
BENCHMARK(within)->ArgName("landmarks")->Arg(60)->Arg(1000)->Unit(benchmark::kMicrosecond);

void nearest(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  cairn_landmark landmarks[10];
  const cairn_pose centre = course.estimate();
  std::size_t needed = 0;
  for (auto _ : state) {
    bench::check(cairn_map_nearest(map_of(course), centre.position, 10, landmarks, 10, &needed, nullptr));
    benchmark::DoNotOptimize(landmarks);
  }
}
BENCHMARK(nearest)->ArgName("landmarks")->Arg(60)->Arg(1000)->Unit(benchmark::kMicrosecond);

void joint_covariance(benchmark::State& state) {
  Course course(1000);
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<uint64_t> ids(count);
  std::iota(ids.begin(), ids.end(), 100u);
  std::vector<double> matrix((6 + 3 * count) * (6 + 3 * count));
  std::size_t needed = 0;
  for (auto _ : state) {
    bench::check(cairn_filter_joint_covariance(course.handle(), ids.data(), count, matrix.data(), matrix.size(),
                                               &needed, nullptr));
    benchmark::DoNotOptimize(matrix.data());
  }
}
BENCHMARK(joint_covariance)->ArgName("chosen")->Arg(1)->Arg(12)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
