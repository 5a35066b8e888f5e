// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/mrclam_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/library.hpp"
#include "program/logs/log.hpp"

namespace cairn::program {
namespace {

using Robot = logs::MrclamLog::Robot;

cairn_pose pose_of(const logs::MrclamLog::Truth& truth) {
  return planar_pose(truth.x, truth.y, truth.heading);
}

}  // namespace

MrclamDrive::MrclamDrive(const logs::MrclamLog& log, const MrclamNoise& noise) : log_(log), noise_(noise) {
  double end = std::numeric_limits<double>::infinity();
  for (const Robot& robot : log.robots) {
    numbers_.push_back(robot.id);
    starts_.push_back(find_start(robot));
    tracks_.emplace_back(log, robot, noise);
    end = std::min(end, robot.odometry.back().time);
    if (!robot.truth.empty()) end = std::min(end, robot.truth.back().time);
  }
  for (std::size_t r = 0; r < log.robots.size(); ++r)
    for (const auto& measurement : log.robots[r].measurements)
      if (tracks_[r].started(measurement.time) && measurement.time <= end) times_.push_back(measurement.time);
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  if (times_.empty()) throw logs::LogError("the folder's robots saw nothing while all of them were on their way");
  first_time_ = times_.front();
  for (const Robot& robot : log.robots) {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < robot.measurements.size(); ++i) {
      count = i > 0 && robot.measurements[i].time == robot.measurements[i - 1].time ? count + 1 : 1;
      largest_frame_ = std::max(largest_frame_, count);
    }
  }
}

// The true pose at the robot's first odometry; without it, the one that its first sightings of posts tell.
RobotStart MrclamDrive::find_start(const Robot& robot) {
  logs::MrclamLog::Truth truth{};
  if (logs::truth_at(robot, robot.odometry.front().time, truth)) return {{truth.x, truth.y, truth.heading}, {}};
  const std::string about = "robot " + std::to_string(robot.id) + ": its first odometry has no true pose";
  if (const std::optional<RobotStart> start = start_from_posts(log_, robot, noise_)) {
    notes_.push_back(about + "; it starts where its first sightings of posts place it");
    return *start;
  }
  if (log_.robots.size() > 1 || !robot.truth.empty())
    throw logs::LogError(about + ", and it saw too few posts to tell where it starts");
  in_frame_of_posts_ = false;
  notes_.push_back(about + "; its start is the origin of the map");
  return {};
}

cairn_range_bearing MrclamDrive::radar() const {
  return robot_radar(noise_);
}

bool MrclamDrive::next(TeamStep& step) {
  if (next_ == times_.size()) return false;
  const double time = times_[next_++];
  step.time = time - first_time_;
  step.vehicles.assign(numbers_.size(), {});
  for (std::size_t r = 0; r < numbers_.size(); ++r) {
    const Robot& robot = log_.robots[r];
    tracks_[r].advance(time, step.vehicles[r]);
    logs::MrclamLog::Truth truth{};
    if (tracks_[r].started(time) && logs::truth_at(robot, time, truth)) step.vehicles[r].truth = pose_of(truth);
  }
  return true;
}

bool MrclamDrive::true_landmark(std::uint64_t id, double position[2]) const {
  const auto entry = log_.landmarks.find(id);
  if (entry == log_.landmarks.end() || !in_frame_of_posts_) return false;
  std::copy(entry->second.begin(), entry->second.end(), position);
  return true;
}

}  // namespace cairn::program
