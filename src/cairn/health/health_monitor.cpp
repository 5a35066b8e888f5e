// SPDX-License-Identifier: BSD-3-Clause
#include "health/health_monitor.hpp"

#include "health/semidefinite.hpp"

namespace cairn {
namespace {

constexpr double kNoiseFrames = 300.0;
constexpr double kKeepInformation = 0.95;
constexpr double kEnoughFrames = 10.0;  // before a direction counts as one without information

// A factor of variances over the one in use, if it is clearly larger.
double excess(const NoiseFactor& factor, double used) {
  constexpr double kClear = 4.0;  // standard deviations
  return factor.value - kClear * factor.sigma > used ? factor.value / used : 1.0;
}

}  // namespace

template <class Pose>
HealthMonitor<Pose>::HealthMonitor(Arena& arena, const HealthOptions& options)
    : apply_(options.apply_noise),
      sensors_(options.max_sensors),
      places_(arena.take<Place>(static_cast<std::size_t>(options.max_sensors))),
      memory_(arena, 4 * options.max_observations),
      paired_{{arena, options.max_observations}, {arena, options.max_observations}, {arena, options.max_observations}},
      steps_(arena.take<typename SightingMemory<Pose>::Sighting*>(static_cast<std::size_t>(options.max_observations))),
      noise_(arena, options.max_sensors, kNoiseFrames),
      verdict_(options.gate_probability) {}

template <class Pose>
void HealthMonitor<Pose>::moved(const Increment<Pose>& increment) {
  const ChainedMotion<Pose> step(increment);
  if (moved_)
    since_.append(step);
  else
    since_ = step;
  moved_ = true;
}

template <class Pose>
void HealthMonitor<Pose>::interrupt() {
  for (Index s = 0; s < sensors_; ++s)
    for (auto& chain : places_[s].chains) chain.unbroken = false;
  moved_ = false;
}

template <class Pose>
void HealthMonitor<Pose>::closed(std::size_t refused, std::size_t known, double worst) {
  verdict_.closing(static_cast<double>(refused), static_cast<double>(known), worst, kDim);
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
void HealthMonitor<Pose>::move_all() {
  if (!moved_) return;
  moved_ = false;
  for (Index s = 0; s < sensors_; ++s)
    for (auto& chain : places_[s].chains) {
      if (!chain.unbroken) continue;
      if (chain.begins)
        chain.motion = since_;
      else
        chain.motion.append(since_);
      chain.begins = false;
      chain.unbroken = chain.motion.noise.allFinite();
    }
}

template <class Pose>
void HealthMonitor<Pose>::start(Index sensor, Index rows, bool relative) {
  move_all();
  now_ = sensor;
  rows_ = rows;
  relative_ = relative;
  ++places_[sensor].frame;
  for (Index stride = 0; stride < kStrides; ++stride) {
    paired_[stride].start(rows);
    auto& chain = places_[sensor].chains[stride];
    if (!due(stride) || !chain.unbroken) continue;
    chain.back = chain.motion.T.inverse();
    chain.R_back = chain.back.rotation().matrix();
  }
  evidence_ = UpdateEvidence();
}

// The difference to a sighting before, and its covariance (docs/trust.md, eq. 1 and 2).
template <class Pose>
bool HealthMonitor<Pose>::pair(const Sighted<Pose>& sighted, bool refused, const Left<Pose>& last, Index stride) {
  const auto& chain = places_[now_].chains[stride];
  if (!chain.unbroken || last.sensor != now_ || last.frame != chain.frame) return false;
  // Where the estimate saw the landmark then, moved by the odometry: other updates between the frames drop out.
  const typename Pose::Point y = chain.R_back * last.y + chain.back.translation();
  Vector3 innovation = sighted.innovation + sighted.J_z_y * (sighted.y - y);
  auto J_z_y = sighted.J_z_y;
  if (refused) {  // the estimate may be far off
    Prediction<Pose> there;
    if (!sighted.sensor->predict(Pose(), y, MountError<Pose>::Zero(), there)) return false;
    innovation = sighted.sensor->residual(sighted.z, there.z);
    J_z_y = there.J_z_landmark;
  }
  // The error of y counts by the change of the Jacobian. The residual before has the covariance R - J P J^T, and the
  // error of y the covariance P - 0 with it: together they are those of `last.noise` and of the term below.
  const typename Prediction<Pose>::ByLandmark J_now = J_z_y.lazyProduct(chain.R_back);
  const typename Prediction<Pose>::ByLandmark by_P = J_now.lazyProduct(last.P);
  Matrix3 noise = sighted.noise + last.noise;
  noise.noalias() += by_P.lazyProduct(J_now.transpose());
  // By the motion's error in the axes of the body after it: dy = -dp - turn(y) dtheta.
  typename PairedFrame<Pose>::ByMotion J;
  J.template leftCols<kDim>() = -J_z_y;
  J.template rightCols<kTurn>() = J.template leftCols<kDim>().lazyProduct(Pose::Rotation::turn(y));
  return paired_[stride].add(innovation - last.residual, noise, J);
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
  const Index number = paired_[0].count();
  for (Index stride = 0; stride < kStrides; ++stride) {
    if (!due(stride)) continue;
    const bool paired = pair(sighted, refused, last->anchors[stride], stride);
    if (stride > 0) continue;
    if (paired)
      steps_[number] = last;
    else
      last->jumped = false;
  }
  last->contradiction.add(distance, rows_);
  evidence_.contradicting += last->contradiction.found() ? 1 : 0;
  Vector3 error = Vector3::Zero();
  for (Index r = 0; r < rows_; ++r) error(r) = sighted.innovation(r) / std::sqrt(sighted.noise(r, r));
  health.persistence.add(error, last->past);
}

template <class Pose>
void HealthMonitor<Pose>::correct(const Pose& before, const Square& P_before, const Pose& after,
                                  const Square& P_after) {
  correction_ = Correction<Pose>(before, P_before, after, P_after);
  drift_.add(correction_);
  semidefinite_factor(P_after, nullptr, &evidence_.pivot);
}

template <class Pose>
FrameParts HealthMonitor<Pose>::split(Index stride) {
  return paired_[stride].split(places_[now_].chains[stride].motion.noise, noise_.sensor(now_).value,
                               noise_.motion().value);
}

template <class Pose>
void HealthMonitor<Pose>::judge_jump(const FrameParts& parts) {
  constexpr Index kLeastFreedoms = 3;  // a single gross error must not look like a jump
  if (parts.residual_dof < kLeastFreedoms) return;
  const double alpha = noise_.sensor(now_).value, beta = noise_.motion().value;
  for (Index j = 0; j < parts.commons; ++j)
    evidence_.jump += parts.common[j].square / (alpha + beta * parts.common[j].weight);
  evidence_.jump += parts.rest / alpha;
  evidence_.jump_dof = parts.commons + parts.rest_dof;
}

// A landmark that jumps and stays has moved, or got another name. A gross error jumps back.
template <class Pose>
void HealthMonitor<Pose>::judge_steps() {
  using Step = typename PairedFrame<Pose>::Step;
  for (Index i = 0; i < paired_[0].count(); ++i) {
    bool& jumped = steps_[i]->jumped;
    const Step step = paired_[0].step(i);
    if (step == Step::agrees && jumped) ++evidence_.contradicting;
    jumped = step == Step::jumped && !jumped;
  }
}

template <class Pose>
void HealthMonitor<Pose>::learn() {
  noise_.fade(now_);
  for (Index stride = 0; stride < kStrides; ++stride) {
    if (paired_[stride].count() == 0) continue;
    const FrameParts parts = split(stride);
    if (stride > 0) {
      noise_.add_motion(now_, parts);
      continue;
    }
    judge_jump(parts);
    judge_steps();
    places_[now_].noise_test.add(parts.residual, parts.residual_dof, applied_to_sensor(now_));
    noise_.add(now_, parts);
    information_ = kKeepInformation * information_ + paired_[stride].information();
    informed_ = kKeepInformation * informed_ + 1.0;
  }
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
  motion_test_.add(correction_, nis, rows, excess(noise_.sensor(now_), applied_to_sensor(now_)));
  evidence_.sensor_noise = places_[now_].noise_test.found();
  evidence_.motion_noise = motion_test_.found();
  verdict_.add(evidence_);
  for (Index stride = 0; stride < kStrides; ++stride) {
    if (!due(stride)) continue;
    auto& chain = places_[now_].chains[stride];
    chain.unbroken = relative_;
    chain.begins = true;
    chain.frame = places_[now_].frame;
    chain.motion = ChainedMotion<Pose>();
  }
}

template <class Pose>
void HealthMonitor<Pose>::remember(std::uint64_t landmark, Left<Pose> left) {
  auto& sighting = memory_.find_or_make(landmark);
  left.sensor = now_;
  left.frame = places_[now_].frame;
  for (Index stride = 0; stride < kStrides; ++stride)
    if (due(stride)) sighting.anchors[stride] = left;
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
