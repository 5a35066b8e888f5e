// SPDX-License-Identifier: BSD-3-Clause
// Updates by one batch that is gated as a whole: an absolute fix, rows that the caller linearised, and two landmarks
// that are one.
#pragma once

#include "core/id_table.hpp"
#include "health/health_monitor.hpp"
#include "sensor/absolute_fix.hpp"
#include "slam/frame_report.hpp"
#include "slam/motion_trust.hpp"
#include "slam/submap_keeper.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

// Every update has one match, number 0 of the report. All of them throw with nothing changed.
template <class Pose>
class WholeBatchUpdate {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  using Square = typename Pose::Square;

  WholeBatchUpdate(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, SubmapKeeper<Pose>& submaps,
                   const Thresholds& thresholds, MotionTrust<Pose>& trust, FrameReport& report,
                   HealthMonitor<Pose>& health, const Log& log);

  void fix(const AbsoluteFix<Pose>& given);
  void rows(const LinearRows& rows);
  // If the gate accepts that two landmarks are one, `other` is removed.
  void merge(std::uint64_t id, std::uint64_t other);

 private:
  // Gates the batch that `fill` gives; if the gate accepts it, finish() takes it.
  template <class Fill>
  void test(EkfUpdate<Pose>& update, Index rows, std::uint64_t landmark, Fill&& fill);
  template <class Fill>
  void finish(EkfUpdate<Pose>& update, int iterations, Fill&& fill);
  bool accepted() { return report_.match(0).distance <= std::min(report_.match(0).threshold, kAbsurdDistance); }
  void fix_state(const AbsoluteFix<Pose>& fix, const Square& covariance);
  void fix_map(const AbsoluteFix<Pose>& fix);
  void finish_report(Index rows);
  FixReport try_fix(const AbsoluteFix<Pose>& fix);
  // A fix as a witness, of a vehicle at `pose` in the axes of the trust's record; S of the residual, by the pose.
  struct Statement {
    Pose pose;
    Vector3 residual;
    typename Witness<Pose>::ByPose J;
    Matrix3 S;
  };
  bool landmarks_support();
  bool contradicted(MotionTrust<Pose>& trust, Index rows, const Statement& statement, bool accepted,
                    Widening<Pose>& widening);
  void find_window(const LinearRows& rows);
  bool matched() const { return report_.matches()[0].decision == Decision::matched; }

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  SubmapKeeper<Pose>& submaps_;
  const Thresholds& thresholds_;
  MotionTrust<Pose>& trust_;
  MotionTrust<Pose> trust_in_map_;  // of fixes, beside submaps
  FrameReport& report_;
  HealthMonitor<Pose>& health_;
  const Log& log_;
  IdTable ids_;    // of the landmarks that the caller's rows depend on
  Index* window_;  // slots
  std::uint64_t fixes_ = 0;
  std::uint64_t observed_again_ = 0;  // at the last fix in the open submap
};

extern template class WholeBatchUpdate<SE2>;
extern template class WholeBatchUpdate<SE3>;

}  // namespace cairn
