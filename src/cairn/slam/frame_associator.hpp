// SPDX-License-Identifier: BSD-3-Clause
// Sorts the observations of a frame that brings no ids: finds the landmark of each one, or that it is of a new landmark
// (docs/association.md).
#pragma once

#include "slam/frame_pairs.hpp"
#include "slam/frame_report.hpp"
#include "slam/log.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class FrameAssociator {
 public:
  FrameAssociator(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, Thresholds& thresholds,
                  FrameReport& report, const Log& log);

  void sort_landmarks(const Frame<Pose>& frame, SortedFrame<Pose>& sorted);

 private:
  class PairInnovations;

  void choose_pairs(const Frame<Pose>& frame);
  bool confusable(const Frame<Pose>& frame, Index observation, Index pair) const;
  bool is_new(const Frame<Pose>& frame, Index observation) const;
  void settle(const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  void add_new(const Frame<Pose>& frame, Index observation, SortedFrame<Pose>& sorted);

  const FilterOptions<Pose>& options_;
  const LocalMap<Pose>& map_;
  Thresholds& thresholds_;
  FrameReport& report_;
  const Log& log_;
  Association association_;
  FramePairs<Pose> pairs_;
  double* covariance_;  // of [pose; landmarks of all pairs], ordinary errors
  bool* paired_;        // by image: it belongs to a chosen pair
};

extern template class FrameAssociator<SE2>;
extern template class FrameAssociator<SE3>;

}  // namespace cairn
