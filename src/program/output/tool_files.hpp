// SPDX-License-Identifier: BSD-3-Clause
// The files of --output that other tools read: trajectories as TUM, the map as PLY, and both as GeoJSON.
#pragma once

#include <cairn/cairn.h>

#include <string>
#include <vector>

#include "program/output/output_place.hpp"
#include "program/output/trajectories.hpp"

namespace cairn::program {

// Each name begins with `prefix`. Throws UsageError.
void write_tool_files(const OutputPlace& place, const std::string& prefix, const std::vector<cairn_landmark>& map,
                      const Trajectories& trajectories);

}  // namespace cairn::program
