// SPDX-License-Identifier: BSD-3-Clause
// Judges whether the estimate is wrong where observations contradict it, and says how far the motion since the last
// agreement has to be widened (docs/update.md, "Finding back").
#pragma once

#include "core/arena.hpp"
#include "slam/axis_evidence.hpp"
#include "slam/local_map.hpp"
#include "slam/log.hpp"
#include "slam/motion_vote.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

template <class Pose>
class MotionTrust {
 public:
  static constexpr int kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using ByPose = typename Witness<Pose>::ByPose;

  MotionTrust(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, const Thresholds& thresholds,
              const Log& log);

  // A landmark bears witness after it has agreed with the motion this often; other vehicles always do.
  bool is_witness(Index slot) const {
    constexpr std::uint64_t kSightings = 10;
    return slot < map_.table().companions() || map_.table().observations(slot) >= kSightings;
  }

  // --- one frame, in this order ---
  // `map_frame` changes where what was heard before no longer applies: the map's frame is another one.
  void begin(std::uint64_t map_frame);
  void hear_nobody() { heard_ = 0; }
  Index heard() const { return heard_; }  // witnesses of the frame
  void agree() { forget(record()); }      // something else supports the pose
  // The residual of a witness, with its Jacobian by the error of the vehicle's pose and the lower triangle of its
  // covariance, before the gates. `source` tells witnesses apart.
  void hear(int rows, std::uint64_t source, const Pose& pose, const double* residual, const ByPose& J_pose,
            const double* S, Index ld);
  // After the gates, which accepted `accepted` of the witnesses. `J` (kDof columns, zero for rows of others) and `r`
  // are Jacobian and residual of the accepted rows, whitened together. If the motion has to be widened: true, and
  // `widening` is the covariance of an additional error [dp; dtheta] of the pose.
  bool contradicted(Index accepted, const double* J, const double* r, Index rows, Square& widening);
  // The same after one witness that is no part of a frame.
  bool contradicted(bool accepted, Square& widening) {
    return contradicted(accepted ? 1 : 0, witnesses_[0].J.data(), witnesses_[0].r.data(), kMostRows, widening);
  }
  // The update is done. A frame whose update throws leaves no trace here.
  void commit();

 private:
  struct Record {
    std::uint64_t vehicle;
    bool used;
    AxisEvidence<Pose> evidence;
    Index kept;             // witnesses of contradicting frames since the last agreement
    Index judged, refused;  // witnesses heard since the last agreement
  };
  static constexpr Index kKept = 32, kKeptOfFrame = 8;

  Record& record();                                                          // of the active vehicle
  Witness<Pose>* kept() const { return kept_ + (own_ - records_) * kKept; }  // of the record at hand
  static void forget(Record& record) { record.kept = record.judged = record.refused = 0; }
  void keep();
  Witness<Pose>* move_kept();
  BoundsByRows bounds() const;
  bool vote(Square& widening);
  bool enough(const Witness<Pose>* witnesses, Index count, const MotionVote<Pose>& vote) const;
  double bound(int rows) const { return thresholds_.single(rows); }

  const FilterOptions<Pose>& options_;
  const LocalMap<Pose>& map_;
  const Thresholds& thresholds_;
  const Log& log_;
  Record* records_;           // one a vehicle
  Witness<Pose>* kept_;       // kKept a vehicle
  Witness<Pose>* witnesses_;  // of the frame; behind them room for those of a record
  Record* own_ = nullptr;     // the record at hand, if contradicted() has judged the frame
  Record next_ = {};          // what commit() makes of it
  bool keeping_ = false;      // commit() keeps witnesses of the frame
  Index heard_ = 0;
  Pose pose_;  // of the last witness
  std::uint64_t frame_ = 0, map_frame_ = 0;
};

// Widens the motion that is held back; throws, with nothing changed, if the result is not finite.
template <class Pose>
void widen(State<Pose>& state, const typename Pose::Square& covariance);

// Takes a widening of the motion back if the update that asked for it throws.
template <class Pose>
class PendingRestore {
 public:
  explicit PendingRestore(State<Pose>& state) : state_(state), before_(state.pending()) {}
  ~PendingRestore() {
    if (!released_) state_.restore_pending(before_);
  }
  PendingRestore(const PendingRestore&) = delete;
  PendingRestore& operator=(const PendingRestore&) = delete;
  void release() { released_ = true; }

 private:
  State<Pose>& state_;
  typename PendingMotion<Pose>::Snapshot before_;
  bool released_ = false;
};

extern template class MotionTrust<SE2>;
extern template class MotionTrust<SE3>;

}  // namespace cairn
