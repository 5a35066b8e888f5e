// SPDX-License-Identifier: BSD-3-Clause
// Errors that last: the correlation of a landmark's innovations with those of its sightings before (docs/trust.md, eq.
// 7).
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/types.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

constexpr Index kPersistenceLags = 4;

// The last errors of one landmark, the latest one first.
struct PastErrors {
  Vector3 error[kPersistenceLags] = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
  Index count = 0;
};

class Persistence {
 public:
  // `error`: an innovation, whitened by its stated noise. A gross error counts as one of kMost standard deviations.
  void add(Vector3 error, PastErrors& past) {
    const double size = error.norm();
    if (!std::isfinite(size)) return;
    if (size > kMost) error *= kMost / size;
    for (Index lag = 0; lag < past.count; ++lag) {
      const double squares = 0.5 * (error.squaredNorm() + past.error[lag].squaredNorm());
      products_[lag] += gain() * (error.dot(past.error[lag]) - products_[lag]);
      squares_[lag] += gain() * (squares - squares_[lag]);
    }
    if (past.count > 0) ++pairs_;
    for (Index lag = kPersistenceLags - 1; lag > 0; --lag) past.error[lag] = past.error[lag - 1];
    past.error[0] = error;
    past.count = std::min(kPersistenceLags, past.count + 1);
  }
  // Correlation at a lag of 1, 2, ... sightings; 0 while nothing is known.
  double correlation(Index lag) const { return squares_[lag - 1] > 0.0 ? products_[lag - 1] / squares_[lag - 1] : 0.0; }
  double pairs() const { return pairs_; }

 private:
  static constexpr double kMost = 6.0;
  static constexpr double kMemory = 3000.0;  // pairs of sightings
  double gain() const { return 1.0 / std::min(kMemory, pairs_ + 1.0); }

  double products_[kPersistenceLags] = {}, squares_[kPersistenceLags] = {};
  double pairs_ = 0.0;
};

}  // namespace cairn
