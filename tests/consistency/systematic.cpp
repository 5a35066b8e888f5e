// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo test of systematic errors as states (docs/systematic_errors.md): a rover whose velocity, rate, wheels and
// head are wrong, in worlds of libcairn_sim. The errors of each world are drawn from the filter's prior. The same
// worlds without errors, and a filter that does not know about them, run beside it.
//
// The NEES of the pose, averaged over the worlds, has to lie in its 95 % band at most times, and the error must not be
// much larger than that of a rover without errors.
//
// Rows "drawn small" show what is possible. All that is drawn is a thousandth of its size, and the filter keeps the
// stated size. Such a filter is linearised at the truth, so its covariance is the Cramer-Rao bound, and it is
// consistent. Errors and NEES are printed in units of what is drawn.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "rover.hpp"
#include "tracker.hpp"

namespace {

using consistency::Follower;
using consistency::kTwoSided95;
using consistency::quantile;
using consistency::Score;

constexpr double kSmall = 1e-3;

struct Options {
  consistency::Rover rover;
  int runs = 50, seed = 1;
  int sets = 1;           // disjoint sets of `runs` worlds
  const char* only = "";  // only the rows whose name has this part
  double check = 0;       // bound of the ratio to a rover without errors; 0: no check
};

constexpr Follower kFollowers[] = {{"clean, drawn small", false, false, 0, CAIRN_JOIN_AUTO, kSmall},
                                   {"errors as states, drawn small", true, true, 0, CAIRN_JOIN_AUTO, kSmall},
                                   {"clean, single map", false, false, 0, CAIRN_JOIN_AUTO, 1},
                                   {"clean, submaps of 40", false, false, 40, CAIRN_JOIN_SPARSE, 1},
                                   {"errors ignored", true, false, 0, CAIRN_JOIN_AUTO, 1},
                                   {"errors as states, single map", true, true, 0, CAIRN_JOIN_AUTO, 1},
                                   {"errors as states, dense submaps of 40", true, true, 40, CAIRN_JOIN_DENSE, 1},
                                   {"errors as states, sparse submaps of 40", true, true, 40, CAIRN_JOIN_SPARSE, 1}};

// Means over runs and steps.
struct Figures {
  double rmse = 0, sensor_rmse = 0;
  double sigma = 0;  // root of the trace of the covariance of the position
  double anees = 0;  // by degree of freedom
  double share = 0;  // of the steps at which the ANEES is in its band
};

Figures figures_of(const Score& score, int runs) {
  const double steps = static_cast<double>(score.steps), dof = 6.0 * runs;
  Figures f;
  f.rmse = std::sqrt(score.squares / steps);
  f.sensor_rmse = std::sqrt(score.sensor_squares / steps);
  f.sigma = std::sqrt(score.variance / steps);
  const double counted = static_cast<double>(score.nees.size() - 1);
  for (std::size_t k = 1; k < score.nees.size(); ++k) {
    f.anees += score.nees[k] / dof / counted;
    if (score.nees[k] >= quantile(dof, -kTwoSided95) && score.nees[k] <= quantile(dof, kTwoSided95))
      f.share += 1 / counted;
  }
  return f;
}

void add(const Score& score, Score& sum) {
  sum.nees.resize(score.nees.size(), 0.0);
  for (std::size_t k = 0; k < score.nees.size(); ++k) sum.nees[k] += score.nees[k];
  sum.squares += score.squares, sum.sensor_squares += score.sensor_squares;
  sum.variance += score.variance, sum.steps += score.steps;
}

// Drives through all sets. Prints the share in band of each set if there is more than one.
Score drive_all(const Options& o, const Follower& follower) {
  Score sum;
  std::vector<double> shares;
  for (int set = 0; set < o.sets; ++set) {
    Score score;
    for (int i = 0; i < o.runs; ++i) consistency::drive(o.rover, follower, o.seed + set * o.runs + i, score);
    shares.push_back(100 * figures_of(score, o.runs).share);
    add(score, sum);
  }
  if (o.sets == 1) return sum;
  std::printf("%s: in band in each set, %%:", follower.name);
  for (const double share : shares) std::printf(" %.0f", share);
  const double dof = 6.0 * o.runs * o.sets;
  const std::size_t last = sum.nees.size() - 1;
  std::printf("; ANEES/6 at a quarter, a half and the end: %.3f %.3f %.3f, 95 %% band %.3f to %.3f\n",
              sum.nees[last / 4] / dof, sum.nees[last / 2] / dof, sum.nees[last] / dof,
              quantile(dof, -kTwoSided95) / dof, quantile(dof, kTwoSided95) / dof);
  return sum;
}

// The value that follows the option argv[i], or the end of the program.
const char* value_of(int argc, char** argv, int& i) {
  if (i + 1 < argc) return argv[++i];
  std::fprintf(stderr, "%s needs a value\n", argv[i]);
  std::exit(2);
}

Options read(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0; };
    if (is("--check")) {
      o.check = std::atof(value_of(argc, argv, i));
    } else if (is("--wheels")) {
      o.rover.wheels = true;
    } else if (is("--known-mount")) {
      o.rover.known_mount = true;
    } else if (is("--only")) {
      o.only = value_of(argc, argv, i);
    } else if (is("--runs")) {
      o.runs = std::max(1, std::atoi(value_of(argc, argv, i)));
    } else if (is("--sets")) {
      o.sets = std::max(1, std::atoi(value_of(argc, argv, i)));
    } else if (is("--preset")) {
      o.rover.preset = std::atoi(value_of(argc, argv, i));
    } else if (is("--laps")) {
      o.rover.laps = std::atof(value_of(argc, argv, i));
    } else if (is("--camera-noise")) {
      o.rover.camera_noise = std::atof(value_of(argc, argv, i));
    } else if (is("--rate-bias")) {
      o.rover.rate = std::atof(value_of(argc, argv, i));
    } else if (is("--velocity-bias")) {
      o.rover.velocity = std::atof(value_of(argc, argv, i));
    } else if (is("--seed")) {
      o.seed = std::atoi(value_of(argc, argv, i));
    } else {
      std::fprintf(stderr,
                   "usage: %s [--wheels] [--known-mount] [--rate-bias R] [--velocity-bias V] [--preset N] [--laps N] "
                   "[--camera-noise TIMES] [--only PART] [--runs N] [--sets N] [--seed N] [--check RATIO]\n",
                   argv[0]);
      std::exit(2);
    }
  }
  return o;
}

// A short run has a wide band, but few worlds: its share of times varies more. To know the errors has to be worth much:
// a third of the error without states at most. The same draws at a small size say what these worlds allow; submaps and
// the size of the errors cost 5 % of that.
bool passes(const Options& o, const Figures& f, const Figures& clean, const Figures& small, double ignored) {
  constexpr double kMargin = 1.2;
  return f.rmse <= o.check * clean.rmse && f.rmse <= ignored / 3 && f.rmse <= kMargin * small.rmse &&
         f.share >= (o.runs < 50 ? 0.75 : 0.90);
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = read(argc, argv);
  std::printf("%d worlds, %s\n", o.runs * o.sets, o.rover.wheels ? "wheels and gyro" : "velocity and rate");
  Figures clean, small;  // a rover without errors; errors as states, drawn small
  double ignored = 0.0;
  bool good = true;
  for (const Follower& follower : kFollowers) {
    if (std::strstr(follower.name, o.only) == nullptr) continue;
    const Figures f = figures_of(drive_all(o, follower), o.runs * o.sets);
    std::printf("%-40s pose RMSE %.3f m, sigma %.3f m, ANEES/6 %.2f, in band %.0f %%", follower.name, f.rmse, f.sigma,
                f.anees, 100 * f.share);
    if (!follower.wrong && follower.submap_landmarks == 0) clean = f;
    if (clean.rmse > 0.0)
      std::printf(", ratio %.2f, of sigma %.2f; as the sensor sees it %.3f m, ratio %.2f", f.rmse / clean.rmse,
                  f.sigma / clean.sigma, f.sensor_rmse, f.sensor_rmse / clean.sensor_rmse);
    std::printf("\n");
    if (follower.knows && follower.drawn == kSmall) small = f;
    if (follower.wrong && !follower.knows) ignored = f.rmse;
    if (o.check > 0 && follower.knows && follower.drawn == 1 && !passes(o, f, clean, small, ignored)) {
      std::fprintf(stderr, "FAILED: %s\n", follower.name);
      good = false;
    }
  }
  return good ? 0 : 1;
}
