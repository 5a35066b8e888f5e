// SPDX-License-Identifier: BSD-3-Clause
#include "program/runners/runner.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "program/library.hpp"

namespace cairn::program {
namespace {

constexpr std::size_t kLandmarkMargin = 8;
constexpr std::size_t kMostLandmarks = 10000000, kMostObservations = 4096,
                      kMostPoses = 10000000;  // limits of the library

}  // namespace

Runner::Runner(Drive& drive, const FilterChoices& choices) : drive_(drive), choices_(choices) {
  create();
}

void Runner::check(cairn_status status) const {
  if (status == CAIRN_OK) return;
  program::check(status, started_ ? "step " + std::to_string(step_.number) + ": " : "");
}

void Runner::create() {
  cairn_filter_options options;
  check(cairn_filter_options_init(&options, sizeof options, nullptr));
  const std::size_t needed =
      std::min(kMostLandmarks, drive_.landmarks_at_once(choices_.forget_after) + kLandmarkMargin);
  // Without known ids some landmarks may be placed twice.
  const std::size_t room = std::min(kMostLandmarks, choices_.names_known() ? needed : 2 * needed);
  options.max_landmarks = static_cast<std::uint32_t>(room);
  options.max_observations = static_cast<std::uint32_t>(std::min(kMostObservations, drive_.largest_frame()));
  options.submap_landmarks = usual_submap(options.max_observations);
  options.trajectory_poses = static_cast<std::uint32_t>(std::min(kMostPoses, drive_.steps()));
  choices_.apply(options);
  options.vehicle = drive_.planar() ? CAIRN_VEHICLE_PLANAR : CAIRN_VEHICLE_SPATIAL;
  has_submaps_ = options.submap_landmarks > 0;
  options.initial_pose = drive_.start();
  cairn_filter* filter = nullptr;
  check(cairn_filter_create(&options, &filter, nullptr));
  filter_.reset(filter);
  sensor_ = drive_.equip(filter);
  if (choices_.loss)
    check(
        cairn_filter_set_loss(filter, sensor_, *choices_.loss, choices_.loss_width.value_or(kUsualLossWidth), nullptr));
  check(choices_.systematic.calibrate(filter, sensor_));
}

void Runner::run(const Observer& observe) {
  while (drive_.next(step_)) {
    started_ = true;
    result_.matches.resize(step_.count);
    if (step_.noise) check(cairn_filter_set_twist_noise(filter_.get(), &*step_.noise, nullptr));
    if (drive_.has_mount()) check(cairn_filter_point_head(filter_.get(), sensor_, step_.pan, step_.stick, nullptr));
    const auto begin = std::chrono::steady_clock::now();
    predict();
    update();
    forget();
    const auto end = std::chrono::steady_clock::now();
    result_.seconds = std::chrono::duration<double>(end - begin).count();
    report();
    observe(filter_.get(), step_, result_);
  }
}

void Runner::predict() {
  if (step_.increment != nullptr) {
    check(cairn_filter_predict_increment(filter_.get(), &step_.increment->T_before_after,
                                         step_.increment->covariance.data(), nullptr));
  }
  for (const logs::Twist& twist : step_.twists) {
    check(cairn_filter_predict_twist(filter_.get(), twist.dt, twist.velocity.data(), twist.rate.data(), nullptr));
  }
  for (const WheelTurn& turn : step_.wheel_turns) {
    if (turn.rate)
      check(
          cairn_filter_predict_wheels_gyro(filter_.get(), turn.dt, turn.left, turn.right, turn.rate->data(), nullptr));
    else
      check(cairn_filter_predict_wheels(filter_.get(), turn.dt, turn.left, turn.right, nullptr));
  }
}

void Runner::update() {
  if (step_.count == 0) return check(cairn_filter_keep_pose(filter_.get(), nullptr, nullptr));
  check(cairn_filter_update(filter_.get(), sensor_, step_.observations, step_.count, result_.matches.data(), nullptr));
}

// A refused observation does not count. A landmark whose observations are all refused is removed; its track may then
// place it anew.
void Runner::forget() {
  if (choices_.forget_after == 0) return;
  for (const cairn_match& match : result_.matches) {
    if (match.result != CAIRN_RESULT_REJECTED) last_seen_[match.landmark] = step_.index;
  }
  for (auto entry = last_seen_.begin(); entry != last_seen_.end();) {
    if (step_.index - entry->second >= choices_.forget_after) {
      const cairn_status status = cairn_filter_remove_landmark(filter_.get(), entry->first, nullptr);
      // A closing may have refused the landmark before.
      if (status != CAIRN_ERROR_NOT_FOUND || !has_submaps_) check(status);
      entry = last_seen_.erase(entry);
    } else {
      ++entry;
    }
  }
}

void Runner::report() {
  result_.report = cairn_update_report{};
  result_.report.struct_size = sizeof result_.report;
  if (step_.count > 0) check(cairn_filter_last_update(filter_.get(), &result_.report, nullptr));
  check(cairn_filter_pose(filter_.get(), &result_.pose, result_.covariance, nullptr));
  check(cairn_filter_local_pose(filter_.get(), nullptr, result_.local_covariance, nullptr));
  check(cairn_map_size(cairn_filter_map(filter_.get()), &result_.landmarks, nullptr));
  check(cairn_map_size(cairn_filter_local_map(filter_.get()), &result_.filter_landmarks, nullptr));
  result_.health.struct_size = sizeof result_.health;
  check(cairn_filter_health(filter_.get(), &result_.health, nullptr));
  result_.sensor_health.struct_size = sizeof result_.sensor_health;
  check(cairn_filter_sensor_health(filter_.get(), sensor_, &result_.sensor_health, nullptr));
  result_.closing = new_closing();
  if (result_.closing) result_.filter_landmarks += result_.closing->landmarks;
}

std::optional<cairn_closing_report> Runner::new_closing() {
  std::size_t closings = 0;
  check(cairn_filter_submap_count(filter_.get(), &closings, nullptr));
  if (closings == closings_) return std::nullopt;
  closings_ = closings;
  cairn_closing_report report{};
  report.struct_size = sizeof report;
  check(cairn_filter_last_closing(filter_.get(), &report, nullptr));
  return report;
}

std::optional<cairn_closing_report> Runner::finish() {
  if (!has_submaps_) return std::nullopt;
  std::size_t open = 0;
  check(cairn_map_size(cairn_filter_local_map(filter_.get()), &open, nullptr));
  if (open == 0) return std::nullopt;
  check(cairn_filter_close_submap(filter_.get(), nullptr));
  return new_closing();
}

}  // namespace cairn::program
