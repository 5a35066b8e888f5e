// SPDX-License-Identifier: BSD-3-Clause
// A simulated drive.
#pragma once

#include <memory>
#include <vector>

#include "program/drives/drive.hpp"

namespace cairn::program {

class WorldDrive : public Drive {
 public:
  // `by_wheels`: the filter gets only the rates of the wheels, instead of the world's twists. `scales_wheels`: it gets
  // the rates of wheels and gyro, if the world's twists come from them, so that it can estimate scales of the wheels.
  // Throws UsageError if the options contradict each other, and LibraryError.
  WorldDrive(const cairn_world_options& options, bool by_wheels, bool scales_wheels = false);

  std::size_t steps() const override { return steps_; }
  cairn_pose start() const override;
  std::size_t largest_frame() const override;
  std::size_t landmarks_at_once(std::uint64_t) const override { return landmarks_; }
  std::int32_t equip(cairn_filter* filter) const override;
  bool has_mount() const override { return true; }
  bool next(DriveStep& step) override;
  bool true_landmark(std::uint64_t id, double position[3]) const override;
  const cairn_world* world() const override { return world_.get(); }

 private:
  std::unique_ptr<cairn_world, void (*)(cairn_world*)> world_{nullptr, &cairn_world_destroy};
  std::size_t landmarks_;
  std::size_t steps_ = 0;
  std::size_t next_ = 0;
  bool by_wheels_, by_gyro_;
  // Of the last step.
  std::vector<cairn_world_motion> motions_;
  std::vector<cairn_observation> observations_;
};

}  // namespace cairn::program
