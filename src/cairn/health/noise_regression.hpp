// SPDX-License-Identifier: BSD-3-Clause
// Factors of the stated variances of each sensor (alpha) and of the motion (beta) that explain the frames of a window:
// weighted least squares on E[square] = alpha + beta weight (docs/trust.md, eq. 5).
#pragma once

#include "core/arena.hpp"
#include "health/frame_parts.hpp"

namespace cairn {

// A factor of stated variances and its standard deviation.
struct NoiseFactor {
  double value = 1.0, sigma = 1e3;
};

class NoiseRegression {
 public:
  // `memory`: number of frames that count.
  NoiseRegression(Arena& arena, Index sensors, double memory);

  void fade(Index sensor);  // once for each frame of the sensor
  // The differences of a frame to the frame before, and over several frames: these tell of the motion only.
  void add(Index sensor, const FrameParts& parts);
  void add_motion(Index sensor, const FrameParts& parts);
  NoiseFactor sensor(Index sensor) const { return sensors_[sensor].factor; }
  NoiseFactor motion() const { return motion_; }

 private:
  // The normal equations of one sensor's frames in (alpha, beta).
  struct Sums {
    double aa, ab, bb, a, b;  // sums of w, w weight, w weight^2, w square, w weight square
    double young;             // share of the window that is not filled yet
    NoiseFactor factor;
  };
  void add(Sums& sums, double weight, double square, double count);
  double bounded(const Sums& sums, const FrameParts::Common& common) const;
  void solve();

  double keep_;  // of the sums, from frame to frame
  Sums* sensors_;
  Index count_;
  NoiseFactor motion_;
};

}  // namespace cairn
