// SPDX-License-Identifier: BSD-3-Clause
// The update of the state by the candidates of a frame: linearise, gates, iterate, commit (docs/update.md).
#pragma once

#include <optional>

#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/log.hpp"
#include "slam/motion_trust.hpp"
#include "slam/sorted_frame.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

template <class Pose>
class FrameUpdate {
 public:
  FrameUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, Thresholds& thresholds,
              MotionTrust<Pose>& trust, FrameReport& report, const Log& log);

  // Opens an update whose window holds the candidates, linearises and gates it. The candidates that the gates accept
  // are left in `sorted`.
  void begin(std::optional<EkfUpdate<Pose>>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  // Whether the motion has to be widened before the frame is used, and how.
  bool contradicted(const EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted,
                    Widening<Pose>& widening);
  // Weighs and iterates.
  void finish(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted);
  void commit(EkfUpdate<Pose>& update, const SortedFrame<Pose>& sorted);

 private:
  class Gates;

  bool fill(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted, double* residual_only);
  Matrix3 noise(const Frame<Pose>& frame, const Candidate<Pose>& candidate, const Prediction<Pose>& prediction,
                double persistence) const;
  void hear(const EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted);
  void place_witnesses(const Frame<Pose>& frame);
  void gate(EkfUpdate<Pose>& update, const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  void weigh(EkfUpdate<Pose>& update, const Frame<Pose>& frame, const SortedFrame<Pose>& sorted);

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  Thresholds& thresholds_;
  MotionTrust<Pose>& trust_;
  FrameReport& report_;
  const Log& log_;
  Index* window_;  // slots
  MountSquare<Pose> mount_;
  double* by_pose_;  // Jacobian of the accepted rows by the pose, kDof columns
  struct Heard {
    Index observation, slot;
  };
  Heard* heard_;           // by witness
  double* noise_factors_;  // of a robust loss, by candidate
  bool settled_ = true;    // the last linearisation changed none of them much
};

extern template class FrameUpdate<SE2>;
extern template class FrameUpdate<SE3>;

}  // namespace cairn
