// SPDX-License-Identifier: BSD-3-Clause
// The life of submaps: when one is closed, how it joins the map, and what the caller's pose is meanwhile. Included by
// filter.cpp alone.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <new>

#include "core/error.hpp"
#include "map/join/dense/dense_map.hpp"
#include "map/join/sparse/sparse_map.hpp"
#include "slam/filter.hpp"

namespace cairn {
namespace {

// Up to here a dense closing is the cheaper one (docs/submaps.md).
constexpr Index kDenseAtMost = 100;

template <class Pose>
NamingOptions naming_options(const FilterOptions<Pose>& options) {
  NamingOptions naming;
  naming.joint = options.association == AssociationKind::joint;
  naming.nodes = options.association_nodes;
  naming.support = options.association_support;
  naming.gate_probability = options.gate_probability;
  naming.joint_gate_probability = options.batch_gate_probability;
  naming.new_probability = options.new_probability;
  return naming;
}

}  // namespace

template <class Pose>
MapOptions<Pose> map_options(const FilterOptions<Pose>& options) {
  MapOptions<Pose> map;
  map.error = options.error;
  map.max_landmarks = static_cast<std::size_t>(options.max_landmarks);
  map.submap_capacity = static_cast<std::size_t>(options.local_landmarks());
  map.iterations = options.iterations;
  map.iteration_tolerance = options.iteration_tolerance;
  map.gate_probability = options.gate_probability;
  map.joint_gate_probability = options.batch_gate_probability;
  map.step_tolerance = options.step_tolerance;
  map.initial_pose = options.initial_pose;
  map.initial_covariance = options.initial_covariance;
  return map;
}

template <class Pose>
bool FilterOptions<Pose>::sparse() const {
  if (single_map()) return false;
  return join == JoinKind::sparse || (join == JoinKind::automatic && max_landmarks > kDenseAtMost);
}

template <class Pose>
std::unique_ptr<GlobalMap<Pose>> Filter<Pose>::make_map(const FilterOptions<Pose>& options) {
  if (options.single_map()) return nullptr;
  if (options.sparse()) return std::make_unique<SparseMap<Pose>>(map_options(options));
  return std::make_unique<DenseMap<Pose>>(map_options(options));
}

template <class Pose>
std::size_t Filter<Pose>::required_bytes(const FilterOptions<Pose>& options) {
  std::size_t bytes = arena_bytes(options);
  if (!options.single_map() && !options.sparse()) bytes += DenseMap<Pose>::required_bytes(map_options(options));
  return bytes;
}

// Which limit the open submap has reached.
template <class Pose>
ClosedBy Filter<Pose>::full() const {
  if (counting() >= options_.submap_landmarks) return ClosedBy::landmarks;
  if (counting() == 0) return ClosedBy::none;
  if (options_.submap_distance > 0.0 && driven_ >= options_.submap_distance) return ClosedBy::distance;
  if (options_.submap_extent > 0.0)
    for (Index slot = 0; slot < ekf_.size(); ++slot)
      if (ekf_.landmark(slot).norm() >= options_.submap_extent) return ClosedBy::extent;
  if (options_.submap_sigma > 0.0) {
    const PointSquare P = ekf_.pose_covariance().template topLeftCorner<kDim, kDim>();
    Eigen::SelfAdjointEigenSolver<PointSquare> solver;
    solver.computeDirect(P, Eigen::EigenvaluesOnly);
    if (solver.eigenvalues().maxCoeff() >= options_.submap_sigma * options_.submap_sigma) return ClosedBy::sigma;
  }
  return ClosedBy::none;
}

template <class Pose>
Submap<Pose> Filter<Pose>::take_submap() const {
  Submap<Pose> submap;
  const Index count = counting(), n = kDof + kDim * count;
  submap.error = options_.error;
  submap.T_base_end = ekf_.pose();
  submap.ids.assign(ids_, ids_ + count);
  submap.counts.assign(counts_, counts_ + count);
  std::vector<Index> slots(static_cast<std::size_t>(count));
  for (Index slot = 0; slot < count; ++slot) {
    slots[slot] = slot;
    submap.landmarks.push_back(ekf_.landmark(slot));
  }
  submap.covariance.resize(n, n);
  ekf_.gather(slots.data(), count, submap.covariance.data(), n);
  return submap;
}

// Closes the open submap, whatever it holds, and starts anew at the vehicle's pose (Mars paper, eq. 14-16). A fix is
// applied to the new base: both or neither.
template <class Pose>
FixReport Filter<Pose>::join_submap(ClosedBy reason, const AbsoluteFix<Pose>* fix, double threshold) {
  ClosingReport next;
  const auto begin = std::chrono::steady_clock::now();
  next.reason = reason;
  next.landmarks = counting();
  Submap<Pose> submap = take_submap();
  if (options_.association != AssociationKind::known) {
    next.naming = name_landmarks(*map_, naming_options(options_), submap);
    if (next.naming.exhausted)
      say("closing: association stopped at %td joint tests, with %zu of %td landmarks named", next.naming.nodes,
          next.naming.named, next.landmarks);
  }
  const auto transaction = map_->begin();
  FixReport fixed;
  transaction->join(submap);
  if (fix != nullptr) fixed = transaction->fix(*fix, threshold);
  next.join = transaction->commit();
  ekf_.start(Pose(), Square::Zero());
  slots_.clear();
  deferred_ = 0;  // those that do not count yet have to be found again
  driven_ = 0.0;
  frames_to_wait_ = 0;
  next_wait_ = 1;
  next.submaps = map_->submap_count();
  next.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  closing_ = next;
  if (next.join.refused > 0)
    say("closing: %zu of %zu known landmarks contradict the map and were left out", next.join.refused,
        next.join.refused + next.join.fused);
  return fixed;
}

template <class Pose>
void Filter<Pose>::close_submap() {
  if (map_ == nullptr)
    throw Error(ErrorCode::state, "filter: it keeps a single map; create it with submap_landmarks to have submaps");
  if (counting() == 0) throw Error(ErrorCode::state, "filter: the open submap holds no landmark; nothing to close");
  join_submap(ClosedBy::caller);
}

// A closing that fails leaves the submap open; the update before it stands. Later frames try again, after ever more of
// them.
template <class Pose>
void Filter<Pose>::close_if_full() {
  if (map_ == nullptr) return;
  const ClosedBy reason = full();
  if (reason == ClosedBy::none) return;
  if (frames_to_wait_ > 0) {
    --frames_to_wait_;
    return;
  }
  ClosingReport failed;
  failed.failed = true;
  failed.submaps = map_->submap_count();
  failed.reason = reason;
  failed.landmarks = counting();
  try {
    join_submap(reason);
    return;
  } catch (const Error& error) {
    failed.error = error.code();
    say("closing: put off: %s", error.what());
  } catch (const std::bad_alloc&) {
    failed.no_memory = true;
    say("closing: put off: memory could not be had");
  }
  closing_ = failed;
  frames_to_wait_ = next_wait_;
  next_wait_ = std::min<std::size_t>(2 * next_wait_, 64);
}

// A fix speaks of the map, and the open submap knows nothing of where it lies there: it is closed, so that the pose is
// the base of the next one, and the map's to improve.
template <class Pose>
void Filter<Pose>::update_map_by_fix(const AbsoluteFix<Pose>& fix) {
  const bool moved = ekf_.size() > 0 || driven_ > 0.0 || !ekf_.pose_covariance().isZero(0.0) ||
                     !ekf_.pose().rotation().matrix().isIdentity(0.0);
  Match& match = next_matches_[0];
  match.landmark = kNoId;
  match.threshold = single_threshold(fix.rows());
  const FixReport done = moved ? join_submap(ClosedBy::fix, &fix, match.threshold) : map_->fix(fix, match.threshold);
  match.distance = done.distance;
  if (done.accepted) {
    match.decision = Decision::matched;
    next_report_.rows = fix.rows();
    next_report_.iterations = done.iterations;
    next_report_.nis = done.distance;
  } else {
    match.reason = Reason::gate;
    say("update: the gate refused a fix, distance %g over %g", match.distance, match.threshold);
  }
  finish_report(1);
}

// Base and open submap share nothing.
template <class Pose>
typename Filter<Pose>::Square Filter<Pose>::pose_covariance() const {
  if (map_ == nullptr) return ekf_.pose_covariance();
  return ProductJacobians(map_->base(), ekf_.pose()).covariance(map_->base_covariance(), ekf_.pose_covariance());
}

template <class Pose>
void Filter<Pose>::pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const {
  const std::size_t size = kDof + kDim * count;
  const auto n = static_cast<Eigen::Index>(size), landmarks = static_cast<Eigen::Index>(kDim * count);
  Eigen::MatrixXd joint(n, n);
  if (map_ == nullptr) {
    const std::vector<Index> slots = slots_of(indices, count);
    ekf_.gather_ordinary(slots.data(), static_cast<Index>(count), joint.data(), n);
  } else {
    map_->base_joint_covariance(indices, count, joint.data());
    const ProductJacobians J(map_->base(), ekf_.pose());
    const Eigen::MatrixXd across = joint.bottomLeftCorner(landmarks, kDof) * J.by_a.transpose();
    joint.topLeftCorner<kDof, kDof>() = J.covariance(joint.topLeftCorner<kDof, kDof>(), ekf_.pose_covariance());
    joint.bottomLeftCorner(landmarks, kDof) = across;
    joint.topRightCorner(kDof, landmarks) = across.transpose();
  }
  with_pose<Pose>(joint.data(), count, matrix);
}

template <class Pose>
double Filter<Pose>::pose_nees(const Pose& truth) const {
  if (map_ == nullptr) return ekf_.pose_nees(truth);
  return Ekf<Pose>::nees(options_.error, options_.initial_pose.translation(), truth, pose(), pose_covariance());
}

}  // namespace cairn
