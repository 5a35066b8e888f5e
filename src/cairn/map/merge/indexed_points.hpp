// SPDX-License-Identifier: BSD-3-Clause
// A set of points with an index by place, and with the covariances that gates use.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/se3.hpp"
#include "map/merge/point_set.hpp"
#include "map/spatial_index.hpp"

namespace cairn {

class IndexedPoints {
 public:
  static constexpr std::size_t kNeighbours = 16;  // points around a point that count as its neighbours

  // `local`: leaves out the errors that neighbours have in common, because an unknown transform absorbs them.
  // The set must outlive the index.
  IndexedPoints(const PointSet& set, bool local);

  const PointSet& set() const { return set_; }
  std::size_t size() const { return set_.points.size(); }
  const Vector3& point(std::size_t i) const { return set_.points[i]; }
  const SpatialIndex& index() const { return index_; }
  const Matrix3& covariance(std::size_t i) const { return covariances_[i]; }
  double largest_trace() const { return largest_trace_; }  // of the covariances
  // Median distance between a point and its nearest neighbour, m; infinite for a single point.
  double median_spacing() const;

 private:
  const PointSet& set_;
  SpatialIndex index_;
  std::vector<Matrix3> covariances_;
  double largest_trace_ = 0;
};

}  // namespace cairn
