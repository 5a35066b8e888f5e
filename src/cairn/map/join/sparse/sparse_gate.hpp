// SPDX-License-Identifier: BSD-3-Clause
// Finds the landmarks of a submap that contradict a sparse map.
#pragma once

#include <vector>

#include "map/contradictions.hpp"
#include "map/join/sparse/sparse_state.hpp"

namespace cairn {

// A quick test of a submap that has joined: true if its fused landmarks may contradict the map.
template <class Pose>
bool may_contradict(const SparseState<Pose>& state, std::uint32_t leaf, const JoinReport& report);

// The exact gates, for a submap that has not joined.
struct Contradicting {
  std::vector<Fusing> fusing;  // for each landmark of the submap
  double worst = 0.0;          // squared distance of the one that contradicts most
};
template <class Pose>
Contradicting find_contradicting(const SparseState<Pose>& state, const Submap<Pose>& submap);

extern template bool may_contradict(const SparseState<SE2>&, std::uint32_t, const JoinReport&);
extern template bool may_contradict(const SparseState<SE3>&, std::uint32_t, const JoinReport&);
extern template Contradicting find_contradicting(const SparseState<SE2>&, const Submap<SE2>&);
extern template Contradicting find_contradicting(const SparseState<SE3>&, const Submap<SE3>&);

}  // namespace cairn
