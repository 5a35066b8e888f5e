// SPDX-License-Identifier: BSD-3-Clause
// New landmarks of a frame.
#include "slam/frame_placer.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace cairn {
namespace {

// Whether a double can hold a landmark at this distance beside its noise. Its arm turns by the error of the attitude;
// with an arm that is longer than this many standard deviations of the place, rounding would outweigh the place.
template <class Square>
bool holds(double distance, const Square& noise) {
  constexpr double kNear = 1e5, kFarthest = 1e9;  // m
  constexpr double kMostSigmas = 2e7;
  if (!(distance <= kFarthest && noise.trace() <= kFarthest * kFarthest)) return false;  // also refuses NaN
  if (distance <= kNear) return true;
  Eigen::SelfAdjointEigenSolver<Square> solver;
  solver.computeDirect(noise, Eigen::EigenvaluesOnly);
  return distance * distance <= kMostSigmas * kMostSigmas * solver.eigenvalues().minCoeff();
}

}  // namespace

template <class Pose>
FramePlacer<Pose>::FramePlacer(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                               FrameReport& report, const Log& log)
    : options_(options),
      map_(map),
      report_(report),
      log_(log),
      prepared_(arena.take<Prepared>(static_cast<std::size_t>(options.max_observations))) {}

template <class Pose>
void FramePlacer<Pose>::prepare(const EkfUpdate<Pose>& update, const Frame<Pose>& frame,
                                const SortedFrame<Pose>& sorted) {
  for (Index k = 0; k < sorted.new_ones(); ++k) {
    const Index observation = sorted.new_one(k);
    Prepared& prepared = prepared_[observation];
    prepared.placed =
        frame.sensor.place(update.solved_pose(), frame.z(observation), update.solved_mount(), prepared.placement);
  }
}

template <class Pose>
bool FramePlacer<Pose>::find_place(const EkfUpdate<Pose>& update, const Frame<Pose>& frame, Index observation,
                                   Placement<Pose>& placement) const {
  if (!frame.sensor.may_abort())
    return frame.sensor.place(map_.state().pose(), frame.z(observation), update.mount(), placement);
  placement = prepared_[observation].placement;
  return prepared_[observation].placed;
}

template <class Pose>
void FramePlacer<Pose>::reserve_id(std::uint64_t id) {
  if (options_.association != AssociationKind::known) next_id_ = std::max(next_id_, id + 1);
}

// A new landmark is placed next to an existing one only if that one was accepted in this frame.
template <class Pose>
void FramePlacer<Pose>::drop_unsupported(SortedFrame<Pose>& sorted) const {
  if (options_.association == AssociationKind::known) return;
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
bool FramePlacer<Pose>::place_one(EkfUpdate<Pose>& update, const Frame<Pose>& frame, Index observation,
                                  std::optional<Index> old) {
  using PointSquare = typename LocalMap<Pose>::PointSquare;
  const Sensor<Pose>& sensor = frame.sensor;
  const MountNoise mode = sensor.mount_noise_mode();
  const State<Pose>& state = map_.state();
  const SystematicErrors& errors = map_.systematic();
  if (frame.calibrated != nullptr)
    frame.calibrated->set(errors.calibration<Pose>(frame.number, [&](Index i) { return state.systematic(i); }));
  Placement<Pose> placement;
  if (!find_place(update, frame, observation, placement)) return false;
  const int rows = sensor.rows();
  const auto J_z = placement.J_landmark_z.leftCols(rows);
  PointSquare noise = PointSquare::Zero();
  noise.noalias() +=
      J_z.lazyProduct(frame.noise(observation).topLeftCorner(rows, rows).eval().lazyProduct(J_z.transpose()));
  if (mode == MountNoise::per_observation)
    noise += placement.J_landmark_mount * sensor.mount_noise() * placement.J_landmark_mount.transpose();
  if (!holds((placement.landmark - state.pose().translation()).norm(), noise)) return false;
  ErrorColumns<Pose::kDim> by_errors;
  if (frame.calibrated != nullptr)
    by_errors = errors.columns(frame.number, frame.calibrated->by_calibration(state.pose(), placement));
  if (old) map_.forget(*old);  // nothing but numbers that are not finite can fail now
  return update.place(placement.landmark, placement.J_landmark_pose,
                      mode == MountNoise::per_frame ? &placement.J_landmark_mount : nullptr, noise, sensor.relative(),
                      frame.calibrated != nullptr ? &by_errors : nullptr);
}

template <class Pose>
void FramePlacer<Pose>::place(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted,
                              bool in_doubt) {
  drop_unsupported(sorted);
  Index no_room = 0;
  for (Index k = 0; k < sorted.new_ones(); ++k) {
    const Index observation = sorted.new_one(k);
    Match& match = report_.match(observation);
    const std::optional<Index> old = match.landmark == kNoId || options_.association != AssociationKind::known
                                         ? std::nullopt
                                         : map_.table().find(match.landmark);
    if (old) {  // the match keeps its distance from the place that the landmark had
      if (!place_one(update, frame, observation, old)) continue;
      map_.name_placed(match.landmark);
      match.decision = Decision::placed;
      match.reason = Reason::none;
      ++report_.update().placed_again;
      continue;
    }
    match = {kNoId, Decision::rejected, Reason::no_place, 0.0, 0.0};
    if (map_.table().landmarks() >= options_.local_landmarks()) {
      match.reason = Reason::no_room;
      ++no_room;
      continue;
    }
    if (!place_one(update, frame, observation, std::nullopt)) continue;
    const std::uint64_t id =
        options_.association == AssociationKind::known ? frame.observations[observation].id : next_id_++;
    map_.name_placed(id, in_doubt);
    match = {id, Decision::placed, Reason::none, 0.0, 0.0};
  }
  if (no_room > 0)
    log_.say("update: %td new landmarks were refused, because the %s holds %td landmarks and is full", no_room,
             options_.single_map() ? "map" : "open submap, which could not be closed,", map_.table().landmarks());
}

template class FramePlacer<SE2>;
template class FramePlacer<SE3>;

}  // namespace cairn
