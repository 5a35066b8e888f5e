// SPDX-License-Identifier: BSD-3-Clause
// One frame, from its observations to the reviewed map.
#include "slam/frame_pipeline.hpp"

namespace cairn {

template <class Pose>
FramePipeline<Pose>::FramePipeline(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                                   Thresholds& thresholds, FrameReport& report, const Log& log)
    : options_(options),
      report_(report),
      sorted_(arena, options.max_observations),
      sorter_(arena, options, map, report),
      associator_(arena, options, map, thresholds, report, log),
      updater_(arena, options, map, thresholds, report, log),
      placer_(arena, options, map, report, log),
      review_(options, map, report) {}

template <class Pose>
void FramePipeline<Pose>::run(const Frame<Pose>& frame) {
  report_.start(frame.count());
  sort(frame);
  EkfUpdate<Pose> update = updater_.begin(frame, sorted_);
  updater_.run(update, frame, sorted_);
  if (frame.sensor.may_abort()) {
    placer_.prepare(update, frame, sorted_);
    review_.prepare(frame);
  }
  updater_.commit(update, sorted_);
  placer_.place(update, frame, sorted_);
  report_.finish();
  review_.run(frame);
}

template <class Pose>
void FramePipeline<Pose>::sort(const Frame<Pose>& frame) {
  sorted_.clear();
  if (options_.association == AssociationKind::known)
    sorter_.sort_landmarks(frame, sorted_);
  else
    associator_.sort_landmarks(frame, sorted_);
  sorter_.sort_companions(frame, sorted_);
}

template class FramePipeline<SE2>;
template class FramePipeline<SE3>;

}  // namespace cairn
