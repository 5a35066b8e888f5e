// SPDX-License-Identifier: BSD-3-Clause
// Places the new landmarks of a frame: appends them to the state and names them.
#pragma once

#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class FramePlacer {
 public:
  FramePlacer(const FilterOptions<Pose>& options, LocalMap<Pose>& map, FrameReport& report);

  // To be called after the update was committed, or if it had no candidate.
  void place(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  // If observations bring no ids, later landmarks get ids above this one.
  void reserve_id(std::uint64_t id);

 private:
  void drop_unsupported(SortedFrame<Pose>& sorted) const;
  bool place_one(EkfUpdate<Pose>& update, const Frame<Pose>& frame, Index observation);

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  FrameReport& report_;
  std::uint64_t next_id_ = 0;
};

extern template class FramePlacer<SE2>;
extern template class FramePlacer<SE3>;

}  // namespace cairn
