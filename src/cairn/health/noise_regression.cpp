// SPDX-License-Identifier: BSD-3-Clause
#include "health/noise_regression.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kLeast = 1e-6, kMost = 1e6;  // factors of variances
constexpr double kPrior = 0.02;               // weight of the statement that the stated noise is right
// A square counts up to kBound times its expectation; an honest one is kBounded of its expectation then (eq. 6).
constexpr double kBound = 9.0, kBounded = 0.995;
constexpr double kSlight = 0.02;  // a direction with less says nothing about the motion
// Two differences of one landmark in a row share an observation: their correlation is -1/2, and the variance of a mean
// of squares 1 + 2 (1/2)^2 times that of independent ones.
constexpr double kShared = 1.5;
constexpr double kOverlap = 1.5;  // differences over several frames contain those over fewer

// Weights that fade have a sum of squares that is this part of their sum: 1 at first, 1/2 once the window is full.
double old_weights(double young) {
  return 0.5 * (1.0 + young);
}

}  // namespace

NoiseRegression::NoiseRegression(Arena& arena, Index sensors, double memory)
    : keep_(1.0 - 1.0 / memory), sensors_(arena.take<Sums>(static_cast<std::size_t>(sensors))), count_(sensors) {
  if (arena.measuring()) return;
  for (Index s = 0; s < count_; ++s) {
    sensors_[s].factor = NoiseFactor();
    sensors_[s].young = 1.0;
  }
}

// `square` is the mean of `count` squares.
void NoiseRegression::add(Sums& sums, double weight, double square, double count) {
  const double expected = sums.factor.value + motion_.value * weight;
  const double w = count / (2.0 * expected * expected);
  if (!std::isfinite(w * weight * weight) || !std::isfinite(square)) return;
  sums.aa += w;
  sums.ab += w * weight;
  sums.bb += w * weight * weight;
  sums.a += w * square;
  sums.b += w * weight * square;
}

double NoiseRegression::bounded(const Sums& sums, const FrameParts::Common& common) const {
  return std::min(common.square, kBound * (sums.factor.value + motion_.value * common.weight)) / kBounded;
}

void NoiseRegression::fade(Index sensor) {
  Sums& sums = sensors_[sensor];
  for (double* sum : {&sums.aa, &sums.ab, &sums.bb, &sums.a, &sums.b, &sums.young}) *sum *= keep_;
}

void NoiseRegression::add(Index sensor, const FrameParts& parts) {
  constexpr Index kEnough = 6;  // with fewer observations all that a frame has counts
  Sums& sums = sensors_[sensor];
  if (parts.residual_dof > 0) {
    const auto dof = static_cast<double>(parts.residual_dof);
    add(sums, 0.0, parts.residual / dof, dof);
  }
  for (Index j = 0; j < parts.commons; ++j)
    if (parts.common[j].weight > kSlight || parts.residual_dof < kEnough)
      add(sums, parts.common[j].weight, bounded(sums, parts.common[j]), 1.0);
  solve();
}

void NoiseRegression::add_motion(Index sensor, const FrameParts& parts) {
  Sums& sums = sensors_[sensor];
  for (Index j = 0; j < parts.commons; ++j)
    if (parts.common[j].weight > kSlight) add(sums, parts.common[j].weight, bounded(sums, parts.common[j]), 1.0);
  solve();
}

// Each sensor's alpha is eliminated; what remains is one equation in beta.
void NoiseRegression::solve() {
  double information = kPrior, right = kPrior, young = 1.0;
  for (Index s = 0; s < count_; ++s) {
    const Sums& sums = sensors_[s];
    if (sums.aa <= 0.0) continue;
    young = std::min(young, sums.young);
    const double aa = sums.aa + kPrior, a = sums.a + kPrior;
    information += std::max(0.0, sums.bb - sums.ab * sums.ab / aa);
    right += sums.b - sums.ab * a / aa;
  }
  motion_ = {std::min(kMost, std::max(kLeast, right / information)),
             std::sqrt(kOverlap * kShared * old_weights(young) / information)};
  for (Index s = 0; s < count_; ++s) {
    Sums& sums = sensors_[s];
    if (sums.aa <= 0.0) continue;
    const double aa = sums.aa + kPrior, a = sums.a + kPrior;
    const double of_motion = sums.ab / aa;
    sums.factor = {
        std::min(kMost, std::max(kLeast, (a - sums.ab * motion_.value) / aa)),
        std::sqrt(kShared * old_weights(sums.young) / aa + of_motion * of_motion * motion_.sigma * motion_.sigma)};
  }
}

}  // namespace cairn
