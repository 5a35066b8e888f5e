// SPDX-License-Identifier: BSD-3-Clause
// The trajectory of a run: as it was estimated online, as it is known at the end, and the true one.
#pragma once

#include <cairn/cairn.h>

#include <optional>
#include <string>
#include <vector>

#include "program/runners/runner.hpp"

namespace cairn::program {

class Trajectories {
 public:
  void add(const DriveStep& step, const StepResult& result);
  // To be called once, after the last submap was closed. The filter has kept one pose for each step. If there were more
  // steps than a filter can keep poses, there is no corrected trajectory.
  void finish(const cairn_filter* filter);

  // Root mean square of the position error of the corrected poses, m; nothing if there is no truth
  // or no corrected trajectory.
  std::optional<double> corrected_rmse() const;
  // Writes trajectory_online.tum, trajectory_corrected.tum and, if there is truth, trajectory_truth.tum. Each line is
  // "timestamp x y z qx qy qz qw", the form that the tool evo reads. A log without times gets the numbers of its steps.
  void write(const std::string& folder) const;

 private:
  template <class AnyPose>
  void write_tum(const std::string& folder, const char* name, const std::vector<AnyPose>& poses) const;

  std::vector<double> times_;
  std::vector<cairn_pose> online_, corrected_;
  std::vector<std::optional<cairn_pose>> truth_;
};

}  // namespace cairn::program
