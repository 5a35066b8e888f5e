// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/dense/dense_transaction.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "ekf/fix_rows.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

// The update that fuses the submap's known landmarks. Their estimates are observations from the submap's base:
// y = R_S^T (l - p_S), with one full noise block, their covariance in the submap. This is eq. 30 of the Mars paper with
// the rotation that its constant Jacobian leaves out. It is a batch for gate_blocks(). A landmark that the gates remove
// leaves the window as well, and the batch is filled again, because the noise block spans all rows.
template <class Pose>
class DenseTransaction<Pose>::FusingUpdate {
 public:
  FusingUpdate(State<Pose>& state, const Submap<Pose>& submap, const GivenErrors& given, std::vector<Pair>& pairs)
      : state_(state), submap_(submap), noise_(given.covariance), K_(given.K), pairs_(pairs) {
    refill();
  }

  Index count() const { return static_cast<Index>(pairs_.size()); }
  double distance(Index block) { return update_->distance(block, kDim); }
  void keep(const Index* blocks, Index count) {
    for (Index k = 0; k < count; ++k) pairs_[k] = pairs_[blocks[k]];
    pairs_.resize(static_cast<std::size_t>(count));
    refill();
  }
  template <class Bound>
  bool consistent(Bound&& bound) {
    update_->factor();
    return count() == 0 || update_->nis() <= bound(kDim * count());  // a batch without rows has no bound
  }
  InverseInnovation invert() { return update_->invert(); }
  void refactor() { update_->factor(); }
  Index* kept() { return update_->kept(); }
  bool* refused() { return update_->refused(); }

  double nis() const { return update_->nis(); }
  int iterate_and_commit(const Iterations& end) {
    const int iterations = update_->iterate(end, [&](double* residual_only) { return fill(residual_only); });
    update_->commit();
    return iterations;
  }

 private:
  void refill() {
    std::vector<Index> slots;
    for (const Pair& pair : pairs_) slots.push_back(pair.slot);
    update_.emplace(state_, typename State<Pose>::Window{slots.data(), static_cast<Index>(slots.size()), nullptr});
    update_->linearise([&](double* residual_only) { return fill(residual_only); });
  }

  bool fill(double* residual_only) {
    Batch& batch = update_->batch();
    const Pose T = update_->pose();
    const Index systematic = K_.cols() - (submap_.base ? kDof : 0);
    if (residual_only == nullptr) batch.clear();
    for (std::size_t a = 0; a < pairs_.size(); ++a) {
      const Point l = update_->landmark(static_cast<Index>(a));
      Point residual = submap_.landmarks[pairs_[a].local] - T.inverse() * l;
      const auto by_errors = K_.middleRows<kDim>(kDof + kDim * pairs_[a].local);
      for (Index i = 0; i < systematic; ++i)
        residual += by_errors.col(i) * (update_->systematic(i) - submap_.errors.value(i));
      if (submap_.base)
        residual += by_errors.template rightCols<kDof>() *
                    (pose_error(T, *submap_.base) - submap_.errors.value.template tail<kDof>());
      double* target = residual_only != nullptr ? residual_only : batch.residual();
      std::copy_n(residual.data(), kDim, target + kDim * a);
      if (residual_only != nullptr) continue;
      Prediction<Pose> prediction;
      map_jacobians(T, l, Prediction<Pose>::ByLandmark::Identity(), prediction);
      if (submap_.base)
        prediction.J_z_pose.template topRows<kDim>() -=
            by_errors.template rightCols<kDof>() * pose_error_jacobian(T, *submap_.base);
      const Index row = batch.add_rows(kDim);
      const auto pose = update_->add_pose_block(row, kDim, prediction.J_z_pose, !submap_.base);
      if (systematic > 0)
        update_->add_systematic_block(row, kDim, Eigen::MatrixXd(-by_errors.leftCols(systematic)), 0, systematic);
      update_->add_landmark_block(row, kDim, prediction.J_z_landmark, static_cast<Index>(a), pose);
    }
    if (residual_only != nullptr) return true;
    const std::size_t rows = kDim * pairs_.size();
    double* block = batch.add_noise(0, static_cast<Index>(rows));
    for (std::size_t c = 0; c < rows; ++c)
      for (std::size_t r = 0; r < rows; ++r)
        block[c * rows + r] = noise_(kDof + kDim * pairs_[r / kDim].local + static_cast<Eigen::Index>(r % kDim),
                                     kDof + kDim * pairs_[c / kDim].local + static_cast<Eigen::Index>(c % kDim));
    return true;
  }

  State<Pose>& state_;
  const Submap<Pose>& submap_;
  const Eigen::MatrixXd& noise_;
  const Eigen::MatrixXd& K_;  // the landmarks' estimates by the systematic errors
  std::vector<Pair>& pairs_;
  std::optional<EkfUpdate<Pose>> update_;
};

template <class Pose>
DenseTransaction<Pose>::~DenseTransaction() {
  if (backup_) map_.state_.restore(*backup_);
}

template <class Pose>
GivenErrors DenseTransaction<Pose>::split_errors(const Submap<Pose>& submap) const {
  GivenErrors given;
  if (submap.errors.count() > 0)
    given = given_errors(submap.covariance, submap.errors);
  else
    given = {Eigen::MatrixXd(submap.covariance.rows(), 0), submap.covariance};
  std::vector<Eigen::Index> known;
  for (const Pair& pair : pairs_) known.push_back(pair.local);
  to_ordinary(submap, known, given.covariance);
  rows_to_ordinary(submap, known, given.K);
  return given;
}

// The map learns what the submap found out about the systematic errors and its base.
template <class Pose>
void DenseTransaction<Pose>::learn_errors(const Submap<Pose>& submap) {
  const ErrorRows found = found_out(submap.errors);
  const Index rows = found.rows.rows(), g = submap.errors.count() - (submap.base ? kDof : 0);
  if (rows == 0) return;
  EkfUpdate<Pose> update = map_.state_.begin({});
  update.linearise([&](double* residual_only) {
    Eigen::VectorXd residual = found.values;
    for (Index i = 0; i < g; ++i) residual -= found.rows.col(i) * update.systematic(i);
    const Pose T = update.pose();
    if (submap.base) residual -= found.rows.rightCols<kDof>() * pose_error(T, *submap.base);
    std::copy_n(residual.data(), rows, residual_only != nullptr ? residual_only : update.batch().residual());
    if (residual_only != nullptr) return true;
    update.batch().clear();
    const Index row = update.batch().add_rows(rows);
    if (submap.base) {
      const Eigen::MatrixXd by_base = found.rows.rightCols<kDof>() * pose_error_jacobian(T, *submap.base);
      update.add_pose_block(row, rows, by_base, false);
    }
    if (g > 0) update.add_systematic_block(row, rows, found.rows, 0, g);
    double* noise = update.batch().add_noise(row, rows);
    for (Index c = 0; c < rows; ++c)
      for (Index r = 0; r < rows; ++r) noise[c * rows + r] = r == c ? 1.0 : 0.0;
    return true;
  });
  update.factor();
  update.solve();
  update.commit();
}

// The error of the rest of the submap (end pose, what the systematic errors walked, new landmarks) is K y + w, with the
// error y of the systematic errors, the base and the fused landmarks.
template <class Pose>
typename State<Pose>::Handover DenseTransaction<Pose>::split_rest(const Submap<Pose>& submap,
                                                                  const GivenErrors& given) const {
  const Eigen::MatrixXd& joint = given.covariance;
  std::vector<Eigen::Index> fused, rest;
  for (Eigen::Index d = 0; d < kDof; ++d) rest.push_back(d);
  for (Eigen::Index d = submap.covariance.rows(); d < joint.rows(); ++d) rest.push_back(d);
  for (const Pair& pair : pairs_) fused.push_back(pair.local);
  const std::vector<Eigen::Index> of_fused = point_rows<Pose>(fused, kDof), of_fresh = point_rows<Pose>(fresh_, kDof);
  rest.insert(rest.end(), of_fresh.begin(), of_fresh.end());
  typename State<Pose>::Handover handover;
  handover.T_base_end = submap.T_base_end;
  const Eigen::MatrixXd cross = joint(of_fused, rest);
  handover.K = pairs_.empty() ? Eigen::MatrixXd(rest.size(), 0)
                              : Eigen::MatrixXd(joint(of_fused, of_fused).ldlt().solve(cross).transpose());
  handover.W = joint(rest, rest);
  handover.W -= handover.K * cross;
  if (submap.errors.count() > 0) {
    Eigen::MatrixXd K(handover.K.rows(), given.K.cols() + handover.K.cols());
    K.leftCols(given.K.cols()) = given.K(rest, Eigen::all) - handover.K * given.K(of_fused, Eigen::all);
    K.rightCols(handover.K.cols()) = handover.K;
    handover.K.swap(K);
    handover.by_base = submap.base.has_value();
    handover.walking = map_.options_.errors.walking.data();
    handover.walking_count = submap.errors.walked.size();
    handover.walked = submap.errors.walked;
  }
  if (!handover.K.allFinite() || !handover.W.allFinite()) throw_not_definite();
  return handover;
}

// Corrects the rest of the submap by the correction of its known landmarks in the fusion, and composes it with the map.
template <class Pose>
void DenseTransaction<Pose>::hand_over(const Submap<Pose>& submap, typename State<Pose>::Handover& handover,
                                       const Eigen::VectorXd& shift) {
  const Eigen::VectorXd error = handover.K * shift;
  if (submap.base) {
    auto by_base = handover.K.middleCols(submap.errors.count() - kDof, kDof);
    by_base = (by_base * pose_error_jacobian(map_.base(), *submap.base)).eval();
  }
  const typename Rotation::Tangent turn = error.segment<kTurn>(kDim);
  const Rotation R = Rotation::exp(turn);
  const typename Rotation::Matrix V = Rotation::translation_jacobian(turn);
  const bool invariant = submap.error == ErrorKind::invariant;
  const auto move_point = [&](const Point& x, const Point& e) -> Point {
    return invariant ? ErrorModel<Pose>::move_point(R, V, x, e) : Point(x + e);
  };
  handover.T_base_end =
      Pose(R * submap.T_base_end.rotation(), move_point(submap.T_base_end.translation(), error.head<kDim>()));
  std::vector<Index> slots;
  for (const Pair& pair : pairs_) slots.push_back(pair.slot);
  std::vector<Point> landmarks;
  handover.walked += error.segment(kDof, handover.walking_count);
  const Index first = kDof + handover.walking_count;
  for (std::size_t a = 0; a < fresh_.size(); ++a)
    landmarks.push_back(
        move_point(submap.landmarks[fresh_[a]], error.segment<kDim>(first + kDim * static_cast<Eigen::Index>(a))));
  handover.fused = slots.data();
  handover.fused_count = static_cast<Index>(slots.size());
  handover.fresh = landmarks.data();
  handover.fresh_count = static_cast<Index>(landmarks.size());
  map_.state_.compose(handover);
}

// Landmarks of the map that turn out to be wrong go at the commit. Those of the submap that take their ids are new ones
// until then, if there is room for both.
template <class Pose>
void DenseTransaction<Pose>::give_way(const Submap<Pose>& submap, const std::vector<Fusing>& fusing) {
  for (std::size_t i = 0; i < fusing.size(); ++i) {
    if (fusing[i] != Fusing::supersede && fusing[i] != Fusing::remove_both) continue;
    if (fusing[i] == Fusing::supersede) {
      if (map_.size() + fresh_.size() >= map_.options_.max_landmarks) continue;
      fresh_.push_back(static_cast<Eigen::Index>(i));
    }
    wrong_.push_back(static_cast<std::size_t>(map_.indices_.find(submap.ids[i])));
  }
  std::sort(wrong_.begin(), wrong_.end());
}

template <class Pose>
JoinReport DenseTransaction<Pose>::join(const Submap<Pose>& submap) {
  State<Pose>& state = map_.state_;
  const MapOptions<Pose>& options = map_.options_;
  for (Eigen::Index i = 0; i < submap.size(); ++i) {
    std::size_t index = 0;
    if (map_.find(submap.ids[i], index))
      pairs_.push_back({i, map_.slot_of(index)});
    else
      fresh_.push_back(i);
  }
  report_.fresh = fresh_.size();
  if (map_.size() + fresh_.size() > options.max_landmarks)
    throw Error(ErrorCode::capacity, "submap: %zu new landmarks, and the map holds %zu of max_landmarks = %zu",
                fresh_.size(), map_.size(), options.max_landmarks);
  const std::size_t known = pairs_.size();
  const GivenErrors given = split_errors(submap);
  const Index errors = submap.errors.count(), systematic = errors - (submap.base ? kDof : 0);
  if (errors > 0) {
    backup_.emplace(state.backup());
    learn_errors(submap);
  }
  std::optional<FusingUpdate> fusing;
  if (known > 0) {
    fusing.emplace(state, submap, given, pairs_);
    const auto bound = [&](Index rows) {
      return chi_square_quantile(static_cast<double>(rows), options.joint_gate_probability);
    };
    Contradictions contradictions(kDim);
    gate_blocks(*fusing, kDim, chi_square_quantile(kDim, options.gate_probability), bound,
                [&](Gate gate, Index block, double distance, double most) {
                  contradictions.add(gate, pairs_[static_cast<std::size_t>(block)].local, distance, most);
                });
    report_.worst_refused = contradictions.worst();
    const auto in_map = [&](Index i) {
      return map_.counts_[map_.indices_.find(submap.ids[static_cast<std::size_t>(i)])];
    };
    give_way(submap, contradictions.decide(static_cast<Index>(known), in_map, submap.counts));
    report_.rows = kDim * pairs_.size();
    report_.distance = fusing->nis();
    report_.threshold = report_.rows > 0 ? bound(static_cast<Index>(report_.rows)) : 0.0;
  }
  report_.fused = pairs_.size();
  report_.refused = known - pairs_.size();

  // A landmark that takes the id of another one has become a new one: its error is the filter's own again.
  typename State<Pose>::Handover handover = split_rest(submap, wrong_.empty() ? given : split_errors(submap));
  for (std::size_t i = 0; i < map_.size(); ++i) before_.push_back(state.landmark(map_.slot_of(i)));
  for (const Eigen::Index i : fresh_) {
    fresh_ids_.push_back(submap.ids[i]);
    fresh_counts_.push_back(submap.counts[i]);
  }
  for (const Pair& pair : pairs_) pair_counts_.push_back(submap.counts[pair.local]);
  closed_.emplace(typename DenseMap<Pose>::Closed{map_.base(), submap.ids});
  if (map_.closed_.size() == map_.closed_.capacity()) map_.closed_.reserve(2 * map_.closed_.size() + 8);

  // The composition allocates again: if there is no memory, the updates are taken back.
  if (!backup_) backup_.emplace(state.backup());
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(errors + static_cast<Eigen::Index>(kDim * pairs_.size()));
  if (!pairs_.empty()) {
    report_.iterations = fusing->iterate_and_commit({options.iterations, options.iteration_tolerance, !submap.base});
    const Pose T_base_map = state.pose().inverse();
    for (std::size_t a = 0; a < pairs_.size(); ++a)
      shift.segment<kDim>(errors + kDim * static_cast<Eigen::Index>(a)) =
          T_base_map * state.landmark(pairs_[a].slot) - submap.landmarks[pairs_[a].local];
  }
  for (Index i = 0; i < systematic; ++i) shift(i) = state.systematic(i) - submap.errors.value(i);
  if (submap.base) {
    const Eigen::VectorXd missed = pose_error(state.pose(), *submap.base) - submap.errors.value.template tail<kDof>();
    shift.segment<kDof>(systematic) = missed;
  }
  hand_over(submap, handover, shift);
  return report_;
}

template <class Pose>
FixReport DenseTransaction<Pose>::fix(const AbsoluteFix<Pose>& fix, double threshold) {
  FixReport report;
  if (!backup_) backup_.emplace(map_.state_.backup());
  EkfUpdate<Pose> update = map_.state_.begin({});
  const auto fill = [&](double* residual_only) { return fill_fix(update, fix, residual_only); };
  update.linearise(fill);
  update.factor();
  report.distance = update.nis();
  report.accepted = report.distance <= threshold;
  if (!report.accepted) return report;
  report.iterations = update.iterate({map_.options_.iterations, map_.options_.iteration_tolerance, false}, fill);
  update.commit();
  return report;
}

template <class Pose>
JoinReport DenseTransaction<Pose>::commit() {
  const State<Pose>& state = map_.state_;
  backup_.reset();
  if (!closed_) return report_;  // only a fix
  for (const std::size_t index : wrong_) map_.indices_.erase(map_.ids_[index]);
  for (std::size_t a = 0; a < fresh_.size(); ++a)
    map_.append(fresh_ids_[a], fresh_counts_[a], map_.size() - fresh_.size() + a);
  for (std::size_t a = 0; a < pairs_.size(); ++a) map_.counts_[pairs_[a].slot - state.companions()] += pair_counts_[a];
  double sum = 0.0;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const double way = (state.landmark(map_.slot_of(i)) - before_[i]).squaredNorm();
    report_.moved_max = std::max(report_.moved_max, std::sqrt(way));
    sum += way;
  }
  if (!before_.empty()) report_.moved_rms = std::sqrt(sum / static_cast<double>(before_.size()));
  for (auto index = wrong_.rbegin(); index != wrong_.rend(); ++index) map_.remove_at(*index);
  map_.closed_.push_back(std::move(*closed_));
  return report_;
}

template class DenseTransaction<SE2>;
template class DenseTransaction<SE3>;

}  // namespace cairn
