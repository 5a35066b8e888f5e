// SPDX-License-Identifier: BSD-3-Clause
// Takes another sparse map of space in: its submaps are appended, moved by where its frame lies, and all are solved for
// together.
//
// The map's submaps are one chain of bases, submap j leading from base j to base j + 1. Another chain is hung on by a
// bridge, a submap without landmarks that leads from the last base of the one to the first of the other and knows
// nothing. Where the transform between the frames is known beforehand, a second bridge tells it: from a base that is
// fixed at the map's origin to the other's first one.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "map/join/sparse/sparse_undo.hpp"

namespace cairn {
namespace {

// What a bridge that knows nothing says of its far end: a million metres, ten thousand turns.
constexpr double kNothingPosition = 1e12, kNothingTurn = 1e8;
// A base that stands at the origin, as what is known exactly (see prior_information()).
constexpr double kExactPosition = 1e-12, kExactTurn = 1e-14;
constexpr int kRounds = 20;

Submap<SE3> link_to(const SE3& T_base_end, const Matrix6& covariance) {
  Submap<SE3> link;
  link.error = ErrorKind::standard;
  link.T_base_end = T_base_end;
  link.covariance = covariance;
  return link;
}

Matrix6 diagonal(double position, double turn) {
  Vector6 variances;
  variances << Vector3::Constant(position), Vector3::Constant(turn);
  return variances.asDiagonal();
}

}  // namespace

// Appends a submap without landmarks; whoever calls evaluates it.
template <>
SparseMap<SE3>::Number SparseMap<SE3>::bridge(const Submap<SE3>& link, Undo& undo) {
  const auto number = static_cast<Number>(leaves_.size());
  Leaf leaf;
  leaf.data = std::make_shared<const Data>(link);
  leaf.saved = undo.change;
  leaf.key = key_of(number);
  bases_.push_back(bases_[number] * link.T_base_end);
  base_saved_.push_back(undo.change);
  leaves_.push_back(std::move(leaf));
  return number;
}

// Whether a bridge ends at a base that is fixed: parts of the map may hang together by that alone.
template <>
bool SparseMap<SE3>::anchored() const {
  for (const auto& [base, fixes] : fixes_) {
    const Data& before = *leaves_[base - 1].data;
    if (before.ids.empty() && before.covariance(0, 0) == kNothingPosition) return true;
  }
  return false;
}

template <>
void SparseMap<SE3>::append(const SparseMap& other, const MergePlan& plan, const MergeOptions& options,
                            MergeReport& report) {
  if (other.anchored())
    throw Error(ErrorCode::state,
                "other: it was merged by has_transform, which ties its parts to its own frame; merge the map into it");
  Undo undo(*this, ++change_);
  JoinReport joined;
  const SE3& T = plan.alignment.T_a_b;
  double before = cost();
  for (const Leaf& leaf : other.leaves_) before += leaf.factor->evaluate(other.values(leaf)).cost;

  // The chain.
  const SE3 first = T * other.bases_[0];
  const auto first_leaf = static_cast<Number>(leaves_.size());
  if (options.prior) {
    bridge(link_to(bases_.back().inverse(), diagonal(kNothingPosition, kNothingTurn)), undo);
    std::vector<AbsoluteFix<SE3>>& fixes = fixes_[static_cast<Number>(leaves_.size())];
    fixes.push_back(AbsoluteFix<SE3>::position(Vector3::Zero(), kExactPosition * Matrix3::Identity(), Vector3::Zero()));
    fixes.push_back(AbsoluteFix<SE3>::attitude(SO3(), kExactTurn * Matrix3::Identity()));
    bases_.back() = SE3();
    // The other's start pose in the map's frame: e_p = e_pT + G(R_T p) e_RT + R_T e_p0, e_R = e_RT + R_T e_R0.
    const SE3& T_known = options.prior->T_a_b;
    Matrix6 by_T = Matrix6::Identity(), turn = Matrix6::Zero();
    by_T.topRightCorner<3, 3>() = SO3::turn(T_known.rotation() * other.prior_.translation());
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_known.rotation().matrix();
    const Matrix6 covariance =
        by_T * options.prior->covariance * by_T.transpose() + turn * other.prior_covariance_ * turn.transpose();
    bridge(link_to(T_known * other.prior_, 0.5 * (covariance + covariance.transpose())), undo);
    before += 0.5 * pose_error(other.bases_[0], other.prior_)
                        .dot(other.prior_information() * pose_error(other.bases_[0], other.prior_));
  } else {
    bridge(link_to(bases_.back().inverse() * first, diagonal(kNothingPosition, kNothingTurn)), undo);
  }
  bases_.back() = first;
  const auto offset = static_cast<Number>(leaves_.size());
  for (std::size_t j = 1; j < other.bases_.size(); ++j) {
    bases_.push_back(T * other.bases_[j]);
    base_saved_.push_back(undo.change);
  }

  // The landmarks. One that was removed from the other still ties its submaps together; nobody sees it.
  std::vector<Number> here(other.landmarks_.size());
  std::vector<Number> reshaped;
  TreeChanges changes;
  for (Number l = 0; l < other.landmarks_.size(); ++l) {
    const Landmark& from = other.landmarks_[l];
    const auto known = from.slot != kNone ? ids_.find(plan.ids[from.slot]) : ids_.end();
    if (known != ids_.end()) {
      here[l] = known->second;
      save_landmark(undo, here[l]);
      const Landmark& to = landmarks_[here[l]];
      if (to.submaps.size() == 1)
        reshaped.push_back(to.submaps[0]);
      else
        changes.variables.emplace_back(landmark_variable(here[l]), leaves_[to.submaps[0]].key);
    } else {
      here[l] = static_cast<Number>(landmarks_.size());
      landmarks_.push_back({0, 0, T * from.position, {}, kNone, undo.change});
      if (from.slot != kNone) {
        Landmark& to = landmarks_.back();
        to.id = plan.ids[from.slot];
        to.slot = static_cast<Number>(visible_.size());
        visible_.push_back(here[l]);
        ids_.emplace(to.id, here[l]);
        index_.add(to.slot);
      }
    }
    Landmark& to = landmarks_[here[l]];
    to.count += from.count;
    for (const Number leaf : from.submaps) to.submaps.push_back(leaf + offset);
    if (to.submaps.size() > 1)
      tree_.set_degree(landmark_variable(here[l]), static_cast<std::int32_t>(to.submaps.size()));
  }

  // The submaps.
  for (const Leaf& from : other.leaves_) {
    const auto number = static_cast<Number>(leaves_.size());
    Leaf leaf;
    leaf.data = from.data;
    leaf.saved = undo.change;
    leaf.key = key_of(number);
    for (const Number l : from.landmarks) leaf.landmarks.push_back(l == kNone ? kNone : here[l]);
    leaves_.push_back(std::move(leaf));
  }
  std::sort(reshaped.begin(), reshaped.end());
  reshaped.erase(std::unique(reshaped.begin(), reshaped.end()), reshaped.end());
  for (const Number old : reshaped) save_leaf(undo, old);
  std::vector<Number> dirty = reshaped;
  for (Number leaf = first_leaf; leaf < leaves_.size(); ++leaf) {
    dirty.push_back(leaf);
    tree_.set_degree(base_variable(leaf + 1), 2);
  }
  for (const Number leaf : dirty) {
    shape(leaves_[leaf], leaf);
    evaluate(leaf);
    changes.leaves.push_back(leaves_[leaf].key);
  }
  length_scale_ = std::min(length_scale_, other.length_scale_);
  turn_scale_ = std::min(turn_scale_, other.turn_scale_);
  refactor(std::move(changes), undo, joined);
  optimise(undo, joined);
  for (int round = 1; round < kRounds && !settled_; ++round) optimise(undo, joined);

  // To first order the cost grows by half of what the two estimates of the common landmarks have against each other.
  report.distance = std::max(0.0, 2.0 * (cost() - before));
  report.rows = 3 * plan.pairs.size() - (options.prior ? 0 : 6);
  report.threshold = chi_square_quantile(static_cast<double>(report.rows), options.joint_gate_probability);
  if (!(report.distance <= report.threshold)) find_worst(offset, report, other, plan);
  finish(undo, joined);
}

// The common landmark that the other's submaps pull at hardest, judged from below: the covariance of the difference of
// its two estimates, given all other states, is the sum of the inverses of what either map's submaps know of it.
template <>
void SparseMap<SE3>::find_worst(Number offset, MergeReport& report, const SparseMap& other,
                                const MergePlan& plan) const {
  double most = -1.0;
  std::pair<std::size_t, std::size_t> worst = plan.pairs[0];
  for (const auto& pair : plan.pairs) {
    const Number landmark = visible_[pair.first];
    Matrix3 information[2] = {Matrix3::Zero(), Matrix3::Zero()};
    Vector3 force = Vector3::Zero();
    for (const Number number : landmarks_[landmark].submaps) {
      const Leaf& leaf = leaves_[number];
      for (Index i = 0; i < leaf.factor->shared_count(); ++i) {
        if (leaf.landmarks[leaf.factor->shared()[i]] != landmark) continue;
        information[number >= offset] += leaf.factor->landmark_information(i, bases_[number].rotation());
        if (number >= offset) force += force_on(leaf, i);
      }
    }
    const double distance = force.dot((information[0].inverse() + information[1].inverse()) * force);
    if (distance > most) most = distance, worst = pair;
  }
  throw_contradiction(id(worst.first), other.id(worst.second), report);
}

}  // namespace cairn
