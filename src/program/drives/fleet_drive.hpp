// SPDX-License-Identifier: BSD-3-Clause
// Boats with radar: the world of the cooperative paper.
#pragma once

#include <cairn/fleet.h>

#include <memory>

#include "program/drives/team_drive.hpp"

namespace cairn::program {

class FleetDrive : public TeamDrive {
 public:
  explicit FleetDrive(const cairn_fleet_options& options);

  const std::vector<std::uint64_t>& vehicles() const override { return numbers_; }
  std::size_t steps() const override { return steps_; }
  cairn_pose start(std::size_t vehicle) const override { return starts_[vehicle]; }
  cairn_range_bearing radar() const override;
  std::uint32_t landmarks() const override { return options_.features; }
  std::uint32_t largest_frame() const override { return options_.features + options_.vehicles; }
  double submap_distance() const override { return options_.course_length / 16; }
  bool next(TeamStep& step) override;
  bool true_landmark(std::uint64_t id, double position[2]) const override;
  const cairn_fleet* fleet() const { return fleet_.get(); }

 private:
  using Seen = cairn_status (*)(const cairn_fleet*, std::uint64_t, cairn_fleet_sighting*, std::size_t, std::size_t*,
                                cairn_error*);
  bool take();
  std::vector<cairn_observation> seen(Seen query, std::uint64_t vehicle) const;

  cairn_fleet_options options_;
  std::unique_ptr<cairn_fleet, void (*)(cairn_fleet*)> fleet_;
  std::vector<std::uint64_t> numbers_;
  std::vector<cairn_pose> starts_;
  std::vector<double> features_;
  std::size_t steps_ = 0;
  cairn_fleet_step step_{};
  std::vector<cairn_fleet_vehicle> boats_;  // of step_
  bool taken_ = false;  // step_ already holds the next step
};

}  // namespace cairn::program
