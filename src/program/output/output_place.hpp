// SPDX-License-Identifier: BSD-3-Clause
// Where the files of a run go, and where on the Earth its map lies.
#pragma once

#include <optional>
#include <string>

#include "program/output/local_frame.hpp"

namespace cairn::program {

struct OutputPlace {
  std::string folder;                   // empty: nothing is written
  std::optional<GeodeticPoint> origin;  // of the map's frame; nothing: it is unknown, and no GeoJSON is written

  bool wanted() const { return !folder.empty(); }
};

}  // namespace cairn::program
