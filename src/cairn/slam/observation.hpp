// SPDX-License-Identifier: BSD-3-Clause
// The inputs of an update: observations of a frame, and rows that the caller linearised.
#pragma once

#include <algorithm>
#include <cstdint>

#include "linear/small_algebra.hpp"

namespace cairn {

constexpr std::uint64_t kNoId = UINT64_MAX;

struct Observation {
  std::uint64_t id;
  double z[3];
  double covariance[9];  // all zero: the sensor's noise

  bool has_covariance() const {
    return std::any_of(covariance, covariance + 9, [](double v) { return v != 0.0; });
  }
};

// Rows of an update that the caller linearised. They are gated as a whole.
struct LinearRows {
  const double* residual;
  Index rows;
  const double* covariance;  // rows x rows
  const double* J_pose;      // rows x 6 row-major, or null; of a pose in space, of which the plane takes its columns
  const std::uint64_t* landmarks;
  Index count;
  const double* J_landmarks;  // rows x 3 count row-major
};

}  // namespace cairn
