// SPDX-License-Identifier: BSD-3-Clause
#include "program/logs/neutral_form.hpp"

#include <algorithm>
#include <cmath>

#include "program/logs/planar.hpp"

namespace cairn::program::logs {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kIncrementPositionSigma = 0.02;        // m, each axis
constexpr double kIncrementAngleSigma = 0.1 * kDegree;  // each of roll, pitch, yaw
constexpr double kRangeSigma = 0.1;                     // m
constexpr double kDirectionSigma = 0.5 * kDegree;       // azimuth and elevation

// The noise is additive on roll, pitch and yaw; the filter takes it as dtheta in the axes of the body before:
// dtheta = ez dyaw + Rz ey dpitch + Rz Ry ex droll, the Euler-rate Jacobian of R = Rz Ry Rx.
Increment spatial_increment(const double* v, const std::vector<double>& sigma) {
  Increment increment{};
  for (int i = 0; i < 3; ++i) increment.T_before_after.position[i] = v[i];
  const double pitch = v[4];
  const double yaw = v[5];
  cairn_quaternion_from_euler(v[3], pitch, yaw, increment.T_before_after.quaternion, nullptr);
  const double jacobian[3][3] = {{std::cos(yaw) * std::cos(pitch), -std::sin(yaw), 0},
                                 {std::sin(yaw) * std::cos(pitch), std::cos(yaw), 0},
                                 {-std::sin(pitch), 0, 1}};
  const double largest = std::max({sigma[3], sigma[4], sigma[5]});
  for (std::size_t i = 0; i < 3; ++i) {
    increment.covariance[i * 7] = sigma[i] * sigma[i];
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = largest > 0 ? sigma[3 + k] / largest : 0;
        sum += jacobian[i][k] * jacobian[j][k] * (share * share);
      }
      increment.covariance[(3 + i) * 6 + 3 + j] = largest * largest * sum;
    }
  }
  return increment;
}

// The error of x, y and heading is additive in the axes of the body before, as the filter takes it.
Increment planar_increment(const double* v, const std::vector<double>& sigma) {
  Increment increment{planar_pose(v[0], v[1], v[2]), {}};
  increment.covariance[0] = sigma[0] * sigma[0];
  increment.covariance[7] = sigma[1] * sigma[1];
  increment.covariance[35] = sigma[2] * sigma[2];
  return increment;
}

}  // namespace

NeutralForm::NeutralForm(bool planar) : planar_(planar) {
  if (planar) {
    pose_ = {"x", "y", "heading"};
    increment_ = {"dx", "dy", "dheading"};
    observation_ = {"range", "bearing"};
    position_ = {"x", "y"};
  } else {
    pose_ = {"x", "y", "z", "roll", "pitch", "yaw"};
    increment_ = {"dx", "dy", "dz", "droll", "dpitch", "dyaw"};
    observation_ = {"range", "azimuth", "elevation"};
    position_ = {"x", "y", "z"};
  }
}

NeutralForm NeutralForm::of(const TextLines& lines) {
  const NeutralForm planar(true);
  const std::string_view letter = lines.field(0);
  const bool fits = lines.size() == planar.fields(letter);
  if (fits && letter != "N")
    lines.fail("record " + std::string(letter) + " is that of a planar log, which begins with its noise (N)");
  return fits ? planar : NeutralForm(false);
}

std::size_t NeutralForm::fields(std::string_view letter) const {
  if (letter == "N") return 1 + increment_.size() + observation_.size();
  if (letter == "T") return 3 + pose_.size();
  if (letter == "O") return 2 + increment_.size();
  if (letter == "Z") return 3 + observation_.size();
  if (letter == "L") return 2 + position_.size();
  return 0;
}

cairn_pose NeutralForm::make_pose(const double* v) const {
  if (planar_) return planar_pose(v[0], v[1], v[2]);
  cairn_pose pose{{v[0], v[1], v[2]}, {}};
  cairn_quaternion_from_euler(v[3], v[4], v[5], pose.quaternion, nullptr);
  return pose;
}

Increment NeutralForm::make_increment(const double* v, const NeutralNoise& noise) const {
  return planar_ ? planar_increment(v, noise.increment) : spatial_increment(v, noise.increment);
}

std::optional<NeutralNoise> NeutralForm::usual_noise() const {
  if (planar_) return std::nullopt;
  NeutralNoise noise;
  noise.increment.assign(3, kIncrementPositionSigma);
  noise.increment.insert(noise.increment.end(), 3, kIncrementAngleSigma);
  noise.observation = {kRangeSigma, kDirectionSigma, kDirectionSigma};
  return noise;
}

void NeutralForm::equip(Log& log) const {
  log.planar = planar_;
  if (planar_) {
    log.format = "planar neutral text log";
    log.sensor = SensorKind::kRangeBearing;
    cairn_range_bearing_init(&log.radar, sizeof log.radar, nullptr);
    return;
  }
  log.format = "neutral text log";
  log.sensor = SensorKind::kStereoHead;
  cairn_stereo_head_init(&log.head, sizeof log.head, nullptr);
  log.head.range_sigma = kRangeSigma;
  log.head.azimuth_sigma = kDirectionSigma;
  log.head.elevation_sigma = kDirectionSigma;
}

}  // namespace cairn::program::logs
