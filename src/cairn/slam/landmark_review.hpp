// SPDX-License-Identifier: BSD-3-Clause
// After each frame: which deferred landmarks count from now on, and which landmarks are removed because they were not
// seen.
#pragma once

#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class LandmarkReview {
 public:
  LandmarkReview(const FilterOptions<Pose>& options, LocalMap<Pose>& map, FrameReport& report);

  // Before the commit, for a sensor that may abort: asks it which landmarks are in its view.
  void prepare(const Frame<Pose>& frame);
  // Reads the matches of the finished frame, and adds to its report.
  void run(const Frame<Pose>& frame);

 private:
  void note_sightings(Index observations);
  void promote();
  void remove_contradicted(Index observations);
  void remove_unconfirmed();
  void make_room();
  void remove_missed(const Frame<Pose>& frame);
  void remove(Index slot);
  bool in_view(const Frame<Pose>& frame, Index slot) const;

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  FrameReport& report_;
};

extern template class LandmarkReview<SE2>;
extern template class LandmarkReview<SE3>;

}  // namespace cairn
