// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/turn_gain.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

namespace cairn::program {
namespace {

constexpr double kRate = 0.5;  // recorded, rad/s

// A robot that turns while it drives, stops and turns on the spot, to the left and to the right. `driving` and
// `on_spot` give the gain of a turn by its number. It sees two posts four times a second, without noise.
logs::MrclamLog log_of(int turns, const std::function<double(int)>& driving,
                       const std::function<double(int)>& on_spot) {
  constexpr double kStep = 0.05, kTurn = 2;  // s
  logs::MrclamLog log;
  log.landmarks = {{6, {4, 1}}, {7, {-3, 3}}};
  log.robots.push_back({1, {}, {}, {}});
  logs::MrclamLog::Robot& robot = log.robots.back();
  double x = 0, y = 0, heading = 0;
  const int steps = static_cast<int>(kTurn / kStep);
  for (int turn = 0; turn < turns; ++turn) {
    const bool drives = turn % 2 == 0;
    const double rate = turn / 2 % 2 == 0 ? kRate : -kRate, speed = drives ? 0.1 : 0;
    const double gain = drives ? driving(turn) : on_spot(turn);
    for (int step = 0; step < steps; ++step) {
      const double time = (turn * steps + step) * kStep;
      robot.odometry.push_back({time, speed, rate});
      if (step % 5 == 0)
        for (const auto& [id, post] : log.landmarks) {
          const double dx = post[0] - x, dy = post[1] - y;
          robot.measurements.push_back({time, id, std::hypot(dx, dy), std::atan2(dy, dx) - heading});
        }
      const double middle = heading + 0.5 * gain * rate * kStep;
      x += speed * kStep * std::cos(middle);
      y += speed * kStep * std::sin(middle);
      heading += gain * rate * kStep;
    }
  }
  return log;
}

double always(int) {
  return 1;
}

TEST_CASE("turn gain: turns that follow the odometry change nothing") {
  logs::MrclamLog log = log_of(80, always, always);
  const TurnGain gain = turn_gain(log);
  CHECK(gain.driving.turns > 100);
  CHECK(gain.on_spot.turns > 100);
  CHECK(gain.driving.gain == doctest::Approx(1).epsilon(1e-9));
  CHECK(gain.on_spot.gain == doctest::Approx(1).epsilon(1e-9));
}

TEST_CASE("turn gain: turns while driving and on the spot are told apart") {
  const logs::MrclamLog log = log_of(
      80, [](int) { return 0.6; }, always);
  const TurnGain gain = turn_gain(log);
  CHECK(gain.driving.gain == doctest::Approx(0.6).epsilon(0.03));
  CHECK(gain.on_spot.gain == doctest::Approx(1).epsilon(0.03));
  const TurnGain other = turn_gain(log_of(80, always, [](int) { return 1.3; }));
  CHECK(other.driving.gain == doctest::Approx(1).epsilon(0.03));
  CHECK(other.on_spot.gain == doctest::Approx(1.3).epsilon(0.03));
}

TEST_CASE("turn gain: turns that differ from each other are noise, and few turns tell nothing") {
  const auto differing = [](int turn) { return turn % 8 < 4 ? 0.6 : 1.0; };
  CHECK(turn_gain(log_of(160, differing, always)).driving.gain == 1);
  CHECK(turn_gain(log_of(
                      8, [](int) { return 0.6; }, always))
            .driving.gain == 1);
}

TEST_CASE("turn gain: the log is corrected with a note") {
  logs::MrclamLog log = log_of(
      80, [](int) { return 0.6; }, always);
  const double gain = turn_gain(log).driving.gain;
  const std::vector<logs::MrclamLog::Odometry> before = log.robots[0].odometry;
  correct_turns(log);
  for (std::size_t i = 0; i < before.size(); ++i)
    CHECK(log.robots[0].odometry[i].rate == doctest::Approx(before[i].rate * (before[i].speed > 0 ? gain : 1)));
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].find("turns while driving: 0.60 of the odometry's rate") != std::string::npos);
  logs::MrclamLog right = log_of(8, always, always);
  correct_turns(right);
  CHECK(right.notes.empty());
}

}  // namespace
}  // namespace cairn::program
