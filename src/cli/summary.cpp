// SPDX-License-Identifier: BSD-3-Clause
#include "cli/summary.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace cairn::cli {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr int kPoseDimension = 6;

double square_norm(const double* v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

double mean(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

double peak_rss_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts it in KiB
}

std::string format(const Figure& figure) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, figure.whole ? "%.0f" : "%.9g", figure.value);
  return buffer;
}

}  // namespace

std::optional<PoseScore> score_pose(const cairn_filter* filter, const io::Step& step, const cairn_pose& estimate) {
  if (!step.truth) return std::nullopt;
  PoseScore score{};
  if (cairn_pose_error(&*step.truth, &estimate, score.error) != CAIRN_OK) throw LibraryError(cairn_last_message());
  double nees = 0;
  const cairn_status status = cairn_filter_pose_nees(filter, &*step.truth, &nees);
  if (status == CAIRN_OK) {
    score.nees = nees;
  } else if (status != CAIRN_ERROR_NUMERICAL) {  // singular covariance, as at the known start: no score
    throw LibraryError(cairn_last_message());
  }
  return score;
}

std::vector<cairn_landmark> map_landmarks(const cairn_filter* filter) {
  const cairn_map* map = cairn_filter_map(filter);
  std::size_t count = 0;
  cairn_status status = cairn_map_size(map, &count);
  std::vector<cairn_landmark> landmarks(count);
  if (status == CAIRN_OK && count > 0) status = cairn_map_landmarks(map, landmarks.data(), count, &count);
  if (status != CAIRN_OK) throw LibraryError(cairn_last_message());
  return landmarks;
}

void Summary::add(const StepResult& result, const std::optional<PoseScore>& score) {
  step_seconds_.push_back(result.seconds);
  observations_ += result.matches.size();
  for (const cairn_match& match : result.matches) rejected_ += match.result == CAIRN_REJECTED;
  nis_sum_ += result.report.nis;
  nis_rows_ += result.report.rows;
  if (!score) return;
  ++scored_;
  const double position = square_norm(score->error);
  position_square_sum_ += position;
  position_last_ = std::sqrt(position);
  position_worst_ = std::max(position_worst_, position_last_);
  attitude_square_sum_ += square_norm(score->error + 3);
  if (score->nees) {
    ++nees_count_;
    nees_sum_ += *score->nees;
  }
}

void Summary::measure(const char* key, double value) {
  if (std::isfinite(value)) figures_.push_back({key, value, false});  // JSON knows no other numbers
}

void Summary::finish(const cairn_filter* filter, double seconds) {
  const std::vector<cairn_landmark> landmarks = map_landmarks(filter);
  count("steps", step_seconds_.size());
  count("landmarks", landmarks.size());
  count("observations", observations_);
  count("rejected", rejected_);
  measure("seconds", seconds);
  finish_timing();
  measure("peak_rss_mib", peak_rss_mib());
  finish_pose();
  finish_landmarks(landmarks);
  if (nees_count_ > 0) measure("pose_anees_per_dof", nees_sum_ / static_cast<double>(nees_count_) / kPoseDimension);
  if (nis_rows_ > 0) measure("nis_per_dof", nis_sum_ / static_cast<double>(nis_rows_));
}

void Summary::finish_timing() {
  if (step_seconds_.empty()) return;
  std::vector<double> sorted = step_seconds_;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t count = sorted.size();
  const std::size_t p99 = (count * 99 + 99) / 100 - 1;  // nearest rank
  const auto middle = step_seconds_.cbegin() + static_cast<std::ptrdiff_t>(count / 2);
  measure("step_ms_mean", 1e3 * mean(step_seconds_.cbegin(), step_seconds_.cend()));
  measure("step_ms_second_half", 1e3 * mean(middle, step_seconds_.cend()));
  measure("step_ms_p99", 1e3 * sorted[p99]);
  measure("step_ms_worst", 1e3 * sorted.back());
}

void Summary::finish_pose() {
  if (scored_ == 0) return;
  const auto count = static_cast<double>(scored_);
  measure("pose_rmse_m", std::sqrt(position_square_sum_ / count));
  measure("pose_final_m", position_last_);
  measure("pose_max_m", position_worst_);
  measure("attitude_rmse_deg", kDegreesPerRadian * std::sqrt(attitude_square_sum_ / count));
}

void Summary::finish_landmarks(const std::vector<cairn_landmark>& landmarks) {
  double sum = 0;
  std::size_t known = 0;
  for (const cairn_landmark& landmark : landmarks) {
    const auto truth = log_.landmarks.find(landmark.id);
    if (truth == log_.landmarks.end()) continue;
    ++known;
    for (std::size_t i = 0; i < 3; ++i) sum += std::pow(truth->second[i] - landmark.position[i], 2);
  }
  if (known > 0) measure("landmark_rmse_m", std::sqrt(sum / static_cast<double>(known)));
}

std::string Summary::json() const {
  std::string out = "{";
  for (const Figure& figure : figures_) {
    if (out.size() > 1) out += ", ";
    out += "\"" + std::string(figure.key) + "\": " + format(figure);
  }
  return out + "}\n";
}

std::string Summary::text() const {
  std::string out;
  char buffer[96];
  for (const Figure& figure : figures_) {
    std::snprintf(buffer, sizeof buffer, figure.whole ? "%-20s %12.0f\n" : "%-20s %12.6g\n", figure.key, figure.value);
    out += buffer;
  }
  return out;
}

}  // namespace cairn::cli
