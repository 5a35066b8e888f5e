// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_gate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "ekf/iterate.hpp"
#include "map/join/sparse/sparse_queries.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

// Whether the fused landmarks' estimates contradict each other, jointly or one by one; the single distances are judged
// from below: a landmark's share of S^-1 nu is the force that the new submap exerts on it, and the covariance of its
// nu, given all other states, is the sum of the inverses of what the new submap and the old ones know of it.
template <class Pose>
bool may_contradict(const SparseState<Pose>& state, std::uint32_t number, const JoinReport& report) {
  constexpr int kDim = Pose::kDim;
  using PointSquare = typename Pose::Rotation::Matrix;
  if (report.distance > report.threshold) return true;
  const typename SparseState<Pose>::Leaf& leaf = state.leaves[number];
  // Among many good landmarks one is likely to exceed the single gate: the bound is such that all of them pass.
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

// Gates the known landmarks against the map as it is: nu = y_submap - R^T (l - p), S = H P H^T + Sigma_DD; each by
// itself, then jointly. Returns, by landmark of the submap, whether it is to be left out.
template <class Pose>
std::vector<char> find_contradicting(const SparseState<Pose>& state, const Submap<Pose>& submap) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  const Pose& base = state.bases.back();
  std::vector<char> left_out(submap.ids.size(), 0);
  std::vector<Index> known;
  std::vector<std::size_t> indices;
  for (Index i = 0; i < submap.size(); ++i) {
    std::size_t index = 0;
    if (!state.find(submap.ids[i], index)) continue;
    known.push_back(i);
    indices.push_back(index);
  }
  Eigen::MatrixXd joint = submap.covariance;
  to_ordinary(submap, known, joint);
  const double single = chi_square_quantile(kDim, state.options.gate_probability);
  for (bool first = true;; first = false) {
    const auto count = static_cast<Index>(known.size()), m = kDim * count;
    if (count == 0) return left_out;
    Eigen::MatrixXd P(kDof + m, kDof + m), H = Eigen::MatrixXd::Zero(m, kDof + m), S(m, m);
    joint_covariance_of_base(state, indices.data(), indices.size(), P.data());
    Eigen::VectorXd residual(m);
    for (Index a = 0; a < count; ++a) {
      const typename Pose::Point l = state.point(indices[a]);
      Prediction<Pose> prediction;
      map_jacobians(base, l, Prediction<Pose>::ByLandmark::Identity(), prediction);
      H.block<kDim, kDof>(kDim * a, 0) = prediction.J_z_pose.template topRows<kDim>();
      H.block<kDim, kDim>(kDim * a, kDof + kDim * a) = prediction.J_z_landmark.template topRows<kDim>();
      residual.segment<kDim>(kDim * a) = submap.landmarks[known[a]] - base.inverse() * l;
      for (Index b = 0; b < count; ++b)
        S.block<kDim, kDim>(kDim * a, kDim * b) =
            joint.block<kDim, kDim>(kDof + kDim * known[a], kDof + kDim * known[b]);
    }
    S += H * P * H.transpose();
    if (first) {
      std::vector<Index> passed;
      std::vector<std::size_t> passed_indices;
      for (Index a = 0; a < count; ++a) {
        const double distance = squared_distance(residual.data() + kDim * a, S.data() + kDim * a * (m + 1), m, kDim);
        if (distance >= 0.0 && distance <= single) {
          passed.push_back(known[a]);
          passed_indices.push_back(indices[a]);
        } else {
          left_out[known[a]] = 1;
        }
      }
      const bool all = passed.size() == known.size();
      known.swap(passed);
      indices.swap(passed_indices);
      if (!all) continue;
    }
    Eigen::MatrixXd inverse = S.selfadjointView<Eigen::Lower>().ldlt().solve(Eigen::MatrixXd::Identity(m, m));
    Eigen::VectorXd u = inverse * residual;
    std::vector<double> workspace(static_cast<std::size_t>(kDim * (kDim + m)));
    gate_by_inverse(
        inverse.data(), count, kDim, u.data(), residual.dot(u), workspace.data(),
        [&](Index rows) {
          return chi_square_quantile(static_cast<double>(rows), state.options.joint_gate_probability);
        },
        [&](Index a) { return left_out[known[a]] != 0; }, [&](Index a, double, double) { left_out[known[a]] = 1; });
    return left_out;
  }
}

template bool may_contradict(const SparseState<SE2>&, std::uint32_t, const JoinReport&);
template bool may_contradict(const SparseState<SE3>&, std::uint32_t, const JoinReport&);
template std::vector<char> find_contradicting(const SparseState<SE2>&, const Submap<SE2>&);
template std::vector<char> find_contradicting(const SparseState<SE3>&, const Submap<SE3>&);

}  // namespace cairn
