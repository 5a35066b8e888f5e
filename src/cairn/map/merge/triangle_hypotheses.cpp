// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/triangle_hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map/spatial_index.hpp"

namespace cairn {
namespace {

constexpr std::size_t kRanked = 20000;  // hypotheses that are remembered

Triangles triangles_of(const IndexedPoints& points, const CorrespondenceOptions& options) {
  return make_triangles(points.set(), points.index(), options.triangle_corners, IndexedPoints::kNeighbours,
                        options.max_triangles);
}

}  // namespace

TriangleHypotheses::TriangleHypotheses(const IndexedPoints& a, const IndexedPoints& b,
                                       const CorrespondenceOptions& options, double gate)
    : a_(a), b_(b), options_(options), gate_(gate), in_a_(triangles_of(a, options)), in_b_(triangles_of(b, options)) {}

// Begins with the triangles of a whose sides few triangles of b share: they are the most distinctive.
void TriangleHypotheses::propose() {
  std::vector<Vector3> sides;
  double widest = 0;
  for (const Triangle& triangle : in_b_.triangles) {
    sides.push_back(triangle.sides);
    widest = std::max(widest, triangle.variances.maxCoeff());
  }
  SpatialIndex table([&sides](std::size_t i) { return sides[i]; });
  for (std::size_t i = 0; i < sides.size(); ++i) table.add(i);
  const auto look_up = [&](const Triangle& triangle, std::vector<SpatialIndex::Hit>& hits) {
    table.within(triangle.sides, std::sqrt(gate_ * (triangle.variances.maxCoeff() + widest)), hits);
  };
  std::vector<SpatialIndex::Hit> hits;
  std::vector<std::pair<std::size_t, std::size_t>> order;  // number of hits, triangle
  for (std::size_t t = 0; t < in_a_.triangles.size(); ++t) {
    look_up(in_a_.triangles[t], hits);
    if (!hits.empty()) order.emplace_back(hits.size(), t);
  }
  std::sort(order.begin(), order.end());
  for (const auto& entry : order) {
    if (tried_ >= options_.max_hypotheses) {
      exhausted_ = true;
      break;
    }
    look_up(in_a_.triangles[entry.second], hits);
    for (const SpatialIndex::Hit& hit : hits) consider(in_a_.triangles[entry.second], in_b_.triangles[hit.index]);
  }
  std::sort(hypotheses_.begin(), hypotheses_.end(), [](const TriangleHypothesis& x, const TriangleHypothesis& y) {
    if (x.score != y.score) return x.score > y.score;
    if (x.misfit != y.misfit) return x.misfit < y.misfit;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
}

// Tries all ways of laying b onto a that the sides allow: more than one if sides are nearly equal.
void TriangleHypotheses::consider(const Triangle& a, const Triangle& b) {
  for (const std::array<int, 3>& way : kPairings) {
    TriangleHypothesis h{};
    double variance = 0;
    for (int s = 0; s < 3; ++s) {
      const int w = way[static_cast<std::size_t>(s)];
      const double sum = a.variances[s] + b.variances[w], difference = a.sides[s] - b.sides[w];
      h.misfit += difference * difference / sum;
      variance = std::max(variance, sum);
      h.a[static_cast<std::size_t>(s)] = a.points[static_cast<std::size_t>(s)];
      h.b[static_cast<std::size_t>(s)] = b.points[static_cast<std::size_t>(w)];
    }
    if (!(h.misfit <= gate_)) continue;
    ++tried_;
    const auto corners = [](const PointSet& set, const std::array<std::uint32_t, 3>& i) {
      return std::array<Vector3, 3>{set.points[i[0]], set.points[i[1]], set.points[i[2]]};
    };
    const std::array<Vector3, 3> on = corners(a_.set(), h.a);
    const SE3 T = lay_onto(on, corners(b_.set(), h.b));
    if (std::acos(std::clamp((T.rotation() * Vector3::UnitZ()).z(), -1.0, 1.0)) > options_.max_tilt) continue;
    const double height = (on[1] - on[0]).cross(on[2] - on[0]).norm() / a.sides[2];
    h.score = support(h, T, variance, height);
    if (h.score <= 0) continue;
    hypotheses_.push_back(h);
    if (hypotheses_.size() >= 2 * kRanked) {
      std::nth_element(hypotheses_.begin(), hypotheses_.begin() + kRanked, hypotheses_.end(),
                       [](const TriangleHypothesis& x, const TriangleHypothesis& y) { return x.score > y.score; });
      hypotheses_.resize(kRanked);
    }
  }
}

// Scores how many neighbours of one corner in b fall onto neighbours of that corner in a.
double TriangleHypotheses::support(const TriangleHypothesis& h, const SE3& T, double variance, double height) const {
  const auto is_corner = [](const std::array<std::uint32_t, 3>& corners, std::uint32_t i) {
    return corners[0] == i || corners[1] == i || corners[2] == i;
  };
  const Vector3 middle = (b_.point(h.b[0]) + b_.point(h.b[1]) + b_.point(h.b[2])) / 3;
  const double most = in_a_.spacing * in_a_.spacing;
  double score = 0;
  for (std::uint32_t j : in_b_.neighbours[h.b[0]]) {
    if (is_corner(h.b, j)) continue;
    // The triangle's errors grow with the distance of the neighbour from the triangle.
    const double tolerance = gate_ * variance * (1 + (b_.point(j) - middle).squaredNorm() / (height * height));
    if (tolerance >= most) continue;
    const Vector3 p = T * b_.point(j);
    double nearest = tolerance;
    for (std::uint32_t i : in_a_.neighbours[h.a[0]]) {
      if (is_corner(h.a, i)) continue;
      nearest = std::min(nearest, (a_.point(i) - p).squaredNorm());
    }
    if (nearest < tolerance) score += 0.5 * std::log(most / tolerance);
  }
  return score;
}

}  // namespace cairn
