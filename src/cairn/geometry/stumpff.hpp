// SPDX-License-Identifier: BSD-3-Clause
// Functions of an angle from which the exponential, the logarithm and the Jacobians of rotations are computed.
#pragma once

#include <cmath>

namespace cairn {

// Stumpff functions c_k(x) = sum_j (-x)^j / (2j + k)! of x = theta^2. They are smooth in x, so the caller never divides
// by the angle. c0 = cos, c1 = sin / theta, c2 = (1 - cos) / theta^2, c3 = (theta - sin) / theta^3, and in general c_k
// = 1/k! - x c_{k+2}. For small x the trigonometric form loses digits by cancellation, and the series is used.
struct Stumpff {
  double c0, c1, c2, c3, c4, c5;

  explicit Stumpff(double x) {
    if (x < 1.0) {
      // Eight terms by Horner's rule. At x = 1 the first omitted term is below 1e-18 of the sum.
      c4 = (1 - x / 30 * (1 - x / 56 * (1 - x / 90 * (1 - x / 132 * (1 - x / 182 * (1 - x / 240 * (1 - x / 306))))))) /
           24;
      c5 = (1 - x / 42 * (1 - x / 72 * (1 - x / 110 * (1 - x / 156 * (1 - x / 210 * (1 - x / 272 * (1 - x / 342))))))) /
           120;
      c3 = 1.0 / 6 - x * c5;
      c2 = 0.5 - x * c4;
      c1 = 1 - x * c3;
      c0 = 1 - x * c2;
    } else {
      const double theta = std::sqrt(x);
      c0 = std::cos(theta);
      c1 = std::sin(theta) / theta;
      c2 = (1 - c0) / x;
      c3 = (1 - c1) / x;
      c4 = (0.5 - c2) / x;
      c5 = (1.0 / 6 - c3) / x;
    }
  }
};

}  // namespace cairn
