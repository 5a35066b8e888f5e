// SPDX-License-Identifier: BSD-3-Clause
// The plan of a merge of two maps: which landmarks are the same, the transform between the frames, whether the maps
// agree, and the ids of the merged map. docs/map_merging.md derives it.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "map/landmarks.hpp"
#include "map/merge/alignment.hpp"

namespace cairn {

struct MergeOptions {
  bool by_geometry = false;
  double gate_probability = 0.9999;  // that all common landmarks pass their own gates
  double joint_gate_probability = 0.9999;
  std::size_t max_landmarks = 0;  // 0: any number
  std::optional<TransformPrior> prior;
  double max_tilt = 4.0;  // rad; 4: any
};

struct MergeReport {
  static constexpr std::uint64_t kNone = UINT64_MAX;
  std::size_t common = 0, added = 0;
  SE3 T_map_other;
  Matrix6 covariance = Matrix6::Zero();
  double distance = 0.0, threshold = 0.0;
  std::size_t rows = 0;
  std::uint64_t broken_id = kNone, broken_other_id = kNone;
};

struct MergedId {
  std::uint64_t other_id, id;
  bool common;
};

struct MergePlan {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  // (index in map, index in other), by ascending id in map
  std::vector<std::uint64_t> ids;                          // in the merged map, by index in other
  Alignment alignment;
};

// Tests up to `joint_at_most` pairs jointly. If there are more pairs, it draws that many evenly for the joint test, and
// tests each of the others by itself. Throws if the maps cannot be merged; `report` then says how far the merge got.
MergePlan plan_merge(const Landmarks& map, const Landmarks& other, const MergeOptions& options,
                     std::size_t joint_at_most, MergeReport& report);

// The new ids of the other map's landmarks, by ascending old id.
std::vector<MergedId> merged_ids(const Landmarks& other, const MergePlan& plan);

// Throws an error that these two landmarks contradict each other, and names them in the report.
[[noreturn]] void throw_contradiction(std::uint64_t id, std::uint64_t other_id, MergeReport& report);

}  // namespace cairn
