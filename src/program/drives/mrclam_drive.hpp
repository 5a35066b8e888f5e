// SPDX-License-Identifier: BSD-3-Clause
// Robots of a MRCLAM folder.
#pragma once

#include "program/drives/mrclam_noise.hpp"
#include "program/drives/robot_start.hpp"
#include "program/drives/robot_track.hpp"
#include "program/drives/team_drive.hpp"
#include "program/logs/mrclam_log.hpp"

namespace cairn::program {

// All robots make a step at each time at which one of them observed something.
class MrclamDrive : public TeamDrive {
 public:
  // `log` has to live as long as the drive. Throws LogError if a robot's start cannot be found.
  MrclamDrive(const logs::MrclamLog& log, const MrclamNoise& noise);

  const std::vector<std::uint64_t>& vehicles() const override { return numbers_; }
  std::size_t steps() const override { return times_.size(); }
  cairn_pose start(std::size_t vehicle) const override { return starts_[vehicle].pose.pose(); }
  const double* start_covariance(std::size_t vehicle) const override { return starts_[vehicle].covariance.data(); }
  cairn_range_bearing radar() const override;
  std::uint32_t landmarks() const override { return static_cast<std::uint32_t>(log_.landmarks.size()); }
  std::uint32_t largest_frame() const override { return largest_frame_; }
  double submap_distance() const override { return 2; }
  bool next(TeamStep& step) override;
  bool true_landmark(std::uint64_t id, double position[2]) const override;
  const std::vector<std::string>& notes() const { return notes_; }  // on starts that are not the true ones

 private:
  RobotStart find_start(const logs::MrclamLog::Robot& robot);

  const logs::MrclamLog& log_;
  MrclamNoise noise_;
  std::vector<std::uint64_t> numbers_;
  std::vector<RobotStart> starts_;
  std::vector<std::string> notes_;
  bool in_frame_of_posts_ = true;
  std::vector<double> times_;
  std::vector<RobotTrack> tracks_;
  double first_time_ = 0;
  std::uint32_t largest_frame_ = 0;
  std::size_t next_ = 0;
};

}  // namespace cairn::program
