// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo test of the filter's consistency: is its error as large as its covariance states? Both error states, and
// submaps with both joinings, run on the same data. Dead reckoning runs beside them and shows that the world is
// difficult enough.
//
// For a consistent filter, the NEES of the pose in the filter's own coordinates, averaged over M runs, is chi-square
// with 6 M degrees of freedom, divided by M, at every time (Bar-Shalom et al., Estimation with Applications, 5.4.2).
// The same holds for the NIS of a batch with its number of rows. Gates are open unless requested: associations are
// known, there are no outliers, and a gate would cut off the tails of the tested distribution.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tracker.hpp"

namespace {

using consistency::Kind;
using consistency::kTwoSided95;
using consistency::Noise;
using consistency::quantile;
using consistency::Setup;
using consistency::Tracker;
using consistency::World;

constexpr double kDegree = 3.14159265358979323846 / 180;

// Noise of velocity (m/s) and rate (rad/s), laps in 400 s, and landmarks of a submap: from almost linear to strongly
// nonlinear. Then the bounds of --check: the share of times at which the ANEES lies in its band; the largest ratio of
// the final errors with submaps and with a single map; and the smallest excess of the standard filter's ANEES/6 over
// that of the invariant filter.
struct Row {
  double velocity, rate;
  int laps;
  uint32_t submap_landmarks;
  double share, final_error, overconfidence;
};
constexpr Row kRows[] = {{0.002, 0.02 * kDegree, 1, 40, 0.85, 1.05, -1},
                         {0.05, 0.2 * kDegree, 1, 40, 0.85, 1.05, 0.04},
                         {0.05, 0.2 * kDegree, 2, 20, 0.85, 1.05, 0.02},
                         {0.2, 1.0 * kDegree, 2, 20, 0.60, 1.08, 0.4}};

struct Options {
  int row = 2, runs = 50;
  unsigned seed = 1;
  Setup setup;
  bool check = false;
};

Options read(int argc, char** argv) {
  Options o;
  int iterations = 0, seed = 1;
  for (int i = 1; i < argc; ++i) {
    const auto number = [&](const char* name, int low, int& out) {
      if (std::strcmp(argv[i], name) != 0 || i + 1 >= argc) return false;
      out = std::atoi(argv[++i]);
      return out >= low;
    };
    if (std::strcmp(argv[i], "--check") == 0) {
      o.check = true;
    } else if (std::strcmp(argv[i], "--gated") == 0) {
      o.setup.gated = true;
    } else if (std::strcmp(argv[i], "--huber") == 0 || std::strcmp(argv[i], "--cauchy") == 0) {
      o.setup.loss = argv[i][2] == 'h' ? CAIRN_LOSS_HUBER : CAIRN_LOSS_CAUCHY;
      o.setup.loss_width = i + 1 < argc ? std::atof(argv[++i]) : 0.0;  // the library refuses 0
    } else if (!number("--seed", 0, seed) && !(number("--row", 1, o.row) && o.row <= 4) &&
               !number("--runs", 1, o.runs) && !number("--iterations", 1, iterations)) {
      std::fprintf(stderr,
                   "usage: %s [--row 1..4] [--runs N] [--seed N] [--iterations N] [--gated] [--huber K] [--cauchy C] "
                   "[--check]\n",
                   argv[0]);
      std::exit(2);
    }
  }
  o.seed = static_cast<unsigned>(seed);
  o.setup.iterations = static_cast<uint32_t>(iterations);
  return o;
}

bool require(bool holds, const char* what, const char* who) {
  if (!holds) std::fprintf(stderr, "FAILED: %s: %s\n", who, what);
  return holds;
}

void print(const Tracker& t, const Tracker& single) {
  std::printf("%-15s %8.2f %8.2f", t.name(), t.final_metres(), t.final_degrees());
  if (t.sees())
    std::printf(" %8.3f %8.1f%% %8.3f %8.1f%%", t.anees(), 100 * t.nees_share(), t.nis_mean(), 100 * t.nis_share());
  if (t.has_submaps())
    std::printf("   %+5.1f%% m %+5.1f%% deg; %ld closings, %ld fused, %ld refused",
                100 * (t.final_metres() / single.final_metres() - 1),
                100 * (t.final_degrees() / single.final_degrees() - 1), t.closings(), t.fused(), t.refused());
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = read(argc, argv);
  const Row& row = kRows[options.row - 1];
  Noise noise;
  noise.velocity = row.velocity;
  noise.rate = row.rate;
  noise.bearing = 3 * kDegree;  // and 1 m (Mars paper, Table 1)
  Tracker dead({"dead reckoning", CAIRN_STATE_ERROR_INVARIANT, 0, CAIRN_JOIN_AUTO, false});
  Tracker standard({"standard", CAIRN_STATE_ERROR_STANDARD, 0, CAIRN_JOIN_AUTO, true});
  Tracker invariant({"invariant", CAIRN_STATE_ERROR_INVARIANT, 0, CAIRN_JOIN_AUTO, true});
  Tracker dense({"dense submaps", CAIRN_STATE_ERROR_INVARIANT, row.submap_landmarks, CAIRN_JOIN_DENSE, true});
  Tracker sparse({"sparse submaps", CAIRN_STATE_ERROR_INVARIANT, row.submap_landmarks, CAIRN_JOIN_SPARSE, true});
  Tracker* all[] = {&dead, &standard, &invariant, &dense, &sparse};
  for (int run = 0; run < options.runs; ++run) {
    World world(noise, row.laps, options.seed + static_cast<unsigned>(run));
    for (Tracker* t : all) t->start(noise, world.pose(0), options.setup);
    for (int step = 0; step < World::kSteps; ++step) {
      double velocity[3], rate[3];
      world.twist(step, velocity, rate);
      for (Tracker* t : all) t->predict(velocity, rate);
      if ((step + 1) % World::kStepsPerFrame != 0) continue;
      const cairn_pose truth = world.pose(step + 1);
      const std::vector<cairn_observation>& seen = world.look(step + 1);
      for (Tracker* t : all) t->update(step / World::kStepsPerFrame, seen, truth);
    }
    for (Tracker* t : all) t->finish(world.pose(World::kSteps));
  }

  std::printf("row %d: %g m/s, %g deg/s, %d lap(s), submaps of %u, %d runs; band of ANEES/6 [%.3f, %.3f]\n",
              options.row, row.velocity, row.rate / kDegree, row.laps, row.submap_landmarks, options.runs,
              quantile(6.0 * options.runs, -kTwoSided95) / (6 * options.runs),
              quantile(6.0 * options.runs, kTwoSided95) / (6 * options.runs));
  std::printf("%-15s %8s %8s %8s %9s %8s %9s   %s\n", "", "final m", "deg", "ANEES/6", "in band", "NIS/dof", "in band",
              "final error against invariant");
  for (const Tracker* t : all) print(*t, invariant);
  if (!options.check) return 0;
  // A consistent filter is inside the band at 95 % of the times on average, but its errors are correlated in time: of
  // 45 other seeds of row 2 with 40 runs, 41 had 85 % and more, and the median was 99 %. NIS is white: it was never
  // below 92 %, and its mean was within 0.7 % of 1. The ANEES of the standard filter exceeded that of the invariant one
  // by at least 0.08. Final errors with submaps were within 3 % of those of a single map; in row 4, within 4 %.
  bool good = require(standard.anees() > invariant.anees() + row.overconfidence, "seen to be the more confident",
                      standard.name());
  for (const Tracker* t : {&invariant, &dense, &sparse}) {
    good = require(t->nees_share() >= row.share, "ANEES in its band at most instants", t->name()) && good;
    good = require(t->nis_share() >= 0.90, "NIS in its band at 90 % of the instants", t->name()) && good;
    // The covariance of an M-estimator is exact only where observations determine the estimate, so that the mean NIS
    // with a loss is 1 to 1.5 % off.
    if (options.setup.loss == CAIRN_LOSS_NONE)
      good =
          require(std::abs(t->nis_deviation()) < 4, "mean NIS within 4 standard deviations of its rows", t->name()) &&
          good;
    const double most = row.final_error;
    good = require(t->final_metres() <= most * invariant.final_metres(), "final position as good as the single map's",
                   t->name()) &&
           good;
    good = require(t->final_degrees() <= most * invariant.final_degrees(), "final attitude as good as the single map's",
                   t->name()) &&
           good;
  }
  return good ? 0 : 1;
}
