// SPDX-License-Identifier: BSD-3-Clause
// The folder of --output of a team: trajectories and maps of all vehicles, and the claim and time of each step.
#pragma once

#include <vector>

#include "program/output/csv_output.hpp"
#include "program/output/output_place.hpp"
#include "program/output/step_table.hpp"
#include "program/output/trajectories.hpp"
#include "program/runners/team_runner.hpp"

namespace cairn::program {

class TeamOutput {
 public:
  // Creates the files, and the folder if it does not exist. Throws UsageError.
  TeamOutput(const TeamDrive& drive, std::int32_t mode, const OutputPlace& place);

  void add(const TeamStep& step, const std::vector<VehicleEstimate>& estimates);
  void finish(const TeamRunner& runner, const std::vector<Figure>& figures);

  // After the steps above: those of the same drive without cooperation.
  void begin_alone();
  void add_alone(const TeamStep& step, const std::vector<VehicleEstimate>& estimates);

 private:
  const TeamDrive& drive_;
  OutputPlace place_;
  OutputFile trajectories_;
  StepTable steps_;
  std::vector<Trajectories> of_vehicles_;
  std::uint64_t step_ = 0;
};

}  // namespace cairn::program
