// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/compare_table.hpp"

#include <cmath>
#include <cstdio>

namespace cairn::program {
namespace {

std::string number(double value, const char* format = "%.4g") {
  if (!std::isfinite(value)) return "-";
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

// The printed figure, then the measured one, for either filter.
std::string row(const std::string& name, const std::string& paper_standard, const std::string& standard,
                const std::string& paper_submaps, const std::string& submaps) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, "%-42s %9s %10s   %9s %10s\n", name.c_str(), paper_standard.c_str(),
                standard.c_str(), paper_submaps.c_str(), submaps.c_str());
  return buffer;
}

}  // namespace

// The paper counts 700 and 440 features in a world of 200, and does not say how: they cannot be the states of one
// filter. They are meant to show the work, by the size of the filter that processes the frames. That size is measured
// here.
std::string compare_table(const std::vector<Figure>& standard, const std::vector<Figure>& submaps) {
  const auto both = [&](const std::string& name, const char* key, const char* paper_standard,
                        const char* paper_submaps) {
    return row(name, paper_standard, number(value_of(standard, key)), paper_submaps, number(value_of(submaps, key)));
  };
  const double work =
      std::pow(value_of(submaps, "filter_landmarks_rms") / value_of(standard, "filter_landmarks_rms"), 2);
  const double time = value_of(submaps, "filter_seconds") / value_of(standard, "filter_seconds");
  std::string out = row("", "EKF-SLAM", "", "submaps", "") + row("", "paper", "measured", "paper", "measured");
  out += row("features in the state variables", "700", "", "440", "");
  out += both("  landmarks of the map at the end", "landmarks", "", "");
  out += both("  landmarks in the filter, at most", "filter_landmarks_max", "", "");
  out += both("  landmarks in the filter, mean of the steps", "filter_landmarks_mean", "", "");
  out += row("complexity, EKF-SLAM = 1", "1", "1", number(std::pow(440.0 / 700.0, 3), "%.3f"), "");
  out += row("  sum of squared landmarks in the filter", "", "1", "", number(work, "%.3f"));
  out += row("  time of the filter", "", "1", "", number(time, "%.3f"));
  out += both("time of the filter, s", "filter_seconds", "", "");
  out += both("largest error of position, an axis, m", "pose_axis_max_m", "<= 1", "<= 0.5");
  out += both("largest error of attitude, an axis, deg", "attitude_axis_max_deg", "<= 0.5", "<= 0.5");
  out += both("position error, RMS, m", "pose_rmse_m", "", "");
  out += both("attitude error, RMS, deg", "attitude_rmse_deg", "", "");
  out += both("error of the landmarks, RMS, m", "landmark_rmse_m", "", "");
  out += both("normalised error squared of the pose, / 6", "pose_anees_per_dof", "", "");
  out += both("submaps closed", "submaps", "", "");
  return out;
}

}  // namespace cairn::program
