// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/trajectories.hpp"

#include <cmath>
#include <cstdio>

#include "program/library.hpp"
#include "program/output/output_file.hpp"

namespace cairn::program {
namespace {

std::string tum_line(double time, const cairn_pose& pose) {
  const double *p = pose.position, *q = pose.quaternion;
  char line[256];
  std::snprintf(line, sizeof line, "%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", time, p[0], p[1], p[2], q[1],
                q[2], q[3], q[0]);
  return line;
}

}  // namespace

void Trajectories::add(const DriveStep& step, const StepResult& result) {
  times_.push_back(std::isnan(step.time) ? static_cast<double>(step.number) : step.time);
  online_.push_back(result.pose);
  truth_.push_back(step.truth);
}

void Trajectories::finish(const cairn_filter* filter) {
  std::uint64_t first = 0;
  check(cairn_filter_trajectory_range(filter, &first, nullptr, nullptr));
  if (first > 0) return;
  std::size_t count = 0;
  check(cairn_filter_trajectory(filter, 0, nullptr, 0, &count, nullptr));
  corrected_.resize(count);
  check(cairn_filter_trajectory(filter, 0, corrected_.data(), count, &count, nullptr));
}

std::optional<double> Trajectories::corrected_rmse() const {
  if (corrected_.empty()) return std::nullopt;
  double sum = 0;
  std::size_t scored = 0;
  for (std::size_t k = 0; k < truth_.size(); ++k) {
    if (!truth_[k]) continue;
    for (int i = 0; i < 3; ++i) sum += std::pow(truth_[k]->position[i] - corrected_[k].position[i], 2);
    ++scored;
  }
  if (scored == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(scored));
}

// Writes no file if there are no poses.
template <class AnyPose>
void Trajectories::write_tum(const std::string& folder, const char* name, const std::vector<AnyPose>& poses) const {
  std::optional<OutputFile> file;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const std::optional<cairn_pose> pose = poses[k];
    if (!pose) continue;
    if (!file) file.emplace(folder, name);
    file->text(tum_line(times_[k], *pose));
  }
  if (file) file->close();
}

void Trajectories::write(const std::string& folder) const {
  write_tum(folder, "trajectory_online.tum", online_);
  write_tum(folder, "trajectory_corrected.tum", corrected_);
  write_tum(folder, "trajectory_truth.tum", truth_);
}

}  // namespace cairn::program
