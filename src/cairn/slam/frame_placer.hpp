// SPDX-License-Identifier: BSD-3-Clause
// Places the new landmarks of a frame: appends them to the state and names them.
#pragma once

#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/log.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class FramePlacer {
 public:
  FramePlacer(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, FrameReport& report,
              const Log& log);

  // Before the commit, for a sensor that may abort: asks it for every place.
  void prepare(const EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted);
  // To be called after the update was committed, or if it had no candidate. Once the map is full, the rest of the new
  // landmarks, in the order of the frame, is refused. `in_doubt`: an observation that places a landmark for the first
  // time may well be a gross error.
  void place(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted, bool in_doubt);
  // If observations bring no ids, later landmarks get ids above this one.
  void reserve_id(std::uint64_t id);

 private:
  struct Prepared {
    Placement<Pose> placement;
    bool placed;
  };

  void drop_unsupported(SortedFrame<Pose>& sorted) const;
  bool find_place(const EkfUpdate<Pose>& update, const Frame<Pose>& frame, Index observation,
                  Placement<Pose>& placement) const;
  // `old`: the landmark is in this slot already, and is placed again.
  bool place_one(EkfUpdate<Pose>& update, const Frame<Pose>& frame, Index observation, std::optional<Index> old);

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  FrameReport& report_;
  const Log& log_;
  Prepared* prepared_;  // by observation
  std::uint64_t next_id_ = 0;
};

extern template class FramePlacer<SE2>;
extern template class FramePlacer<SE3>;

}  // namespace cairn
