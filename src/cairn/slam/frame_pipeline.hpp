// SPDX-License-Identifier: BSD-3-Clause
// The way of one frame through a filter: sort, update, place, review.
#pragma once

#include <optional>

#include "slam/frame_associator.hpp"
#include "slam/frame_placer.hpp"
#include "slam/frame_sorter.hpp"
#include "slam/frame_update.hpp"
#include "slam/health_feed.hpp"
#include "slam/landmark_review.hpp"
#include "slam/other_places.hpp"
#include "slam/slip_pairs.hpp"

namespace cairn {

template <class Pose>
class FramePipeline {
 public:
  FramePipeline(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, Thresholds& thresholds,
                MotionTrust<Pose>& trust, FrameReport& report, HealthMonitor<Pose>& health, const Log& log);

  // Throws with nothing changed.
  void run(const Frame<Pose>& frame);
  void moved(const Increment<Pose>& increment) { other_places_.moved(increment); }
  void reserve_id(std::uint64_t id) { placer_.reserve_id(id); }

 private:
  void attempt(const Frame<Pose>& frame, std::optional<EkfUpdate<Pose>>& update, bool again);
  void sort(const Frame<Pose>& frame, bool again);

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  MotionTrust<Pose>& trust_;
  FrameReport& report_;
  SortedFrame<Pose> sorted_;
  FrameSorter<Pose> sorter_;
  FrameAssociator<Pose> associator_;
  SlipPairs<Pose> slip_;
  FrameUpdate<Pose> updater_;
  FramePlacer<Pose> placer_;
  OtherPlaces<Pose> other_places_;
  HealthFeed<Pose> health_feed_;
  LandmarkReview<Pose> review_;
};

extern template class FramePipeline<SE2>;
extern template class FramePipeline<SE3>;

}  // namespace cairn
