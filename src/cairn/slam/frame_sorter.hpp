// SPDX-License-Identifier: BSD-3-Clause
// Sorts observations by the ids that they bring: landmarks if ids are known, and companions in any case.
#pragma once

#include "core/id_table.hpp"
#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class FrameSorter {
 public:
  FrameSorter(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, FrameReport& report);

  // Both throw if an id comes twice in the frame.
  void sort_landmarks(const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  void sort_companions(const Frame<Pose>& frame, SortedFrame<Pose>& sorted);

 private:
  void add_known(const Frame<Pose>& frame, Index observation, Index slot, SortedFrame<Pose>& sorted);

  const LocalMap<Pose>& map_;
  FrameReport& report_;
  IdTable ids_;  // of the frame's landmarks
};

extern template class FrameSorter<SE2>;
extern template class FrameSorter<SE3>;

}  // namespace cairn
