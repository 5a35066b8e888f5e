// SPDX-License-Identifier: BSD-3-Clause
// Time of a step in a submap, and whether it depends on the size of the map. Prints one line of JSON:
//
//   submap_step [LANDMARKS]      of the large map; default 100000
//
// First, predict and update with 12 observations in an open submap of 60 landmarks are compared with one BLAS dsyrk of
// that size (186 states, 36 rows) in the same run. Then the steps of submaps of 60 landmarks are timed alternately with
// a map of 100 landmarks and with a map of LANDMARKS. Steps that close a submap are reported separately. Both drives
// have the same pattern of known and new landmarks. Processor time.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "course.hpp"
#include "samples.hpp"
#include "syrk.hpp"

namespace {

using bench::Course;

constexpr int kSubmap = 60, kSmall = 100, kRounds = 500;
constexpr int kWarm = 200;         // steps before the first sample
constexpr double kSpacing = 1.42;  // m, between landmarks along the ring

double radius_of(int landmarks) {
  return kSpacing * landmarks / 6.283185307179586;
}

// The steps of a drive. Steps that close a submap are kept separately.
struct Drive {
  Drive(int landmarks, int placed) : course(landmarks, radius_of(landmarks), kSubmap, CAIRN_JOIN_SPARSE) {
    course.drive((placed + Course::kAdvance - 1) / Course::kAdvance);
    submaps = course.filter().last_closing().submaps;
  }

  void step(bool counts) {
    course.advance();
    const bench::Stopwatch watch;
    course.predict_and_update();
    const double milliseconds = watch.milliseconds();
    const cairn_closing_report closing = course.filter().last_closing();
    bench::check(static_cast<cairn_status>(closing.status));
    const bool closed = closing.submaps != submaps;
    submaps = closing.submaps;
    if (!counts) return;
    (closed ? closings : steps).add(milliseconds);
    if (!closed) iterations += course.filter().last_update().iterations;
  }

  double mean_iterations() const { return iterations / static_cast<double>(steps.size()); }

  Course course;
  bench::Samples steps, closings;
  uint32_t submaps = 0;
  double iterations = 0;
};

void print_drive(const char* name, Drive& drive) {
  std::printf("\"%s\": {\"landmarks\": %zu, \"step_ms\": {\"mean\": %.6g, \"median\": %.6g}, ", name,
              drive.course.filter().landmarks(), drive.steps.mean(), drive.steps.median());
  std::printf("\"iterations\": %.3f, \"closings\": %zu, \"closing_ms\": {\"median\": %.6g, \"worst\": %.6g}}, ",
              drive.mean_iterations(), drive.closings.size(), drive.closings.median(), drive.closings.quantile(1.0));
}

}  // namespace

int main(int argc, char** argv) try {
  const int large = argc > 1 ? std::atoi(argv[1]) : 100000;
  if (argc > 2 || large < kSmall) {
    std::fprintf(stderr, "usage: submap_step [LANDMARKS], 100 or more\n");
    return 2;
  }
  std::printf("{\"program\": \"cairn %s\", \"build\": \"%s\", \"blas_core\": \"%s\", ", cairn_version(), cairn_build(),
              openblas_get_corename());

  // One more landmark would close the submap.
  Course open(kSubmap, radius_of(kSubmap), kSubmap + 1, CAIRN_JOIN_SPARSE);
  open.drive(kSubmap / Course::kAdvance + 2 + kWarm);
  constexpr std::size_t kStates = 6 + 3 * kSubmap, kRows = 3 * Course::kSeen;
  bench::Syrk syrk(kStates, kRows);
  bench::Samples steps, rows;
  for (int round = 0; round < kRounds; ++round) {
    open.advance();
    const bench::Stopwatch watch;
    open.predict_and_update();
    steps.add(watch.milliseconds());
    rows.add(open.filter().last_update().rows);
    if (round % 5 == 0) syrk.time(kStates, kRows);
  }
  std::printf("\"open_submap\": {\"landmarks\": %d, \"n\": %zu, \"m\": %.4g, ", kSubmap, kStates, rows.mean());
  std::printf("\"step_ms\": {\"mean\": %.6g, \"median\": %.6g}, ", steps.mean(), steps.median());
  std::printf("\"dsyrk_ms\": {\"mean\": %.6g, \"median\": %.6g}, ", syrk.hot.mean(), syrk.hot.median());
  std::printf("\"ratio\": {\"mean\": %.4g, \"median\": %.4g}}, ", steps.mean() / syrk.hot.mean(),
              steps.median() / syrk.hot.median());
  std::fflush(stdout);

  // The large ring is not driven to its end: it has landmarks left for the timed rounds.
  Drive small_map(kSmall, 2 * kSmall), large_map(large + (kRounds + kWarm + 4) * Course::kAdvance, large);
  for (int round = -kWarm; round < kRounds; ++round) {
    small_map.step(round >= 0);
    large_map.step(round >= 0);
  }
  print_drive("small_map", small_map);
  print_drive("large_map", large_map);
  std::printf("\"large_to_small\": {\"mean\": %.4g, \"median\": %.4g}}\n",
              large_map.steps.mean() / small_map.steps.mean(), large_map.steps.median() / small_map.steps.median());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "submap_step: %s\n", error.what());
  return 2;
}
