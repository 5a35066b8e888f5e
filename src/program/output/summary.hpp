// SPDX-License-Identifier: BSD-3-Clause
// The figures of a run: gathered step by step, printed once.
#pragma once

#include <cairn/cairn.h>

#include <optional>
#include <unordered_map>
#include <vector>

#include "program/output/figures.hpp"
#include "program/runners/runner.hpp"

namespace cairn::program {

// The error of a pose, truth minus estimate: [dp; dtheta] as the library defines it, and the NEES if the pose's
// covariance is regular.
struct PoseScore {
  double error[6];
  std::optional<double> nees;
};

// Returns nothing if the step has no true pose.
std::optional<PoseScore> score_pose(const cairn_filter* filter, const DriveStep& step, const cairn_pose& estimate);

// All landmarks of a filter's map, by ascending id.
std::vector<cairn_landmark> map_landmarks(const cairn_filter* filter);

class Summary {
 public:
  // Figures that need the truth are left out if the drive has none.
  Summary(const Drive& drive, bool names_known) : drive_(drive), names_known_(names_known) {}

  void add(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score);
  // To be called once, after the last step, with the closing of the submap that was still open, the error of the
  // corrected trajectory, if there is truth, and the time of the whole run.
  void finish(const cairn_filter* filter, const std::optional<cairn_closing_report>& last_closing,
              const std::optional<double>& corrected_rmse, double seconds);

  const std::vector<Figure>& figures() const { return figures_; }
  // The drive's id of one of the filter's landmarks: the id of the observation that placed it.
  std::uint64_t name_of(std::uint64_t landmark) const;

 private:
  void add_pairings(const DriveStep& step, const StepResult& result);
  void count(const char* key, std::size_t value) { figures_.push_back({key, static_cast<double>(value), true}); }
  void measure(const char* key, double value);
  void add_closing(const cairn_closing_report& closing);
  void finish_timing();
  void finish_health(const cairn_filter* filter);
  void finish_pose(const cairn_filter* filter);
  void finish_landmarks(const std::vector<cairn_landmark>& landmarks);

  const Drive& drive_;
  bool names_known_;
  // If the filter was given no ids:
  std::unordered_map<std::uint64_t, std::uint64_t> names_;
  std::size_t paired_ = 0, wrongly_paired_ = 0, association_exhausted_ = 0;
  std::vector<double> step_seconds_;
  std::size_t observations_ = 0;
  std::size_t rejected_ = 0;
  std::size_t scored_ = 0;                // steps with a true pose
  bool scored_later_ = false;             // one of them is not the start, which the filter was given
  std::optional<cairn_pose> last_truth_;  // of the last step
  double position_square_sum_ = 0;
  double position_last_ = 0;
  double position_worst_ = 0;
  double position_worst_axis_ = 0;
  double attitude_square_sum_ = 0;
  double attitude_last_ = 0;
  double attitude_worst_axis_ = 0;
  std::size_t nees_count_ = 0;
  double nees_sum_ = 0;
  double nis_sum_ = 0;
  std::size_t nis_rows_ = 0;
  cairn_sensor_health sensor_health_{};  // after the last step
  std::size_t submaps_ = 0;
  double closing_worst_ = 0;               // s
  double closing_outside_ = 0;             // s, of the closing after the last step
  std::size_t filter_landmarks_most_ = 0;  // in the filter that processes the frames
  double filter_landmarks_sum_ = 0;
  double filter_landmarks_square_sum_ = 0;
  std::vector<Figure> figures_;
};

}  // namespace cairn::program
