// SPDX-License-Identifier: BSD-3-Clause
// New landmarks of a frame.
#include "slam/frame_placer.hpp"

#include <algorithm>

namespace cairn {

template <class Pose>
FramePlacer<Pose>::FramePlacer(const FilterOptions<Pose>& options, LocalMap<Pose>& map, FrameReport& report)
    : options_(options), map_(map), report_(report) {}

template <class Pose>
void FramePlacer<Pose>::reserve_id(std::uint64_t id) {
  if (options_.association != AssociationKind::known) next_id_ = std::max(next_id_, id + 1);
}

// A new landmark is placed next to an existing one only if that one was accepted in this frame.
template <class Pose>
void FramePlacer<Pose>::drop_unsupported(SortedFrame<Pose>& sorted) const {
  const auto accepted = [&](std::uint64_t id) {
    return std::any_of(sorted.begin(), sorted.end(), [&](const Candidate<Pose>& candidate) {
      return candidate.slot >= map_.table().companions() && map_.table().id(candidate.slot) == id;
    });
  };
  sorted.keep_new([&](Index observation) {
    const std::uint64_t neighbour = report_.match(observation).landmark;
    return neighbour == kNoId || accepted(neighbour);
  });
}

template <class Pose>
bool FramePlacer<Pose>::place_one(EkfUpdate<Pose>& update, const Frame<Pose>& frame, Index observation) {
  using PointSquare = typename LocalMap<Pose>::PointSquare;
  const Sensor<Pose>& sensor = frame.sensor;
  const MountNoise mode = sensor.mount_noise_mode();
  const State<Pose>& state = map_.state();
  const SystematicErrors& errors = map_.systematic();
  if (frame.calibrated != nullptr)
    frame.calibrated->set(errors.calibration<Pose>(frame.number, [&](Index i) { return state.systematic(i); }));
  Placement<Pose> placement;
  if (!sensor.place(map_.state().pose(), frame.z(observation), update.mount(), placement)) return false;
  const int rows = sensor.rows();
  const auto J_z = placement.J_landmark_z.leftCols(rows);
  PointSquare noise = PointSquare::Zero();
  noise.noalias() +=
      J_z.lazyProduct(frame.noise(observation).topLeftCorner(rows, rows).eval().lazyProduct(J_z.transpose()));
  if (mode == MountNoise::per_observation)
    noise += placement.J_landmark_mount * sensor.mount_noise() * placement.J_landmark_mount.transpose();
  ErrorColumns<Pose::kDim> by_errors;
  if (frame.calibrated != nullptr)
    by_errors = errors.columns(frame.number, frame.calibrated->by_calibration(state.pose(), placement));
  return update.place(placement.landmark, placement.J_landmark_pose,
                      mode == MountNoise::per_frame ? &placement.J_landmark_mount : nullptr, noise, sensor.relative(),
                      frame.calibrated != nullptr ? &by_errors : nullptr);
}

template <class Pose>
void FramePlacer<Pose>::place(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  drop_unsupported(sorted);
  for (Index k = 0; k < sorted.new_ones(); ++k) {
    const Index observation = sorted.new_one(k);
    Match& match = report_.match(observation);
    match = {kNoId, Decision::rejected, Reason::no_place, 0.0, 0.0};
    if (!place_one(update, frame, observation)) continue;
    const std::uint64_t id =
        options_.association == AssociationKind::known ? frame.observations[observation].id : next_id_++;
    map_.name_placed(id);
    match = {id, Decision::placed, Reason::none, 0.0, 0.0};
  }
}

template class FramePlacer<SE2>;
template class FramePlacer<SE3>;

}  // namespace cairn
