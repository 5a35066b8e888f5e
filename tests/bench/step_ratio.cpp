// SPDX-License-Identifier: BSD-3-Clause
// Runs the library over a neutral log and, between steps, one BLAS dsyrk of the same size: the arithmetic that every
// dense update needs. Prints one line of JSON with the times, their ratio, and the heap allocations of the steps.
//
//   step_ratio LOG
//
// Every few steps of the second half, the dsyrk of the size of this step is timed (syrk.hpp).
#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>

#include "cairn_run.hpp"
#include "heap_count.hpp"
#include "samples.hpp"
#include "syrk.hpp"

namespace {

constexpr std::size_t kInterval = 5;  // steps between two series of dsyrk calls

struct Result {
  bench::Samples steps, states, rows;
  std::size_t rejected = 0, allocations = 0;
  bench::SquaredError pose, map;
};

std::size_t most_sightings(const bench::Log& log) {
  std::size_t most = 1;
  for (const bench::Step& step : log.steps) most = std::max(most, step.sightings.size());
  return most;
}

std::size_t landmarks_seen(const bench::Log& log) {
  std::set<std::uint64_t> ids;
  for (const bench::Step& step : log.steps) {
    for (const bench::Sighting& sighting : step.sightings) ids.insert(sighting.id);
  }
  return std::max<std::size_t>(ids.size(), 1);
}

void score_map(bench::Filter& filter, const bench::Log& log, bench::SquaredError& error) {
  for (const auto& [id, truth] : log.landmarks) {
    cairn_landmark landmark;
    if (cairn_map_landmark(cairn_filter_map(filter.get()), id, &landmark, nullptr) == CAIRN_OK) {
      error.add(landmark.position, truth);
    }
  }
}

Result run(const bench::Log& log, bench::Syrk& syrk, std::size_t max_landmarks) {
  bench::Filter filter(max_landmarks, most_sightings(log), bench::pose_of(log.steps.front().truth));
  Result result;
  result.steps.reserve(log.steps.size());
  for (std::size_t k = 0; k < log.steps.size(); ++k) {
    const bench::Step& step = log.steps[k];
    const std::vector<cairn_observation> observations = bench::observations_of(step);
    const cairn_pose increment = bench::pose_of(step.increment.value_or(bench::Vector6{}));
    const std::size_t before = bench::heap_allocations();
    const bench::Stopwatch watch;
    if (step.increment) filter.predict(increment);
    filter.update(observations);
    const double milliseconds = watch.milliseconds();
    if (k > 0) result.allocations += bench::heap_allocations() - before;

    const cairn_update_report report = filter.last_update();
    result.rejected += report.rejected;
    cairn_pose pose;
    bench::check(cairn_filter_pose(filter.get(), &pose, nullptr, nullptr));
    result.pose.add(pose.position, step.truth);
    if (2 * k < log.steps.size()) continue;
    const std::size_t states = 6 + 3 * filter.landmarks();
    result.steps.add(milliseconds);
    result.states.add(static_cast<double>(states));
    result.rows.add(report.rows);
    if (k % kInterval == 0 && report.rows > 0) syrk.time(states, report.rows);
  }
  score_map(filter, log, result.map);
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: step_ratio LOG\n");
    return 2;
  }
  const bench::Log log = bench::read_log(argv[1]);
  const std::size_t landmarks = landmarks_seen(log);
  bench::Syrk syrk(6 + 3 * landmarks, 3 * most_sightings(log));
  const Result r = run(log, syrk, landmarks);
  std::printf("{\"program\": \"cairn %s\", \"build\": \"%s\", \"blas_core\": \"%s\", ", cairn_version(), cairn_build(),
              openblas_get_corename());
  std::printf("\"landmarks\": %zu, \"n\": %.0f, \"m\": %.4g, \"rejected\": %zu, ", landmarks, r.states.median(),
              r.rows.mean(), r.rejected);
  std::printf("\"step_ms_second_half\": {\"mean\": %.6g, \"median\": %.6g}, ", r.steps.mean(), r.steps.median());
  std::printf("\"dsyrk_ms\": {\"mean\": %.6g, \"median\": %.6g}, ", syrk.hot.mean(), syrk.hot.median());
  std::printf("\"dsyrk_cold_ms\": {\"mean\": %.6g, \"median\": %.6g}, ", syrk.cold.mean(), syrk.cold.median());
  std::printf("\"ratio\": {\"mean\": %.4g, \"median\": %.4g}, ", r.steps.mean() / syrk.hot.mean(),
              r.steps.median() / syrk.hot.median());
  std::printf("\"heap_allocations\": %zu, \"pose_rmse_m\": %.6g, \"landmark_rmse_m\": %.6g}\n", r.allocations,
              r.pose.rms(), r.map.rms());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "step_ratio: %s\n", error.what());
  return 2;
}
