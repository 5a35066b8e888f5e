// SPDX-License-Identifier: BSD-3-Clause
// A recorded drive.
#pragma once

#include <optional>

#include "program/drives/drive.hpp"
#include "program/logs/log.hpp"

namespace cairn::program {

// Limits of the log's stereo camera that replace the library's.
struct CameraChoices {
  std::optional<double> min_disparity;         // pixels
  std::optional<double> min_disparity_sigmas;  // standard deviations of the disparity
};

class LogDrive : public Drive {
 public:
  // `log` has to live as long as the drive.
  LogDrive(const logs::Log& log, const CameraChoices& camera) : log_(log), camera_(camera) {}

  std::size_t steps() const override { return log_.steps.size(); }
  // The first true pose; the identity if the log has none.
  cairn_pose start() const override;
  bool planar() const override { return log_.planar; }
  std::size_t largest_frame() const override;
  std::size_t landmarks_at_once(std::uint64_t forget_after) const override;
  std::int32_t equip(cairn_filter* filter) const override;
  bool has_mount() const override { return false; }
  bool next(DriveStep& step) override;
  bool true_landmark(std::uint64_t id, double position[3]) const override;

 private:
  const logs::Log& log_;
  CameraChoices camera_;
  std::size_t next_ = 0;
};

}  // namespace cairn::program
