// SPDX-License-Identifier: BSD-3-Clause
// Updates by one batch that is gated as a whole: an absolute fix, rows that the caller linearised, and two landmarks
// that are one.
#pragma once

#include "core/id_table.hpp"
#include "sensor/absolute_fix.hpp"
#include "slam/frame_report.hpp"
#include "slam/submap_keeper.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

// Every update has one match, number 0 of the report. All of them throw with nothing changed.
template <class Pose>
class WholeBatchUpdate {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;

  WholeBatchUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, SubmapKeeper<Pose>& submaps,
                   const Thresholds& thresholds, FrameReport& report, const Log& log);

  void fix(const AbsoluteFix<Pose>& given);
  void rows(const LinearRows& rows);
  // If the gate accepts that two landmarks are one, `other` is removed.
  void merge(std::uint64_t id, std::uint64_t other);

 private:
  template <class Fill>
  void run(EkfUpdate<Pose>& update, Index rows, int iterations, std::uint64_t landmark, Fill&& fill);
  void fix_map(const AbsoluteFix<Pose>& fix);
  void find_window(const LinearRows& rows);
  bool matched() const { return report_.matches()[0].decision == Decision::matched; }

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  SubmapKeeper<Pose>& submaps_;
  const Thresholds& thresholds_;
  FrameReport& report_;
  const Log& log_;
  IdTable ids_;    // of the landmarks that the caller's rows depend on
  Index* window_;  // slots
};

extern template class WholeBatchUpdate<SE2>;
extern template class WholeBatchUpdate<SE3>;

}  // namespace cairn
