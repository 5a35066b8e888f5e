// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/step_table.hpp"

#include <algorithm>

#include "program/output/output_file.hpp"

namespace cairn::program {
namespace {

double median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + static_cast<double>(*std::max_element(values.begin(), middle)));
}

}  // namespace

void StepTable::begin_run(std::uint32_t features, std::int32_t mode, const std::vector<std::uint64_t>& vehicles) {
  const auto found = std::find_if(runs_.begin(), runs_.end(),
                                  [&](const Runs& runs) { return runs.features == features && runs.mode == mode; });
  current_ = static_cast<std::size_t>(found - runs_.begin());
  if (found == runs_.end()) runs_.push_back({features, mode, vehicles, 0, {}});
  ++runs_[current_].count;
  step_ = 0;
}

void StepTable::add(double time, const std::vector<VehicleEstimate>& estimates) {
  std::vector<Step>& steps = runs_[current_].steps;
  if (step_ == steps.size())
    steps.push_back({time, std::vector<double>(estimates.size()), std::vector<std::vector<float>>(estimates.size())});
  Step& step = steps[step_++];
  for (std::size_t v = 0; v < estimates.size(); ++v) {
    step.norm[v] += position_norm(estimates[v].covariance);
    if (step.seconds[v].size() < kMostTimes) step.seconds[v].push_back(static_cast<float>(estimates[v].seconds));
  }
}

void StepTable::write(const std::string& folder) const {
  OutputFile file(folder, "team_steps.csv");
  file.text("features,mode,runs,step,time,vehicle,norm_m2,recursion_ms\n");
  for (const Runs& runs : runs_) {
    const double count = static_cast<double>(runs.count);
    for (std::size_t k = 0; k < runs.steps.size(); ++k) {
      for (std::size_t v = 0; v < runs.vehicles.size(); ++v) {
        file.field(std::uint64_t{runs.features});
        file.field(kModeNames[static_cast<std::size_t>(runs.mode)]);
        file.field(runs.count);
        file.field(std::uint64_t{k});
        file.field(runs.steps[k].time);
        file.field(runs.vehicles[v]);
        file.field(runs.steps[k].norm[v] / count);
        file.field(1e3 * median(runs.steps[k].seconds[v]));
        file.end();
      }
    }
  }
  file.close();
}

}  // namespace cairn::program
