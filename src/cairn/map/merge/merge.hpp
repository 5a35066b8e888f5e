// SPDX-License-Identifier: BSD-3-Clause
// The plan by which two maps become one: which landmarks are the same, how the frames lie, whether both agree, and the
// ids of the merged map. docs/map_merging.md derives it.
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

// Tests all pairs jointly, up to `joint_at_most` pairs; of more pairs, that many, evenly drawn, are tested jointly and
// each of the others singly. Throws where the maps do not merge; `report` then tells how far it got.
MergePlan plan_merge(const Landmarks& map, const Landmarks& other, const MergeOptions& options,
                     std::size_t joint_at_most, MergeReport& report);

// The new ids of the other's landmarks, by ascending old id.
std::vector<MergedId> merged_ids(const Landmarks& other, const MergePlan& plan);

// Throws that these two landmarks contradict each other, and names them in the report.
[[noreturn]] void throw_contradiction(std::uint64_t id, std::uint64_t other_id, MergeReport& report);

}  // namespace cairn
