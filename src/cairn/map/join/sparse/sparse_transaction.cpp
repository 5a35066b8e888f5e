// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/sparse_transaction.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "map/join/sparse/sparse_fuser.hpp"
#include "map/join/sparse/sparse_solver.hpp"

namespace cairn {

template <class Pose>
SparseTransaction<Pose>::SparseTransaction(SparseState<Pose>& state, SpatialIndex& index)
    : state_(state), index_(index), change_(std::in_place, state, index) {}

template <class Pose>
JoinReport SparseTransaction<Pose>::join(const Submap<Pose>& submap) {
  solved_ = true;
  const Number leaf = try_join(submap, std::vector<Fusing>(submap.ids.size(), Fusing::fuse));
  if (report_.rows == 0 || !may_contradict(state_, leaf, report_)) return report_;
  // Some landmark does not fit: the exact gates, which cost more, find out which.
  change_.reset();
  const Contradicting contradicting = find_contradicting(state_, submap);
  report_ = JoinReport();
  report_.worst_refused = contradicting.worst;
  change_.emplace(state_, index_);
  try_join(submap, contradicting.fusing);
  return report_;
}

// Adds the submap and solves; the report tells how well the fused landmarks agree.
template <class Pose>
typename SparseTransaction<Pose>::Number SparseTransaction<Pose>::try_join(const Submap<Pose>& submap,
                                                                           const std::vector<Fusing>& fusing) {
  const Number leaf = append(submap, fusing);
  SparseSolver<Pose> solver(state_, *change_);
  solver.optimise(report_);
  report_.rows = kDim * report_.fused;
  if (report_.rows == 0) return leaf;
  // To first order the cost grows by half of the squared distance between the fused landmarks' two estimates, and
  // between those of the systematic errors.
  report_.rows += static_cast<std::size_t>(state_.leaves[leaf].data->errors.found.values.size());
  report_.threshold = chi_square_quantile(static_cast<double>(report_.rows), state_.options.joint_gate_probability);
  report_.distance = 2.0 * change_->cost_growth();
  if (report_.distance > report_.threshold && !state_.solution.settled) {  // perhaps not accurate yet
    solver.optimise(report_);
    report_.distance = 2.0 * change_->cost_growth();
  }
  return leaf;
}

// Appends the submap, its end and its new landmarks, and makes the affected part of the factor anew.
template <class Pose>
typename SparseTransaction<Pose>::Number SparseTransaction<Pose>::append(const Submap<Pose>& submap,
                                                                         const std::vector<Fusing>& fusing) {
  const Pose base = state_.newest_base();
  const Number from = state_.solution.newest, to = change_->add_base(base * submap.T_base_end);
  const Number number = change_->add_leaf({from, to});
  state_.leaves[number].data = std::make_shared<const SubmapData<Pose>>(submap, state_.error_points);
  hold_errors(number);
  TreeChanges changes;
  std::vector<Number> reshaped;
  add_landmarks(submap, fusing, number, base, changes, reshaped);
  if (state_.visible.size() > state_.options.max_landmarks)
    throw Error(ErrorCode::capacity, "submap: %zu new landmarks, and the map holds %zu of max_landmarks = %zu",
                report_.fresh, change_->old_visible(), state_.options.max_landmarks);
  state_.shape(state_.leaves[number]);
  set_scales(submap, *state_.leaves[number].data);
  state_.evaluate(number);
  std::sort(reshaped.begin(), reshaped.end());
  reshaped.erase(std::unique(reshaped.begin(), reshaped.end()), reshaped.end());
  for (const Number old : reshaped) {
    change_->save_leaf(old);
    state_.shape(state_.leaves[old]);
    state_.evaluate(old);
    changes.leaves.push_back(state_.leaves[old].key);
  }
  // The newest base counts as held by the submap that will begin there, so that it is eliminated last.
  EliminationTree<Pose>& tree = state_.solution.tree;
  tree.set_degree(base_variable(from), state_.bases[from].held());
  tree.set_degree(base_variable(to), 2);
  tree.set_last(base_variable(to));
  state_.solution.newest = to;
  if (state_.options.fuse && state_.error_points.count() == 0) state_.solution.recent.push_back(number);
  state_.solution.largest = std::max(state_.solution.largest, submap.ids.size());
  for (const Number point : state_.leaves[number].errors) set_error_degree(point);
  changes.leaves.push_back(state_.leaves[number].key);
  SparseSolver<Pose>(state_, *change_).refactor(std::move(changes), report_);
  return number;
}

// `changes` and `reshaped` get what changes with landmarks that the map knows.
template <class Pose>
void SparseTransaction<Pose>::add_landmarks(const Submap<Pose>& submap, const std::vector<Fusing>& fusing, Number leaf,
                                            const Pose& base, TreeChanges& changes, std::vector<Number>& reshaped) {
  const auto add = [&](std::size_t i) {
    const Number landmark = change_->add_landmark(base * submap.landmarks[i]);
    state_.landmarks[landmark].count = submap.counts[i];
    state_.landmarks[landmark].submaps = {leaf};
    return landmark;
  };
  std::vector<Number>& held = state_.leaves[leaf].landmarks;
  for (std::size_t i = 0; i < submap.ids.size(); ++i) {
    const auto known = state_.ids.find(submap.ids[i]);
    if (known != state_.ids.end() && fusing[i] != Fusing::fuse) {
      ++report_.refused;
      held.push_back(State::kNone);
      if (fusing[i] == Fusing::remove_both) change_->hide_landmark(known->second);
      if (fusing[i] != Fusing::supersede) continue;
      const Number landmark = add(i);
      change_->supersede_landmark(known->second, landmark);
      held.back() = landmark;
      continue;
    }
    if (known == state_.ids.end()) {
      const Number landmark = add(i);
      change_->show_landmark(landmark, submap.ids[i]);
      held.push_back(landmark);
      ++report_.fresh;
      continue;
    }
    const Number landmark = known->second;
    change_->note_held_again(landmark, reshaped, changes);
    change_->extend(landmark, leaf, submap.counts[i]);
    held.push_back(landmark);
    ++report_.fused;
    state_.solution.tree.set_degree(landmark_variable(landmark),
                                    static_cast<std::int32_t>(state_.landmarks[landmark].submaps.size()));
  }
}

// The points of systematic errors that the leaf holds, and those of the errors that walk at its end.
template <class Pose>
void SparseTransaction<Pose>::hold_errors(Number number) {
  const ErrorPoints<Pose>& points = state_.error_points;
  if (points.count() == 0) return;
  typename State::Leaf& leaf = state_.leaves[number];
  const Index first = kDim * points.constant();
  Eigen::VectorXd end = state_.error_values(state_.errors_at(leaf.poses[0])).tail(points.size() - first);
  for (Index w = 0; w < leaf.data->errors.walked.size(); ++w)
    end(points.at(points.walkers()[static_cast<std::size_t>(w)]) - first) += leaf.data->errors.walked(w);
  change_->add_errors(end);
  leaf.errors = state_.errors_at(leaf.poses[0]);
  const std::vector<Number> at_end = state_.errors_at(leaf.poses[1]);
  leaf.errors.insert(leaf.errors.end(), at_end.begin() + points.constant(), at_end.end());
  for (std::size_t i = 0; i < leaf.errors.size(); ++i) change_->extend(leaf.errors[i], number, 0);
}

// Errors that do not walk are held by all submaps: they are eliminated last. Those at a base are held as the base is.
template <class Pose>
void SparseTransaction<Pose>::set_error_degree(Number point) {
  const std::vector<Number>& constant = state_.constant_errors;
  const std::vector<Number>& walking = state_.walking_errors;
  std::int32_t degree = 2;
  if (std::find(constant.begin(), constant.end(), point) != constant.end()) {
    degree = std::numeric_limits<std::int32_t>::max();
  } else if (std::find(walking.begin(), walking.begin() + state_.error_points.walking(), point) !=
             walking.begin() + state_.error_points.walking()) {
    degree = 1;  // at the first base
  }
  state_.solution.tree.set_degree(landmark_variable(point), degree);
}

template <class Pose>
void SparseTransaction<Pose>::set_scales(const Submap<Pose>& submap, const SubmapData<Pose>& data) {
  std::vector<double> sigmas;
  double extent = 1.0;
  for (Index i = 0; i < submap.size(); ++i) {
    const PointSquare P = submap.covariance.template block<kDim, kDim>(kDof + kDim * i, kDof + kDim * i);
    sigmas.push_back(std::sqrt(P.trace()));
    extent = std::max(extent, submap.landmarks[i].norm());
  }
  if (sigmas.empty()) sigmas.push_back(std::sqrt(submap.covariance.template topLeftCorner<kDim, kDim>().trace()));
  const auto median = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), median, sigmas.end());
  if (!(*median > 0.0)) return;
  typename State::Solution& solution = state_.solution;
  solution.length_scale = std::min(solution.length_scale, *median);
  solution.turn_scale = std::min(solution.turn_scale, *median / extent);
  // The motion of a systematic error that moves a landmark or the end by the typical standard deviation.
  const Eigen::MatrixXd& K = data.errors.K;
  double reach = 0.0;
  for (Index row = 0; K.cols() > 0 && row < kDof + kDim * submap.size(); row += row == 0 ? kDof : kDim)
    reach = std::max(reach, K.middleRows<kDim>(row).norm());
  if (reach > 0.0) solution.error_scale = std::min(solution.error_scale, *median / reach);
}

template <class Pose>
FixReport SparseTransaction<Pose>::fix(const AbsoluteFix<Pose>& fix, double threshold) {
  if (solved_) state_.refresh_base_covariance();  // the fix is tested against the base after the join
  FixReport report;
  const int rows = fix.rows();
  const Pose T = state_.newest_base();
  if (!fix.defined(T)) return report;
  const Eigen::MatrixXd J = fix.jacobian(T).topRows(rows);
  const Eigen::VectorXd r = fix.residual(T).head(rows);
  const Eigen::MatrixXd S =
      J * state_.solution.base_covariance * J.transpose() + fix.covariance().topLeftCorner(rows, rows);
  report.distance = r.dot(S.ldlt().solve(r));
  report.accepted = report.distance <= threshold;
  if (!report.accepted) return report;
  const Number leaf = state_.bases[state_.solution.newest].leaves[0];
  if (leaf == State::kNone) {
    fix_prior(r, J, S, fix.covariance().topLeftCorner(rows, rows));
    report.iterations = 1;
    return report;
  }
  solved_ = true;
  JoinReport joined;
  change_->save_leaf(leaf);
  state_.solution.anchors.add(leaf, fix);
  state_.evaluate(leaf);
  TreeChanges changes;
  changes.leaves.push_back(state_.leaves[leaf].key);
  SparseSolver<Pose> solver(state_, *change_);
  solver.refactor(std::move(changes), joined);
  solver.optimise(joined);
  report.iterations = joined.iterations;
  return report;
}

// Without a submap there is only the prior: one linearisation. Joseph's form keeps the digits of a precise fix of a
// start that is hardly known.
template <class Pose>
void SparseTransaction<Pose>::fix_prior(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, const Eigen::MatrixXd& S,
                                        const Eigen::MatrixXd& R) {
  using Square = typename Pose::Square;
  change_->save_base(0);
  Square& P = state_.solution.base_covariance;
  const Eigen::MatrixXd PJ = P * J.transpose();
  const typename Pose::Tangent e = PJ * S.ldlt().solve(r);
  const Eigen::MatrixXd K = S.ldlt().solve(PJ.transpose()).transpose();
  const Square A = Square::Identity() - K * J;
  const Square lower = A * P * A.transpose() + K * R * K.transpose();
  Pose& base = state_.bases[0].pose;
  base = retract(base, e);
  P = lower.template selfadjointView<Eigen::Lower>();
  state_.solution.anchors.set_prior(base, P);
}

// Submaps are fused in a change of their own. What the map knows does not depend on it: where it is impossible, the
// submaps stay as they are.
template <class Pose>
JoinReport SparseTransaction<Pose>::commit() {
  if (solved_) change_->prepare(report_);
  try {
    if (solved_) SparseFuser<Pose>(state_, index_).run();
  } catch (const Error&) {
    state_.solution.recent.clear();
    state_.solution.grown.clear();
  }
  change_->keep();
  return report_;
}

template class SparseTransaction<SE2>;
template class SparseTransaction<SE3>;

}  // namespace cairn
