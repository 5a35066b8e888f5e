// SPDX-License-Identifier: BSD-3-Clause
// Random numbers with the same bits on every machine. They use only sums, products, quotients and square roots of IEEE
// numbers, and this library is compiled without contraction to fused multiply-adds.
#pragma once

#include <cmath>
#include <cstdint>

namespace cairn::sim {

// The purpose of a draw. Each purpose and index has its own sequence of draws.
enum class Stream : std::uint64_t {
  terrain = 1,
  course,
  landmark,
  motion,
  frame,
  observation,
  coast,
  feature,
  boat_motion,
  feature_sighting,
  boat_sighting
};

class Random {
 public:
  Random(std::uint64_t seed, Stream stream, std::uint64_t index = 0)
      : state_(mix(mix(mix(seed) + static_cast<std::uint64_t>(stream)) + index)) {}

  // SplitMix64 (Steele, Lea, Flood 2014).
  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15); }

  // In [low, high).
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }

  // Marsaglia's polar method. The next call returns its second number.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    double u = 0, v = 0, s = 0;
    do {
      u = uniform(-1, 1);
      v = uniform(-1, 1);
      s = u * u + v * v;
    } while (s >= 1 || s == 0);
    const double stretch = std::sqrt(-2 * logarithm(s) / s);
    spare_ = v * stretch;
    has_spare_ = true;
    return u * stretch;
  }

  // Logarithm of a number in (0, 1): its exponent times log 2, plus the series of 2 atanh((m - 1) / (m + 1)) for the
  // mantissa m in [sqrt(1/2), sqrt(2)). The log of the C library differs in the last bit between machines.
  static double logarithm(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (m < 0.70710678118654752) {
      m *= 2;
      --exponent;
    }
    const double f = (m - 1) / (m + 1), f2 = f * f;
    double sum = 0;
    for (int k = 25; k >= 1; k -= 2) sum = sum * f2 + 1.0 / k;
    return exponent * 0.69314718055994531 + 2 * f * sum;
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
  bool has_spare_ = false;
  double spare_ = 0;
};

}  // namespace cairn::sim
