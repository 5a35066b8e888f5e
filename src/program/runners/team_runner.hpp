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

namespace cairn::program {

struct TeamChoices {
  std::int32_t mode = CAIRN_TEAM_JOINT;
  FilterChoices filter;
  double score_from = 0;  // share of the steps that is left out at the start
};

extern const std::vector<const char*> kModeNames;  // by the CAIRN_TEAM_ constants

// Scores of one vehicle, over all scored steps.
struct VehicleScore {
  std::size_t steps = 0, nees_steps = 0;
  double claimed = 0;       // sum of ||C_qq||, Frobenius, m^2
  double square_error = 0;  // sum, m^2
  double nees = 0;          // sum
  double landmark_square = 0;
  std::size_t landmarks = 0, landmarks_known = 0;  // of its map; of these, those with known truth
  std::size_t paired = 0, paired_wrongly = 0;
  double rmse() const;
  double landmark_rmse() const;
  double anees() const;  // for each degree of freedom
  void add(const VehicleScore& other);
};

struct VehicleEstimate {
  cairn_pose pose;
  double covariance[36];
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
  std::vector<std::map<std::uint64_t, std::map<std::uint64_t, std::size_t>>> votes_;  // by vehicle and landmark
};

// The figures of a run. `alone` (or null): the result of the same run without cooperation. `seconds`: time of the whole
// run. Figures that need the truth are left out if there is none.
std::vector<Figure> team_figures(const TeamDrive& drive, const TeamResult& result, const TeamResult* alone,
                                 double seconds);

}  // namespace cairn::program
