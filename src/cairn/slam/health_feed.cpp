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
  const typename Pose::Rotation::Matrix R = before_.rotation().matrix();
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
    sighted.J_z_y.noalias() = candidate.prediction.J_z_landmark.lazyProduct(R);
    sighted.y = R.transpose() * (map_.state().landmark(candidate.slot) - before_.translation());
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
  after_ = map_.state().pose();
  // The update took off the difference of two covariances of the same error. Therefore the one before the update is
  // carried to the new position: the invariant error is about the position.
  typename Pose::Square covariance_before = covariance_before_;
  const Point moved = after_.translation() - before_.translation();
  map_.state().model().to_ordinary(
      0, [&moved](Index) { return moved; }, covariance_before.data(), Pose::kDof);
  health_.correct(before_, covariance_before, after_, map_.state().pose_covariance());
  health_.finish(report_.last().nis, report_.last().rows);
  if (frame.sensor.may_abort()) return;  // the update has been committed: a callback must not be asked any more
  turn_after_ = after_.rotation().matrix();
  Index next = 0;
  for (Index i = 0; i < frame.landmarks; ++i)
    remember(frame, i, next < count_ && seen_[next].observation == i ? &seen_[next++].sighted : nullptr);
}

// The place of an observed landmark in the body frame: as the filter estimates it after the update, or, if the
// observation was refused, as the observation itself says. `sighted`: of the same observation, or null.
template <class Pose>
void HealthFeed<Pose>::remember(const Frame<Pose>& frame, Index observation, const Sighted<Pose>* sighted) {
  // If the update moves the point y by less than this part of its distance, the Jacobians from before it still hold:
  // the second order is 1e-5 of a value. They save a call of the sensor.
  constexpr double kSlightMove = 0.005;
  using PointSquare = typename SightingMemory<Pose>::PointSquare;
  using ByLandmark = typename Prediction<Pose>::ByLandmark;
  const Match& match = report_.matches()[observation];
  const std::optional<Index> slot = match.landmark == kNoId ? std::nullopt : map_.table().find(match.landmark);
  if (!slot || match.reason == Reason::ambiguous) return;
  const bool refused = match.decision == Decision::rejected;
  Point landmark = map_.state().landmark(*slot);
  Placement<Pose> placement;
  if (refused) {
    if (!frame.sensor.place(after_, frame.z(observation), MountError<Pose>::Zero(), placement)) return;
    landmark = placement.landmark;
  }
  const Matrix& R = turn_after_;
  Left<Pose> left;
  ByLandmark J_z_y;
  left.y = R.transpose() * (landmark - after_.translation());
  if (sighted != nullptr && !refused && frame.sensor.relative() &&
      (left.y - sighted->y).squaredNorm() < kSlightMove * kSlightMove * sighted->y.squaredNorm()) {
    J_z_y = sighted->J_z_y;
    left.noise = sighted->noise;
    left.residual = sighted->innovation - J_z_y * (left.y - sighted->y);
  } else {
    Prediction<Pose> prediction;
    if (!frame.sensor.predict(after_, landmark, MountError<Pose>::Zero(), prediction)) return;
    J_z_y.noalias() = prediction.J_z_landmark.lazyProduct(R);
    left.noise = stated_noise(frame, observation, prediction);
    left.residual = frame.sensor.residual(frame.z(observation), prediction.z);
  }
  const PointSquare P = refused ? placement.J_landmark_z * left.noise * placement.J_landmark_z.transpose()
                                : map_.state().relative_covariance(*slot);
  const PointSquare turned = R.transpose().lazyProduct(P);
  left.P.noalias() = turned.lazyProduct(R);
  const ByLandmark by_P = J_z_y.lazyProduct(left.P);
  left.noise.noalias() -= by_P.lazyProduct(J_z_y.transpose());
  health_.remember(match.landmark, left);
}

template class HealthFeed<SE2>;
template class HealthFeed<SE3>;

}  // namespace cairn
