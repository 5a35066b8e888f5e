// SPDX-License-Identifier: BSD-3-Clause
// Runs a team through a drive: each vehicle has its own estimate, and the runner carries the packets.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "program/drives/team_drive.hpp"
#include "program/options/filter_choices.hpp"
#include "program/output/figures.hpp"
#include "program/runners/vehicle_score.hpp"

namespace cairn::program {

struct TeamChoices {
  std::int32_t mode = CAIRN_TEAM_JOINT;
  FilterChoices filter;
  double score_from = 0;  // share of the steps that is left out at the start
};

extern const std::vector<const char*> kModeNames;  // by the CAIRN_TEAM_ constants

struct VehicleEstimate {
  cairn_pose pose;
  double covariance[36];
  double seconds = 0;  // of this step in the library, with the vehicle's share of the packets
};

struct TeamResult {
  std::vector<VehicleScore> vehicles;
  std::vector<double> nees_by_step;  // of the first vehicle; NaN if it was not scored
  double seconds = 0;                // in the library
  std::size_t recursions = 0;        // steps of one vehicle
  std::size_t rejected = 0;          // of the observations of all vehicles
};

class TeamRunner {
 public:
  TeamRunner(TeamDrive& drive, const TeamChoices& choices);

  using Observer = std::function<void(const TeamStep&, const std::vector<VehicleEstimate>&)>;
  TeamResult run(const Observer& observe);
  // The map of one vehicle. Landmarks have their true ids; if observations have no ids, a landmark gets the true id of
  // most of its observations.
  std::vector<cairn_landmark> map(std::size_t vehicle) const;

 private:
  using Team = std::unique_ptr<cairn_team, void (*)(cairn_team*)>;
  Team create(std::size_t vehicle) const;
  void step(const TeamStep& step);
  void exchange();
  void note_pairs(std::size_t vehicle, const VehicleStep& step, VehicleScore& score);
  std::uint64_t name_of(std::size_t vehicle, std::uint64_t landmark) const;
  double score(std::size_t vehicle, const cairn_pose& truth, VehicleScore& score);

  TeamDrive& drive_;
  TeamChoices choices_;
  std::vector<Team> teams_;
  std::vector<double> seconds_;  // of each vehicle in the current step
  std::vector<std::map<std::uint64_t, std::map<std::uint64_t, std::size_t>>> votes_;  // by vehicle and landmark
};

// The figures of a run. `alone` (or null): the result of the same run without cooperation. `seconds`: time of the whole
// run. Figures that need the truth are left out if there is none.
std::vector<Figure> team_figures(const TeamDrive& drive, const TeamResult& result, const TeamResult* alone,
                                 double seconds);

}  // namespace cairn::program
