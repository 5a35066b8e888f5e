// SPDX-License-Identifier: BSD-3-Clause
// Draws the coast line and places features and boats.
#include "sim/fleet_scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "sim/random.hpp"

namespace cairn::sim {
namespace {

// The coast is a sum of waves of different lengths: wave k has about k periods along the line, and its amplitude is
// about k times smaller. The normalised amplitudes add up to 1, so the departure from a straight line is at most the
// relief.
std::vector<Vector2> draw_coast(const cairn_fleet_options& o) {
  constexpr int kSegments = 200, kWaves = 12;
  Random random(o.seed, Stream::coast);
  double turns[kWaves], phases[kWaves], shares[kWaves], sum = 0;
  for (int k = 0; k < kWaves; ++k) {
    turns[k] = k + random.uniform(0.5, 1.5);
    phases[k] = random.uniform(0, 2 * kPi);
    shares[k] = random.uniform(0.5, 1) / (k + 1);
    sum += shares[k];
  }
  std::vector<Vector2> coast;
  coast.reserve(kSegments + 1);
  for (int i = 0; i <= kSegments; ++i) {
    const double way = static_cast<double>(i) / kSegments;
    double departure = 0;
    for (int k = 0; k < kWaves; ++k) departure += shares[k] / sum * std::sin(2 * kPi * turns[k] * way + phases[k]);
    coast.emplace_back(o.area * (way - 0.5), o.area * (o.coast_distance + o.coast_relief * departure));
  }
  return coast;
}

std::vector<Vector2> place_anywhere(const cairn_fleet_options& o) {
  std::vector<Vector2> features;
  features.reserve(o.features);
  for (std::uint32_t id = 1; id <= o.features; ++id) {
    Random random(o.seed, Stream::feature, id);
    const double x = random.uniform(-o.area / 2, o.area / 2), y = random.uniform(-o.area / 2, o.area / 2);
    features.emplace_back(x, y);
  }
  return features;
}

// A feature lies in the water at a uniform distance south of a place that is uniform over the length of the coast.
// South, and not perpendicular to the coast, so that no feature leaves the square at the ends of the coast.
std::vector<Vector2> place_along(const std::vector<Vector2>& coast, const cairn_fleet_options& o) {
  std::vector<double> lengths(coast.size(), 0);  // length of the line up to each point
  for (std::size_t i = 1; i < coast.size(); ++i) lengths[i] = lengths[i - 1] + (coast[i] - coast[i - 1]).norm();
  std::vector<Vector2> features;
  features.reserve(o.features);
  for (std::uint32_t id = 1; id <= o.features; ++id) {
    Random random(o.seed, Stream::feature, id);
    const double length = random.uniform(0, lengths.back()), off = random.uniform(0, o.coast_strip * o.area);
    const std::size_t after = std::upper_bound(lengths.begin(), lengths.end() - 1, length) - lengths.begin();
    const double share = (length - lengths[after - 1]) / (lengths[after] - lengths[after - 1]);
    features.push_back(coast[after - 1] + share * (coast[after] - coast[after - 1]) - Vector2(0, off));
  }
  return features;
}

std::vector<SE2> place_boats(const cairn_fleet_options& o) {
  std::uint32_t columns = 1;
  while (columns * columns < o.vehicles) ++columns;
  const std::uint32_t rows = (o.vehicles + columns - 1) / columns;
  const double spacing = columns > 1 ? std::min(o.separation, o.area / 2 / (columns - 1)) : o.separation;
  const double radius = o.course_length / (2 * kPi);
  std::vector<SE2> starts;
  starts.reserve(o.vehicles);
  for (std::uint32_t boat = 0; boat < o.vehicles; ++boat) {
    const std::uint32_t row = boat / columns, in_row = std::min(columns, o.vehicles - row * columns);
    const double x = (boat % columns - 0.5 * (in_row - 1)) * spacing, y = (row - 0.5 * (rows - 1)) * spacing;
    starts.emplace_back(SO2(), Vector2(x, y - radius));
  }
  return starts;
}

// Refuses boats that would run aground: the circle of a boat reaches two radii north of its start.
void check_water(const FleetScene& scene, const cairn_fleet_options& o) {
  double shore = scene.coast[0].y(), course = -o.area;
  for (const Vector2& point : scene.coast) shore = std::min(shore, point.y());
  for (const SE2& start : scene.starts) course = std::max(course, start.translation().y() + o.course_length / kPi);
  if (course >= shore)
    throw Error(ErrorCode::argument,
                "options: the courses of the boats reach %g m north, and the coast comes down to %g m; increase "
                "coast_distance, "
                "or reduce course_length or separation",
                course, shore);
}

}  // namespace

FleetScene make_scene(const cairn_fleet_options& options) {
  FleetScene scene;
  scene.coast = draw_coast(options);
  scene.starts = place_boats(options);
  if (options.layout == CAIRN_FLEET_COAST) {
    check_water(scene, options);
    scene.features = place_along(scene.coast, options);
  } else {
    scene.features = place_anywhere(options);
  }
  return scene;
}

}  // namespace cairn::sim
