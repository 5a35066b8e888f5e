// SPDX-License-Identifier: BSD-3-Clause
// Which landmark an observation is of, where it brings no name: nearest neighbour, and joint compatibility by branch
// and bound (Neira and Tardos 2001). Both choose among candidates, pairs of an observation and a landmark that pass
// their gate alone, and give a landmark to one observation at most (docs/association.md).
//
// Nothing allocates after construction, and nothing depends on more than the arguments: ties go to the candidate that
// was named first.
#pragma once

#include "core/arena.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

struct PairCandidate {
  Index observation;  // candidates of one observation stand together, observations ascend
  Index landmark;
  double distance;  // squared Mahalanobis distance of its innovation
};

constexpr Index kUnpaired = -1;

// What joint compatibility asks for. An innovation has rows() <= 3 rows.
class Innovations {
 public:
  virtual ~Innovations() = default;
  virtual Index rows() const = 0;
  virtual void innovation(Index candidate, double* nu) const = 0;
  // Covariance of the innovations of two candidates of different observations, or of one with itself, its noise
  // included. rows x rows, column-major, row by `a`.
  virtual void covariance(Index a, Index b, double* block) const = 0;
  // Chi-square bound of so many rows.
  virtual double threshold(Index rows) const = 0;
};

class Association {
 public:
  static constexpr Index kMostRows = 3;

  struct Capacity {
    Index observations, candidates, landmarks;  // landmarks: one more than the largest number of one
  };
  Association(Arena& arena, const Capacity& capacity);

  // Candidates by ascending distance, each taken where its observation and its landmark are both still free.
  // O(c log c) for c candidates.
  void nearest_neighbour(const PairCandidate* candidates, Index count, Index observations);

  // The largest set of pairs whose innovations fit together, of several such the one with the least joint distance. A
  // set fits where the joint squared distance of its first pairs, in the order of the search, is below the bound of
  // their rows for every number of them. `nodes` bounds the joint tests, of O(p^2) for p pairs each; the first descent,
  // which takes the best fitting candidate at each observation, is finished whatever the bound is, and what is found is
  // a set that fits whether the bound is met or not.
  void joint_compatibility(const PairCandidate* candidates, Index count, Index observations,
                           const Innovations& innovations, Index nodes);

  // Pairs that could be chance, by doubtful(observation, candidate), are taken together or not at all: at the first
  // sight of a known place one of them fits easily, and would bend the map; several fit by chance together hardly ever.
  // Those of the last call are given up where they are fewer than `support`.
  template <class Doubtful>
  void demand_support(Index support, Doubtful&& doubtful) {
    Index count = 0;
    for (Index o = 0; o < all_observations_; ++o) {
      now_[o] = best_[o] != kUnpaired && doubtful(o, best_[o]) ? 1 : 0;
      count += now_[o];
    }
    if (count >= support) return;
    for (Index o = 0; o < all_observations_; ++o)
      if (now_[o] != 0) {
        best_[o] = kUnpaired;
        --best_pairs_;
      }
  }

  // --- of the last call ---
  Index chosen(Index observation) const { return best_[observation]; }  // number of a candidate, or kUnpaired
  Index pairs() const { return best_pairs_; }
  double distance() const { return best_distance_; }  // jointly; nearest neighbour: the sum of single ones
  Index nodes() const { return nodes_; }              // joint tests; nearest neighbour: 0
  bool exhausted() const { return exhausted_; }       // the bound was met: there may be a better set

 private:
  void begin(const PairCandidate* candidates, Index count, Index observations);
  void search(Index depth, Index pairs, double distance);
  double border(Index candidate, Index pairs);
  bool better(Index pairs, double distance) const {
    return pairs > best_pairs_ || (pairs == best_pairs_ && distance < best_distance_);
  }

  const PairCandidate* candidates_ = nullptr;
  const Innovations* innovations_ = nullptr;
  Index observations_ = 0, all_observations_ = 0, rows_ = 0, budget_ = 0;

  Index* first_;      // by observation: its first candidate; one more at the end
  Index* order_;      // by depth of the search: observation
  Index* queue_;      // candidates, those of one depth together, or all by distance
  double* joint_;     // by queue: joint distance with the candidate
  char* taken_;       // by landmark
  Index* now_;        // by depth: candidate of the set at hand
  Index* best_;       // by observation
  double* factor_;    // L of the joint covariance, by rows, packed; see border()
  double* whitened_;  // L^-1 nu
  Index best_pairs_ = 0, nodes_ = 0;
  double best_distance_ = 0.0;
  bool exhausted_ = false;
};

}  // namespace cairn
