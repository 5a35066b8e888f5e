// SPDX-License-Identifier: BSD-3-Clause
// The chi-square bounds of a filter's gates, by the number of rows that a gate judges.
#pragma once

#include "core/arena.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

class Thresholds {
 public:
  struct Probabilities {
    double single;        // of one observation, or of a batch that is judged as a whole
    double joint;         // of all observations of a frame together
    double new_landmark;  // an observation within this distance of a landmark places none
  };
  Thresholds(Arena& arena, const Probabilities& probabilities, Index most_rows);

  double single(Index rows) const;
  double joint(Index rows);  // computed when it is first asked for
  double new_landmark(Index rows) const { return new_landmark_[rows]; }

 private:
  static constexpr Index kMostSingle = 6, kMostNew = 3;

  Probabilities probabilities_;
  double single_[kMostSingle + 1] = {};
  double new_landmark_[kMostNew + 1] = {};
  double* joint_;  // by rows
  bool* known_;    // by rows: whether joint_ was computed
};

}  // namespace cairn
