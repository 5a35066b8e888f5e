// SPDX-License-Identifier: BSD-3-Clause
// What a change of the sparse map has changed so far. Included by the map's own files alone.
#pragma once

#include "map/join/sparse/sparse_map.hpp"

namespace cairn {

template <class Pose>
struct SparseMap<Pose>::Undo {
  Undo(const SparseMap& map, Number number);

  Number change;
  Number landmarks;  // how many of each there were
  std::size_t leaf_count, base_count, visible;
  Pose prior;
  Square prior_covariance;
  Tree tree;
  std::map<Number, std::vector<AbsoluteFix<Pose>>> fixes;
  std::vector<Number> pending;
  bool settled;
  std::vector<Number> stale;
  Square base_covariance;
  double length_scale, turn_scale;
  std::vector<std::pair<Number, Point>> positions;
  std::vector<std::pair<Number, Pose>> bases;
  std::vector<std::pair<Number, Leaf>> leaves;
  std::vector<std::pair<Number, Rotation>> turned;  // leaves that were carried before they were saved, in order
  std::vector<Number> extended;                     // landmarks that got another submap
  std::vector<std::uint64_t> counts;
};

}  // namespace cairn
