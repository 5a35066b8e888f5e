// SPDX-License-Identifier: BSD-3-Clause
// Updates that are accepted or refused as a whole.
#include "slam/whole_batch.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "ekf/fix_rows.hpp"

namespace cairn {
namespace {

// S of a fix of a vehicle at `pose` with this covariance.
template <class Pose>
Matrix3 innovation_of(const AbsoluteFix<Pose>& fix, const Pose& pose, const typename Pose::Square& covariance) {
  const Index rows = fix.rows();
  const auto J = fix.jacobian(pose);
  Matrix3 S = fix.covariance();
  S.topLeftCorner(rows, rows) += J.topRows(rows) * covariance * J.topRows(rows).transpose();
  return S;
}

}  // namespace

template <class Pose>
WholeBatchUpdate<Pose>::WholeBatchUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                                         SubmapKeeper<Pose>& submaps, const Thresholds& thresholds,
                                         MotionTrust<Pose>& trust, FrameReport& report, HealthMonitor<Pose>& health,
                                         const Log& log)
    : options_(options),
      map_(map),
      submaps_(submaps),
      thresholds_(thresholds),
      trust_(trust),
      trust_in_map_(arena, options, map, thresholds, log),
      report_(report),
      health_(health),
      log_(log),
      ids_(arena, static_cast<std::size_t>(options.max_observations)),
      window_(arena.take<Index>(static_cast<std::size_t>(options.max_observations))) {}

template <class Pose>
template <class Fill>
void WholeBatchUpdate<Pose>::test(EkfUpdate<Pose>& update, Index rows, std::uint64_t landmark, Fill&& fill) {
  update.linearise(fill);
  Match& match = report_.match(0);
  match.landmark = landmark;
  match.threshold = thresholds_.single(rows);
  update.factor();
  match.distance = update.nis();
}

template <class Pose>
template <class Fill>
void WholeBatchUpdate<Pose>::finish(EkfUpdate<Pose>& update, int iterations, Fill&& fill) {
  Match& match = report_.match(0);
  if (accepted()) {
    report_.update().nis = update.nis();
    report_.update().iterations = update.iterate({iterations, options_.iteration_tolerance, false}, fill);
    update.commit();
    report_.update().rows = update.batch().rows();
    match.decision = Decision::matched;
  } else {
    match.reason = Reason::gate;
    log_.say("update: the gate refused a batch of %td rows, distance %g over %g", update.batch().rows(), match.distance,
             match.threshold);
  }
  finish_report(update.batch().rows());
}

template <class Pose>
void WholeBatchUpdate<Pose>::finish_report(Index rows) {
  const Match& match = report_.match(0);
  const double distance = match.distance;
  const bool refused = match.decision != Decision::matched;
  report_.finish();
  if (report_.last().widened()) health_.widened(report_.last().widened_position);
  health_.fixed(rows, distance, refused);
}

// Whether the motion has to be widened because of this fix.
template <class Pose>
bool WholeBatchUpdate<Pose>::contradicted(MotionTrust<Pose>& trust, Index rows, const Statement& fix, bool accepted,
                                          Widening<Pose>& widening) {
  trust.hear_nobody();
  trust.hear(static_cast<int>(rows), kNoId - ++fixes_, fix.pose, fix.residual.data(), fix.J, fix.S.data(), 3);
  return trust.contradicted(accepted, widening);
}

template <class Pose>
void WholeBatchUpdate<Pose>::fix(const AbsoluteFix<Pose>& given) {
  report_.start(1);
  const auto vehicle = submaps_.vehicle();
  const std::optional<AbsoluteFix<Pose>> fix = given.usable(vehicle.pose, vehicle.covariance);
  if (!fix) {
    report_.match(0).reason = Reason::no_image;
    log_.say("update: no heading, because the body's x axis may be vertical");
    return report_.finish();
  }
  if (submaps_.map() == nullptr || submaps_.takes(*fix)) return fix_state(*fix, vehicle.covariance);
  return fix_map(*fix);
}

// Whether landmarks of the map that the open submap has observed since the last fix speak for the place of both,
// against a fix that was refused.
template <class Pose>
bool WholeBatchUpdate<Pose>::landmarks_support() {
  const std::uint64_t before = std::exchange(observed_again_, submaps_.observed_again());
  return observed_again_ > before && !accepted() && submaps_.agrees_with_map();
}

// A fix of the state's pose: that of the vehicle with a single map, and in the open submap beside others. `covariance`:
// of the vehicle in the map.
template <class Pose>
void WholeBatchUpdate<Pose>::fix_state(const AbsoluteFix<Pose>& fix, const Square& covariance) {
  State<Pose>& state = map_.state();
  const bool in_submap = submaps_.map() != nullptr;
  trust_.begin(map_.starts());
  PendingRestore<Pose> restore(state);
  std::optional<EkfUpdate<Pose>> update;
  const auto fill = [&](double* residual_only) {
    return in_submap ? submaps_.fill_fix(*update, fix, residual_only) : fill_fix(*update, fix, residual_only);
  };
  const auto attempt = [&] {
    update.emplace(state, typename State<Pose>::Window());
    test(*update, fix.rows(), kNoId, fill);
  };
  attempt();
  if (in_submap && landmarks_support()) trust_.agree();
  Widening<Pose> widening;
  const Pose base = in_submap ? submaps_.base() : Pose(), T = base * state.pose();
  const Statement statement{state.pose(), fix.residual(T), fix.jacobian(T) * Pose::turn_axes(base.rotation()),
                            innovation_of(fix, T, covariance)};
  if (contradicted(trust_, fix.rows(), statement, accepted(), widening)) {
    widen(state, widening.covariance);
    report_.widened<Pose>(widening.covariance);
    attempt();
  }
  finish(*update, options_.iterations, fill);
  if (in_submap && matched()) submaps_.note_fix();
  restore.release();
  trust_.commit();
}

// The submap closes at the first fix. If the fix contradicts the map and several fixes agree on another pose, the
// motion in the new submap, which is empty, is widened, and the fix is tried again.
template <class Pose>
FixReport WholeBatchUpdate<Pose>::try_fix(const AbsoluteFix<Pose>& fix) {
  const double threshold = report_.match(0).threshold;
  trust_in_map_.begin(0);
  const FixReport first = submaps_.fix(fix, threshold);
  const JoinReport& join = submaps_.closing().join;
  const bool supported = join.fused > 0 && join.fused > join.refused;  // by the landmarks of the closing
  if (supported) trust_in_map_.agree();
  Widening<Pose> widening;
  const auto vehicle = submaps_.vehicle();
  const Statement statement{vehicle.pose, fix.residual(vehicle.pose), fix.jacobian(vehicle.pose),
                            innovation_of(fix, vehicle.pose, vehicle.covariance)};
  const bool wider = contradicted(trust_in_map_, fix.rows(), statement, first.accepted, widening);
  if (!wider || first.accepted) {  // an accepted fix has been used: a second time would count it twice
    trust_in_map_.commit();
    return first;
  }
  const Square turn = Pose::turn_axes(submaps_.map()->base().rotation().inverse());  // to the axes of the submap
  PendingRestore<Pose> restore(map_.state());
  try {
    widen(map_.state(), Square(turn * widening.covariance * turn.transpose()));
    const FixReport second = submaps_.fix(fix, threshold);
    restore.release();
    trust_in_map_.commit();
    report_.widened<Pose>(widening.covariance);
    return second;
  } catch (const std::exception&) {  // the submap has closed already: the fix stays refused
    return first;
  }
}

template <class Pose>
void WholeBatchUpdate<Pose>::fix_map(const AbsoluteFix<Pose>& fix) {
  Match& match = report_.match(0);
  match.landmark = kNoId;
  match.threshold = thresholds_.single(fix.rows());
  const FixReport done = try_fix(fix);
  match.distance = done.distance;
  if (done.accepted) {
    match.decision = Decision::matched;
    report_.update().rows = fix.rows();
    report_.update().iterations = done.iterations;
    report_.update().nis = done.distance;
  } else {
    match.reason = Reason::gate;
    log_.say("update: the gate refused a fix, distance %g over %g", match.distance, match.threshold);
  }
  finish_report(fix.rows());
}

template <class Pose>
void WholeBatchUpdate<Pose>::find_window(const LinearRows& rows) {
  ids_.clear();
  for (Index k = 0; k < rows.count; ++k) {
    const std::uint64_t id = rows.landmarks[k];
    if (ids_.find(id) != IdTable::kAbsent)
      throw Error(ErrorCode::argument, "landmarks: %llu comes twice", static_cast<unsigned long long>(id));
    ids_.set(id, static_cast<std::int32_t>(k));
    const std::optional<Index> slot = map_.table().find(id);
    if (!slot)
      throw Error(ErrorCode::not_found, "landmarks: the map has no landmark %llu", static_cast<unsigned long long>(id));
    window_[k] = *slot;
  }
}

template <class Pose>
void WholeBatchUpdate<Pose>::rows(const LinearRows& linear) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  report_.start(1);
  find_window(linear);
  EkfUpdate<Pose> update = map_.state().begin({window_, linear.count, nullptr});
  const Index rows = linear.rows;
  const auto fill = [&](double*) {
    update.batch().clear();
    const Index row = update.batch().add_rows(rows);
    std::copy_n(linear.residual, rows, update.batch().residual());
    std::copy_n(linear.covariance, rows * rows, update.batch().add_noise(row, rows));
    const auto J_pose = [&](Index r, Index c) {
      return linear.J_pose != nullptr ? linear.J_pose[r * 6 + Embedding<Pose>::axis(c)] : 0.0;
    };
    const auto pose = update.add_pose_block(row, rows, J_pose, false);
    if (linear.count == 0) return true;
    const Eigen::Map<const RowMajor> J(linear.J_landmarks, rows, 3 * linear.count);
    for (Index k = 0; k < linear.count; ++k)
      update.add_landmark_block(row, rows, J.template middleCols<kDim>(3 * k), k, pose);
    return true;
  };
  test(update, rows, linear.count > 0 ? linear.landmarks[0] : kNoId, fill);
  finish(update, 1, fill);
  if (matched())
    for (Index k = 0; k < linear.count; ++k) map_.table().add_observations(window_[k], 1);
}

// l_id - l_other = 0: an observation of both landmarks, exact but for a variance that keeps S positive definite.
template <class Pose>
void WholeBatchUpdate<Pose>::merge(std::uint64_t id, std::uint64_t other) {
  using PointSquare = Eigen::Matrix<double, kDim, kDim>;
  constexpr double kExact = 1e-6;  // fraction of the smaller variance
  if (id == other) throw Error(ErrorCode::argument, "id: a landmark cannot be merged with itself");
  if (options_.max_observations < 2)
    throw Error(ErrorCode::capacity, "id: merging looks at two landmarks at once, and max_observations is 1");
  const Index keep = map_.slot_at(id), gone = map_.slot_at(other);
  report_.start(1);
  window_[0] = keep;
  window_[1] = gone;
  State<Pose>& state = map_.state();
  const double variance =
      std::min(state.landmark_covariance(keep).trace(), state.landmark_covariance(gone).trace()) / kDim;
  const typename Pose::Point apart = state.landmark(gone) - state.landmark(keep);
  EkfUpdate<Pose> update = state.begin({window_, 2, nullptr});
  const auto fill = [&](double*) {
    update.batch().clear();
    const Index row = update.batch().add_rows(kDim);
    std::copy_n(apart.data(), kDim, update.batch().residual());
    Eigen::Map<PointSquare>(update.batch().add_noise(row, kDim)) = kExact * variance * PointSquare::Identity();
    const Eigen::Matrix<double, kDim, kDof> J_pose = Eigen::Matrix<double, kDim, kDof>::Zero();
    const auto pose = update.add_pose_block(row, kDim, J_pose, false);
    const PointSquare one = PointSquare::Identity(), minus = -PointSquare::Identity();
    update.add_landmark_block(row, kDim, one, 0, pose);
    update.add_landmark_block(row, kDim, minus, 1, pose);
    return true;
  };
  test(update, kDim, id, fill);
  finish(update, 1, fill);
  if (!matched()) return;
  map_.table().add_observations(keep, map_.table().observations(gone));
  map_.forget(gone);
}

template class WholeBatchUpdate<SE2>;
template class WholeBatchUpdate<SE3>;

}  // namespace cairn
