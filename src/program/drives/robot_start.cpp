// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/robot_start.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "program/drives/robot_track.hpp"
#include "program/library.hpp"

namespace cairn::program {
namespace {

using logs::MrclamLog;

constexpr double kTimes[] = {10, 30, 100, 300, 1000};                 // s after the start
constexpr double kGoodHeadingSigma = 0.1, kWorstHeadingSigma = 0.35;  // rad
constexpr int kIterations = 10;
constexpr std::size_t kColumns = 4;  // of the least squares: x, y, heading of the start, and the residual

using Filter = std::unique_ptr<cairn_filter, void (*)(cairn_filter*)>;

Filter make_filter(std::size_t posts, const MrclamNoise& noise) {
  cairn_filter_options options;
  check(cairn_filter_options_init(&options, sizeof options, nullptr));
  options.vehicle = CAIRN_VEHICLE_PLANAR;
  options.max_landmarks = options.max_observations = static_cast<std::uint32_t>(std::max<std::size_t>(1, posts));
  options.max_observations = std::min<std::uint32_t>(4096, options.max_observations);
  cairn_filter* filter = nullptr;
  check(cairn_filter_create(&options, &filter, nullptr));
  Filter owner(filter, &cairn_filter_destroy);
  const cairn_range_bearing radar = robot_radar(noise);
  std::int32_t sensor = 0;
  check(cairn_filter_add_range_bearing(filter, &radar, &sensor, nullptr));
  return owner;
}

void feed(cairn_filter* filter, const VehicleStep& step) {
  for (const TeamMotion& motion : step.motions) {
    cairn_twist_noise noise{};
    noise.struct_size = sizeof noise;
    noise.velocity_sigma[0] = motion.speed_sigma;
    noise.rate_sigma[2] = motion.rate_sigma;
    const double velocity[3] = {motion.speed, 0, 0}, rate[3] = {0, 0, motion.rate};
    check(cairn_filter_set_twist_noise(filter, &noise, nullptr));
    check(cairn_filter_predict_twist(filter, motion.dt, velocity, rate, nullptr));
  }
  if (!step.landmarks.empty())
    check(cairn_filter_update(filter, 0, step.landmarks.data(), step.landmarks.size(), nullptr, nullptr));
}

// L L^T = A, n x n, row-major, in place. False if A is not positive definite.
bool cholesky(std::vector<double>& A, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      double sum = A[n * i + j];
      for (std::size_t k = 0; k < j; ++k) sum -= A[n * i + k] * A[n * j + k];
      if (i == j && !(sum > 0)) return false;
      A[n * i + j] = i == j ? std::sqrt(sum) : sum / A[n * j + j];
    }
  }
  return true;
}

// The map of the posts, and the covariance's factor L (x and y of each post in turn).
struct PostMap {
  std::vector<cairn_landmark> posts;
  std::vector<double> L;
};

std::optional<PostMap> map_of(const cairn_filter* filter) {
  PostMap map;
  const cairn_map* of = cairn_filter_map(filter);
  std::size_t count = 0;
  check(cairn_map_size(of, &count, nullptr));
  if (count < 2) return std::nullopt;
  map.posts.resize(count);
  check(cairn_map_landmarks(of, map.posts.data(), count, &count, nullptr));
  std::vector<std::uint64_t> ids;
  for (const cairn_landmark& post : map.posts) ids.push_back(post.id);
  std::size_t needed = 9 * count * count;
  std::vector<double> joint(needed);
  check(cairn_map_joint_covariance(of, ids.data(), count, joint.data(), needed, &needed, nullptr));
  map.L.resize(4 * count * count);
  for (std::size_t i = 0; i < 2 * count; ++i)
    for (std::size_t j = 0; j < 2 * count; ++j)
      map.L[2 * count * i + j] = joint[3 * count * (i / 2 * 3 + i % 2) + j / 2 * 3 + j % 2];
  if (!cholesky(map.L, 2 * count)) return std::nullopt;
  return map;
}

// A post q of the map lies at R^T (l - p), if l is its true place. Least squares over p and heading, with the map's
// covariance: rows [dh, q - h] with dh = [-R^T, -R^T G (l - p)], divided by L.
std::optional<RobotStart> lay(const MrclamLog& log, const PostMap& map) {
  const std::size_t rows = 2 * map.posts.size();
  // Start with the direction from the first post to the one that lies farthest from it.
  const auto square = [&](const cairn_landmark& post) {
    return std::pow(post.position[0] - map.posts[0].position[0], 2) +
           std::pow(post.position[1] - map.posts[0].position[1], 2);
  };
  const cairn_landmark& near = map.posts[0];
  const cairn_landmark& far = *std::max_element(map.posts.begin(), map.posts.end(),
                                                [&](const auto& a, const auto& b) { return square(a) < square(b); });
  const std::array<double, 2>&l0 = log.landmarks.at(near.id), &l1 = log.landmarks.at(far.id);
  RobotStart start;
  start.pose.heading = std::atan2(l1[1] - l0[1], l1[0] - l0[0]) -
                       std::atan2(far.position[1] - near.position[1], far.position[0] - near.position[0]);
  const std::array<double, 2> turned = start.pose.apply(near.position[0], near.position[1]);
  start.pose.x = l0[0] - turned[0];
  start.pose.y = l0[1] - turned[1];
  std::vector<double> factor;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const double c = std::cos(start.pose.heading), s = std::sin(start.pose.heading);
    std::vector<double> A(rows * kColumns);
    for (std::size_t i = 0; i < map.posts.size(); ++i) {
      const std::array<double, 2>& l = log.landmarks.at(map.posts[i].id);
      const double x = l[0] - start.pose.x, y = l[1] - start.pose.y;
      const double hx = c * x + s * y, hy = -s * x + c * y;
      const double block[8] = {-c, -s, hy, map.posts[i].position[0] - hx, s, -c, -hx, map.posts[i].position[1] - hy};
      std::copy_n(block, 8, A.begin() + static_cast<std::ptrdiff_t>(8 * i));
    }
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k < kColumns; ++k) {
        for (std::size_t j = 0; j < i; ++j) A[kColumns * i + k] -= map.L[rows * i + j] * A[kColumns * j + k];
        A[kColumns * i + k] /= map.L[rows * i + i];
      }
    // Normal equations with the residual as a last row. The last pivot is not used: + 1 keeps it positive.
    std::vector<double> N(kColumns * kColumns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t r = 0; r < kColumns; ++r)
        for (std::size_t k = 0; k < kColumns; ++k) N[kColumns * r + k] += A[kColumns * i + r] * A[kColumns * i + k];
    N.back() += 1;
    if (!cholesky(N, kColumns)) return std::nullopt;
    double step[3];
    for (std::size_t r = 3; r-- > 0;) {
      step[r] = N[kColumns * 3 + r];
      for (std::size_t k = r + 1; k < 3; ++k) step[r] -= N[kColumns * k + r] * step[k];
      step[r] /= N[kColumns * r + r];
    }
    start.pose.x += step[0];
    start.pose.y += step[1];
    start.pose.heading += step[2];
    factor = N;
  }
  // Covariance = U^T U, U = L^-1, of the first three rows of the factor.
  double U[9] = {};
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = j; i < 3; ++i) {
      double sum = i == j ? 1 : 0;
      for (std::size_t k = j; k < i; ++k) sum -= factor[kColumns * i + k] * U[3 * k + j];
      U[3 * i + j] = sum / factor[kColumns * i + i];
    }
  constexpr std::size_t kAxis[3] = {0, 1, 5};  // x, y, yaw
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) start.covariance[6 * kAxis[i] + kAxis[j]] += U[3 * k + i] * U[3 * k + j];
  return start;
}

}  // namespace

std::optional<RobotStart> start_from_posts(const MrclamLog& log, const MrclamLog::Robot& robot,
                                           const MrclamNoise& noise) {
  const Filter filter = make_filter(log.landmarks.size(), noise);
  RobotTrack track(log, robot, noise);
  std::optional<RobotStart> best;
  auto next = robot.measurements.begin();
  for (const double time : kTimes) {
    for (; next != robot.measurements.end() && next->time <= robot.odometry.front().time + time; ++next) {
      if (!track.started(next->time)) continue;
      VehicleStep step;
      track.advance(next->time, step);
      feed(filter.get(), step);
    }
    const std::optional<PostMap> map = map_of(filter.get());
    const std::optional<RobotStart> start = map ? lay(log, *map) : std::nullopt;
    if (!start) continue;
    best = start;
    if (std::sqrt(best->covariance[35]) <= kGoodHeadingSigma) break;
  }
  if (best && !(std::sqrt(best->covariance[35]) <= kWorstHeadingSigma)) best.reset();
  return best;
}

}  // namespace cairn::program
