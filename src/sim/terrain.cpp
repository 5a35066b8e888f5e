// SPDX-License-Identifier: BSD-3-Clause
// Height and slope of the ground.
#include "sim/terrain.hpp"

#include <cmath>

#include "geometry/angle.hpp"
#include "sim/random.hpp"

namespace cairn::sim {
namespace {

constexpr int kWaves = 9;
constexpr double kAnchorX = 100, kAnchorY = 20;  // start of the Mars paper, where options.start_height is the height

}  // namespace

// Rolling ground is a sum of waves in all directions. Their steepness adds up to the limit, so the slope exceeds the
// limit nowhere. Longer waves have a larger share of the steepness.
Terrain::Terrain(const cairn_world_options& options) : kind_(options.terrain) {
  if (kind_ != CAIRN_TERRAIN_ROLLING) return;
  Random random(options.seed, Stream::terrain);
  const double shortest = options.wavelength[0], longest = options.wavelength[1];
  double steepness = 0;
  for (int i = 0; i < kWaves; ++i) {
    // Each group of three waves covers three sectors of 60 degrees, so that no direction stays flat.
    const double direction = kPi * (i % 3 + random.uniform(0, 1)) / 3;
    const double length = shortest * std::pow(longest / shortest, (i + random.uniform(0, 1)) / kWaves);
    const double k = 2 * kPi / length;
    const double share = std::sqrt(length);
    waves_.push_back({k * std::cos(direction), k * std::sin(direction), random.uniform(0, 2 * kPi), share / k});
    steepness += share;
  }
  for (Wave& wave : waves_) wave.amplitude *= std::tan(options.max_slope) / steepness;
  shift_ = options.start_height - height(kAnchorX, kAnchorY);
}

double Terrain::height(double x, double y) const {
  if (kind_ == CAIRN_TERRAIN_WAVES) return std::sin(x / 15) + 0.8 * std::cos(y / 12);
  double sum = shift_;
  for (const Wave& wave : waves_) sum += wave.amplitude * std::sin(wave.kx * x + wave.ky * y + wave.phase);
  return sum;
}

Vector2 Terrain::slope(double x, double y) const {
  if (kind_ == CAIRN_TERRAIN_WAVES) return Vector2(std::cos(x / 15) / 15, -0.8 * std::sin(y / 12) / 12);
  Vector2 sum = Vector2::Zero();
  for (const Wave& wave : waves_) {
    sum += wave.amplitude * std::cos(wave.kx * x + wave.ky * y + wave.phase) * Vector2(wave.kx, wave.ky);
  }
  return sum;
}

}  // namespace cairn::sim
