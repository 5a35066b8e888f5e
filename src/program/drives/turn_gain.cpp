// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/turn_gain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

namespace cairn::program {
namespace {

constexpr double kPi = 3.14159265358979323846;

using Robot = logs::MrclamLog::Robot;

bool on_the_spot(const logs::MrclamLog::Odometry& record) {
  constexpr double kStands = 0.001;  // m/s
  return std::abs(record.speed) < kStands;
}

// Dead reckoning by the odometry, and how it turned.
struct Reckoned {
  double x = 0, y = 0, heading = 0;
  double turned_driving = 0, turned_on_spot = 0;  // sums of |rate| dt
};

// Follows the odometry from one time to later ones.
class DeadReckoning {
 public:
  explicit DeadReckoning(const Robot& robot) : odometry_(robot.odometry), time_(robot.odometry.front().time) {}

  const Reckoned& at(double time) {
    while (time_ < time) {
      while (next_ < odometry_.size() && odometry_[next_].time <= time_) ++next_;
      const double until = next_ < odometry_.size() ? std::min(time, odometry_[next_].time) : time;
      const auto& record = odometry_[next_ - 1];
      const double dt = until - time_, middle = now_.heading + 0.5 * record.rate * dt;
      now_.x += record.speed * dt * std::cos(middle);
      now_.y += record.speed * dt * std::sin(middle);
      now_.heading += record.rate * dt;
      (on_the_spot(record) ? now_.turned_on_spot : now_.turned_driving) += std::abs(record.rate) * dt;
      time_ = until;
    }
    return now_;
  }

 private:
  const std::vector<logs::MrclamLog::Odometry>& odometry_;
  double time_;
  std::size_t next_ = 1;  // the record after the one that holds
  Reckoned now_;
};

struct Sighting {
  double time, range, bearing;
  Reckoned from;
};

double quantile(std::vector<double>& values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The gain is believed where single turns agree on it: a robot that follows its commands now well and now badly has
// noise, which the filter knows, and no gain.
TurnGain::Kind judge(std::vector<double>& excess) {
  constexpr std::size_t kEnough = 100;
  constexpr double kAgree = 2;          // standard deviations of a single turn
  constexpr double kQuartiles = 1.349;  // between the quartiles of a normal variable, in standard deviations
  TurnGain::Kind kind;
  kind.turns = excess.size();
  if (excess.size() < kEnough) return kind;
  const double middle = quantile(excess, 0.5);
  const double spread = (quantile(excess, 0.75) - quantile(excess, 0.25)) / kQuartiles;
  if (std::abs(middle) > kAgree * spread) kind.gain = 1 + middle;
  return kind;
}

class Turns {
 public:
  // Compares a post's bearing before and after a turn. A robot that turns more than recorded sees the post farther to
  // its right than dead reckoning predicts.
  void compare(const Sighting& before, const Sighting& after) {
    constexpr double kLeastTurn = 0.3;  // rad
    constexpr double kOneWay = 0.9;     // of all that is turned
    const double turn = after.from.heading - before.from.heading;
    const double driving = after.from.turned_driving - before.from.turned_driving;
    const double on_spot = after.from.turned_on_spot - before.from.turned_on_spot;
    if (!(std::abs(turn) > kLeastTurn && std::abs(turn) > kOneWay * (driving + on_spot))) return;
    const double ahead = before.from.heading + before.bearing;
    const double dx = before.from.x + before.range * std::cos(ahead) - after.from.x;
    const double dy = before.from.y + before.range * std::sin(ahead) - after.from.y;
    const double error = std::remainder(after.bearing - (std::atan2(dy, dx) - after.from.heading), 2 * kPi);
    if (driving > kOneWay * (driving + on_spot)) driving_.push_back(-error / turn);
    if (on_spot > kOneWay * (driving + on_spot)) on_spot_.push_back(-error / turn);
  }
  TurnGain gain() { return {judge(driving_), judge(on_spot_)}; }

 private:
  std::vector<double> driving_, on_spot_;  // true over recorded turn, minus 1
};

}  // namespace

TurnGain turn_gain(const logs::MrclamLog& log) {
  constexpr double kSoonest = 1, kLatest = 4;  // s between two sightings: a whole turn, and little other error
  Turns turns;
  for (const Robot& robot : log.robots) {
    DeadReckoning reckoning(robot);
    std::map<std::uint64_t, std::vector<Sighting>> posts;
    for (const auto& m : robot.measurements)
      if (log.landmarks.count(m.subject) > 0 && m.time >= robot.odometry.front().time)
        posts[m.subject].push_back({m.time, m.range, m.bearing, reckoning.at(m.time)});
    for (const auto& [post, seen] : posts) {
      std::size_t later = 0;
      for (const Sighting& before : seen) {
        while (later < seen.size() && seen[later].time < before.time + kSoonest) ++later;
        if (later == seen.size()) break;
        if (seen[later].time < before.time + kLatest) turns.compare(before, seen[later]);
      }
    }
  }
  return turns.gain();
}

void correct_turns(logs::MrclamLog& log) {
  const TurnGain gain = turn_gain(log);
  for (Robot& robot : log.robots)
    for (auto& record : robot.odometry) record.rate *= on_the_spot(record) ? gain.on_spot.gain : gain.driving.gain;
  const auto note = [&](const TurnGain::Kind& kind, const char* which) {
    if (kind.gain == 1) return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "turns %s: %.2f of the odometry's rate, by posts seen before and after %zu of them", which, kind.gain,
                  kind.turns);
    log.notes.push_back(text);
  };
  note(gain.driving, "while driving");
  note(gain.on_spot, "on the spot");
}

}  // namespace cairn::program
