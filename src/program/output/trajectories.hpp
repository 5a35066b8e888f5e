// SPDX-License-Identifier: BSD-3-Clause
// The trajectory of a vehicle: as it was estimated online, as it is known at the end, and the true one.
#pragma once

#include <cairn/cairn.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "program/output/geojson.hpp"

namespace cairn::program {

class Trajectories {
 public:
  // A step whose time is not known (NaN) gets its number.
  void add(double time, std::uint64_t number, const cairn_pose& pose, const std::optional<cairn_pose>& truth);
  // To be called once, after the last submap was closed. The filter has kept one pose for each step. If there were more
  // steps than a filter can keep poses, there is no corrected trajectory. Nor is there one without this call.
  void finish(const cairn_filter* filter);

  // Root mean square of the position error of the corrected poses, m; nothing if there is no truth
  // or no corrected trajectory.
  std::optional<double> corrected_rmse() const;
  // Writes trajectory_online.tum, trajectory_corrected.tum and, if there is truth, trajectory_truth.tum. Each line is
  // "timestamp x y z qx qy qz qw", the form that the tool evo reads. Each name begins with `prefix`.
  void write_tum(const std::string& folder, const std::string& prefix) const;
  void add_lines(GeoJson& file) const;

 private:
  struct Named {
    const char* name;
    std::vector<double> times;
    std::vector<cairn_pose> poses;
    void add(double time, const cairn_pose& pose) {
      times.push_back(time);
      poses.push_back(pose);
    }
  };
  // Those that have poses.
  std::vector<Named> named() const;

  std::vector<double> times_;
  std::vector<cairn_pose> online_, corrected_;
  std::vector<std::optional<cairn_pose>> truth_;
};

}  // namespace cairn::program
