// SPDX-License-Identifier: BSD-3-Clause
// A filter of the library for the neutral log: a single map unless submaps are requested, the invariant error, and
// defaults for everything that the log does not contain.
#pragma once

#include <cairn/cairn.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "log.hpp"

namespace bench {

inline void check(cairn_status status) {
  if (status == CAIRN_OK) return;
  throw std::runtime_error(std::string(cairn_status_name(status)) + ": " + cairn_last_message());
}

inline cairn_pose pose_of(const Vector6& p) {
  cairn_pose pose;
  for (int i = 0; i < 3; ++i) pose.position[i] = p[i];
  check(cairn_quaternion_from_euler(p[3], p[4], p[5], pose.quaternion, nullptr));
  return pose;
}

class Filter {
 public:
  Filter(std::size_t max_landmarks, std::size_t max_observations, const cairn_pose& start,
         std::size_t submap_landmarks = 0, int32_t join = CAIRN_JOIN_AUTO) {
    cairn_filter_options options;
    check(cairn_filter_options_init(&options, sizeof options, nullptr));
    options.max_landmarks = static_cast<uint32_t>(max_landmarks);
    options.max_observations = static_cast<uint32_t>(max_observations);
    options.initial_pose = start;
    options.submap_landmarks = static_cast<uint32_t>(submap_landmarks);
    options.join = join;
    check(cairn_filter_create(&options, &filter_, nullptr));
    cairn_stereo_head head;
    check(cairn_stereo_head_init(&head, sizeof head, nullptr));
    head.range_sigma = Noise::kRange;
    head.azimuth_sigma = head.elevation_sigma = Noise::kAngle;
    check(cairn_filter_add_stereo_head(filter_, &head, &sensor_, nullptr));
    for (int i = 0; i < 6; ++i) {
      const double sigma = i < 3 ? Noise::kIncrementMetres : Noise::kIncrementRadians;
      increment_covariance_[7 * i] = sigma * sigma;
    }
  }
  ~Filter() { cairn_filter_destroy(filter_); }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  cairn_filter* get() { return filter_; }
  int32_t sensor() const { return sensor_; }
  const double* increment_covariance() const { return increment_covariance_; }

  void predict(const cairn_pose& increment) {
    check(cairn_filter_predict_increment(filter_, &increment, increment_covariance_, nullptr));
  }
  void update(const std::vector<cairn_observation>& observations) {
    check(cairn_filter_update(filter_, sensor_, observations.data(), observations.size(), nullptr, nullptr));
  }

  cairn_update_report last_update() const {
    cairn_update_report report;
    report.struct_size = sizeof report;
    check(cairn_filter_last_update(filter_, &report, nullptr));
    return report;
  }
  cairn_closing_report last_closing() const {
    cairn_closing_report report;
    report.struct_size = sizeof report;
    check(cairn_filter_last_closing(filter_, &report, nullptr));
    return report;
  }
  std::size_t landmarks() const {
    std::size_t count = 0;
    check(cairn_map_size(cairn_filter_map(filter_), &count, nullptr));
    return count;
  }

 private:
  cairn_filter* filter_ = nullptr;
  int32_t sensor_ = -1;
  double increment_covariance_[36] = {};
};

inline std::vector<cairn_observation> observations_of(const Step& step) {
  std::vector<cairn_observation> all;
  for (const Sighting& sighting : step.sightings) {
    cairn_observation one{};
    one.id = sighting.id;
    for (int i = 0; i < 3; ++i) one.z[i] = sighting.z[i];
    all.push_back(one);
  }
  return all;
}

}  // namespace bench
