// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/tool_files.hpp"

#include <algorithm>
#include <cmath>

#include "program/output/geojson.hpp"
#include "program/output/output_file.hpp"

namespace cairn::program {
namespace {

// PLY has no integer of 64 bits: an id is a double, which is exact up to 2^53.
void write_ply(const std::string& folder, const std::string& name, const std::vector<cairn_landmark>& map) {
  OutputFile file(folder, name, ' ');
  file.text("ply\nformat ascii 1.0\ncomment landmarks of a map of Cairn; positions and standard deviations in m\n");
  file.text("element vertex " + std::to_string(map.size()) + "\n");
  for (const char* property : {"x", "y", "z", "id", "sigma_x", "sigma_y", "sigma_z"})
    file.text(std::string("property double ") + property + "\n");
  file.text("property uint observations\nend_header\n");
  constexpr std::uint64_t kLargest = 4294967295;  // that the type of the property can hold
  for (const cairn_landmark& landmark : map) {
    file.fields(landmark.position, 3);
    file.field(landmark.id);
    for (int i = 0; i < 3; ++i) file.field(std::sqrt(std::max(landmark.covariance[i * 4], 0.0)));
    file.field(std::min(landmark.observations, kLargest));
    file.end();
  }
  file.close();
}

}  // namespace

void write_tool_files(const OutputPlace& place, const std::string& prefix, const std::vector<cairn_landmark>& map,
                      const Trajectories& trajectories) {
  write_ply(place.folder, prefix + "map.ply", map);
  trajectories.write_tum(place.folder, prefix);
  if (!place.origin) return;
  GeoJson geojson(place.folder, prefix + "map.geojson", *place.origin);
  for (const cairn_landmark& landmark : map) geojson.landmark(landmark);
  trajectories.add_lines(geojson);
  geojson.close();
}

}  // namespace cairn::program
