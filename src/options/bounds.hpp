// SPDX-License-Identifier: BSD-3-Clause
// The range of a real option.
#pragma once

#include <limits>

namespace cairn::options {

struct Bounds {
  double lower;
  bool lower_open;  // the lower bound itself is refused
  double upper;
  bool upper_open;

  constexpr bool contain(double value) const {  // never NaN
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
  }
  constexpr bool unbounded() const { return upper == std::numeric_limits<double>::infinity(); }
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Bounds kPositive = {0, true, kInfinity, true};
constexpr Bounds kNotNegative = {0, false, kInfinity, true};
constexpr Bounds kProbability = {0, true, 1, false};
constexpr Bounds kProbabilityBelowOne = {0, true, 1, true};
constexpr Bounds kFinite = {-kInfinity, true, kInfinity, true};
constexpr Bounds from_to(double lower, double upper) {  // both bounds are allowed
  return {lower, false, upper, false};
}

}  // namespace cairn::options
