// SPDX-License-Identifier: BSD-3-Clause
#include "program/runners/team_runner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "program/library.hpp"
#include "program/runners/stopwatch.hpp"

namespace cairn::program {

const std::vector<const char*> kModeNames = {"mono", "eo_diagonal", "eo_full", "joint", "submaps"};

TeamRunner::TeamRunner(TeamDrive& drive, const TeamChoices& choices)
    : drive_(drive), choices_(choices), votes_(drive.vehicles().size()) {
  const std::vector<std::uint64_t>& numbers = drive.vehicles();
  for (std::size_t v = 0; v < numbers.size(); ++v) teams_.push_back(create(v));
  for (std::size_t v = 0; v < numbers.size(); ++v)
    for (std::size_t other = 0; other < numbers.size(); ++other) {
      if (other == v || choices.mode == CAIRN_TEAM_MONO) continue;
      const cairn_pose start = drive.start(other);
      check(cairn_team_add(teams_[v].get(), numbers[other], &start, drive.start_covariance(other), nullptr));
    }
}

TeamRunner::Team TeamRunner::create(std::size_t vehicle) const {
  const FilterChoices& choices = choices_.filter;
  cairn_team_options options;
  check(cairn_team_options_init(&options, sizeof options, nullptr));
  options.mode = choices_.mode;
  options.vehicle = drive_.vehicles()[vehicle];
  options.max_vehicles = static_cast<std::uint32_t>(drive_.vehicles().size());
  options.time_tolerance = 0;
  options.max_jump = std::numeric_limits<double>::max();  // a log may pause, and its times are sorted
  cairn_filter_options filter;
  check(cairn_filter_options_init(&filter, sizeof filter, nullptr));
  filter.vehicle = CAIRN_VEHICLE_PLANAR;
  // Without ids some landmarks may be placed twice.
  const std::uint32_t room = drive_.landmarks() * (choices.names_known() ? 1 : 4);
  filter.max_landmarks = std::max<std::uint32_t>(1, room);
  filter.max_observations = std::max<std::uint32_t>(1, drive_.largest_frame());
  choices.apply(filter);
  filter.initial_pose = drive_.start(vehicle);
  if (const double* covariance = drive_.start_covariance(vehicle))
    std::copy_n(covariance, 36, filter.initial_covariance);
  if (choices_.mode == CAIRN_TEAM_SUBMAPS) {
    if (!choices.submap_landmarks) filter.submap_landmarks = usual_submap(filter.max_observations);
    if (!choices.submap_distance) filter.submap_distance = drive_.submap_distance();
    filter.join = CAIRN_JOIN_DENSE;
  } else {
    filter.submap_landmarks = 0;
    filter.submap_distance = filter.submap_extent = filter.submap_sigma = 0;
  }
  const cairn_range_bearing radar = drive_.radar();
  cairn_team* team = nullptr;
  check(cairn_team_create(&options, &filter, &radar, &team, nullptr));
  return Team(team, &cairn_team_destroy);
}

void TeamRunner::step(const TeamStep& step) {
  seconds_.assign(teams_.size(), 0);
  for (std::size_t v = 0; v < teams_.size(); ++v) {
    const Stopwatch watch(seconds_[v]);
    cairn_team* team = teams_[v].get();
    const VehicleStep& own = step.vehicles[v];
    for (const TeamMotion& motion : own.motions) {
      cairn_twist_noise noise{};
      noise.struct_size = sizeof noise;
      noise.velocity_sigma[0] = motion.speed_sigma;
      noise.rate_sigma[2] = motion.rate_sigma;
      const double velocity[3] = {motion.speed, 0, 0}, rate[3] = {0, 0, motion.rate};
      check(cairn_team_predict_twist(team, motion.dt, velocity, rate, &noise, nullptr));
    }
    check(cairn_team_observe(team, step.time, own.landmarks.data(), own.landmarks.size(), own.vehicles.data(),
                             own.vehicles.size(), nullptr));
  }
  exchange();
}

void TeamRunner::exchange() {
  std::vector<std::uint8_t> packet;
  for (std::size_t from = 0; from < teams_.size(); ++from) {
    for (;;) {
      std::size_t size = 0;
      {
        const Stopwatch watch(seconds_[from]);
        check(cairn_team_take_packet(teams_[from].get(), nullptr, 0, &size, nullptr));
        if (size == 0) break;
        packet.resize(size);
        check(cairn_team_take_packet(teams_[from].get(), packet.data(), size, &size, nullptr));
      }
      if (choices_.mode == CAIRN_TEAM_MONO) continue;
      for (std::size_t to = 0; to < teams_.size(); ++to) {
        if (to == from) continue;
        const Stopwatch watch(seconds_[to]);
        check(cairn_team_receive(teams_[to].get(), packet.data(), size, nullptr, nullptr));
      }
    }
  }
}

// Without ids the library numbers the landmarks. The observations matched with a number decide which true landmark the
// number is.
void TeamRunner::note_pairs(std::size_t vehicle, const VehicleStep& step, VehicleScore& score) {
  std::size_t count = 0;
  check(cairn_team_decisions(teams_[vehicle].get(), nullptr, 0, &count, nullptr));
  std::vector<cairn_match> matches(count);
  if (count > 0) check(cairn_team_decisions(teams_[vehicle].get(), matches.data(), count, &count, nullptr));
  for (std::size_t i = 0; i < std::min(count, step.landmarks.size()); ++i) {
    if (matches[i].result == CAIRN_RESULT_REJECTED) continue;
    auto& votes = votes_[vehicle][matches[i].landmark];
    if (matches[i].result == CAIRN_RESULT_MATCHED) {
      ++score.paired;
      score.paired_wrongly += !votes.empty() && name_of(vehicle, matches[i].landmark) != step.landmarks[i].id;
    }
    ++votes[step.landmarks[i].id];
  }
}

std::uint64_t TeamRunner::name_of(std::size_t vehicle, std::uint64_t landmark) const {
  if (choices_.filter.names_known()) return landmark;
  const auto votes = votes_[vehicle].find(landmark);
  if (votes == votes_[vehicle].end()) return CAIRN_ID_NONE;  // only teammates saw it
  return std::max_element(votes->second.begin(), votes->second.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

// Returns the step's normalised error squared, NaN if the covariance is singular.
double TeamRunner::score(std::size_t vehicle, const cairn_pose& truth, VehicleScore& score) {
  cairn_team* team = teams_[vehicle].get();
  cairn_pose pose;
  double P[36];
  check(cairn_team_pose(team, drive_.vehicles()[vehicle], &pose, P, nullptr));
  ++score.steps;
  score.claimed += position_norm(P);
  score.square_error +=
      std::pow(truth.position[0] - pose.position[0], 2) + std::pow(truth.position[1] - pose.position[1], 2);
  double nees = 0;
  const cairn_status status = cairn_team_pose_nees(team, &truth, &nees, nullptr);
  if (status == CAIRN_ERROR_NUMERICAL) return std::numeric_limits<double>::quiet_NaN();
  check(status);
  ++score.nees_steps;
  score.nees += nees;
  return nees;
}

std::vector<cairn_landmark> TeamRunner::map(std::size_t vehicle) const {
  const cairn_map* map = cairn_team_map(teams_[vehicle].get());
  std::size_t count = 0;
  check(cairn_map_size(map, &count, nullptr));
  std::vector<cairn_landmark> landmarks(count);
  if (count > 0) check(cairn_map_landmarks(map, landmarks.data(), count, &count, nullptr));
  for (cairn_landmark& landmark : landmarks) landmark.id = name_of(vehicle, landmark.id);
  return landmarks;
}

TeamResult TeamRunner::run(const Observer& observe) {
  TeamResult result;
  result.vehicles.resize(teams_.size());
  const double first = choices_.score_from * static_cast<double>(drive_.steps());
  std::vector<VehicleEstimate> estimates(teams_.size());
  TeamStep next;
  for (std::size_t number = 0; drive_.next(next); ++number) {
    step(next);
    result.recursions += teams_.size();
    double nees = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t v = 0; v < teams_.size(); ++v) {
      result.seconds += estimates[v].seconds = seconds_[v];
      if (!choices_.filter.names_known()) note_pairs(v, next.vehicles[v], result.vehicles[v]);
      check(
          cairn_team_pose(teams_[v].get(), drive_.vehicles()[v], &estimates[v].pose, estimates[v].covariance, nullptr));
      if (!next.vehicles[v].truth || static_cast<double>(number) < first) continue;
      const double own = score(v, *next.vehicles[v].truth, result.vehicles[v]);
      if (v == 0) nees = own;
    }
    result.nees_by_step.push_back(nees);
    if (observe) observe(next, estimates);
  }
  for (std::size_t v = 0; v < teams_.size(); ++v) {
    for (const cairn_landmark& landmark : map(v)) {
      ++result.vehicles[v].landmarks;
      double truth[2];
      if (!drive_.true_landmark(landmark.id, truth)) continue;
      ++result.vehicles[v].landmarks_known;
      result.vehicles[v].landmark_square +=
          std::pow(landmark.position[0] - truth[0], 2) + std::pow(landmark.position[1] - truth[1], 2);
    }
  }
  // If all vehicles process all packets, the counts of one vehicle are those of all.
  const bool all = choices_.mode == CAIRN_TEAM_JOINT || choices_.mode == CAIRN_TEAM_SUBMAPS;
  for (std::size_t v = 0; v < (all ? 1 : teams_.size()); ++v) {
    cairn_team_report report{};
    report.struct_size = sizeof report;
    check(cairn_team_last_report(teams_[v].get(), &report, nullptr));
    result.rejected += report.rejected;
  }
  return result;
}

std::vector<Figure> team_figures(const TeamDrive& drive, const TeamResult& result, const TeamResult* alone,
                                 double seconds) {
  std::vector<Figure> figures;
  const auto measure = [&](const std::string& key, double value) {
    if (std::isfinite(value)) figures.push_back({key, value, false});
  };
  const auto count = [&](const std::string& key, std::size_t value) {
    figures.push_back({key, static_cast<double>(value), true});
  };
  // Over the vehicles that have the figure: one without truth has no error.
  const auto mean = [&](auto&& figure) {
    double sum = 0, known = 0;
    for (const VehicleScore& score : result.vehicles) {
      const double value = figure(score);
      if (!std::isfinite(value)) continue;
      sum += value;
      known += 1;
    }
    return sum / known;
  };
  count("vehicles", result.vehicles.size());
  count("steps", result.recursions / result.vehicles.size());
  count("landmarks", result.vehicles[0].landmarks);
  count("rejected", result.rejected);
  measure("seconds", seconds);
  measure("filter_seconds", result.seconds);
  measure("recursion_ms_mean", 1e3 * result.seconds / static_cast<double>(result.recursions));
  measure("pose_rmse_m", mean([](const VehicleScore& s) { return s.rmse(); }));
  measure("landmark_rmse_m", mean([](const VehicleScore& s) { return s.landmark_rmse(); }));
  measure("pose_anees_per_dof", mean([](const VehicleScore& s) { return s.anees(); }));
  std::size_t paired = 0, wrongly = 0;
  for (const VehicleScore& score : result.vehicles) paired += score.paired, wrongly += score.paired_wrongly;
  if (paired > 0) {
    count("paired", paired);
    count("wrong_pairings", wrongly);
  }
  if (alone != nullptr) {
    const VehicleScore &with = result.vehicles[0], &without = alone->vehicles[0];
    measure("claimed_improvement", 1 - with.claimed / without.claimed);
    measure("true_improvement", 1 - with.square_error / without.square_error);
  }
  for (std::size_t v = 0; v < result.vehicles.size(); ++v) {
    const std::string prefix = "vehicle_" + std::to_string(drive.vehicles()[v]) + "_";
    measure(prefix + "pose_rmse_m", result.vehicles[v].rmse());
    measure(prefix + "landmark_rmse_m", result.vehicles[v].landmark_rmse());
    measure(prefix + "pose_anees_per_dof", result.vehicles[v].anees());
  }
  return figures;
}

}  // namespace cairn::program
