// SPDX-License-Identifier: BSD-3-Clause
// The update of the state by the candidates of a frame: linearise, gates, iterate, commit (docs/update.md).
#pragma once

#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/log.hpp"
#include "slam/sorted_frame.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

template <class Pose>
class FrameUpdate {
 public:
  FrameUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, Thresholds& thresholds,
              FrameReport& report, const Log& log);

  // The update whose window holds the candidates.
  EkfUpdate<Pose> begin(const Frame<Pose>& frame, const SortedFrame<Pose>& sorted);
  // Everything before the commit. The candidates that the gates accept are left in `sorted`.
  void run(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  void commit(EkfUpdate<Pose>& update, const SortedFrame<Pose>& sorted);

 private:
  class Gates;

  bool fill(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted,
            double* residual_only) const;
  void gate(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted);

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  Thresholds& thresholds_;
  FrameReport& report_;
  const Log& log_;
  Index* window_;  // slots
};

extern template class FrameUpdate<SE2>;
extern template class FrameUpdate<SE3>;

}  // namespace cairn
