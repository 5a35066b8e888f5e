// SPDX-License-Identifier: BSD-3-Clause
// Tells the health monitor of a frame: what was seen before the update, and what the update left.
#pragma once

#include "health/health_monitor.hpp"
#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class HealthFeed {
 public:
  using Point = typename Pose::Point;
  using Matrix = typename Pose::Rotation::Matrix;

  HealthFeed(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, const FrameReport& report,
             HealthMonitor<Pose>& health);

  // After the sorting: notes the innovations. Changes nothing of the monitor, for the update may still throw.
  void before(const Frame<Pose>& frame, const SortedFrame<Pose>& sorted);
  // After the frame has succeeded and its report is finished.
  void after(const Frame<Pose>& frame);

 private:
  struct Seen {
    Index observation;
    Sighted<Pose> sighted;
  };
  void remember(const Frame<Pose>& frame, Index observation, const Sighted<Pose>* sighted);

  const LocalMap<Pose>& map_;
  const FrameReport& report_;
  HealthMonitor<Pose>& health_;
  Seen* seen_;
  Index count_ = 0;
  Pose before_, after_;
  Matrix turn_after_ = Matrix::Identity();  // the rotation of after_
  typename Pose::Square covariance_before_ = Pose::Square::Zero();
};

extern template class HealthFeed<SE2>;
extern template class HealthFeed<SE3>;

}  // namespace cairn
