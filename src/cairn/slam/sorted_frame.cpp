// SPDX-License-Identifier: BSD-3-Clause
// The lists of a sorted frame.
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
SortedFrame<Pose>::SortedFrame(Arena& arena, Index max_observations)
    : candidates_(arena.take<Candidate<Pose>>(static_cast<std::size_t>(max_observations))),
      new_ones_(arena.take<Index>(static_cast<std::size_t>(max_observations))) {}

template <class Pose>
void SortedFrame<Pose>::add_candidate(const Frame<Pose>& frame, Index observation, Index slot,
                                      const Prediction<Pose>& prediction) {
  candidates_[candidate_count_] = {observation, slot, frame.noise(observation), prediction, candidate_count_};
  ++candidate_count_;
}

template <class Pose>
bool SortedFrame<Pose>::add_new(const Frame<Pose>& frame, Index observation, const Pose& pose) {
  Placement<Pose> placement;
  if (!frame.sensor.place(pose, frame.z(observation), MountError<Pose>::Zero(), placement)) return false;
  new_ones_[new_count_++] = observation;
  return true;
}

template <class Pose>
void SortedFrame<Pose>::keep(const Index* kept, Index count) {
  for (Index k = 0; k < count; ++k) candidates_[k] = candidates_[kept[k]];
  candidate_count_ = count;
}

template class SortedFrame<SE2>;
template class SortedFrame<SE3>;

}  // namespace cairn
