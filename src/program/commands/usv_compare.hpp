// SPDX-License-Identifier: BSD-3-Clause
// Runs all modes of a team, and compares them with the figures of the cooperative paper.
#pragma once

#include <functional>
#include <string>

#include "program/options/team_options.hpp"
#include "program/output/step_table.hpp"

namespace cairn::program {

// Runs options.runs worlds for each number of features and each mode; the first boat is scored. `advance` is called
// once a run. Fills `table`, for people; `object`, one JSON object; `rows`, a CSV file; and `steps`.
void compare_modes(const UsvOptions& options, const std::function<void()>& advance, std::string& table,
                   std::string& object, std::string& rows, StepTable& steps);

std::size_t compared_runs(const UsvOptions& options);  // that compare_modes() will do

// The first world with the largest number of features. The worlds with fewer features are parts of it.
cairn_fleet_options compared_scene(const UsvOptions& options);

}  // namespace cairn::program
