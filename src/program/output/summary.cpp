// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "program/library.hpp"
#include "program/output/process.hpp"

namespace cairn::program {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

double square_norm(const double* v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

double mean(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

}  // namespace

std::optional<PoseScore> score_pose(const cairn_filter* filter, const DriveStep& step, const cairn_pose& estimate) {
  if (!step.truth) return std::nullopt;
  PoseScore score{};
  check(cairn_pose_error(&*step.truth, &estimate, score.error, nullptr));
  double nees = 0;
  const cairn_status status = cairn_filter_pose_nees(filter, &*step.truth, &nees, nullptr);
  if (status == CAIRN_OK) {
    score.nees = nees;
  } else if (status != CAIRN_ERROR_NUMERICAL) {  // singular covariance, as at the known start: no score
    check(status);
  }
  return score;
}

std::vector<cairn_landmark> map_landmarks(const cairn_filter* filter) {
  const cairn_map* map = cairn_filter_map(filter);
  std::size_t count = 0;
  cairn_status status = cairn_map_size(map, &count, nullptr);
  std::vector<cairn_landmark> landmarks(count);
  if (status == CAIRN_OK && count > 0) status = cairn_map_landmarks(map, landmarks.data(), count, &count, nullptr);
  check(status);
  return landmarks;
}

void Summary::add(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score) {
  step_seconds_.push_back(result.seconds);
  observations_ += result.matches.size();
  for (const cairn_match& match : result.matches) rejected_ += match.result == CAIRN_RESULT_REJECTED;
  if (!names_known_) add_pairings(step, result);
  nis_sum_ += result.report.nis;
  nis_rows_ += result.report.rows;
  const auto held = static_cast<double>(result.filter_landmarks);
  filter_landmarks_most_ = std::max(filter_landmarks_most_, result.filter_landmarks);
  filter_landmarks_sum_ += held;
  filter_landmarks_square_sum_ += held * held;
  if (result.closing) add_closing(*result.closing);
  sensor_health_ = result.sensor_health;
  last_truth_ = step.truth;
  if (!score) return;
  ++scored_;
  scored_later_ |= step.index > 0;
  const double position = square_norm(score->error);
  position_square_sum_ += position;
  position_last_ = std::sqrt(position);
  position_worst_ = std::max(position_worst_, position_last_);
  const double attitude = square_norm(score->error + 3);
  attitude_square_sum_ += attitude;
  attitude_last_ = std::sqrt(attitude);
  for (int axis = 0; axis < 3; ++axis) {
    position_worst_axis_ = std::max(position_worst_axis_, std::abs(score->error[axis]));
    attitude_worst_axis_ = std::max(attitude_worst_axis_, std::abs(score->error[3 + axis]));
  }
  if (score->nees) {
    ++nees_count_;
    nees_sum_ += *score->nees;
  }
}

void Summary::add_pairings(const DriveStep& step, const StepResult& result) {
  for (std::size_t i = 0; i < result.matches.size(); ++i) {
    const cairn_match& match = result.matches[i];
    const std::uint64_t name = step.observations[i].id;
    if (match.result == CAIRN_RESULT_NEW) {
      names_[match.landmark] = name;
    } else if (match.result == CAIRN_RESULT_MATCHED) {
      ++paired_;
      wrongly_paired_ += names_.at(match.landmark) != name;
    }
  }
  association_exhausted_ += result.report.association_exhausted;
}

std::uint64_t Summary::name_of(std::uint64_t landmark) const {
  return names_known_ ? landmark : names_.at(landmark);
}

void Summary::add_closing(const cairn_closing_report& closing) {
  ++submaps_;
  closing_worst_ = std::max(closing_worst_, closing.seconds);
}

void Summary::measure(const char* key, double value) {
  if (std::isfinite(value)) figures_.push_back({key, value, false});  // JSON has no other numbers
}

void Summary::finish(const cairn_filter* filter, const std::optional<cairn_closing_report>& last_closing,
                     const std::optional<double>& corrected_rmse, double seconds) {
  if (last_closing) {
    add_closing(*last_closing);
    closing_outside_ = last_closing->seconds;
  }
  const std::vector<cairn_landmark> landmarks = map_landmarks(filter);
  count("steps", step_seconds_.size());
  count("landmarks", landmarks.size());
  count("observations", observations_);
  count("rejected", rejected_);
  count("submaps", submaps_);
  if (!names_known_) {
    count("paired", paired_);
    count("paired_wrongly", wrongly_paired_);
    std::unordered_set<std::uint64_t> names;
    for (const cairn_landmark& landmark : landmarks) names.insert(name_of(landmark.id));
    count("landmarks_twice", landmarks.size() - names.size());
    count("association_exhausted", association_exhausted_);
  }
  measure("seconds", seconds);
  finish_timing();
  measure("peak_rss_mib", peak_rss_mib());
  finish_pose(filter);
  if (corrected_rmse && scored_later_) measure("pose_rmse_corrected_m", *corrected_rmse);
  finish_landmarks(landmarks);
  const int pose_dimension = drive_.planar() ? 3 : 6;
  if (nees_count_ > 0) measure("pose_anees_per_dof", nees_sum_ / static_cast<double>(nees_count_) / pose_dimension);
  if (nis_rows_ > 0) measure("nis_per_dof", nis_sum_ / static_cast<double>(nis_rows_));
  finish_health(filter);
}

// A scale of which the observations say nothing is left out.
void Summary::finish_health(const cairn_filter* filter) {
  cairn_health health{};
  health.struct_size = sizeof health;
  check(cairn_filter_health(filter, &health, nullptr));
  figures_.push_back({"verdict", 0, false, cairn_verdict_text(health.verdict)});
  measure("verdict_good_share", health.good_share);
  measure("verdict_doubtful_share", health.doubtful_share);
  measure("verdict_lost_share", health.lost_share);
  if (sensor_health_.compared > 0) {
    measure("refused_share",
            static_cast<double>(sensor_health_.refused) / static_cast<double>(sensor_health_.compared));
    measure("error_correlation", sensor_health_.persistence[0]);
  }
  count("widenings", health.widenings);
  if (sensor_health_.scale_sigma < sensor_health_.scale) {
    measure("sensor_noise_scale", sensor_health_.scale);
    measure("sensor_noise_scale_sigma", sensor_health_.scale_sigma);
  }
  if (health.motion_scale_sigma < health.motion_scale) {
    measure("motion_noise_scale", health.motion_scale);
    measure("motion_noise_scale_sigma", health.motion_scale_sigma);
  }
}

void Summary::finish_timing() {
  if (step_seconds_.empty()) return;
  const double steps_sum = std::accumulate(step_seconds_.cbegin(), step_seconds_.cend(), 0.0);
  measure("filter_seconds", steps_sum + closing_outside_);
  std::vector<double> sorted = step_seconds_;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t count = sorted.size();
  const std::size_t p99 = (count * 99 + 99) / 100 - 1;  // nearest rank
  const auto middle = step_seconds_.cbegin() + static_cast<std::ptrdiff_t>(count / 2);
  measure("step_ms_mean", 1e3 * mean(step_seconds_.cbegin(), step_seconds_.cend()));
  measure("step_ms_second_half", 1e3 * mean(middle, step_seconds_.cend()));
  measure("step_ms_p99", 1e3 * sorted[p99]);
  measure("step_ms_worst", 1e3 * sorted.back());
  if (submaps_ > 0) measure("closing_ms_worst", 1e3 * closing_worst_);
  this->count("filter_landmarks_max", filter_landmarks_most_);
  measure("filter_landmarks_mean", filter_landmarks_sum_ / static_cast<double>(count));
  measure("filter_landmarks_rms", std::sqrt(filter_landmarks_square_sum_ / static_cast<double>(count)));
}

void Summary::finish_pose(const cairn_filter* filter) {
  if (!scored_later_) return;
  const auto count = static_cast<double>(scored_);
  measure("pose_rmse_m", std::sqrt(position_square_sum_ / count));
  measure("pose_final_m", position_last_);
  measure("pose_max_m", position_worst_);
  measure("pose_axis_max_m", position_worst_axis_);
  measure("attitude_rmse_deg", kDegreesPerRadian * std::sqrt(attitude_square_sum_ / count));
  measure("attitude_final_deg", kDegreesPerRadian * attitude_last_);
  measure("attitude_axis_max_deg", kDegreesPerRadian * attitude_worst_axis_);
  if (!last_truth_) return;
  cairn_pose pose;  // after all submaps are closed
  double error[6];
  check(cairn_filter_pose(filter, &pose, nullptr, nullptr));
  check(cairn_pose_error(&*last_truth_, &pose, error, nullptr));
  measure("pose_end_m", std::sqrt(square_norm(error)));
  measure("attitude_end_deg", kDegreesPerRadian * std::sqrt(square_norm(error + 3)));
}

void Summary::finish_landmarks(const std::vector<cairn_landmark>& landmarks) {
  double sum = 0;
  std::size_t known = 0;
  for (const cairn_landmark& landmark : landmarks) {
    double truth[3];
    if (!drive_.true_landmark(name_of(landmark.id), truth)) continue;
    ++known;
    for (std::size_t i = 0; i < 3; ++i) sum += std::pow(truth[i] - landmark.position[i], 2);
  }
  if (known > 0) measure("landmark_rmse_m", std::sqrt(sum / static_cast<double>(known)));
}

}  // namespace cairn::program
