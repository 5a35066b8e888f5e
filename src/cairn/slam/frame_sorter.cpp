// SPDX-License-Identifier: BSD-3-Clause
// Sorting by id.
#include "slam/frame_sorter.hpp"

#include "core/error.hpp"

namespace cairn {

template <class Pose>
FrameSorter<Pose>::FrameSorter(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map,
                               FrameReport& report)
    : map_(map), report_(report), ids_(arena, static_cast<std::size_t>(options.max_observations)) {}

template <class Pose>
void FrameSorter<Pose>::add_known(const Frame<Pose>& frame, Index observation, Index slot, SortedFrame<Pose>& sorted) {
  Match& match = report_.match(observation);
  match.landmark = frame.observations[observation].id;
  const State<Pose>& state = map_.state();
  Prediction<Pose> prediction;
  if (frame.sensor.predict(state.pose(), state.landmark(slot), MountError<Pose>::Zero(), prediction))
    sorted.add_candidate(frame, observation, slot, prediction);
  else
    match.reason = Reason::no_image;
}

template <class Pose>
void FrameSorter<Pose>::sort_landmarks(const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  ids_.clear();
  for (Index i = 0; i < frame.landmarks; ++i) {
    const std::uint64_t id = frame.observations[i].id;
    if (ids_.find(id) != IdTable::kAbsent)
      throw Error(ErrorCode::argument, "observations: landmark %llu comes twice in one frame",
                  static_cast<unsigned long long>(id));
    ids_.set(id, static_cast<std::int32_t>(i));
    const std::optional<Index> slot = map_.table().find(id);
    if (slot)
      add_known(frame, i, *slot, sorted);
    else if (!sorted.add_new(frame, i, map_.state().pose()))
      report_.match(i).reason = Reason::no_place;
  }
}

// A companion's position is observed like a landmark and takes part in the gates and the batch like a landmark.
template <class Pose>
void FrameSorter<Pose>::sort_companions(const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  for (Index i = frame.landmarks; i < frame.count(); ++i) {
    const std::uint64_t id = frame.observations[i].id;
    const Index k = map_.companion_at(id);
    for (Index other = frame.landmarks; other < i; ++other)
      if (frame.observations[other].id == id)
        throw Error(ErrorCode::argument, "observations: vehicle %llu comes twice in one frame",
                    static_cast<unsigned long long>(id));
    add_known(frame, i, k, sorted);
  }
}

template class FrameSorter<SE2>;
template class FrameSorter<SE3>;

}  // namespace cairn
