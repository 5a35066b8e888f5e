// SPDX-License-Identifier: BSD-3-Clause
// Two buffers of matches, so that an update that fails leaves the matches of the update before.
#include "slam/frame_report.hpp"

#include <utility>

namespace cairn {

FrameReport::FrameReport(Arena& arena, Index max_observations)
    : matches_(arena.take<Match>(static_cast<std::size_t>(max_observations))),
      next_matches_(arena.take<Match>(static_cast<std::size_t>(max_observations))) {}

void FrameReport::start(Index count) {
  next_update_ = UpdateReport();
  next_count_ = count;
  for (Index i = 0; i < count; ++i) next_matches_[i] = Match();
}

void FrameReport::finish() {
  for (Index i = 0; i < next_count_; ++i) {
    const Match& match = next_matches_[i];
    next_update_.matched += match.decision == Decision::matched;
    next_update_.placed += match.decision == Decision::placed;
    next_update_.rejected += match.decision == Decision::rejected;
  }
  last_ = next_update_;
  std::swap(matches_, next_matches_);
}

}  // namespace cairn
