// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/log_drive.hpp"

#include <algorithm>
#include <map>

#include "program/library.hpp"

namespace cairn::program {

cairn_pose LogDrive::start() const {
  cairn_pose identity;
  check(cairn_pose_identity(&identity, nullptr));
  return log_.steps.front().truth.value_or(identity);
}

std::size_t LogDrive::largest_frame() const {
  std::size_t largest = 1;
  for (const logs::Step& step : log_.steps) largest = std::max(largest, step.observations.size());
  return largest;
}

std::size_t LogDrive::landmarks_at_once(std::uint64_t forget_after) const {
  const logs::Log& log = log_;
  std::map<std::uint64_t, std::size_t> last_seen;
  if (forget_after == 0) {
    for (std::size_t k = 0; k < log.steps.size(); ++k) {
      for (const cairn_observation& observation : log.steps[k].observations) last_seen[observation.id] = k;
    }
    return last_seen.size();
  }
  // A landmark is held from a frame that saw it until `forget_after` frames later, including that frame's update. Add
  // up where these intervals begin and end.
  std::vector<std::int64_t> change(log.steps.size() + 1, 0);
  for (std::size_t k = 0; k < log.steps.size(); ++k) {
    const auto end_of = [&](std::size_t seen) {
      return forget_after < log.steps.size() - seen ? seen + forget_after + 1 : log.steps.size();
    };
    for (const cairn_observation& observation : log.steps[k].observations) {
      const auto [entry, is_new] = last_seen.emplace(observation.id, k);
      if (is_new || end_of(entry->second) <= k) {
        ++change[k];
      } else {
        ++change[end_of(entry->second)];  // it stays: undo the end that was set
      }
      entry->second = k;
      --change[end_of(k)];
    }
  }
  std::int64_t held = 0;
  std::int64_t most = 0;
  for (const std::int64_t step : change) {
    held += step;
    most = std::max(most, held);
  }
  return static_cast<std::size_t>(most);
}

std::int32_t LogDrive::equip(cairn_filter* filter) const {
  std::int32_t sensor = -1;
  switch (log_.sensor) {
    case logs::SensorKind::kStereoHead:
      check(cairn_filter_add_stereo_head(filter, &log_.head, &sensor, nullptr));
      break;
    case logs::SensorKind::kStereoCamera: {
      cairn_stereo_camera camera = log_.camera;
      camera.min_disparity = camera_.min_disparity.value_or(camera.min_disparity);
      camera.min_disparity_sigmas = camera_.min_disparity_sigmas.value_or(camera.min_disparity_sigmas);
      check(cairn_filter_add_stereo_camera(filter, &camera, &sensor, nullptr));
      check(cairn_filter_set_twist_noise(filter, &log_.twist_noise, nullptr));
      break;
    }
    case logs::SensorKind::kCartesian:
      check(cairn_filter_add_cartesian(filter, &log_.cartesian, &sensor, nullptr));
      break;
    case logs::SensorKind::kRangeBearing:
      check(cairn_filter_add_range_bearing(filter, &log_.radar, &sensor, nullptr));
      break;
  }
  return sensor;
}

bool LogDrive::next(DriveStep& step) {
  if (next_ == log_.steps.size()) return false;
  const logs::Step& recorded = log_.steps[next_];
  step.index = next_++;
  step.number = recorded.number;
  step.time = recorded.time;
  step.increment = recorded.increment ? &*recorded.increment : nullptr;
  step.twists.clear();
  if (recorded.twist) step.twists.push_back(*recorded.twist);
  step.observations = recorded.observations.data();
  step.count = recorded.observations.size();
  step.truth = recorded.truth;
  return true;
}

bool LogDrive::true_landmark(std::uint64_t id, double position[3]) const {
  const auto truth = log_.landmarks.find(id);
  if (truth == log_.landmarks.end()) return false;
  std::copy_n(truth->second.data(), 3, position);
  return true;
}

}  // namespace cairn::program
