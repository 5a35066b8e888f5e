// SPDX-License-Identifier: BSD-3-Clause
#include "team/score.hpp"

#include <cmath>

namespace cairn {
namespace {

FilterOptions<SE2> single_map(const TeamOptions& options) {
  FilterOptions<SE2> filter = options.filter;
  filter.submap_landmarks = 0;
  return filter;
}

template <class Function>
void ignore_errors(Function&& function) {
  try {
    function();
  } catch (const Error&) {
  }
}

}  // namespace

Baseline::Baseline(const TeamOptions& options) : own_(single_map(options), options.mail.vehicle, options.radar) {}

void Baseline::propagate(const Increment<SE2>& increment) {
  ignore_errors([&] { own_.filter().propagate(increment); });
}

void Baseline::observe(const std::vector<Observation>& landmarks) {
  ignore_errors([&] { own_.update(kRadarSensor, Scan(landmarks)); });
}

void Score::add(const Team& team, const Baseline* baseline, const SE2& truth) {
  const VehicleEstimate now = team.estimate(team.options().mail.vehicle);
  ++steps_;
  claimed_ += now.covariance.topLeftCorner<2, 2>().norm();
  squared_error_ += (truth.translation() - now.pose.translation()).squaredNorm();
  const double nees = team.pose_nees(truth);
  if (nees >= 0.0) {
    ++nees_steps_;
    nees_ += nees;
  }
  if (baseline == nullptr) return;
  const auto alone = baseline->filter().vehicle();
  baseline_claimed_ += alone.covariance.topLeftCorner<2, 2>().norm();
  baseline_squared_error_ += (truth.translation() - alone.pose.translation()).squaredNorm();
}

double Score::position_rmse() const {
  return steps_ > 0 ? std::sqrt(squared_error_ / static_cast<double>(steps_)) : 0.0;
}
double Score::anees_per_dof() const {
  return nees_steps_ > 0 ? nees_ / (3.0 * static_cast<double>(nees_steps_)) : 0.0;
}
double Score::claimed_improvement() const {
  return baseline_claimed_ > 0.0 ? 1.0 - claimed_ / baseline_claimed_ : 0.0;
}
double Score::true_improvement() const {
  return baseline_squared_error_ > 0.0 ? 1.0 - squared_error_ / baseline_squared_error_ : 0.0;
}

}  // namespace cairn
