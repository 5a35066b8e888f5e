// SPDX-License-Identifier: BSD-3-Clause
#include "health/health_monitor.hpp"

#include "health/semidefinite.hpp"

namespace cairn {
namespace {

constexpr double kSlowFrames = 300.0, kFastFrames = 20.0;
constexpr double kKeepInformation = 0.95;
constexpr double kEnoughFrames = 10.0;  // before a direction counts as one without information

}  // namespace

template <class Pose>
HealthMonitor<Pose>::HealthMonitor(Arena& arena, const HealthOptions& options)
    : apply_(options.apply_noise),
      sensors_(options.max_sensors),
      places_(arena.take<Place>(static_cast<std::size_t>(options.max_sensors))),
      memory_(arena, 4 * options.max_observations),
      paired_(arena, options.max_observations),
      slow_(arena, options.max_sensors, kSlowFrames),
      fast_(arena, options.max_sensors, kFastFrames),
      verdict_(options.gate_probability) {}

template <class Pose>
void HealthMonitor<Pose>::moved(const Increment<Pose>& increment) {
  const ProductJacobians J(since_.T_before_after, increment.T_before_after);
  since_.covariance = J.covariance(since_.covariance, increment.covariance);
  since_.T_before_after = since_.T_before_after * increment.T_before_after;
}

template <class Pose>
void HealthMonitor<Pose>::interrupt() {
  for (Index s = 0; s < sensors_; ++s) places_[s].chained = false;
  since_ = Increment<Pose>();
}

template <class Pose>
void HealthMonitor<Pose>::closed(std::size_t refused, std::size_t known) {
  verdict_.closing(static_cast<double>(refused), static_cast<double>(known));
}

template <class Pose>
void HealthMonitor<Pose>::fixed(Index rows, double distance, bool refused) {
  evidence_ = UpdateEvidence();
  evidence_.compared = 1;
  evidence_.refused = refused ? 1 : 0;
  if (!refused) evidence_.nis = distance, evidence_.rows = rows;
  verdict_.add(evidence_);
}

// The motion since the last frame of any sensor goes to every sensor.
template <class Pose>
void HealthMonitor<Pose>::drive_all() {
  for (Index s = 0; s < sensors_; ++s) {
    Place& place = places_[s];
    if (!place.chained) continue;
    place.noise = ProductJacobians(place.driven, since_.T_before_after).covariance(place.noise, since_.covariance);
    place.driven = place.driven * since_.T_before_after;
    place.chained = place.noise.allFinite();
  }
  since_ = Increment<Pose>();
}

template <class Pose>
void HealthMonitor<Pose>::start(Index sensor, Index rows, bool relative) {
  drive_all();
  now_ = sensor;
  rows_ = rows;
  relative_ = relative;
  ++places_[sensor].frame;
  paired_.start(rows);
  evidence_ = UpdateEvidence();
}

template <class Pose>
void HealthMonitor<Pose>::pair(const Sighted<Pose>& sighted, const typename SightingMemory<Pose>::Sighting& last) {
  const Place& place = places_[now_];
  if (!place.chained || last.sensor != now_ || last.frame + 1 != place.frame) return;
  // Where the last estimate saw the landmark, moved by the odometry (eq. 1): other updates between the frames drop out.
  const typename Pose::Point y = place.driven.inverse() * last.y;
  const Vector3 difference = sighted.innovation + sighted.J_z_y * (sighted.y - y) - last.residual;
  // By the motion's error in the axes of the body after it: dy = -dp - turn(y) dtheta.
  typename PairedFrame<Pose>::ByMotion J;
  J.template leftCols<kDim>() = -sighted.J_z_y;
  J.template rightCols<kTurn>() = -sighted.J_z_y * Pose::Rotation::turn(y);
  paired_.add(difference, sighted.noise + last.noise, J);
}

template <class Pose>
void HealthMonitor<Pose>::compare(const Sighted<Pose>& sighted, double distance, bool refused) {
  SensorHealth& health = places_[now_].health;
  health.compared += 1.0;
  health.refused += refused ? 1.0 : 0.0;
  ++evidence_.compared;
  evidence_.refused += refused ? 1 : 0;
  auto* last = memory_.find(sighted.landmark);
  if (last == nullptr) return;
  pair(sighted, *last);
  last->contradiction.add(distance, rows_);
  evidence_.contradicting += last->contradiction.found() ? 1 : 0;
  Vector3 error = Vector3::Zero();
  for (Index r = 0; r < rows_; ++r) error(r) = sighted.innovation(r) / std::sqrt(sighted.noise(r, r));
  health.persistence.add(error, last->past);
}

template <class Pose>
void HealthMonitor<Pose>::correct(const Pose& before, const Square& P_before, const Pose& after,
                                  const Square& P_after) {
  drift_.add(before, P_before, after, P_after);
  semidefinite_factor(P_after, nullptr, &evidence_.pivot);
}

template <class Pose>
void HealthMonitor<Pose>::learn() {
  const Place& place = places_[now_];
  if (paired_.count() == 0) return;
  const typename Pose::Rotation R_inverse = place.driven.rotation().inverse();
  Square to_body = Square::Zero();
  to_body.template topLeftCorner<kDim, kDim>() = R_inverse.matrix();
  to_body.template bottomRightCorner<kTurn, kTurn>() = R_inverse.adjoint();
  const Square noise = to_body * place.noise * to_body.transpose();
  const double alpha = slow_.sensor(now_).value, beta = slow_.motion().value;
  const FrameParts parts = paired_.split(noise, alpha, beta);
  for (Index j = 0; j < parts.commons; ++j)
    evidence_.jump += parts.common[j].square / (alpha + beta * parts.common[j].weight);
  evidence_.jump += parts.rest / alpha;
  // A single gross error must not look like a jump.
  constexpr Index kWitnesses = 3;
  if (parts.residual_dof >= kWitnesses) evidence_.jump_dof = parts.commons + parts.rest_dof;
  slow_.add(now_, parts);
  fast_.add(now_, parts);
  information_ = kKeepInformation * information_ + paired_.information();
  informed_ = kKeepInformation * informed_ + 1.0;
}

template <class Pose>
void HealthMonitor<Pose>::finish(double nis, Index rows) {
  learn();
  evidence_.nis = nis;
  evidence_.rows = rows;
  if (rows > 0) places_[now_].health.nis.add(nis, static_cast<double>(rows), kKeepInformation);
  evidence_.drift = drift_.sigmas();
  int rank = kDof;
  if (informed_ >= kEnoughFrames) semidefinite_factor(information_, &rank);
  evidence_.blind = kDof - rank;
  const auto over = [](NoiseFactor factor, double used) {
    return NoiseFactor{factor.value / used, factor.sigma / used};
  };
  evidence_.sensor = over(fast_.sensor(now_), applied_to_sensor(now_));
  evidence_.motion = over(fast_.motion(), applied_to_motion());
  verdict_.add(evidence_);
  Place& place = places_[now_];
  place.chained = relative_;
  place.driven = Pose();
  place.noise.setZero();
}

template <class Pose>
void HealthMonitor<Pose>::remember(std::uint64_t landmark, const Vector3& residual, const Matrix3& noise,
                                   const typename Pose::Point& y) {
  auto& sighting = memory_.find_or_make(landmark);
  sighting.sensor = now_;
  sighting.frame = places_[now_].frame;
  sighting.residual = residual;
  sighting.noise = noise;
  sighting.y = y;
}

// A factor that is not known well moves the noise less: the noise follows what is significant.
template <class Pose>
double HealthMonitor<Pose>::applied(const NoiseFactor& factor) {
  constexpr double kKnown = 0.2;  // relative standard deviation
  return factor.sigma < kKnown * factor.value ? factor.value : 1.0;
}

template class HealthMonitor<SE2>;
template class HealthMonitor<SE3>;

}  // namespace cairn
