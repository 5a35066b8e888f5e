// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/robot_start.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cairn::program {
namespace {

using logs::MrclamLog;
using logs::PlanarPose;

// The shorter the time, the smaller the drift of the odometry. A longer time is used if it is needed.
constexpr double kTimes[] = {10, 30, 100, 300};                       // s
constexpr double kGoodHeadingSigma = 0.1, kWorstHeadingSigma = 0.35;  // rad
constexpr int kRounds = 20;                                           // of weights, which fade out misread barcodes

struct Sighting {
  double time;                         // s after the start
  std::array<double, 2> place;         // of the post in the frame of the start, by dead reckoning
  const std::array<double, 2>* truth;  // of the post
  double variance;                     // of each axis, m^2
};

std::vector<Sighting> sightings_of(const MrclamLog& log, const MrclamLog::Robot& robot, const MrclamNoise& noise) {
  std::vector<Sighting> out;
  PlanarPose now;
  const double start = robot.odometry.front().time;
  double time = start;
  std::size_t record = 0;
  for (const MrclamLog::Measurement& m : robot.measurements) {
    const auto post = log.landmarks.find(m.subject);
    if (m.time < start || post == log.landmarks.end()) continue;
    while (time < m.time) {
      const bool last = record + 1 == robot.odometry.size();
      const double until = last ? m.time : std::min(m.time, robot.odometry[record + 1].time);
      const double turn = robot.odometry[record].rate * (until - time);
      const double path = robot.odometry[record].speed * (until - time);
      now = now.compose({path * std::cos(0.5 * turn), path * std::sin(0.5 * turn), turn});
      time = until;
      if (!last && until == robot.odometry[record + 1].time) ++record;
    }
    const std::array<double, 2> place = now.apply(m.range * std::cos(m.bearing), m.range * std::sin(m.bearing));
    const double seen = std::pow(m.range, 2) * (std::pow(noise.range, 2) + std::pow(noise.bearing, 2));
    const double distance = std::hypot(place[0], place[1]);
    const double drift = (std::pow(noise.speed, 2) + std::pow(noise.rate * distance, 2)) * (m.time - start);
    out.push_back({m.time - start, place, &post->second, 0.5 * (seen + drift)});
  }
  return out;
}

// The rigid motion from places to true places with the least sum of weighted squares: turn, then shift. Empty if the
// weighted places have no extent.
std::optional<RobotStart> fit(const std::vector<Sighting>& sightings, std::size_t count,
                              const std::vector<double>& weights) {
  double all = 0, place[2] = {0, 0}, truth[2] = {0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    all += weights[i];
    for (std::size_t k = 0; k < 2; ++k) {
      place[k] += weights[i] * sightings[i].place[k];
      truth[k] += weights[i] * (*sightings[i].truth)[k];
    }
  }
  for (std::size_t k = 0; k < 2; ++k) place[k] /= all, truth[k] /= all;
  double along = 0, across = 0, spread = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double qx = sightings[i].place[0] - place[0], qy = sightings[i].place[1] - place[1];
    const double lx = (*sightings[i].truth)[0] - truth[0], ly = (*sightings[i].truth)[1] - truth[1];
    along += weights[i] * (qx * lx + qy * ly);
    across += weights[i] * (qx * ly - qy * lx);
    spread += weights[i] * (lx * lx + ly * ly);
  }
  if (!(spread > 0)) return std::nullopt;  // one post: the heading is unknown
  RobotStart start;
  start.pose.heading = std::atan2(across, along);
  const std::array<double, 2> turned = PlanarPose{0, 0, start.pose.heading}.apply(place[0], place[1]);
  start.pose.x = truth[0] - turned[0];
  start.pose.y = truth[1] - turned[1];
  // Inverse of the sum of J^T w J with J = -[I, G R q]. The centre of the turned places is independent of the heading.
  const double heading = 1 / spread;
  const double arm[2] = {-turned[1], turned[0]};  // G R q at the centre
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t c = 0; c < 2; ++c)
      start.covariance[6 * r + c] = (r == c ? 1 / all : 0) + arm[r] * arm[c] * heading;
    start.covariance[6 * r + 5] = start.covariance[30 + r] = -arm[r] * heading;
  }
  start.covariance[35] = heading;
  return start;
}

// The first `count` sightings, with weights that fall with the distance from the fit (Cauchy).
std::optional<RobotStart> robust_fit(const std::vector<Sighting>& sightings, std::size_t count) {
  std::vector<double> weights(count);
  for (std::size_t i = 0; i < count; ++i) weights[i] = 1 / sightings[i].variance;
  std::optional<RobotStart> start;
  for (int round = 0; round < kRounds; ++round) {
    start = fit(sightings, count, weights);
    if (!start) return start;
    for (std::size_t i = 0; i < count; ++i) {
      const std::array<double, 2> p = start->pose.apply(sightings[i].place[0], sightings[i].place[1]);
      const std::array<double, 2>& l = *sightings[i].truth;
      const double square = (std::pow(l[0] - p[0], 2) + std::pow(l[1] - p[1], 2)) / sightings[i].variance;
      weights[i] = 1 / (sightings[i].variance * (1 + square / 4));
    }
  }
  return start;
}

}  // namespace

std::optional<RobotStart> start_from_posts(const MrclamLog& log, const MrclamLog::Robot& robot,
                                           const MrclamNoise& noise) {
  const std::vector<Sighting> sightings = sightings_of(log, robot, noise);
  std::optional<RobotStart> best;
  for (const double time : kTimes) {
    const auto end = std::find_if(sightings.begin(), sightings.end(), [&](const Sighting& s) { return s.time > time; });
    const auto count = static_cast<std::size_t>(end - sightings.begin());
    if (count < 2) continue;
    const std::optional<RobotStart> start = robust_fit(sightings, count);
    if (!start) continue;
    if (!best || start->covariance[35] < best->covariance[35]) best = start;
    if (std::sqrt(best->covariance[35]) <= kGoodHeadingSigma) break;
  }
  if (best && std::sqrt(best->covariance[35]) > kWorstHeadingSigma) best.reset();
  return best;
}

}  // namespace cairn::program
