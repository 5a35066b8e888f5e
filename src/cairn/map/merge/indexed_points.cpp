// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/indexed_points.hpp"

#include <algorithm>
#include <limits>

#include "map/merge/triangles.hpp"

namespace cairn {

IndexedPoints::IndexedPoints(const PointSet& set, bool local)
    : set_(set), index_([&set](std::size_t i) { return set.points[i]; }) {
  for (std::size_t i = 0; i < set_.points.size(); ++i) index_.add(i);
  covariances_ = local ? local_covariances(set_, index_, kNeighbours) : set_.covariances;
  for (const Matrix3& covariance : covariances_) largest_trace_ = std::max(largest_trace_, covariance.trace());
}

double IndexedPoints::median_spacing() const {
  std::vector<double> nearest;
  std::vector<SpatialIndex::Hit> hits;
  for (const Vector3& p : set_.points) {
    index_.nearest(p, 2, hits);
    if (hits.size() > 1) nearest.push_back(hits[1].distance);
  }
  if (nearest.empty()) return std::numeric_limits<double>::infinity();  // a single point has no neighbour
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2), nearest.end());
  return nearest[nearest.size() / 2];
}

}  // namespace cairn
