// SPDX-License-Identifier: BSD-3-Clause
// One update by one frame.
#include "slam/frame_update.hpp"

#include "ekf/update_gates.hpp"

namespace cairn {

template <class Pose>
FrameUpdate<Pose>::FrameUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                               Thresholds& thresholds, FrameReport& report, const Log& log)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      report_(report),
      log_(log),
      window_(arena.take<Index>(static_cast<std::size_t>(options.max_observations))) {}

template <class Pose>
EkfUpdate<Pose> FrameUpdate<Pose>::begin(const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) {
  for (Index a = 0; a < sorted.candidates(); ++a) window_[a] = sorted.candidate(a).slot;
  const MountSquare<Pose> mount = frame.sensor.mount_noise();
  const bool shared = frame.sensor.mount_noise_mode() == MountNoise::per_frame;
  return map_.state().begin({window_, sorted.candidates(), shared ? &mount : nullptr});
}

// Fills the batch at the iterate or, if `residual_only` is given, only the residual. Returns false if a landmark has no
// image.
template <class Pose>
bool FrameUpdate<Pose>::fill(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted,
                             double* residual_only) const {
  const Sensor<Pose>& sensor = frame.sensor;
  const Index rows = sensor.rows();
  const MountNoise mode = sensor.mount_noise_mode();
  if (residual_only == nullptr) update.batch().clear();
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
    if (mode == MountNoise::per_frame) update.add_mount_block(row, rows, prediction.J_z_mount);
    update.add_landmark_block(row, rows, prediction.J_z_landmark, candidate.number, pose);
    Matrix3 noise = options_.error_persistence * candidate.noise;
    if (mode == MountNoise::per_observation)
      noise += prediction.J_z_mount * sensor.mount_noise() * prediction.J_z_mount.transpose();
    double* block = update.batch().add_noise(row, rows);
    for (Index c = 0; c < rows; ++c)
      for (Index r = 0; r < rows; ++r) block[c * rows + r] = noise(r, c);
  }
  return true;
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
void FrameUpdate<Pose>::run(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  const auto fill_at = [&](double* residual_only) { return fill(update, frame, sorted, residual_only); };
  update.linearise(fill_at);
  gate(update, frame, sorted);
  if (sorted.candidates() > 0) {
    report_.update().nis = update.nis();
    report_.update().iterations =
        update.iterate({options_.iterations, options_.iteration_tolerance, frame.sensor.relative()}, fill_at);
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
