// SPDX-License-Identifier: BSD-3-Clause
// A small drive for the tests, and a program's memory.
#ifndef CAIRN_BINDINGS_CPP_TESTS_SCENE_HPP
#define CAIRN_BINDINGS_CPP_TESTS_SCENE_HPP

#include <cairn/cairn.hpp>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace scene {

inline cairn::FilterOptions small() {
  cairn::FilterOptions options;
  options.max_landmarks = 20;
  options.max_observations = 8;
  return options;
}

/// Points that a body at the origin sees: observations of a cartesian sensor.
inline std::vector<cairn::Observation> points(std::uint64_t first_id = 1) {
  std::vector<cairn::Observation> observations(4);
  for (std::size_t i = 0; i < observations.size(); ++i) {
    observations[i].id = first_id + i;
    observations[i].z = {4.0 + static_cast<double>(i), 1.0 - static_cast<double>(i), 0.5};
  }
  return observations;
}

/// Pose and map of a filter, byte by byte.
inline std::vector<unsigned char> bytes_of(const cairn::Filter& filter) {
  const cairn::PoseEstimate estimate = filter.pose();
  const std::vector<cairn::Landmark> landmarks = filter.map().landmarks();
  const std::size_t size = landmarks.size() * sizeof(cairn::Landmark);
  std::vector<unsigned char> bytes(sizeof estimate + size);
  std::memcpy(bytes.data(), &estimate, sizeof estimate);
  if (size != 0) std::memcpy(bytes.data() + sizeof estimate, landmarks.data(), size);
  return bytes;
}

/// The model of a sensor that sees a point in the axes of the map.
struct MapAxes {
  bool operator()(const cairn::Pose& pose, cairn::Span<const double> landmark, cairn::Prediction& out) const {
    if (fail != nullptr && *fail) throw std::out_of_range("the model does not want to");
    for (std::size_t i = 0; i < 3; ++i) {
      out.z[i] = landmark[i] - pose.position[i];
      for (std::size_t k = 0; k < 6; ++k) out.jacobian_pose[6 * i + k] = i == k ? -1.0 : 0.0;
      for (std::size_t k = 0; k < 3; ++k) out.jacobian_landmark[3 * i + k] = i == k ? 1.0 : 0.0;
    }
    return true;
  }
  const bool* fail = nullptr;
};

/// Where such a sensor places a landmark.
struct PlaceInMapAxes {
  bool operator()(const cairn::Pose& pose, cairn::Span<const double> z, cairn::Placement& out) const {
    for (std::size_t i = 0; i < 3; ++i) {
      out.landmark[i] = pose.position[i] + z[i];
      for (std::size_t k = 0; k < 6; ++k) out.jacobian_pose[6 * i + k] = i == k ? 1.0 : 0.0;
      for (std::size_t k = 0; k < 3; ++k) out.jacobian_z[3 * i + k] = i == k ? 1.0 : 0.0;
    }
    return true;
  }
};

/// Resident memory of this process, KiB.
inline long resident_kib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
    if (word == "VmRSS:") {
      long kib = 0;
      status >> kib;
      return kib;
    }
  throw std::runtime_error("no VmRSS");
}

}  // namespace scene

#endif
