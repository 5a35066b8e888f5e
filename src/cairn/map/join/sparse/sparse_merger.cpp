// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_merger.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "map/join/sparse/sparse_solver.hpp"

namespace cairn {
namespace {

// Variances of the far end of a bridge without information: a million metres, ten thousand turns.
constexpr double kNothingPosition = 1e12, kNothingTurn = 1e8;
// Variances of a base at the origin: the same as for every exactly known value (SparseAnchors::prior_information()).
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

// The data of the other map's submap: fixes are in its own frame.
std::shared_ptr<const SubmapData<SE3>> here(const SparseState<SE3>::Leaf& leaf) {
  return leaf.fixed() ? std::make_shared<const SubmapData<SE3>>(leaf.data->without_base()) : leaf.data;
}

// Whether a bridge ends at a base that is fixed: the bridge may be the only connection between parts of the map.
bool anchored(const SparseState<SE3>& state) {
  for (const auto& [leaf, fixes] : state.solution.anchors.fixes()) {
    const SubmapData<SE3>& before = *state.leaves[leaf].data;  // places have no fixes
    if (before.ids.empty() && before.covariance(0, 0) == kNothingPosition) return true;
  }
  return false;
}

}  // namespace

SparseMerger::SparseMerger(State& state, SpatialIndex& index, const State& other, const MergePlan& plan,
                           const MergeOptions& options)
    : state_(state),
      other_(other),
      plan_(plan),
      options_(options),
      change_(state, index),
      bases_(other.bases.size(), State::kNone),
      leaves_(other.leaves.size(), State::kNone) {}

void SparseMerger::append(MergeReport& report) {
  if (anchored(other_))
    throw Error(ErrorCode::state,
                "other: it was merged by has_transform, which fixes its parts in its own frame; merge the map into it");
  double before = state_.cost();
  for (const State::Leaf& leaf : other_.leaves) {
    if (leaf.place != nullptr) before += leaf.place->evaluate(other_.place_values(leaf)).cost;
    if (leaf.factor == nullptr) continue;
    const State::Factor factor = leaf.fixed() ? State::Factor(here(leaf), leaf.factor->shared()) : *leaf.factor;
    before += factor.evaluate(other_.values(leaf, factor)).cost;
  }
  before += append_bases();
  append_leaves();
  append_landmarks();
  fill_leaves();
  solve();
  // To first order the cost grows by half of the squared distance between the two estimates of the common landmarks.
  report.distance = std::max(0.0, 2.0 * (state_.cost() - before));
  report.rows = 3 * plan_.pairs.size() - (options_.prior ? 0 : 6);
  report.threshold = chi_square_quantile(static_cast<double>(report.rows), options_.joint_gate_probability);
  if (!(report.distance <= report.threshold)) throw_worst(report);
  JoinReport joined;
  change_.prepare(joined);
  change_.keep();
}

// Appends the bridges, then the other map's bases. Returns the cost of the other map's first base against its prior.
double SparseMerger::append_bases() {
  const SE3& T = plan_.alignment.T_a_b;
  const SE3 first = T * other_.bases[0].pose;
  double cost = 0.0;
  if (options_.prior) {
    const Number leaf = bridge(state_.newest_base().inverse(), diagonal(kNothingPosition, kNothingTurn));
    SparseAnchors<SE3>& anchors = state_.solution.anchors;
    anchors.add(leaf,
                AbsoluteFix<SE3>::position(Vector3::Zero(), kExactPosition * Matrix3::Identity(), Vector3::Zero()));
    anchors.add(leaf, AbsoluteFix<SE3>::attitude(SO3(), kExactTurn * Matrix3::Identity()));
    state_.bases[state_.solution.newest].pose = SE3();
    // The other map's start pose in the map's frame: e_p = e_pT + G(R_T p) e_RT + R_T e_p0, e_R = e_RT + R_T e_R0.
    const SE3& T_known = options_.prior->T_a_b;
    const SE3& prior = other_.solution.anchors.prior();
    Matrix6 by_T = Matrix6::Identity(), turn = Matrix6::Zero();
    by_T.topRightCorner<3, 3>() = SO3::turn(T_known.rotation() * prior.translation());
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_known.rotation().matrix();
    const Matrix6 covariance = by_T * options_.prior->covariance * by_T.transpose() +
                               turn * other_.solution.anchors.prior_covariance() * turn.transpose();
    bridge(T_known * prior, 0.5 * (covariance + covariance.transpose()));
    const SE3::Tangent e = pose_error(other_.bases[0].pose, prior);
    cost = 0.5 * e.dot(other_.solution.anchors.prior_information() * e);
  } else {
    bridge(state_.newest_base().inverse() * first, diagonal(kNothingPosition, kNothingTurn));
  }
  state_.bases[state_.solution.newest].pose = first;
  bases_[0] = state_.solution.newest;
  for (std::size_t j = 1; j < other_.bases.size(); ++j)
    if (other_.bases[j].held() > 0) bases_[j] = change_.add_base(T * other_.bases[j].pose);
  state_.solution.newest = bases_[other_.solution.newest];
  return cost;
}

// Appends a submap without landmarks; fill_leaves() evaluates it.
SparseMerger::Number SparseMerger::bridge(const SE3& T_base_end, const Matrix6& covariance) {
  const Number from = state_.solution.newest, to = change_.add_base(state_.newest_base() * T_base_end);
  fresh_.push_back(change_.add_leaf({from, to}));
  state_.leaves[fresh_.back()].data =
      std::make_shared<const SubmapData<SE3>>(link_to(T_base_end, covariance), state_.error_points);
  state_.solution.newest = to;
  return fresh_.back();
}

// In the order of the submaps: one that was fused lies in a place that is named by an older one.
void SparseMerger::append_leaves() {
  for (Number submap = 0; submap < other_.submaps.size(); ++submap) {
    const State::Closed& closed = other_.submaps[submap];
    const State::Leaf& from = other_.leaves[closed.leaf];
    if (from.submap != submap) {
      state_.submaps.push_back({leaves_[closed.leaf], closed.T_leaf_submap});
      continue;
    }
    std::vector<Number> poses;
    for (const Number pose : from.poses) poses.push_back(bases_[pose]);
    const Number leaf = change_.add_leaf(std::move(poses));
    state_.leaves[leaf].data = here(from);
    state_.leaves[leaf].place = from.place;
    leaves_[closed.leaf] = leaf;
    fresh_.push_back(leaf);
  }
}

// A landmark that was removed from the other map still connects its submaps, but callers do not see it.
void SparseMerger::append_landmarks() {
  const SE3& T = plan_.alignment.T_a_b;
  here_.resize(other_.landmarks.size());
  for (Number l = 0; l < other_.landmarks.size(); ++l) {
    const State::Landmark& from = other_.landmarks[l];
    if (from.submaps.empty()) continue;
    const auto known = from.slot != State::kNone ? state_.ids.find(plan_.ids[from.slot]) : state_.ids.end();
    if (known != state_.ids.end()) {
      here_[l] = known->second;
      change_.note_held_again(here_[l], reshaped_, changes_);
      std::uint64_t count = from.count;
      for (const Number leaf : from.submaps) change_.extend(here_[l], leaves_[leaf], std::exchange(count, 0));
    } else {
      here_[l] = change_.add_landmark(T * from.position);
      if (from.slot != State::kNone) change_.show_landmark(here_[l], plan_.ids[from.slot]);
      State::Landmark& to = state_.landmarks[here_[l]];
      to.count = from.count;
      for (const Number leaf : from.submaps) to.submaps.push_back(leaves_[leaf]);
    }
    const std::size_t held = state_.landmarks[here_[l]].submaps.size();
    state_.solution.tree.set_degree(landmark_variable(here_[l]), static_cast<std::int32_t>(held));
  }
}

void SparseMerger::fill_leaves() {
  for (Number number = 0; number < other_.leaves.size(); ++number)
    for (const Number l : other_.leaves[number].landmarks)
      state_.leaves[leaves_[number]].landmarks.push_back(l == State::kNone ? State::kNone : here_[l]);
  std::sort(reshaped_.begin(), reshaped_.end());
  reshaped_.erase(std::unique(reshaped_.begin(), reshaped_.end()), reshaped_.end());
  for (const Number old : reshaped_) change_.save_leaf(old);
  EliminationTree<SE3>& tree = state_.solution.tree;
  const Number newest = state_.solution.newest;
  tree.set_last(base_variable(newest));
  std::vector<Number> dirty = reshaped_;
  for (const Number leaf : fresh_) {
    dirty.push_back(leaf);
    for (const Number base : state_.leaves[leaf].poses)
      tree.set_degree(base_variable(base), base == newest ? 2 : state_.bases[base].held());
  }
  for (const Number leaf : dirty) {
    state_.shape(state_.leaves[leaf]);
    state_.evaluate(leaf);
    changes_.leaves.push_back(state_.leaves[leaf].key);
  }
}

void SparseMerger::solve() {
  State::Solution& solution = state_.solution;
  solution.length_scale = std::min(solution.length_scale, other_.solution.length_scale);
  solution.turn_scale = std::min(solution.turn_scale, other_.solution.turn_scale);
  SparseSolver<SE3> solver(state_, change_);
  JoinReport unused;
  solver.refactor(std::move(changes_), unused);
  solver.optimise(unused);
  for (int round = 1; round < kRounds && !solution.settled; ++round) solver.optimise(unused);
}

// Names the common landmark with the largest lower bound of the squared distance between its two estimates: the
// covariance of their difference, given all other states, is the sum of the inverses of the landmark's information in
// the submaps of either map.
void SparseMerger::throw_worst(MergeReport& report) const {
  double most = -1.0;
  std::vector<bool> of_other(state_.leaves.size(), false);
  for (const Number leaf : fresh_) of_other[leaf] = true;
  std::pair<std::size_t, std::size_t> worst = plan_.pairs[0];
  for (const auto& pair : plan_.pairs) {
    const Number landmark = state_.visible[pair.first];
    Matrix3 information[2] = {Matrix3::Zero(), Matrix3::Zero()};
    Vector3 force = Vector3::Zero();
    for (const Number number : state_.landmarks[landmark].submaps) {
      const State::Leaf& leaf = state_.leaves[number];
      for (Index i = 0; i < leaf.shared_count(); ++i) {
        if (leaf.shared(i) != landmark) continue;
        information[of_other[number]] += state_.landmark_information(leaf, i);
        if (of_other[number]) force += state_.force_on(leaf, i);
      }
    }
    const double distance = force.dot((information[0].inverse() + information[1].inverse()) * force);
    if (distance > most) most = distance, worst = pair;
  }
  const auto id = [](const State& state, std::size_t index) { return state.landmarks[state.visible[index]].id; };
  throw_contradiction(id(state_, worst.first), id(other_, worst.second), report);
}

}  // namespace cairn
