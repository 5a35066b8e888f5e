// SPDX-License-Identifier: BSD-3-Clause
// A vehicle that runs for a long time in a known place: time of a closing, memory and error must not grow with the time
// driven. Prints one line of JSON:
//
//   lifelong WORLD [STEPS [JOIN [SEED]]]
//
// WORLD: laps (200 landmarks around a circle), square (random ways through one square kilometre, a step is ten
// seconds), stand (it stands still, and closes a submap every 50 steps), stand_open (it stands still). JOIN: sparse or
// dense.
#include <cairn/cairn.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "cairn_run.hpp"
#include "samples.hpp"

namespace {

using bench::check;

struct Point {
  double x, y, z;
};

class World {
 public:
  World(const std::string& name, unsigned seed) : random_(seed), standing_(name.rfind("stand", 0) == 0) {
    if (name == "square") {
      square_ = true;
      for (int i = 0; i < 40; ++i)
        for (int k = 0; k < 40; ++k) add({25.0 * i + uniform(-8, 8), 25.0 * k + uniform(-8, 8), uniform(0, 1.5)});
      place_ = {500, 500, 0};
      aim();
      return;
    }
    for (int i = 0; i < 200; ++i) {
      const double angle = uniform(0, 6.283185307179586), away = kRadius + uniform(-25, 25);
      add({away * std::cos(angle), away * std::sin(angle), uniform(0, 1.5)});
    }
    place_ = {kRadius, 0, 0};
    heading_ = 1.5707963267948966;
  }

  const std::vector<Point>& landmarks() const { return landmarks_; }
  const Point& place() const { return place_; }
  double heading() const { return heading_; }

  // Moves on; returns the distance and the turn that the vehicle measures.
  std::pair<double, double> advance() {
    double way = standing_ ? 0.0 : kStep, turn = 0.0;
    if (square_) {
      const double dx = aim_.x - place_.x, dy = aim_.y - place_.y;
      if (std::hypot(dx, dy) < kStep) aim();
      const double wanted =
          std::remainder(std::atan2(aim_.y - place_.y, aim_.x - place_.x) - heading_, 6.283185307179586);
      turn = std::max(-0.3, std::min(0.3, wanted));
    } else if (!standing_) {
      turn = kStep / kRadius;
    }
    heading_ += turn;
    place_.x += way * std::cos(heading_);
    place_.y += way * std::sin(heading_);
    return {way, turn};
  }

  // What it sees, in the axes of the body.
  void look(std::vector<cairn_observation>& seen) {
    seen.clear();
    const auto cell = [](double x) { return static_cast<int>(std::floor(x / kCell)); };
    for (int i = cell(place_.x) - 1; i <= cell(place_.x) + 1; ++i)
      for (int k = cell(place_.y) - 1; k <= cell(place_.y) + 1; ++k) {
        const auto found = cells_.find({i, k});
        if (found == cells_.end()) continue;
        for (const std::size_t number : found->second) {
          const double dx = landmarks_[number].x - place_.x, dy = landmarks_[number].y - place_.y;
          if (std::hypot(dx, dy) > kCell || seen.size() == 12) continue;
          const double c = std::cos(heading_), s = std::sin(heading_);
          cairn_observation observation{};
          observation.id = number;
          observation.z[0] = c * dx + s * dy + normal(kSight);
          observation.z[1] = -s * dx + c * dy + normal(kSight);
          observation.z[2] = landmarks_[number].z - place_.z + normal(kSight);
          seen.push_back(observation);
        }
      }
  }
  double normal(double sigma) { return sigma * normal_(random_); }

  static constexpr double kSight = 0.2, kWay = 0.05, kTurn = 0.005;

 private:
  static constexpr double kRadius = 100, kStep = 1.0, kCell = 30.0;

  void add(const Point& p) {
    cells_[{static_cast<int>(std::floor(p.x / kCell)), static_cast<int>(std::floor(p.y / kCell))}].push_back(
        landmarks_.size());
    landmarks_.push_back(p);
  }
  void aim() { aim_ = {uniform(0, 975), uniform(0, 975), 0}; }
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  bool standing_, square_ = false;
  std::vector<Point> landmarks_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> cells_;
  Point place_{}, aim_{};
  double heading_ = 0.0;
};

double resident_mib() {
  std::ifstream file("/proc/self/statm");
  long pages = 0, resident = 0;
  file >> pages >> resident;
  return static_cast<double>(resident) * 4096.0 / 1048576.0;
}

double mean(const std::vector<double>& values, std::size_t from, std::size_t to) {
  double sum = 0.0;
  to = std::min(to, values.size());
  for (std::size_t i = from; i < to; ++i) sum += values[i];
  return to > from ? sum / static_cast<double>(to - from) : 0.0;
}

int run(int count, char** arguments) {
  const std::string name = count > 1 ? arguments[1] : "laps", join = count > 3 ? arguments[3] : "sparse";
  const long steps = count > 2 ? std::atol(arguments[2]) : 100000;
  World world(name, count > 4 ? static_cast<unsigned>(std::atol(arguments[4])) : 3u);

  cairn_filter_options options;
  cairn_filter_options_init(&options, sizeof options, nullptr);
  options.max_landmarks = static_cast<std::uint32_t>(world.landmarks().size() + 100);
  options.submap_landmarks = 60;
  options.join = join == "dense" ? CAIRN_JOIN_DENSE : CAIRN_JOIN_SPARSE;
  cairn_pose start{{world.place().x, world.place().y, world.place().z}, {1, 0, 0, 0}};
  const double turn[3] = {0, 0, world.heading()};
  check(cairn_quaternion_exp(turn, start.quaternion, nullptr));
  options.initial_pose = start;
  cairn_filter* filter = nullptr;
  check(cairn_filter_create(&options, &filter, nullptr));
  cairn_cartesian points;
  cairn_cartesian_init(&points, sizeof points, nullptr);
  for (double& sigma : points.sigma) sigma = World::kSight;
  std::int32_t sensor = -1;
  check(cairn_filter_add_cartesian(filter, &points, &sensor, nullptr));
  cairn_twist_noise noise;
  cairn_twist_noise_init(&noise, sizeof noise, nullptr);
  for (int i = 0; i < 3; ++i) noise.velocity_sigma[i] = World::kWay, noise.rate_sigma[i] = World::kTurn;
  check(cairn_filter_set_twist_noise(filter, &noise, nullptr));

  std::vector<double> closings;
  bench::Samples times;
  times.reserve(static_cast<std::size_t>(steps));
  std::vector<cairn_observation> seen;
  bench::SquaredError pose_error, map_error;
  double nees_sum = 0.0, early_mib = 0.0;
  long samples = 0;
  std::size_t closed = 0;
  for (long step = 1; step <= steps; ++step) {
    const auto [way, by] = world.advance();
    // The body turns, then moves: its velocity is along its x axis at the end.
    const double rate[3] = {world.normal(World::kTurn), world.normal(World::kTurn), by + world.normal(World::kTurn)};
    const double half = 0.5 * by;
    const double velocity[3] = {way * std::cos(half) + world.normal(World::kWay),
                                way * std::sin(half) + world.normal(World::kWay), world.normal(World::kWay)};
    world.look(seen);
    const bench::Stopwatch watch;
    check(cairn_filter_predict_twist(filter, 1.0, velocity, rate, nullptr));
    check(cairn_filter_update(filter, sensor, seen.data(), seen.size(), nullptr, nullptr));
    if (name == "stand" && step % 50 == 0) check(cairn_filter_close_submap(filter, nullptr));
    times.add(watch.milliseconds());
    std::size_t now = 0;
    check(cairn_filter_submap_count(filter, &now, nullptr));
    if (now != closed) {
      closed = now;
      cairn_closing_report report;
      std::memset(&report, 0, sizeof report);
      report.struct_size = sizeof report;
      check(cairn_filter_last_closing(filter, &report, nullptr));
      closings.push_back(1e3 * report.seconds);
    }
    if (step == steps / 10) early_mib = resident_mib();
    if (step % 97 != 0) continue;
    cairn_pose pose, truth{{world.place().x, world.place().y, world.place().z}, {1, 0, 0, 0}};
    const double heading[3] = {0, 0, world.heading()};
    check(cairn_quaternion_exp(heading, truth.quaternion, nullptr));
    check(cairn_filter_pose(filter, &pose, nullptr, nullptr));
    double nees = 0.0;
    check(cairn_filter_pose_nees(filter, &truth, &nees, nullptr));
    pose_error.add(pose.position, truth.position);
    nees_sum += nees / 6.0;
    ++samples;
  }
  const cairn_map* map = cairn_filter_map(filter);
  std::size_t size = 0;
  check(cairn_map_size(map, &size, nullptr));
  for (std::size_t i = 0; i < world.landmarks().size(); ++i) {
    cairn_landmark landmark;
    if (cairn_map_landmark(map, i, &landmark, nullptr) != CAIRN_OK) continue;
    const Point& p = world.landmarks()[i];
    const double there[3] = {p.x, p.y, p.z};
    map_error.add(landmark.position, there);
  }
  const std::size_t n = closings.size(), last = n > 100 ? n - 100 : 0;
  std::printf(
      "{\"world\": \"%s\", \"join\": \"%s\", \"steps\": %ld, \"submaps\": %zu, \"landmarks\": %zu, "
      "\"closing_ms_100_to_200\": %.3f, \"closing_ms_last_100\": %.3f, \"closing_ms_worst\": %.3f, "
      "\"step_ms_mean\": %.4f, \"step_ms_p9999\": %.3f, \"step_ms_worst\": %.3f, \"rss_mib_tenth\": %.1f, "
      "\"rss_mib\": %.1f, \"pose_rmse_m\": %.4f, \"pose_nees_per_dof\": %.3f, \"landmark_rmse_m\": %.4f}\n",
      name.c_str(), join.c_str(), steps, closed, size, mean(closings, 100, 200), mean(closings, last, n),
      n > 0 ? *std::max_element(closings.begin(), closings.end()) : 0.0, times.mean(), times.quantile(0.9999),
      times.quantile(1.0), early_mib, resident_mib(), pose_error.rms(),
      nees_sum / static_cast<double>(std::max(samples, 1L)), map_error.rms());
  cairn_filter_destroy(filter);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lifelong: %s\n", error.what());
    return 1;
  }
}
