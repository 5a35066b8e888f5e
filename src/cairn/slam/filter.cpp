// SPDX-License-Identifier: BSD-3-Clause
// Creation, motion and frames of one vehicle's filter.
#include "slam/filter.hpp"

#include "core/error.hpp"

namespace cairn {

template <class Pose>
Filter<Pose>::Filter(Arena& arena, const FilterOptions<Pose>& options)
    : options_(options),
      sensors_(arena, options_.max_sensors),
      local_(arena, options_),
      thresholds_(arena, {options.gate_probability, options.batch_gate_probability, options.new_probability},
                  kDim * options.max_observations + kDof),
      report_(arena, options_.max_observations),
      trajectory_(arena, options_.trajectory_poses),
      submaps_(options_, local_, trajectory_, log_),
      trust_(arena, options_, local_, thresholds_, log_),
      health_(arena, {options.max_sensors, options.max_observations, options.gate_probability, options.apply_noise}),
      frames_(arena, options_, local_, thresholds_, trust_, report_, health_, log_),
      batches_(arena, options_, local_, submaps_, thresholds_, trust_, report_, health_, log_) {
  if (!arena.measuring()) begin();
}

template <class Pose>
std::size_t Filter<Pose>::arena_bytes(const FilterOptions<Pose>& options) {
  Arena measure;
  const Filter unused(measure, options);
  return measure.used();
}

template <class Pose>
std::size_t Filter<Pose>::required_bytes(const FilterOptions<Pose>& options) {
  return arena_bytes(options) + SubmapKeeper<Pose>::required_bytes(options);
}

template <class Pose>
void Filter<Pose>::calibrate(int sensor, const Calibration<Pose>& sigma, const Calibration<Pose>& walk) {
  const int rows = sensors_.at(sensor).rows();
  const SystematicErrors& errors = local_.systematic();
  if (started_)
    throw Error(ErrorCode::state,
                "sensor: the filter has moved or observed something already; calibrate its sensors before that");
  if (errors.calibrates(sensor)) throw Error(ErrorCode::state, "sensor: number %d has a calibration already", sensor);
  Index count = 0, used = 0;
  for (int i = 0; i < kCalibrationErrors<Pose>; ++i) {
    if (!(sigma[i] > 0.0)) continue;
    ++count;
    if (i >= kDof + rows)
      throw Error(ErrorCode::argument, "calibration.offset_sigma[%d] is %g, but the sensor gives %d values", i - kDof,
                  sigma[i], rows);
  }
  for (Index i = 0; i < errors.count(); ++i) used += errors.sensor(i) != SystematicErrors::kMotion ? 1 : 0;
  if (used + count > options_.max_sensor_errors)
    throw Error(ErrorCode::capacity,
                "calibration: %td errors, and %td of max_sensor_errors = %td are taken; create the filter with more",
                count, used, options_.max_sensor_errors);
  const SystematicErrors before = errors;
  try {
    for (int i = 0; i < kCalibrationErrors<Pose>; ++i)
      if (sigma[i] > 0.0) local_.add_error(sensor, i, sigma[i], walk[i]);
    begin();
  } catch (...) {  // no memory: as before
    local_.use_errors(before);
    begin();
    throw;
  }
}

template <class Pose>
void Filter<Pose>::begin() {
  if (options_.single_map())
    local_.start(options_.initial_pose, options_.initial_covariance);
  else
    local_.start(Pose(), Square::Zero());
  submaps_.make_map();
}

template <class Pose>
void Filter<Pose>::predict_wheels(double dt, double left, double right) {
  if (!local_.systematic().any()) return move(drive_wheels<Pose>(wheels_, left, right, dt));
  move(drive_wheels<Pose>(wheels_, left, right, dt, local_.systematic().motion(local_.state())), dt);
}

template <class Pose>
void Filter<Pose>::predict_wheels_gyro(double dt, double left, double right, const Vector3& w) {
  move(drive_wheels_gyro<Pose>(wheels_, left, right, w, dt, twist_noise_, local_.systematic().motion(local_.state())),
       dt);
}

template <class Pose>
void Filter<Pose>::predict_twist(double dt, const Vector3& v, const Vector3& w) {
  if (!local_.systematic().any()) return move(integrate_twist<Pose>(v, w, dt, twist_noise_));
  move(integrate_twist<Pose>(v, w, dt, twist_noise_, local_.systematic().motion(local_.state())), dt);
}

template <class Pose>
void Filter<Pose>::propagate(const Increment<Pose>& increment) {
  if (local_.systematic().any_twist())
    throw Error(ErrorCode::state,
                "prediction: an increment has no duration, so that a velocity or rate bias cannot be taken out; use "
                "cairn_filter_predict_twist, or create the filter without these biases");
  move(increment);
}

template <class Pose>
void Filter<Pose>::move(const CorrectedStep<Pose>& step, double dt) {
  if (!local_.systematic().any()) return move(step.increment);
  const MotionCoupling<Pose> coupling = local_.systematic().coupling(step, dt);
  move(step.increment, &coupling);
}

template <class Pose>
void Filter<Pose>::move(const Increment<Pose>& increment, const MotionCoupling<Pose>* coupling) {
  constexpr double kTurnSquared = 39.478417604357432;  // (2 pi)^2
  if (!(increment.covariance.diagonal().template tail<kTurn>().maxCoeff() <= kTurnSquared))
    throw Error(ErrorCode::numerical,
                "prediction: the attitude's noise of this step exceeds a whole turn; nothing was changed");
  constexpr double kFarthestStep = 1e9;  // m
  const Point step = increment.T_before_after.translation();
  if (!(step.cwiseAbs().maxCoeff() <= kFarthestStep))
    throw Error(ErrorCode::numerical, "prediction: this step is longer than %g m; nothing was changed", kFarthestStep);
  if (!(increment.covariance.diagonal().template head<kDim>().maxCoeff() <= kFarthestStep * kFarthestStep))
    throw Error(ErrorCode::numerical, "prediction: the position's noise of this step exceeds %g m; nothing was changed",
                kFarthestStep);
  Increment<Pose> scaled = increment;
  scaled.covariance *= health_.applied_to_motion();
  if (!local_.state().propagate(scaled, coupling))
    throw Error(ErrorCode::numerical,
                "prediction: the pose or its covariance would not be finite; nothing was changed");
  health_.moved(increment);
  frames_.moved(scaled);
  started_ = true;
  submaps_.drive(increment.T_before_after.translation().norm());
}

template <class Pose>
void Filter<Pose>::update(int sensor, const Observation* observations, Index landmarks, Index companions) {
  started_ = true;
  log_.watch([&] {
    const Sensor<Pose>& own = sensors_.at(sensor);
    const SystematicErrors& errors = local_.systematic();
    Frame<Pose> frame{own,
                      sensors_.view(sensor),
                      sensors_.loss(sensor),
                      observations,
                      landmarks,
                      companions,
                      sensor,
                      health_.applied_to_sensor(sensor)};
    if (!errors.calibrates(sensor)) return frames_.run(frame);
    CalibratedSensor<Pose> calibrated(
        own, errors.calibration<Pose>(sensor, [&](Index i) { return local_.state().systematic(i); }));
    frames_.run(frame.with(calibrated));
  });
  submaps_.keep_pose();  // of the frame, before its submap is closed
  submaps_.close_if_full();
  note_closing();
}

template <class Pose>
void Filter<Pose>::update_fix(const AbsoluteFix<Pose>& fix) {
  started_ = true;
  log_.watch([&] { batches_.fix(fix); });
  submaps_.keep_pose();
  note_closing();
}

template <class Pose>
void Filter<Pose>::close_submap() {
  submaps_.close();
  note_closing();
}

// Tells the health monitor of the last closing, if there is a new one.
template <class Pose>
void Filter<Pose>::note_closing() {
  const ClosingReport& closing = submaps_.closing();
  if (closing.submaps == closings_) return;
  closings_ = closing.submaps;
  if (closing.widened()) health_.widened(closing.widened_position);
  health_.closed(closing.join.refused, closing.join.refused + closing.join.fused, closing.join.worst_refused);
}

template <class Pose>
void Filter<Pose>::look_from(std::uint64_t id) {
  if (id == local_.table().vehicle()) return;
  local_.look_from(id);
  health_.interrupt();
}

template <class Pose>
void Filter<Pose>::split_landmark(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance) {
  // Where the filter gives names, it counts on from the highest name: it must not come to the end of the numbers.
  constexpr std::uint64_t kCallersEnd = std::uint64_t{1} << 63;
  if (options_.association != AssociationKind::known && fresh >= kCallersEnd)
    throw Error(ErrorCode::argument,
                "fresh is %llu; a filter that names landmarks itself takes only numbers below 2^63 from its caller",
                static_cast<unsigned long long>(fresh));
  local_.split(id, fresh, covariance);
  frames_.reserve_id(fresh);
}

template <class Pose>
void Filter<Pose>::add_vehicle(std::uint64_t id, const Pose& pose, const Square& J_pose, const Square& noise) {
  if (submaps_.map() != nullptr)
    throw Error(ErrorCode::state, "vehicle: a filter with submaps holds no other vehicles");
  local_.add_vehicle(id, pose, J_pose, noise);
}

template <class Pose>
Pose Filter<Pose>::vehicle_pose(std::uint64_t id) const {
  if (id == local_.table().vehicle()) return pose();
  return local_.state().companion(local_.companion_at(id));
}

template <class Pose>
typename Filter<Pose>::Square Filter<Pose>::vehicle_covariance(std::uint64_t id) const {
  if (id == local_.table().vehicle()) return pose_covariance();
  return local_.state().companion_covariance(local_.companion_at(id));
}

template class Filter<SE2>;
template class Filter<SE3>;

}  // namespace cairn
