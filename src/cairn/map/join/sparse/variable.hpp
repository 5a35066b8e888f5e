// SPDX-License-Identifier: BSD-3-Clause
// The variables of the sparse problem: bases and landmarks, by number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "linear/small_algebra.hpp"

namespace cairn {

// Bases are even, landmarks odd.
using Variable = std::int32_t;
inline Variable base_variable(std::size_t base) {
  return static_cast<Variable>(2 * base);
}
inline Variable landmark_variable(std::size_t landmark) {
  return static_cast<Variable>(2 * landmark + 1);
}
inline bool is_landmark(Variable v) {
  return (v & 1) != 0;
}
template <class Pose>
Index dimension(Variable v) {
  return is_landmark(v) ? Pose::kDim : Pose::kDof;
}
template <class Pose>
Index dimension(const std::vector<Variable>& variables) {
  Index sum = 0;
  for (const Variable v : variables) sum += dimension<Pose>(v);
  return sum;
}

}  // namespace cairn
