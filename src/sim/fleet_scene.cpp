// SPDX-License-Identifier: BSD-3-Clause
#include "sim/fleet_scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/angle.hpp"
#include "sim/random.hpp"

namespace cairn::sim {
namespace {

// A line that is wavy at every size: the k-th wave goes about k times up and down on the way, and is as much smaller.
// The shares add up to 1 at most, which bounds the departure by the relief.
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

// Uniform over the line's length, then in the water south of that place: south, not across the line, so that no feature
// leaves the square at its ends.
std::vector<Vector2> place_along(const std::vector<Vector2>& coast, const cairn_fleet_options& o) {
  std::vector<double> lengths(coast.size(), 0);  // of the line up to each point
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

// A boat's circle reaches two radii north of its start. Beside a coast it is not to run aground.
void check_water(const FleetScene& scene, const cairn_fleet_options& o) {
  double shore = scene.coast[0].y(), course = -o.area;
  for (const Vector2& point : scene.coast) shore = std::min(shore, point.y());
  for (const SE2& start : scene.starts) course = std::max(course, start.translation().y() + o.course_length / kPi);
  if (course >= shore)
    throw Error(
        ErrorCode::argument,
        "options: the boats' courses reach %g m north and the coast comes down to %g m; raise coast_distance, or "
        "take a shorter course_length or separation",
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
