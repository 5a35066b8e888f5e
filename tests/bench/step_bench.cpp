// SPDX-License-Identifier: BSD-3-Clause
// Steps of the filter and their parts, through the C functions. Only the named calls are timed, in processor time and
// by hand, so that drawing the next frame and other programs are not measured.
#include <benchmark/benchmark.h>

#include "course.hpp"
#include "samples.hpp"

namespace {

using bench::Course;

template <class Call>
void timed(benchmark::State& state, const Call& call) {
  const bench::Stopwatch watch;
  call();
  state.SetIterationTime(1e-3 * watch.milliseconds());
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgName("landmarks")->Arg(60)->Arg(200)->Arg(354)->Arg(1000)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

// Predict and update, 12 observations.
void step(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  double rows = 0.0, refused = 0.0;
  for (auto _ : state) {
    course.advance();
    timed(state, [&] { course.predict_and_update(); });
    const cairn_update_report report = course.filter().last_update();
    rows += report.rows;
    refused += report.rejected;
  }
  state.counters["rows"] = benchmark::Counter(rows, benchmark::Counter::kAvgIterations);
  state.counters["rejected"] = benchmark::Counter(refused, benchmark::Counter::kAvgIterations);
  state.SetLabel(cairn_build());
}
BENCHMARK(step)->Apply(sizes);

// One update right after one prediction, by the number of observations: the cost of more rows.
void update_of(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  const auto count = static_cast<std::size_t>(state.range(1));
  for (auto _ : state) {
    course.advance();
    course.predict();
    std::vector<cairn_observation> some = course.observations();
    some.resize(count);
    timed(state, [&] { course.filter().update(some); });
  }
}
BENCHMARK(update_of)
    ->ArgNames({"landmarks", "observations"})
    ->ArgsProduct({{60, 354}, {0, 1, 3, 6, 12}})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

// Three rows that depend on the pose only: no Jacobian of a landmark, the same covariance.
void update_position(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  const double covariance[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  for (auto _ : state) {
    course.advance();
    course.predict();
    const cairn_pose pose = course.estimate();
    timed(state, [&] {
      bench::check(cairn_filter_update_position(course.handle(), pose.position, covariance, nullptr, nullptr, nullptr));
    });
  }
}
BENCHMARK(update_position)->Apply(sizes);

// One row.
void update_heading(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    course.advance();
    course.predict();
    const cairn_pose pose = course.estimate();
    double roll = 0.0, pitch = 0.0, yaw = 0.0;
    bench::check(cairn_quaternion_to_euler(pose.quaternion, &roll, &pitch, &yaw, nullptr));
    timed(state, [&] { bench::check(cairn_filter_update_heading(course.handle(), yaw, 0.05, nullptr, nullptr)); });
  }
}
BENCHMARK(update_heading)->Apply(sizes);

// The cost of a prediction does not depend on the size of the map. Here many predictions follow one another without an
// update, at the rate of an inertial sensor. The growing covariance is not used.
void predict_increment(benchmark::State& state) {
  Course course(static_cast<int>(state.range(0)));
  cairn_pose increment;
  bench::check(cairn_pose_identity(&increment, nullptr));
  increment.position[0] = 1e-3;
  for (auto _ : state) course.filter().predict(increment);
}
BENCHMARK(predict_increment)->ArgName("landmarks")->Arg(60)->Arg(1000);

void predict_twist(benchmark::State& state) {
  Course course(60);
  const double velocity[3] = {1.0, 0.0, 0.0}, rate[3] = {0.0, 0.0, 0.1};
  for (auto _ : state) bench::check(cairn_filter_predict_twist(course.handle(), 0.01, velocity, rate, nullptr));
}
BENCHMARK(predict_twist);

void predict_wheels(benchmark::State& state) {
  Course course(60);
  for (auto _ : state) bench::check(cairn_filter_predict_wheels(course.handle(), 0.01, 3.0, 3.1, nullptr));
}
BENCHMARK(predict_wheels);

}  // namespace
