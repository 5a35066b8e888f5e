// SPDX-License-Identifier: BSD-3-Clause
// One update by one frame.
#include "slam/frame_update.hpp"

#include <algorithm>
#include <cmath>

#include "ekf/update_gates.hpp"
#include "slam/placed_point.hpp"

namespace cairn {

template <class Pose>
FrameUpdate<Pose>::FrameUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                               Thresholds& thresholds, MotionTrust<Pose>& trust, FrameReport& report, const Log& log)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      trust_(trust),
      report_(report),
      log_(log),
      window_(arena.take<Index>(static_cast<std::size_t>(options.max_observations))),
      by_pose_(arena.take<double>(static_cast<std::size_t>(Pose::kDof * kMostRows * options.max_observations))),
      heard_(arena.take<Heard>(static_cast<std::size_t>(options.max_observations))),
      noise_factors_(arena.take<double>(static_cast<std::size_t>(options.max_observations))) {}

template <class Pose>
void FrameUpdate<Pose>::begin(std::optional<EkfUpdate<Pose>>& update, const Frame<Pose>& frame,
                              SortedFrame<Pose>& sorted) {
  for (Index a = 0; a < sorted.candidates(); ++a) window_[a] = sorted.candidate(a).slot;
  mount_ = frame.sensor.mount_noise();
  const bool shared = frame.sensor.mount_noise_mode() == MountNoise::per_frame;
  update.emplace(map_.state(), typename State<Pose>::Window{window_, sorted.candidates(), shared ? &mount_ : nullptr});
  std::fill_n(noise_factors_, sorted.candidates(), 1.0);
  update->linearise([&](double* residual_only) { return fill(*update, frame, sorted, residual_only); });
  hear(*update, frame, sorted);
  gate(*update, frame, sorted);
}

// Noise of one observation: that of its values, and that of a mount which moves between observations. `persistence`:
// by this the noise of the values is multiplied.
template <class Pose>
Matrix3 FrameUpdate<Pose>::noise(const Frame<Pose>& frame, const Candidate<Pose>& candidate,
                                 const Prediction<Pose>& prediction, double persistence) const {
  Matrix3 noise = persistence * candidate.noise;
  if (frame.sensor.mount_noise_mode() == MountNoise::per_observation)
    noise += prediction.J_z_mount * frame.sensor.mount_noise() * prediction.J_z_mount.transpose();
  return noise;
}

// Fills the batch at the iterate or, if `residual_only` is given, only the residual. Returns false if a landmark has no
// image.
template <class Pose>
bool FrameUpdate<Pose>::fill(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted,
                             double* residual_only) {
  const Sensor<Pose>& sensor = frame.sensor;
  const Index rows = sensor.rows();
  const SystematicErrors& errors = map_.systematic();
  if (frame.calibrated != nullptr)
    frame.calibrated->set(errors.calibration<Pose>(frame.number, [&](Index i) { return update.systematic(i); }));
  if (residual_only == nullptr) {
    update.batch().clear();
    settled_ = true;
  }
  for (Index a = 0; a < sorted.candidates(); ++a) {
    const Candidate<Pose>& candidate = sorted.candidate(a);
    Prediction<Pose> moved;
    if (update.iterating() && !sensor.predict(update.pose(), update.landmark(candidate.number), update.mount(), moved))
      return false;
    const Prediction<Pose>& prediction = update.iterating() ? moved : candidate.prediction;
    const Vector3 residual = sensor.residual(frame.z(candidate.observation), prediction.z);
    double* target = residual_only != nullptr ? residual_only : update.batch().residual();
    for (Index r = 0; r < rows; ++r) target[a * rows + r] = residual(r);
    if (residual_only != nullptr) continue;

    const Index row = update.batch().add_rows(rows);
    const auto pose = update.add_pose_block(row, rows, prediction.J_z_pose, sensor.relative());
    if (frame.calibrated != nullptr) {
      const auto by_errors = errors.columns(frame.number, frame.calibrated->by_calibration(update.pose(), prediction));
      update.add_systematic_block(row, rows, by_errors.J, by_errors.first, by_errors.count);
    }
    if (sensor.mount_noise_mode() == MountNoise::per_frame) update.add_mount_block(row, rows, prediction.J_z_mount);
    update.add_landmark_block(row, rows, prediction.J_z_landmark, candidate.number, pose);
    const Matrix3 noise = this->noise(frame, candidate, prediction, options_.error_persistence);
    if (update.iterating() && frame.loss.robust()) {
      // (L2): the weight at the iterate, by the distance (L1) from what the iterate predicts
      constexpr double kSettled = 0.1;
      const Matrix3 own = this->noise(frame, candidate, prediction, 1.0);
      const double distance = squared_distance(residual.data(), own.data(), kMostRows, rows);
      const double factor = frame.loss.noise_factor(distance, rows);
      if (std::abs(factor - noise_factors_[a]) > kSettled * noise_factors_[a]) settled_ = false;
      noise_factors_[a] = factor;
    }
    double* block = update.batch().add_noise(row, rows);
    for (Index c = 0; c < rows; ++c)
      for (Index r = 0; r < rows; ++r) block[c * rows + r] = noise_factors_[a] * noise(r, c);
  }
  return true;
}

// What the candidates that bear witness say about the pose.
template <class Pose>
void FrameUpdate<Pose>::hear(const EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) {
  const int rows = frame.sensor.rows();
  const Pose pose = map_.state().pose();
  trust_.hear_nobody();
  if (!frame.sensor.bears_witness()) return;
  for (Index a = 0; a < sorted.candidates(); ++a) {
    const Candidate<Pose>& candidate = sorted.candidate(a);
    if (!trust_.is_witness(candidate.slot)) continue;
    heard_[trust_.heard()] = {candidate.observation, candidate.slot};
    trust_.hear(rows, map_.table().id(candidate.slot), pose, update.batch().residual() + a * rows,
                candidate.prediction.J_z_pose, update.covariance(a * rows), update.batch().rows());
  }
}

// The witnesses as placed points.
template <class Pose>
void FrameUpdate<Pose>::place_witnesses(const Frame<Pose>& frame) {
  const State<Pose>& state = map_.state();
  PlacedPoint<Pose> placed;
  for (Index w = 0; w < trust_.heard(); ++w)
    if (placed.place(frame, heard_[w].observation, state.pose(), options_.error_persistence))
      trust_.place(w, state.landmark(heard_[w].slot) - state.pose().translation() - placed.arm, placed.arm,
                   state.relative_covariance(heard_[w].slot) + placed.noise);
}

// The batch as the gates see it: block number a is candidate number a.
template <class Pose>
class FrameUpdate<Pose>::Gates : public UpdateGates<Pose> {
 public:
  using Base = UpdateGates<Pose>;

  Gates(EkfUpdate<Pose>& update, Index rows, double threshold, SortedFrame<Pose>& sorted, FrameReport& report,
        const Log& log)
      : Base(update, rows), threshold_(threshold), sorted_(sorted), report_(report), log_(log) {}

  Match& match(Index a) { return report_.match(sorted_.candidate(a).observation); }

  // Every candidate's match contains its distance, even if both gates accept the candidate.
  double distance(Index a) {
    match(a).distance = Base::distance(a);
    match(a).threshold = threshold_;
    return match(a).distance;
  }
  void keep(const Index* kept, Index count) {
    before_ = sorted_.candidates();
    sorted_.keep(kept, count);
    Base::keep(kept, count);
  }
  template <class Bound>
  bool consistent(Bound&& bound) {
    if (sorted_.candidates() == 0) return true;
    return Base::consistent(bound);
  }
  void refactor() {
    const Index left = sorted_.candidates();
    if (left < before_) log_.say("update: the batch gate refused %td of %td observations", before_ - left, before_);
    Base::refactor();
  }

 private:
  double threshold_;
  SortedFrame<Pose>& sorted_;
  FrameReport& report_;
  const Log& log_;
  Index before_ = 0;  // candidates before the last keep()
};

template <class Pose>
void FrameUpdate<Pose>::gate(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  const Index rows = frame.sensor.rows();
  const double single = thresholds_.single(rows);
  Gates gates(update, rows, single, sorted, report_, log_);
  gate_blocks(
      gates, rows, single, [&](Index left) { return thresholds_.joint(left); },
      [&](Gate gate, Index a, double distance, double threshold) {
        Match& match = gates.match(a);
        match.reason = gate == Gate::single ? Reason::gate : Reason::batch_gate;
        match.distance = distance;
        match.threshold = threshold;
      });
}

template <class Pose>
bool FrameUpdate<Pose>::contradicted(const EkfUpdate<Pose>& update, const Frame<Pose>& frame,
                                     const SortedFrame<Pose>& sorted, Widening<Pose>& widening) {
  if (trust_.heard() == 0) return false;
  const Index rows = frame.sensor.rows(), m = update.batch().rows();
  Index accepted = 0;  // witnesses
  for (Index a = 0; a < sorted.candidates(); ++a) {
    const bool witness = trust_.is_witness(sorted.candidate(a).slot);
    if (witness) ++accepted;
    for (int c = 0; c < Pose::kDof; ++c)
      for (Index r = 0; r < rows; ++r)
        by_pose_[c * m + a * rows + r] = witness ? sorted.candidate(a).prediction.J_z_pose(r, c) : 0.0;
  }
  if (trust_.contradicts(accepted)) place_witnesses(frame);
  // Under a loss the tails are heavy, so an innovation that is larger than stated says nothing about the motion (F4).
  const bool compares = accepted > 0 && !frame.loss.robust();
  for (int c = 0; c < Pose::kDof && compares; ++c) update.whiten(by_pose_ + c * m);
  return trust_.contradicted(accepted, by_pose_, update.innovation(), compares ? m : 0, widening);
}

// The weights of a robust loss at the prediction, where a distance counts the uncertainty of the estimate too. An error
// that lasts is no larger than one that does not: the distance leaves out by how much `error_persistence` raises S.
template <class Pose>
void FrameUpdate<Pose>::weigh(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) {
  const Index rows = frame.sensor.rows(), m = update.batch().rows();
  const double raised = options_.error_persistence - 1.0;
  update.form_innovation();  // S was overwritten by its factor
  for (Index a = 0; a < sorted.candidates(); ++a) {
    const Matrix3& noise = sorted.candidate(a).noise;
    const double* block = update.covariance(a * rows);
    Matrix3 S = Matrix3::Identity();
    for (Index c = 0; c < rows; ++c)
      for (Index r = c; r < rows; ++r) S(r, c) = block[c * m + r] - raised * noise(r, c);
    const double distance = squared_distance(update.batch().residual() + a * rows, S.data(), kMostRows, rows);
    noise_factors_[a] = frame.loss.noise_factor(distance, rows);
    update.batch().scale_noise(a * rows, noise_factors_[a]);
  }
  update.form_innovation();
  update.factor();
}

template <class Pose>
void FrameUpdate<Pose>::finish(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) {
  if (sorted.candidates() > 0) {
    report_.update().nis = update.nis();
    Iterations end{options_.iterations, options_.iteration_tolerance, frame.sensor.relative()};
    if (frame.loss.robust()) {
      weigh(update, frame, sorted);
      settled_ = false;
      end.settled = &settled_;
    }
    report_.update().iterations =
        update.iterate(end, [&](double* residual_only) { return fill(update, frame, sorted, residual_only); });
    report_.update().rows = update.batch().rows();
  }
}

template <class Pose>
void FrameUpdate<Pose>::commit(EkfUpdate<Pose>& update, const SortedFrame<Pose>& sorted) {
  if (sorted.candidates() > 0) update.commit();
  for (const Candidate<Pose>& candidate : sorted) {
    report_.match(candidate.observation).decision = Decision::matched;
    map_.table().add_observations(candidate.slot, 1);
  }
}

template class FrameUpdate<SE2>;
template class FrameUpdate<SE3>;

}  // namespace cairn
