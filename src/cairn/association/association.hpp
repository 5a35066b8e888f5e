// SPDX-License-Identifier: BSD-3-Clause
// Association of observations without ids: nearest neighbour, and joint compatibility by branch and bound (Neira and
// Tardos 2001). Both choose among candidates: pairs of an observation and a landmark that pass the individual gate.
// Each landmark is matched at most once (docs/association.md).
//
// Nothing allocates after construction. The result depends only on the arguments: of equal candidates the first is
// taken.
#pragma once

#include "core/arena.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

struct PairCandidate {
  Index observation;  // candidates are sorted by observation
  Index landmark;
  double distance;  // squared Mahalanobis distance of the innovation
};

constexpr Index kUnpaired = -1;

// The innovations of all candidates, for joint compatibility. An innovation has rows() <= 3 rows.
class Innovations {
 public:
  virtual ~Innovations() = default;
  virtual Index rows() const = 0;
  virtual void innovation(Index candidate, double* nu) const = 0;
  // Covariance between the innovations of candidates `a` and `b` of different observations; for a = b the covariance of
  // the innovation, noise included. rows x rows, column-major; the row index belongs to `a`.
  virtual void covariance(Index a, Index b, double* block) const = 0;
  // Chi-square bound for this number of rows.
  virtual double threshold(Index rows) const = 0;
};

class Association {
 public:
  static constexpr Index kMostRows = 3;

  struct Capacity {
    Index observations, candidates, landmarks;  // landmarks: the largest landmark number plus 1
  };
  Association(Arena& arena, const Capacity& capacity);

  // Nearest neighbour: takes candidates by ascending distance if both their observation and their landmark are still
  // unmatched. O(c log c) for c candidates.
  void nearest_neighbour(const PairCandidate* candidates, Index count, Index observations);

  // The largest set of jointly compatible pairs; of several such sets the one with the smallest joint distance. A set
  // is jointly compatible if, for every n, the joint squared distance of its first n pairs in search order is below the
  // bound for their rows. `nodes` limits the number of joint tests; one test of p pairs costs O(p^2). The first
  // descent, which takes the best candidate of each observation, is always finished. The result is jointly compatible
  // even if the limit stopped the search.
  void joint_compatibility(const PairCandidate* candidates, Index count, Index observations,
                           const Innovations& innovations, Index nodes);

  // Drops the doubtful pairs of the last call if they are fewer than `support`. doubtful(observation, candidate) is
  // true for a pair that may fit by chance. When a known place is seen again, one wrong pair fits easily and would bend
  // the map; several pairs hardly ever fit together by chance.
  template <class Doubtful>
  void demand_support(Index support, Doubtful&& doubtful) {
    Index count = 0;
    for (Index o = 0; o < all_observations_; ++o) {
      current_[o] = best_[o] != kUnpaired && doubtful(o, best_[o]) ? 1 : 0;
      count += current_[o];
    }
    if (count >= support) return;
    for (Index o = 0; o < all_observations_; ++o)
      if (current_[o] != 0) {
        best_[o] = kUnpaired;
        --best_pairs_;
      }
  }

  // --- result of the last call ---
  Index chosen(Index observation) const { return best_[observation]; }  // number of a candidate, or kUnpaired
  Index pairs() const { return best_pairs_; }
  double distance() const { return best_distance_; }  // joint distance; nearest neighbour: sum of individual distances
  Index nodes() const { return nodes_; }              // number of joint tests; nearest neighbour: 0
  bool exhausted() const { return exhausted_; }       // the limit stopped the search: there may be a better set

 private:
  void begin(const PairCandidate* candidates, Index count, Index observations);
  void search(Index depth, Index pairs, double distance);
  double extend(Index candidate, Index pairs);
  bool better(Index pairs, double distance) const {
    return pairs > best_pairs_ || (pairs == best_pairs_ && distance < best_distance_);
  }

  const PairCandidate* candidates_ = nullptr;
  const Innovations* innovations_ = nullptr;
  Index observations_ = 0, all_observations_ = 0, rows_ = 0, budget_ = 0;

  Index* first_;      // by observation: its first candidate, and one more entry at the end
  Index* order_;      // by search depth: observation
  Index* queue_;      // candidates: those of each observation together, or all of them by distance
  double* joint_;     // by candidate: joint distance of the current set with the candidate
  char* taken_;       // by landmark: 1 if it is matched
  Index* current_;    // pairs of the current set: candidates
  Index* best_;       // by observation: candidate of the best set
  double* factor_;    // L of the joint covariance, packed by rows; see extend()
  double* whitened_;  // L^-1 nu
  Index best_pairs_ = 0, nodes_ = 0;
  double best_distance_ = 0.0;
  bool exhausted_ = false;
};

}  // namespace cairn
