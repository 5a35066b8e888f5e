// SPDX-License-Identifier: BSD-3-Clause
// A frame whose observations are sorted: candidates for the update, and observations that may place a landmark. All
// other observations are rejected.
#pragma once

#include "core/arena.hpp"
#include "slam/frame.hpp"

namespace cairn {

// An observation of a point that the state knows.
template <class Pose>
struct Candidate {
  Index observation;
  Index slot;
  Matrix3 noise;
  Prediction<Pose> prediction;  // at the estimate
  Index number;                 // of the point in the update's window
};

template <class Pose>
class SortedFrame {
 public:
  SortedFrame(Arena& arena, Index max_observations);

  void clear() { candidate_count_ = new_count_ = 0; }
  void add_candidate(const Frame<Pose>& frame, Index observation, Index slot, const Prediction<Pose>& prediction);
  // Returns false if the observation, from this pose, places no landmark.
  bool add_new(const Frame<Pose>& frame, Index observation, const Pose& pose);

  Index candidates() const { return candidate_count_; }
  const Candidate<Pose>& candidate(Index a) const { return candidates_[a]; }
  const Candidate<Pose>* begin() const { return candidates_; }
  const Candidate<Pose>* end() const { return candidates_ + candidate_count_; }
  void keep(const Index* kept, Index count);  // these candidates, in rising order

  void add_again(Index observation) { new_ones_[new_count_++] = observation; }  // places its landmark again
  Index new_ones() const { return new_count_; }
  Index new_one(Index k) const { return new_ones_[k]; }  // its observation
  template <class Keep>
  void keep_new(Keep&& keep) {  // those for which keep(observation) holds
    Index kept = 0;
    for (Index k = 0; k < new_count_; ++k)
      if (keep(new_ones_[k])) new_ones_[kept++] = new_ones_[k];
    new_count_ = kept;
  }

 private:
  Candidate<Pose>* candidates_;
  Index* new_ones_;
  Index candidate_count_ = 0, new_count_ = 0;
};

extern template class SortedFrame<SE2>;
extern template class SortedFrame<SE3>;

}  // namespace cairn
