// SPDX-License-Identifier: BSD-3-Clause
// When a submap is closed: its limits, and how long to wait after a closing that failed.
#pragma once

#include "slam/local_map.hpp"

namespace cairn {

enum class ClosedBy { none, caller, landmarks, distance, extent, sigma, fix };

template <class Pose>
class SubmapPolicy {
 public:
  SubmapPolicy(const FilterOptions<Pose>& options, const LocalMap<Pose>& map) : options_(options), map_(map) {}

  void drive(double distance) { driven_ += distance; }
  double driven() const { return driven_; }  // in the open submap, m
  ClosedBy limit() const;                    // that the open submap has reached

  // Closings that fail are tried again, each time after twice as many frames.
  bool wait();     // returns true and counts one frame if it is too early to try again
  void put_off();  // a closing failed
  void restart();  // a submap was closed

 private:
  const FilterOptions<Pose>& options_;
  const LocalMap<Pose>& map_;
  double driven_ = 0.0;
  std::size_t frames_to_wait_ = 0, next_wait_ = 1;
};

extern template class SubmapPolicy<SE2>;
extern template class SubmapPolicy<SE3>;

}  // namespace cairn
