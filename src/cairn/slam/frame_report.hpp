// SPDX-License-Identifier: BSD-3-Clause
// The outcome of an update: one match for each observation, and a summary. The outcome of the last update stays
// readable until the next update has succeeded.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/arena.hpp"
#include "slam/observation.hpp"

namespace cairn {

enum class Decision { matched, placed, rejected };
enum class Reason { none, gate, batch_gate, no_image, no_place, ambiguous, no_room, contradicted };

// The landmark that an observation was paired with, and whether the observation was used.
struct Match {
  std::uint64_t landmark = kNoId;
  Decision decision = Decision::rejected;
  Reason reason = Reason::none;
  double distance = 0.0;
  double threshold = 0.0;
};

struct UpdateReport {
  Index matched = 0, placed = 0, rejected = 0;
  Index rows = 0;
  int iterations = 0;
  double nis = 0.0;
  Index association_nodes = 0;
  bool association_exhausted = false;
  double association_seconds = 0.0;
  Index deferred = 0;                                     // landmarks that do not count yet after the update
  Index removed = 0;                                      // removed landmarks: missed, or deferred for too long
  Index placed_again = 0;                                 // landmarks among `placed` that were placed wrongly before
  double widened_position = 0.0, widened_attitude = 0.0;  // standard deviations by which the motion was widened
  bool widened() const { return widened_position > 0.0 || widened_attitude > 0.0; }
};

class FrameReport {
 public:
  FrameReport(Arena& arena, Index max_observations);

  // --- of the update at hand ---
  void start(Index count);  // every observation is rejected without a reason
  Match& match(Index observation) { return next_matches_[observation]; }
  UpdateReport& update() { return next_update_; }
  template <class Pose>
  void widened(const typename Pose::Square& covariance) {
    next_update_.widened_position = std::sqrt(covariance.template topLeftCorner<Pose::kDim, Pose::kDim>().trace());
    next_update_.widened_attitude =
        std::sqrt(covariance.template bottomRightCorner<Pose::kTurn, Pose::kTurn>().trace());
  }
  void finish();  // counts the matches; the update at hand becomes the last one

  // --- of the last update ---
  const Match* matches() const { return matches_; }
  const UpdateReport& last() const { return last_; }
  UpdateReport& last() { return last_; }  // the review of landmarks adds to it

 private:
  Match* matches_;
  Match* next_matches_;
  Index next_count_ = 0;
  UpdateReport last_, next_update_;
};

}  // namespace cairn
