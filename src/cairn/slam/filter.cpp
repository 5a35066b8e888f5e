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
      submaps_(options_, local_, log_),
      frames_(arena, options_, local_, thresholds_, report_, log_),
      batches_(arena, options_, local_, submaps_, thresholds_, report_, log_) {
  if (arena.measuring()) return;
  if (options.single_map())
    local_.start(options.initial_pose, options.initial_covariance);
  else
    local_.start(Pose(), Square::Zero());
  submaps_.make_map();
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
void Filter<Pose>::propagate(const Increment<Pose>& increment) {
  constexpr double kTurnSquared = 39.478417604357432;  // (2 pi)^2
  if (!(increment.covariance.diagonal().template tail<kTurn>().maxCoeff() <= kTurnSquared))
    throw Error(ErrorCode::numerical,
                "prediction: the attitude's noise of this step exceeds a whole turn; nothing was changed");
  constexpr double kFarthestStep = 1e9;  // m
  const Point& step = increment.T_before_after.translation();
  if (!(step.cwiseAbs().maxCoeff() <= kFarthestStep))
    throw Error(ErrorCode::numerical, "prediction: this step is longer than %g m; nothing was changed", kFarthestStep);
  if (!(increment.covariance.diagonal().template head<kDim>().maxCoeff() <= kFarthestStep * kFarthestStep))
    throw Error(ErrorCode::numerical, "prediction: the position's noise of this step exceeds %g m; nothing was changed",
                kFarthestStep);
  if (!local_.state().propagate(increment))
    throw Error(ErrorCode::numerical,
                "prediction: the pose or its covariance would not be finite; nothing was changed");
  submaps_.drive(increment.T_before_after.translation().norm());
}

template <class Pose>
void Filter<Pose>::update(int sensor, const Observation* observations, Index landmarks, Index companions) {
  log_.watch([&] {
    const Sensor<Pose>& own = sensors_.at(sensor);
    frames_.run({own, sensors_.view(sensor), observations, landmarks, companions});
  });
  submaps_.close_if_full();
}

template <class Pose>
void Filter<Pose>::split_landmark(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance) {
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
