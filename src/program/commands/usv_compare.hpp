// SPDX-License-Identifier: BSD-3-Clause
// Runs all modes of a team, and compares them with the figures of the cooperative paper.
#pragma once

#include <functional>
#include <string>

#include "program/options/team_options.hpp"

namespace cairn::program {

// Runs options.runs worlds for each number of features and each mode; the first boat is scored. `advance` is called
// once a run. Fills `table`, for people; `object`, one JSON object; and `rows`, a CSV file.
void compare_modes(const UsvOptions& options, const std::function<void()>& advance, std::string& table,
                   std::string& object, std::string& rows);

std::size_t compared_runs(const UsvOptions& options);  // that compare_modes() will do

}  // namespace cairn::program
