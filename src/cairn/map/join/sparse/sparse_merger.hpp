// SPDX-License-Identifier: BSD-3-Clause
// Appends a sparse map of space to another one: its submaps are appended to the map's own, moved by the transform
// between the frames, and all are solved for together.
//
// The map's submaps are a chain of bases: each leads from its base to the base of the next one. A bridge connects the
// other chain: a submap without landmarks and without information that leads from the last base of the map to the first
// base of the other map. If the transform between the frames is known beforehand, a second bridge contains it: from a
// base that is fixed at the map's origin to the other map's first base.
#pragma once

#include <vector>

#include "map/join/sparse/sparse_change.hpp"
#include "map/merge/merge.hpp"

namespace cairn {

// One merge. Unless append() returns, the state is as it was.
class SparseMerger {
 public:
  using State = SparseState<SE3>;
  using Number = State::Number;

  SparseMerger(State& state, SpatialIndex& index, const State& other, const MergePlan& plan,
               const MergeOptions& options);

  void append(MergeReport& report);

 private:
  double append_bases();
  Number bridge(const SE3& T_base_end, const Matrix6& covariance);
  void append_leaves();
  void append_landmarks();
  void fill_leaves();
  void solve();
  [[noreturn]] void throw_worst(MergeReport& report) const;

  State& state_;
  const State& other_;
  const MergePlan& plan_;
  const MergeOptions& options_;
  SparseChange<SE3> change_;
  std::vector<Number> fresh_;                  // leaves: the bridges, then those of the other map
  std::vector<Number> bases_, leaves_, here_;  // the other map's bases, leaves and landmarks, by their numbers there
  std::vector<Number> reshaped_;               // leaves with landmarks that are shared only now
  TreeChanges changes_;
};

}  // namespace cairn
