// SPDX-License-Identifier: BSD-3-Clause
#include "cli/runner.hpp"

#include <algorithm>
#include <chrono>
#include <string>

namespace cairn::cli {
namespace {

constexpr std::size_t kLandmarkMargin = 8;

std::size_t largest_frame(const io::Log& log) {
  std::size_t largest = 1;
  for (const io::Step& step : log.steps) largest = std::max(largest, step.observations.size());
  return largest;
}

}  // namespace

std::size_t landmarks_at_once(const io::Log& log, std::uint64_t forget_after) {
  std::map<std::uint64_t, std::size_t> last_seen;
  if (forget_after == 0) {
    for (std::size_t k = 0; k < log.steps.size(); ++k) {
      for (const cairn_observation& observation : log.steps[k].observations) last_seen[observation.id] = k;
    }
    return last_seen.size();
  }
  // A landmark is held from a frame that saw it until `forget_after` frames later, that frame's update included: add up
  // where those stretches begin and end.
  std::vector<std::int64_t> change(log.steps.size() + 1, 0);
  for (std::size_t k = 0; k < log.steps.size(); ++k) {
    const auto end_of = [&](std::size_t seen) {
      return forget_after < log.steps.size() - seen ? seen + forget_after + 1 : log.steps.size();
    };
    for (const cairn_observation& observation : log.steps[k].observations) {
      const auto [entry, is_new] = last_seen.emplace(observation.id, k);
      if (is_new || end_of(entry->second) <= k) {
        ++change[k];
      } else {
        ++change[end_of(entry->second)];  // it stays: take back the end that was set
      }
      entry->second = k;
      --change[end_of(k)];
    }
  }
  std::int64_t held = 0;
  std::int64_t most = 0;
  for (const std::int64_t step : change) {
    held += step;
    most = std::max(most, held);
  }
  return static_cast<std::size_t>(most);
}

Runner::Runner(const io::Log& log, const RunOptions& options) : log_(log), options_(options) {
  create();
}

// The library's own word, with the step that it was about.
void Runner::check(cairn_status status) const {
  if (status == CAIRN_OK) return;
  const std::string step = created_ ? "step " + std::to_string(log_.steps[result_.index].number) + ": " : "";
  throw LibraryError(step + cairn_status_name(status) + ": " + cairn_last_message());
}

void Runner::create() {
  cairn_filter_options options;
  check(cairn_filter_options_init(&options, sizeof options));
  const std::size_t needed = landmarks_at_once(log_, options_.forget_after) + kLandmarkMargin;
  options.error = options_.error;
  options.max_landmarks = options_.max_landmarks.value_or(static_cast<std::uint32_t>(needed));
  options.max_observations = static_cast<std::uint32_t>(largest_frame(log_));
  options.iterations = options_.iterations.value_or(options.iterations);
  options.gate_probability = options_.gate.value_or(options.gate_probability);
  options.batch_gate_probability = options_.batch_gate.value_or(options.batch_gate_probability);
  options.initial_pose = log_.steps.front().truth.value();
  cairn_filter* filter = nullptr;
  check(cairn_filter_create(&options, &filter));
  filter_.reset(filter);
  add_sensor();
  created_ = true;
}

void Runner::add_sensor() {
  if (log_.sensor == io::SensorKind::kStereoHead) {
    check(cairn_filter_add_stereo_head(filter_.get(), &log_.head, &sensor_));
    return;
  }
  cairn_stereo_camera camera = log_.camera;
  camera.min_disparity = options_.min_disparity.value_or(camera.min_disparity);
  camera.min_disparity_sigmas = options_.min_disparity_sigmas.value_or(camera.min_disparity_sigmas);
  check(cairn_filter_add_stereo_camera(filter_.get(), &camera, &sensor_));
  check(cairn_filter_set_twist_noise(filter_.get(), &log_.twist_noise));
}

void Runner::run(const std::function<void(const cairn_filter*, const StepResult&)>& observe) {
  for (result_.index = 0; result_.index < log_.steps.size(); ++result_.index) {
    const io::Step& step = log_.steps[result_.index];
    result_.matches.resize(step.observations.size());
    const auto begin = std::chrono::steady_clock::now();
    predict(step);
    update(step);
    forget();
    const auto end = std::chrono::steady_clock::now();
    result_.seconds = std::chrono::duration<double>(end - begin).count();

    result_.report = cairn_update_report{};
    result_.report.struct_size = sizeof result_.report;
    if (!step.observations.empty()) check(cairn_filter_last_update(filter_.get(), &result_.report));
    check(cairn_filter_pose(filter_.get(), &result_.pose, result_.covariance));
    check(cairn_map_size(cairn_filter_map(filter_.get()), &result_.landmarks));
    observe(filter_.get(), result_);
  }
}

void Runner::predict(const io::Step& step) {
  if (step.increment) {
    check(cairn_filter_predict_increment(filter_.get(), &step.increment->T_before_after,
                                         step.increment->covariance.data()));
  } else if (step.twist) {
    check(cairn_filter_predict_twist(filter_.get(), step.twist->dt, step.twist->velocity.data(),
                                     step.twist->rate.data()));
  }
}

void Runner::update(const io::Step& step) {
  if (step.observations.empty()) return;
  check(cairn_filter_update(filter_.get(), sensor_, step.observations.data(), step.observations.size(),
                            result_.matches.data()));
}

// A refused observation does not count: a landmark that only gives those is lost, and a track that went astray may then
// start anew.
void Runner::forget() {
  if (options_.forget_after == 0) return;
  for (const cairn_match& match : result_.matches) {
    if (match.result != CAIRN_REJECTED) last_seen_[match.landmark] = result_.index;
  }
  for (auto entry = last_seen_.begin(); entry != last_seen_.end();) {
    if (result_.index - entry->second >= options_.forget_after) {
      check(cairn_filter_remove_landmark(filter_.get(), entry->first));
      entry = last_seen_.erase(entry);
    } else {
      ++entry;
    }
  }
}

}  // namespace cairn::cli
