// SPDX-License-Identifier: BSD-3-Clause
// The figures of a run: gathered step by step, printed once.
#pragma once

#include <cairn/cairn.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/runner.hpp"
#include "io/log.hpp"

namespace cairn::cli {

// How far a pose is off, truth minus estimate: [dp; dtheta] as the library defines it, and the NEES where the pose's
// covariance is regular.
struct PoseScore {
  double error[6];
  std::optional<double> nees;
};

// Nothing where the step has no true pose.
std::optional<PoseScore> score_pose(const cairn_filter* filter, const io::Step& step, const cairn_pose& estimate);

// All landmarks of a filter's map, by ascending id.
std::vector<cairn_landmark> map_landmarks(const cairn_filter* filter);

// A figure's key and how to print it; there is no figure where the log has no truth for it.
struct Figure {
  const char* key;
  double value;
  bool whole;  // a count
};

class Summary {
 public:
  explicit Summary(const io::Log& log) : log_(log) {}

  void add(const StepResult& result, const std::optional<PoseScore>& score);
  // Once, after the last step. `seconds` is what the whole run took.
  void finish(const cairn_filter* filter, double seconds);

  std::string json() const;  // one object on one line
  std::string text() const;  // for people
  const std::vector<double>& step_seconds() const { return step_seconds_; }

 private:
  void count(const char* key, std::size_t value) { figures_.push_back({key, static_cast<double>(value), true}); }
  void measure(const char* key, double value);
  void finish_timing();
  void finish_pose();
  void finish_landmarks(const std::vector<cairn_landmark>& landmarks);

  const io::Log& log_;
  std::vector<double> step_seconds_;
  std::size_t observations_ = 0;
  std::size_t rejected_ = 0;
  std::size_t scored_ = 0;  // steps with a true pose
  double position_square_sum_ = 0;
  double position_last_ = 0;
  double position_worst_ = 0;
  double attitude_square_sum_ = 0;
  std::size_t nees_count_ = 0;
  double nees_sum_ = 0;
  double nis_sum_ = 0;
  std::size_t nis_rows_ = 0;
  std::vector<Figure> figures_;
};

}  // namespace cairn::cli
