// SPDX-License-Identifier: BSD-3-Clause
// Errors of a filter over many runs.
#include "tracker.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace consistency {

double quantile(double dof, double z) {
  return dof * std::pow(1 - 2 / (9 * dof) + z * std::sqrt(2 / (9 * dof)), 3);
}

void check(cairn_status status, const char* what) {
  if (status == CAIRN_OK) return;
  std::fprintf(stderr, "%s: %s: %s\n", what, cairn_status_name(status), cairn_last_message());
  std::exit(2);
}

void Tracker::start(const Noise& noise, const cairn_pose& pose, const Setup& setup) {
  cairn_filter_options options;
  CHECK(cairn_filter_options_init(&options, sizeof options, nullptr));
  options.state_error = kind_.error;
  options.max_landmarks = options.max_observations = World::kLandmarks;
  options.submap_landmarks = kind_.submap_landmarks;
  options.join = kind_.join;
  if (!setup.gated) options.gate_probability = options.batch_gate_probability = 1;
  options.initial_pose = pose;
  if (setup.iterations > 0) options.iterations = setup.iterations;
  CHECK(cairn_filter_create(&options, &filter_, nullptr));
  cairn_twist_noise motion;
  CHECK(cairn_twist_noise_init(&motion, sizeof motion, nullptr));
  for (int i = 0; i < 3; ++i) motion.velocity_sigma[i] = noise.velocity, motion.rate_sigma[i] = noise.rate;
  CHECK(cairn_filter_set_twist_noise(filter_, &motion, nullptr));
  cairn_stereo_head head;
  CHECK(cairn_stereo_head_init(&head, sizeof head, nullptr));
  head.range_sigma = noise.range;
  head.azimuth_sigma = head.elevation_sigma = noise.bearing;
  CHECK(cairn_filter_add_stereo_head(filter_, &head, &sensor_, nullptr));
  CHECK(cairn_filter_set_loss(filter_, sensor_, setup.loss, setup.loss_width, nullptr));
  submaps_ = 0;
}

void Tracker::predict(const double velocity[3], const double rate[3]) {
  CHECK(cairn_filter_predict_twist(filter_, World::kStep, velocity, rate, nullptr));
}

void Tracker::update(int frame, const std::vector<cairn_observation>& seen, const cairn_pose& truth) {
  if (!kind_.sees) return;
  CHECK(cairn_filter_update(filter_, sensor_, seen.data(), seen.size(), nullptr, nullptr));
  cairn_update_report report = {};
  report.struct_size = sizeof report;
  CHECK(cairn_filter_last_update(filter_, &report, nullptr));
  nis_[frame].value += report.nis;
  nis_[frame].dof += report.rows;
  count_closing();
  size_t open = 0;
  CHECK(cairn_map_size(cairn_filter_local_map(filter_), &open, nullptr));
  if (has_submaps() && frame + 1 == World::kFrames && open > 0) {
    CHECK(cairn_filter_close_submap(filter_, nullptr));
    count_closing();
  }
  double nees = 0;
  CHECK(cairn_filter_pose_nees(filter_, &truth, &nees, nullptr));
  nees_[frame].value += nees;
  nees_[frame].dof += 6;
}

void Tracker::count_closing() {
  cairn_closing_report closing = {};
  closing.struct_size = sizeof closing;
  CHECK(cairn_filter_last_closing(filter_, &closing, nullptr));
  check(static_cast<cairn_status>(closing.status), "closing a submap");
  if (closing.submaps == submaps_) return;
  submaps_ = closing.submaps;
  ++closings_;
  fused_ += closing.landmarks_fused;
  refused_ += closing.landmarks_refused;
}

void Tracker::finish(const cairn_pose& truth) {
  cairn_pose pose;
  double error[6];
  CHECK(cairn_filter_pose(filter_, &pose, nullptr, nullptr));
  CHECK(cairn_pose_error(&truth, &pose, error, nullptr));
  for (int i = 0; i < 3; ++i) position_ += error[i] * error[i], attitude_ += error[3 + i] * error[3 + i];
  ++runs_;
  cairn_filter_destroy(filter_);
  filter_ = nullptr;
}

double Tracker::nis_deviation() const {
  double value = 0, dof = 0;
  for (const Sum& sum : nis_) value += sum.value, dof += sum.dof;
  return (value - dof) / std::sqrt(2 * dof);
}

double Tracker::final_metres() const {
  return std::sqrt(position_ / runs_);
}

double Tracker::final_degrees() const {
  return std::sqrt(attitude_ / runs_) * (180 / 3.14159265358979323846);
}

double Tracker::share(const Sums& sums) {
  int inside = 0, counted = 0;
  for (const Sum& sum : sums)
    if (sum.dof > 0) ++counted, inside += sum.inside();
  return static_cast<double>(inside) / counted;
}

double Tracker::mean(const Sums& sums) {
  double value = 0, dof = 0;
  for (const Sum& sum : sums) value += sum.value, dof += sum.dof;
  return value / dof;
}

}  // namespace consistency
