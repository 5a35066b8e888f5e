// SPDX-License-Identifier: BSD-3-Clause
// One frame, from its observations to the reviewed map.
#include "slam/frame_pipeline.hpp"

namespace cairn {

template <class Pose>
FramePipeline<Pose>::FramePipeline(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                                   Thresholds& thresholds, MotionTrust<Pose>& trust, FrameReport& report,
                                   HealthMonitor<Pose>& health, const Log& log)
    : options_(options),
      map_(map),
      trust_(trust),
      report_(report),
      sorted_(arena, options.max_observations),
      sorter_(arena, options, map, report),
      associator_(arena, options, map, thresholds, report, log),
      slip_(arena, options, map, thresholds, trust),
      updater_(arena, options, map, thresholds, trust, report, log),
      placer_(arena, options, map, report, log),
      other_places_(arena, options, map, thresholds, trust, report),
      health_feed_(arena, options, map, report, health),
      review_(options, map, report) {}

template <class Pose>
void FramePipeline<Pose>::run(const Frame<Pose>& frame) {
  PendingRestore<Pose> restore(map_.state());
  std::optional<EkfUpdate<Pose>> update;
  Widening<Pose> widening;
  trust_.begin(map_.starts());
  attempt(frame, update, false);
  if (updater_.contradicted(*update, frame, sorted_, widening)) {
    widen(map_.state(), widening);
    attempt(frame, update, true);
    report_.widened<Pose>(widening.covariance);
  }
  if (trust_.undecided())
    sorted_.keep_new([&](Index observation) {
      report_.match(observation).reason = Reason::contradicted;
      return false;
    });
  updater_.finish(*update, frame, sorted_);
  if (!report_.update().widened()) other_places_.judge(frame, sorted_);
  if (frame.sensor.may_abort()) {
    placer_.prepare(*update, frame, sorted_);
    review_.prepare(frame);
  }
  updater_.commit(*update, sorted_);
  restore.release();
  trust_.commit();
  placer_.place(*update, frame, sorted_, other_places_.gross_errors_are_many());
  report_.finish();
  slip_.commit(frame, report_);
  health_feed_.after(frame);
  if (report_.last().widened())
    other_places_.forget();
  else
    other_places_.commit();
  review_.run(frame);
}

// Everything before the first change of the state.
template <class Pose>
void FramePipeline<Pose>::attempt(const Frame<Pose>& frame, std::optional<EkfUpdate<Pose>>& update, bool again) {
  report_.start(frame.count());
  sort(frame, again);
  if (!again) health_feed_.before(frame, sorted_);
  updater_.begin(update, frame, sorted_);
}

template <class Pose>
void FramePipeline<Pose>::sort(const Frame<Pose>& frame, bool again) {
  sorted_.clear();
  if (options_.association == AssociationKind::known) {
    sorter_.sort_landmarks(frame, sorted_);
  } else if (!again || !slip_.repeat(frame, sorted_, report_)) {
    associator_.sort_landmarks(frame, sorted_);
    if (!again) slip_.find(frame, sorted_, report_);
  }
  sorter_.sort_companions(frame, sorted_);
}

template class FramePipeline<SE2>;
template class FramePipeline<SE3>;

}  // namespace cairn
