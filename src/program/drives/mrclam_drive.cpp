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
    places_.push_back({robot.odometry.front().time, 0, 0});
    end = std::min(end, robot.odometry.back().time);
    if (!robot.truth.empty()) end = std::min(end, robot.truth.back().time);
  }
  for (std::size_t r = 0; r < log.robots.size(); ++r)
    for (const auto& measurement : log.robots[r].measurements)
      if (measurement.time >= places_[r].time && measurement.time <= end) times_.push_back(measurement.time);
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
  cairn_range_bearing radar;
  check(cairn_range_bearing_init(&radar, sizeof radar));
  radar.range_sigma = noise_.range;  // at 1 m: each observation has a covariance of its own
  radar.bearing_sigma = noise_.bearing;
  return radar;
}

// A record holds until the next one. Noise is white in time: over dt its mean has a variance of its density over dt.
void MrclamDrive::move(const Robot& robot, double time, Place& place, VehicleStep& step) const {
  while (place.time < time) {
    while (place.odometry + 1 < robot.odometry.size() && robot.odometry[place.odometry + 1].time <= place.time)
      ++place.odometry;
    const bool last = place.odometry + 1 == robot.odometry.size();
    const double until = last ? time : std::min(time, robot.odometry[place.odometry + 1].time);
    const double dt = until - place.time;
    const auto& record = robot.odometry[place.odometry];
    step.motions.push_back({dt, record.speed, record.rate, noise_.speed / std::sqrt(dt), noise_.rate / std::sqrt(dt)});
    place.time = until;
  }
}

// The observations of a robot at a time. If a subject comes twice, the first one counts.
void MrclamDrive::look(const Robot& robot, double time, Place& place, VehicleStep& step) const {
  const auto& all = robot.measurements;
  while (place.measurement < all.size() && all[place.measurement].time < time) ++place.measurement;
  for (; place.measurement < all.size() && all[place.measurement].time == time; ++place.measurement) {
    const auto& from = all[place.measurement];
    const bool vehicle = std::find(numbers_.begin(), numbers_.end(), from.subject) != numbers_.end();
    std::vector<cairn_observation>& to = vehicle ? step.vehicles : step.landmarks;
    if (std::any_of(to.begin(), to.end(), [&](const cairn_observation& o) { return o.id == from.subject; })) continue;
    cairn_observation observation{};
    observation.id = from.subject;
    observation.z[0] = from.range;
    observation.z[1] = from.bearing;
    observation.covariance[0] = std::pow(noise_.range * from.range, 2);  // 2 x 2, packed
    observation.covariance[3] = noise_.bearing * noise_.bearing;
    to.push_back(observation);
  }
}

bool MrclamDrive::next(TeamStep& step) {
  if (next_ == times_.size()) return false;
  const double time = times_[next_++];
  step.time = time - first_time_;
  step.vehicles.assign(numbers_.size(), {});
  for (std::size_t r = 0; r < numbers_.size(); ++r) {
    const Robot& robot = log_.robots[r];
    const bool started = time >= robot.odometry.front().time;
    move(robot, time, places_[r], step.vehicles[r]);
    if (started) look(robot, time, places_[r], step.vehicles[r]);
    logs::MrclamLog::Truth truth{};
    if (started && logs::truth_at(robot, time, truth)) step.vehicles[r].truth = pose_of(truth);
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
