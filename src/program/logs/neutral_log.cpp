// SPDX-License-Identifier: BSD-3-Clause
// The neutral text log: one record a line, SI units, fields separated by blanks.
//   T k t x y z roll pitch yaw          true pose at step k
//   O k dx dy dz droll dpitch dyaw      measured increment from step k-1 to k, in the body frame
//   Z k id range azimuth elevation      observation of a landmark, in the body frame
//   L id x y z                          true landmark
// Empty lines and lines that begin with # are skipped.
#include <cmath>
#include <limits>
#include <unordered_set>

#include "program/logs/log.hpp"
#include "program/logs/text_file.hpp"

namespace cairn::program::logs {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kIncrementPositionSigma = 0.02;        // m, each axis
constexpr double kIncrementAngleSigma = 0.1 * kDegree;  // each of roll, pitch, yaw
constexpr double kRangeSigma = 0.1;                     // m
constexpr double kDirectionSigma = 0.5 * kDegree;       // azimuth and elevation

// The noise is additive on roll, pitch and yaw; the filter takes it as dtheta in the axes of the body before:
// dtheta = ez dyaw + Rz ey dpitch + Rz Ry ex droll, the Euler-rate Jacobian of R = Rz Ry Rx.
Increment make_increment(const double* v) {
  Increment increment{};
  for (int i = 0; i < 3; ++i) increment.T_before_after.position[i] = v[i];
  const double pitch = v[4];
  const double yaw = v[5];
  cairn_quaternion_from_euler(v[3], pitch, yaw, increment.T_before_after.quaternion);
  const double jacobian[3][3] = {{std::cos(yaw) * std::cos(pitch), -std::sin(yaw), 0},
                                 {std::sin(yaw) * std::cos(pitch), std::cos(yaw), 0},
                                 {-std::sin(pitch), 0, 1}};
  for (int i = 0; i < 3; ++i) {
    increment.covariance[i * 7] = kIncrementPositionSigma * kIncrementPositionSigma;
    for (int j = 0; j < 3; ++j) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += jacobian[i][k] * jacobian[j][k];
      increment.covariance[(3 + i) * 6 + 3 + j] = kIncrementAngleSigma * kIncrementAngleSigma * sum;
    }
  }
  return increment;
}

class Reader {
 public:
  Reader(const std::string& path, const std::string& text) : lines_(path, text) {}

  Log read() {
    log_.format = "neutral text log";
    log_.sensor = SensorKind::kStereoHead;
    cairn_stereo_head_init(&log_.head, sizeof log_.head);
    log_.head.range_sigma = kRangeSigma;
    log_.head.azimuth_sigma = kDirectionSigma;
    log_.head.elevation_sigma = kDirectionSigma;
    while (lines_.next()) read_record();
    if (log_.steps.empty()) fail("no record T: the log has no steps");
    finish_step();
    return std::move(log_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { lines_.fail(cause); }
  std::string text(std::size_t index) const { return std::string(lines_.field(index)); }
  double number(std::size_t index, const char* name) const { return lines_.number(index, name); }
  std::uint64_t identity(std::size_t index) const { return lines_.identity(index, "id"); }

  void read_record() {
    const std::string_view letter = lines_.field(0);
    if (letter == "T") {
      read_truth();
    } else if (letter == "O") {
      read_increment();
    } else if (letter == "Z") {
      read_observation();
    } else if (letter == "L") {
      read_landmark();
    } else {
      fail("unknown record " + TextLines::quoted(letter) + ", expected T, O, Z or L");
    }
  }

  void expect_fields(std::size_t count) const {
    if (lines_.size() == count) return;
    fail("record " + text(0) + " has " + std::to_string(lines_.size()) + " fields, expected " + std::to_string(count));
  }

  // Goes to the step that field 1 names: the current one, or the next.
  Step& enter_step() {
    const std::uint64_t k = lines_.whole(1, "step");
    if (log_.steps.empty()) {
      if (lines_.field(0) != "T") fail("record " + text(0) + " before any true pose (T)");
    } else {
      const std::uint64_t current = log_.steps.back().number;
      if (k == current) return log_.steps.back();
      if (k < current) fail("step " + std::to_string(k) + " comes after step " + std::to_string(current));
      if (k - current > 1) {
        fail("step " + std::to_string(k) + " follows step " + std::to_string(current) + ": steps are missing");
      }
      finish_step();
    }
    log_.steps.emplace_back();
    log_.steps.back().number = k;
    seen_.clear();
    return log_.steps.back();
  }

  void finish_step() const {
    const Step& step = log_.steps.back();
    if (log_.steps.size() > 1 && !step.increment) {
      fail("step " + std::to_string(step.number) + " ends here without an increment (O)");
    }
  }

  void read_truth() {
    expect_fields(9);
    Step& step = enter_step();
    if (step.truth) fail("second true pose of step " + std::to_string(step.number));
    step.time = number(2, "time");
    if (step.time <= last_time_) fail("time " + text(2) + " does not increase");
    last_time_ = step.time;
    static constexpr const char* kNames[6] = {"x", "y", "z", "roll", "pitch", "yaw"};
    double v[6];
    for (std::size_t i = 0; i < 6; ++i) v[i] = number(3 + i, kNames[i]);
    cairn_pose pose{{v[0], v[1], v[2]}, {}};
    cairn_quaternion_from_euler(v[3], v[4], v[5], pose.quaternion);
    step.truth = pose;
  }

  void read_increment() {
    expect_fields(8);
    Step& step = enter_step();
    if (log_.steps.size() == 1) fail("increment (O) to the first step: there is none before it");
    if (step.increment) fail("second increment of step " + std::to_string(step.number));
    static constexpr const char* kNames[6] = {"dx", "dy", "dz", "droll", "dpitch", "dyaw"};
    double v[6];
    for (std::size_t i = 0; i < 6; ++i) v[i] = number(2 + i, kNames[i]);
    step.increment = make_increment(v);
  }

  void read_observation() {
    expect_fields(6);
    Step& step = enter_step();
    cairn_observation observation{};
    observation.id = identity(2);
    observation.z[0] = number(3, "range");
    observation.z[1] = number(4, "azimuth");
    observation.z[2] = number(5, "elevation");
    if (!(observation.z[0] > 0)) fail("range " + text(3) + " is not positive");
    if (!seen_.insert(observation.id).second) {
      fail("landmark " + std::to_string(observation.id) + " twice in step " + std::to_string(step.number));
    }
    step.observations.push_back(observation);
  }

  void read_landmark() {
    expect_fields(5);
    const std::uint64_t id = identity(1);
    const std::array<double, 3> position = {number(2, "x"), number(3, "y"), number(4, "z")};
    if (!log_.landmarks.emplace(id, position).second) fail("landmark " + std::to_string(id) + " a second time");
  }

  TextLines lines_;
  Log log_;
  std::unordered_set<std::uint64_t> seen_;  // ids of the current step
  double last_time_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Log read_neutral_log(const std::string& path, const std::string& text) {
  return Reader(path, text).read();
}

}  // namespace cairn::program::logs
