// SPDX-License-Identifier: BSD-3-Clause
// The file team_steps.csv: claimed uncertainty and time of each vehicle at each step, by number of features and mode.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program/runners/team_runner.hpp"

namespace cairn::program {

class StepTable {
 public:
  // The next calls of add() are the steps of one run. Of several runs with the same features and mode the file has, for
  // each step, the mean of the norms and the median of the times: a step that the computer interrupted takes a hundred
  // times as long as its neighbours.
  void begin_run(std::uint32_t features, std::int32_t mode, const std::vector<std::uint64_t>& vehicles);
  void add(double time, const std::vector<VehicleEstimate>& estimates);

  // Throws UsageError.
  void write(const std::string& folder) const;

 private:
  struct Step {
    double time = 0;
    std::vector<double> norm;                 // sum over the runs, by vehicle
    std::vector<std::vector<float>> seconds;  // by vehicle, then of each run; at most of kMostTimes runs
  };
  static constexpr std::size_t kMostTimes = 1000;  // so that memory does not grow with the runs
  struct Runs {
    std::uint32_t features;
    std::int32_t mode;
    std::vector<std::uint64_t> vehicles;  // their numbers
    std::uint64_t count = 0;
    std::vector<Step> steps;
  };

  std::vector<Runs> runs_;
  std::size_t current_ = 0;  // the runs that add() continues
  std::size_t step_ = 0;     // its next step
};

}  // namespace cairn::program
