// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_gate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/chi_square.hpp"
#include "linear/joint_gate.hpp"
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
  for (Index i = 0; i < leaf.factor->shared_count(); ++i) {
    const std::uint32_t landmark = leaf.landmarks[leaf.factor->shared()[i]];
    PointSquare old = PointSquare::Zero();
    for (const std::uint32_t other : state.landmarks[landmark].submaps) {
      if (other == number) continue;
      const std::vector<Index>& shared_there = state.leaves[other].factor->shared();
      for (std::size_t j = 0; j < shared_there.size(); ++j)
        if (state.leaves[other].landmarks[shared_there[j]] == landmark)
          old += state.leaves[other].factor->landmark_information(static_cast<Index>(j), state.bases[other].rotation());
    }
    const PointSquare fresh = leaf.factor->landmark_information(i, state.bases[number].rotation());
    const typename Pose::Point force = state.force_on(leaf, i);
    if (force.dot((fresh.inverse() + old.inverse()) * force) > bound) return true;
  }
  return false;
}

namespace {

// The submap's known landmarks against the map as it is, as a batch for gate_blocks(): nu = y_submap - R^T (l - p) and
// S = H P H^T + Sigma_DD.
template <class Pose>
class KnownLandmarks {
 public:
  KnownLandmarks(const SparseState<Pose>& state, const Submap<Pose>& submap) : state_(state), submap_(submap) {
    for (Index i = 0; i < submap.size(); ++i) {
      std::size_t index = 0;
      if (state.find(submap.ids[i], index)) known_.push_back({i, index});
    }
    noise_ = submap.covariance;
    std::vector<Index> locals;
    for (const Known& known : known_) locals.push_back(known.local);
    to_ordinary(submap, locals, noise_);
    kept_.resize(known_.size());
    refused_.reset(new bool[known_.size()]);
    form();
  }

  Index local(Index block) const { return known_[block].local; }  // in the submap

  Index count() const { return static_cast<Index>(known_.size()); }
  double distance(Index block) const {
    const Index m = kDim * count();
    return squared_distance(residual_.data() + kDim * block, S_.data() + kDim * block * (m + 1), m, kDim);
  }
  void keep(const Index* blocks, Index count) {
    for (Index k = 0; k < count; ++k) known_[k] = known_[blocks[k]];
    known_.resize(static_cast<std::size_t>(count));
    formed_ = false;
  }
  template <class Bound>
  bool consistent(Bound&& bound) {
    if (known_.empty()) return true;
    if (!formed_) form();
    const Index m = kDim * count();
    inverse_ = S_.template selfadjointView<Eigen::Lower>().ldlt().solve(Eigen::MatrixXd::Identity(m, m));
    u_ = inverse_ * residual_;
    workspace_.resize(static_cast<std::size_t>(kDim * (kDim + m)));
    return residual_.dot(u_) <= bound(m);
  }
  InverseInnovation invert() { return {inverse_.data(), u_.data(), residual_.dot(u_), workspace_.data()}; }
  void refactor() {}  // S is not needed again
  Index* kept() { return kept_.data(); }
  bool* refused() { return refused_.get(); }

 private:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  struct Known {
    Index local;        // in the submap
    std::size_t index;  // in the map
  };

  void form() {
    formed_ = true;
    if (known_.empty()) return;
    std::vector<std::size_t> indices;
    std::vector<Index> locals;
    std::vector<typename Pose::Point> points;
    for (const Known& known : known_) {
      indices.push_back(known.index);
      locals.push_back(known.local);
      points.push_back(state_.point(known.index));
    }
    Eigen::MatrixXd P(kDof + kDim * count(), kDof + kDim * count());
    joint_covariance_of_base(state_, indices.data(), indices.size(), P.data());
    SubmapInnovation<Pose> innovation(state_.bases.back(), P, points, submap_, locals, noise_);
    residual_ = std::move(innovation.residual);
    S_ = std::move(innovation.S);
  }

  const SparseState<Pose>& state_;
  const Submap<Pose>& submap_;
  std::vector<Known> known_;
  Eigen::MatrixXd noise_;  // of the whole submap, ordinary errors of the known landmarks
  bool formed_ = false;    // residual_ and S_ belong to known_
  Eigen::VectorXd residual_;
  Eigen::MatrixXd S_;
  Eigen::MatrixXd inverse_;
  Eigen::VectorXd u_;
  std::vector<double> workspace_;
  std::vector<Index> kept_;
  std::unique_ptr<bool[]> refused_;
};

}  // namespace

template <class Pose>
Contradicting find_contradicting(const SparseState<Pose>& state, const Submap<Pose>& submap) {
  Contradictions contradictions(Pose::kDim);
  KnownLandmarks<Pose> landmarks(state, submap);
  const Index known = landmarks.count();
  const auto bound = [&](Index rows) {
    return chi_square_quantile(static_cast<double>(rows), state.options.joint_gate_probability);
  };
  gate_blocks(landmarks, Pose::kDim, chi_square_quantile(Pose::kDim, state.options.gate_probability), bound,
              [&](Gate gate, Index block, double distance, double most) {
                contradictions.add(gate, landmarks.local(block), distance, most);
              });
  const auto in_map = [&](Index i) { return state.landmarks[state.ids.find(submap.ids[i])->second].count; };
  return {contradictions.decide(known, in_map, submap.counts), contradictions.worst()};
}

template bool may_contradict(const SparseState<SE2>&, std::uint32_t, const JoinReport&);
template bool may_contradict(const SparseState<SE3>&, std::uint32_t, const JoinReport&);
template Contradicting find_contradicting(const SparseState<SE2>&, const Submap<SE2>&);
template Contradicting find_contradicting(const SparseState<SE3>&, const Submap<SE3>&);

}  // namespace cairn
