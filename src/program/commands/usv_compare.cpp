// SPDX-License-Identifier: BSD-3-Clause
#include "program/commands/usv_compare.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "program/drives/fleet_drive.hpp"

namespace cairn::program {
namespace {

constexpr std::uint32_t kFeatures[] = {6, 10, 40};
constexpr double kPaper[] = {50, 40, 30};  // improvement that the cooperative paper claims, %
constexpr std::int32_t kModes[] = {CAIRN_TEAM_MONO, CAIRN_TEAM_EO_DIAGONAL, CAIRN_TEAM_EO_FULL, CAIRN_TEAM_SUBMAPS,
                                   CAIRN_TEAM_JOINT};

// Sums over runs.
struct Sums {
  VehicleScore score;
  std::vector<double> nees, count;  // by step
  double seconds = 0, recursions = 0;
};

void add(const TeamResult& result, Sums& sums) {
  sums.score.add(result.vehicles[0]);
  sums.seconds += result.seconds;
  sums.recursions += static_cast<double>(result.recursions);
  sums.nees.resize(result.nees_by_step.size());
  sums.count.resize(result.nees_by_step.size());
  for (std::size_t k = 0; k < result.nees_by_step.size(); ++k) {
    if (!std::isfinite(result.nees_by_step[k])) continue;
    sums.nees[k] += result.nees_by_step[k];
    sums.count[k] += 1;
  }
}

// Share of the steps whose mean over the runs lies in the 95 % band of its chi-square (Wilson and Hilferty), and the
// band.
double share_in_band(const Sums& sums, double runs, double band[2]) {
  const double dof = 3 * runs;
  for (int side = 0; side < 2; ++side) {
    const double z = side == 0 ? -1.959963984540054 : 1.959963984540054;
    band[side] = std::pow(1 - 2 / (9 * dof) + z * std::sqrt(2 / (9 * dof)), 3);
  }
  double inside = 0, all = 0;
  for (std::size_t k = 0; k < sums.nees.size(); ++k) {
    if (sums.count[k] < runs) continue;
    const double mean = sums.nees[k] / (3 * runs);
    all += 1;
    inside += mean >= band[0] && mean <= band[1];
  }
  return inside / all;
}

template <class... Values>
std::string print(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

}  // namespace

std::size_t compared_runs(const UsvOptions& options) {
  return std::size(kFeatures) * std::size(kModes) * options.runs;
}

cairn_fleet_options compared_scene(const UsvOptions& options) {
  cairn_fleet_options fleet = options.fleet;
  fleet.features = *std::max_element(std::begin(kFeatures), std::end(kFeatures));
  fleet.seed = options.common.seed;
  return fleet;
}

void compare_modes(const UsvOptions& options, const std::function<void()>& advance, std::string& table,
                   std::string& object, std::string& rows, StepTable& steps) {
  table = print("%9s  %-12s %12s %12s %10s %8s %10s %12s %7s\n", "features", "mode", "claimed", "true", "ANEES/3",
                "in band", "RMSE", "ms/recursion", "paper");
  rows = "features,mode,claimed,true,anees,in_band,band_low,band_high,rmse_m,landmark_rmse_m,recursion_ms,paper\n";
  object = "{";
  for (std::size_t f = 0; f < std::size(kFeatures); ++f) {
    VehicleScore alone;
    for (const std::int32_t mode : kModes) {
      Sums sums;
      for (std::uint32_t run = 0; run < options.runs; ++run) {
        cairn_fleet_options fleet = options.fleet;
        fleet.features = kFeatures[f];
        fleet.seed = options.common.seed + run;
        FleetDrive drive(fleet);
        TeamChoices choices = options.team;
        choices.mode = mode;
        TeamRunner runner(drive, choices);
        steps.begin_run(kFeatures[f], mode, drive.vehicles());
        const auto add_step = [&](const TeamStep& step, const std::vector<VehicleEstimate>& estimates) {
          steps.add(step.time, estimates);
        };
        add(runner.run(add_step), sums);
        advance();
      }
      if (mode == CAIRN_TEAM_MONO) alone = sums.score;
      double band[2];
      const double inside = share_in_band(sums, options.runs, band);
      const double claimed = 100 * (1 - sums.score.claimed / alone.claimed);
      const double honest = 100 * (1 - sums.score.square_error / alone.square_error);
      const double ms = 1e3 * sums.seconds / sums.recursions;
      const char* name = kModeNames[static_cast<std::size_t>(mode)];
      const std::string paper = mode == CAIRN_TEAM_EO_DIAGONAL ? print("%.0f %%", kPaper[f]) : std::string();
      table += print("%9u  %-12s %10.1f %% %10.1f %% %10.2f %6.0f %% %8.2f m %12.4f %7s\n", kFeatures[f], name, claimed,
                     honest, sums.score.anees(), 100 * inside, sums.score.rmse(), ms, paper.c_str());
      rows += print("%u,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.0f\n", kFeatures[f], name, claimed, honest,
                    sums.score.anees(), inside, band[0], band[1], sums.score.rmse(), sums.score.landmark_rmse(), ms,
                    kPaper[f]);
      object += object.size() > 1 ? ", " : "";
      object += print("\"%s_%u\": {\"claimed_improvement\": %.6g, \"true_improvement\": %.6g, ", name, kFeatures[f],
                      claimed / 100, honest / 100);
      object += print(
          "\"pose_anees_per_dof\": %.6g, \"in_band\": %.6g, \"pose_rmse_m\": %.6g, \"landmark_rmse_m\": %.6g, "
          "\"recursion_ms_mean\": %.6g}",
          sums.score.anees(), inside, sums.score.rmse(), sums.score.landmark_rmse(), ms);
    }
  }
  object += "}";
}

}  // namespace cairn::program
