// SPDX-License-Identifier: BSD-3-Clause
// Triangles of neighbouring points: two maps of one place have the same triangles, in any frames.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "map/merge/point_set.hpp"
#include "map/spatial_index.hpp"

namespace cairn {

// A point's neighbours, nearest first.
using Neighbours = std::vector<std::vector<std::uint32_t>>;

struct Triangle {
  std::array<std::uint32_t, 3> points;  // point i is opposite side i
  Vector3 sides;                        // ascending, m
  Vector3 variances;                    // of the sides, m^2
};

struct Triangles {
  Neighbours neighbours;
  std::vector<Triangle> triangles;
  double spacing = 0;  // median distance between a point and its nearest neighbour, m
};

// Triangles of each point with pairs of its `corners` nearest points, each triangle once. Slivers are left out, and
// triangles whose shape is too uncertain. Keeps `neighbours` neighbours of each point, at least `corners`.
Triangles make_triangles(const PointSet& set, const SpatialIndex& index, std::size_t corners, std::size_t neighbours,
                         std::size_t most);

// Covariance of each point relative to its neighbours: without the part of the error that is a common rigid motion of
// all of them, because a transform between two maps absorbs that part. Without a joint covariance, these are the
// covariances of the points.
std::vector<Matrix3> local_covariances(const PointSet& set, const SpatialIndex& index, std::size_t neighbours);

// The rotation and translation that lay triangle b onto triangle a, corner i on corner i: sides along each other,
// planes together, centroids together.
SE3 lay_onto(const std::array<Vector3, 3>& a, const std::array<Vector3, 3>& b);

// Ways of pairing the corners: corner i of a is corner kPairings[w][i] of b.
inline constexpr std::array<std::array<int, 3>, 6> kPairings = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

}  // namespace cairn
