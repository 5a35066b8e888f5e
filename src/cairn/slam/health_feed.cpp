// SPDX-License-Identifier: BSD-3-Clause
// A frame before and after its update, for the health monitor.
#include "slam/health_feed.hpp"

namespace cairn {
namespace {

// The stated noise of an observation, without the factor that was learned for it.
template <class Pose>
Matrix3 stated_noise(const Frame<Pose>& frame, Index observation, const Prediction<Pose>& prediction) {
  Matrix3 noise = frame.stated_noise(observation);
  if (frame.sensor.mount_noise_mode() != MountNoise::none)
    noise += prediction.J_z_mount * frame.sensor.mount_noise() * prediction.J_z_mount.transpose();
  return noise;
}

}  // namespace

template <class Pose>
HealthFeed<Pose>::HealthFeed(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map,
                             const FrameReport& report, HealthMonitor<Pose>& health)
    : map_(map),
      report_(report),
      health_(health),
      seen_(arena.take<Seen>(static_cast<std::size_t>(options.max_observations))) {}

template <class Pose>
void HealthFeed<Pose>::before(const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) {
  count_ = 0;
  before_ = map_.state().pose();
  covariance_before_ = map_.state().pose_covariance();
  const auto R = before_.rotation().matrix();
  for (const Candidate<Pose>& candidate : sorted) {
    if (candidate.observation >= frame.landmarks) continue;  // another vehicle, which moves
    Seen& seen = seen_[count_++];
    seen.observation = candidate.observation;
    Sighted<Pose>& sighted = seen.sighted;
    sighted.landmark = map_.table().id(candidate.slot);
    sighted.sensor = &frame.sensor;
    sighted.z = frame.z(candidate.observation);
    sighted.innovation = frame.sensor.residual(frame.z(candidate.observation), candidate.prediction.z);
    sighted.noise = stated_noise(frame, candidate.observation, candidate.prediction);
    sighted.J_z_y = candidate.prediction.J_z_landmark * R;
    sighted.y = before_.rotation().inverse() * (map_.state().landmark(candidate.slot) - before_.translation());
  }
}

template <class Pose>
void HealthFeed<Pose>::after(const Frame<Pose>& frame) {
  if (report_.last().widened()) health_.widened(report_.last().widened_position);
  health_.start(frame.number, frame.sensor.rows(), frame.sensor.relative());
  for (Index i = 0; i < count_; ++i) {
    const Match& match = report_.matches()[seen_[i].observation];
    // The distance of a batch belongs to no single observation.
    const bool batch = match.reason == Reason::batch_gate;
    health_.compare(seen_[i].sighted, batch ? static_cast<double>(frame.sensor.rows()) : match.distance,
                    match.decision != Decision::matched);
  }
  health_.correct(before_, covariance_before_, map_.state().pose(), map_.state().pose_covariance());
  health_.finish(report_.last().nis, report_.last().rows);
  for (Index i = 0; i < frame.landmarks; ++i) remember(frame, i);
}

// The place of an observed landmark in the body frame: as the filter estimates it after the update, or, if the
// observation was refused, as the observation itself says.
template <class Pose>
void HealthFeed<Pose>::remember(const Frame<Pose>& frame, Index observation) {
  if (frame.sensor.may_abort()) return;  // the update has been committed: a callback must not be asked any more
  const Match& match = report_.matches()[observation];
  const std::optional<Index> slot = match.landmark == kNoId ? std::nullopt : map_.table().find(match.landmark);
  if (!slot || match.reason == Reason::ambiguous) return;
  const State<Pose>& state = map_.state();
  const Pose pose = state.pose();
  const typename Pose::Rotation::Matrix R = pose.rotation().matrix();
  const bool refused = match.decision == Decision::rejected;
  typename Pose::Point landmark = state.landmark(*slot);
  Placement<Pose> placement;
  if (refused) {
    if (!frame.sensor.place(pose, frame.z(observation), MountError<Pose>::Zero(), placement)) return;
    landmark = placement.landmark;
  }
  Prediction<Pose> prediction;
  if (!frame.sensor.predict(pose, landmark, MountError<Pose>::Zero(), prediction)) return;
  Left<Pose> left;
  left.residual = frame.sensor.residual(frame.z(observation), prediction.z);
  left.noise = stated_noise(frame, observation, prediction);
  left.y = pose.rotation().inverse() * (landmark - pose.translation());
  left.J_z_y = prediction.J_z_landmark * R;
  left.P = refused ? placement.J_landmark_z * left.noise * placement.J_landmark_z.transpose()
                   : state.relative_covariance(*slot);
  left.P = (R.transpose() * left.P * R).eval();
  health_.remember(match.landmark, left);
}

template class HealthFeed<SE2>;
template class HealthFeed<SE3>;

}  // namespace cairn
