// SPDX-License-Identifier: BSD-3-Clause
// The simulated course of the Monte Carlo runs.
#include "world.hpp"

#include <cmath>
#include <cstring>

namespace consistency {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 101.98;  // m, through the start (100, 20)
constexpr double kAnnulus = 25;     // m, landmarks to both sides of the circle

double ground(double x, double y) {
  return std::sin(x / 15) + 0.8 * std::cos(y / 12);
}

void normalise(double v[3]) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int i = 0; i < 3; ++i) v[i] /= length;
}

void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

}  // namespace

double Random::normal(double sigma) {  // Box-Muller
  const double u = 1 - uniform(0, 1);
  return sigma * std::sqrt(-2 * std::log(u)) * std::cos(uniform(0, 2 * kPi));
}

World::World(const Noise& noise, int laps, unsigned long long seed) : noise_(noise), laps_(laps), random_(seed) {
  for (double(&l)[3] : landmarks_) {
    const double azimuth = random_.uniform(0, 2 * kPi), radius = kRadius + random_.uniform(-kAnnulus, kAnnulus);
    l[0] = radius * std::cos(azimuth);
    l[1] = radius * std::sin(azimuth);
    l[2] = ground(l[0], l[1]) + random_.uniform(0, 1.5);
  }
}

// z is the normal of the ground, x the direction of travel in the ground.
World::Frame World::frame(int step) const {
  const double azimuth = std::atan2(20, 100) + 2 * kPi * laps_ * step / kSteps;
  Frame f;
  f.p[0] = kRadius * std::cos(azimuth);
  f.p[1] = kRadius * std::sin(azimuth);
  f.p[2] = ground(f.p[0], f.p[1]);
  const double slope_x = std::cos(f.p[0] / 15) / 15, slope_y = -0.8 * std::sin(f.p[1] / 12) / 12;
  double z[3] = {-slope_x, -slope_y, 1};
  double x[3] = {-std::sin(azimuth), std::cos(azimuth), 0};
  x[2] = slope_x * x[0] + slope_y * x[1];
  normalise(z);
  normalise(x);
  double y[3];
  cross(z, x, y);
  for (int i = 0; i < 3; ++i) f.R[i][0] = x[i], f.R[i][1] = y[i], f.R[i][2] = z[i];
  return f;
}

cairn_pose World::pose(int step) const {
  const Frame f = frame(step);
  cairn_pose pose;
  std::memcpy(pose.position, f.p, sizeof f.p);
  // Shepperd's method with the larger of w and z: the rover never stands on its head.
  double* q = pose.quaternion;
  const double trace = f.R[0][0] + f.R[1][1] + f.R[2][2];
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    q[0] = s / 4;
    q[1] = (f.R[2][1] - f.R[1][2]) / s;
    q[2] = (f.R[0][2] - f.R[2][0]) / s;
    q[3] = (f.R[1][0] - f.R[0][1]) / s;
  } else {
    const double s = 2 * std::sqrt(1 + f.R[2][2] - f.R[0][0] - f.R[1][1]);
    q[0] = (f.R[1][0] - f.R[0][1]) / s;
    q[1] = (f.R[0][2] + f.R[2][0]) / s;
    q[2] = (f.R[1][2] + f.R[2][1]) / s;
    q[3] = s / 4;
  }
  return pose;
}

// The constant twist between two poses, Log(T_a^-1 T_b) / dt. The rotations of a step are small, so series are used;
// the omitted terms are below 1e-12.
void World::twist(int step, double velocity[3], double rate[3]) {
  const Frame a = frame(step), b = frame(step + 1);
  double R[3][3] = {}, d[3] = {};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      d[i] += a.R[k][i] * (b.p[k] - a.p[k]);
      for (int j = 0; j < 3; ++j) R[i][j] += a.R[k][i] * b.R[k][j];
    }
  double turn[3] = {(R[2][1] - R[1][2]) / 2, (R[0][2] - R[2][0]) / 2, (R[1][0] - R[0][1]) / 2};  // sin(angle) axis
  const double s2 = turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2];
  const double stretch = 1 + s2 / 6 + 3 * s2 * s2 / 40;  // asin(s) / s
  for (double& t : turn) t *= stretch;
  double w_d[3], w_w_d[3];  // J_l(w)^-1 d = d - w x d / 2 + w x (w x d) / 12 + ...
  cross(turn, d, w_d);
  cross(turn, w_d, w_w_d);
  for (int i = 0; i < 3; ++i) {
    velocity[i] = (d[i] - w_d[i] / 2 + w_w_d[i] / 12) / kStep + random_.normal(noise_.velocity);
    rate[i] = turn[i] / kStep + random_.normal(noise_.rate);
  }
}

const std::vector<cairn_observation>& World::look(int step) {
  const Frame f = frame(step);
  seen_.clear();
  for (int i = 0; i < kLandmarks; ++i) {
    double y[3] = {};
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j) y[j] += f.R[k][j] * (landmarks_[i][k] - f.p[k]);
    const double horizontal = std::hypot(y[0], y[1]), range = std::hypot(horizontal, y[2]);
    const double azimuth = std::atan2(y[1], y[0]);
    if (range < 2 || range > 40 || std::abs(azimuth) > kPi / 3) continue;
    cairn_observation o = {};
    o.id = static_cast<uint64_t>(i);
    o.z[0] = range + random_.normal(noise_.range);
    o.z[1] = azimuth + random_.normal(noise_.bearing);
    o.z[2] = std::atan2(y[2], horizontal) + random_.normal(noise_.bearing);
    seen_.push_back(o);
  }
  return seen_;
}

}  // namespace consistency
