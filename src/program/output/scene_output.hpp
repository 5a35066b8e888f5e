// SPDX-License-Identifier: BSD-3-Clause
// The file team_scene.csv: the square of sea that simulated boats drive in.
#pragma once

#include <cairn/fleet.h>

#include <string>

namespace cairn::program {

// Writes coast line, features, commanded courses, true drives, and the circle of each radar at the start. Throws
// UsageError and LibraryError.
void write_scene(const cairn_fleet_options& options, const std::string& folder);

}  // namespace cairn::program
