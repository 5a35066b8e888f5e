// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_gate.hpp"

#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "map/join/sparse/sparse_queries.hpp"
#include "map/submap_innovation.hpp"

namespace cairn {

// Whether the fused landmarks' estimates contradict each other, jointly or one by one. The single distances are lower
// bounds: a landmark's share of S^-1 nu is the force that the new submap exerts on it, and the covariance of its nu,
// given all other states, is the sum of the inverses of its information in the new submap and in the old ones.
template <class Pose>
bool may_contradict(const SparseState<Pose>& state, std::uint32_t number, const JoinReport& report) {
  constexpr int kDim = Pose::kDim;
  using PointSquare = typename Pose::Rotation::Matrix;
  if (report.distance > report.threshold) return true;
  const typename SparseState<Pose>::Leaf& leaf = state.leaves[number];
  // Among many good landmarks one is likely to exceed the single gate: the bound is chosen so that all of them pass.
  const double count = std::max(1.0, static_cast<double>(report.fused));
  const double bound = chi_square_quantile(kDim, std::pow(state.options.gate_probability, 1.0 / count));
  for (Index i = 0; i < leaf.shared_count(); ++i) {
    const std::uint32_t landmark = leaf.shared(i);
    PointSquare old = PointSquare::Zero();
    for (const std::uint32_t other : state.landmarks[landmark].submaps) {
      if (other == number) continue;
      const typename SparseState<Pose>::Leaf& there = state.leaves[other];
      for (Index j = 0; j < there.shared_count(); ++j)
        if (there.shared(j) == landmark) old += state.landmark_information(there, j);
    }
    const PointSquare fresh = state.landmark_information(leaf, i);
    const typename Pose::Point force = state.force_on(leaf, i);
    if (force.dot((fresh.inverse() + old.inverse()) * force) > bound) return true;
  }
  return false;
}

template <class Pose>
Contradicting find_contradicting(const SparseState<Pose>& state, const Submap<Pose>& submap) {
  constexpr int kDim = Pose::kDim;
  std::vector<Index> locals;  // in the submap
  std::vector<std::size_t> indices;
  std::vector<typename Pose::Point> points;
  for (Index i = 0; i < submap.size(); ++i) {
    std::size_t index = 0;
    if (!state.find(submap.ids[i], index)) continue;
    locals.push_back(i);
    indices.push_back(index);
    points.push_back(state.point(index));
  }
  Eigen::MatrixXd noise = submap.covariance;
  to_ordinary(submap, locals, noise);
  const auto size = static_cast<Index>(Pose::kDof + kDim * locals.size());
  Eigen::MatrixXd P(size, size);
  joint_covariance_of_base(state, indices.data(), indices.size(), P.data());
  const SubmapInnovation<Pose> innovation(state.newest_base(), P, points, submap, locals, noise);

  Contradictions contradictions(kDim);
  InnovationBatch<Pose> batch(innovation);
  const auto bound = [&](Index rows) {
    return chi_square_quantile(static_cast<double>(rows), state.options.joint_gate_probability);
  };
  gate_blocks(batch, kDim, chi_square_quantile(kDim, state.options.gate_probability), bound,
              [&](Gate gate, Index block, double distance, double most) {
                contradictions.add(gate, locals[batch.number(block)], distance, most);
              });
  const auto in_map = [&](Index i) { return state.landmarks[state.ids.find(submap.ids[i])->second].count; };
  return {contradictions.decide(static_cast<Index>(locals.size()), in_map, submap.counts), contradictions.worst()};
}

template bool may_contradict(const SparseState<SE2>&, std::uint32_t, const JoinReport&);
template bool may_contradict(const SparseState<SE3>&, std::uint32_t, const JoinReport&);
template Contradicting find_contradicting(const SparseState<SE2>&, const Submap<SE2>&);
template Contradicting find_contradicting(const SparseState<SE3>&, const Submap<SE3>&);

}  // namespace cairn
