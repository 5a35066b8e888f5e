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

// What a contradiction asks for: an additional error [dp; dtheta] of the pose with this covariance, and a motion by
// which the pose is moved first, so that the frame is linearised where it agrees.
template <class Pose>
struct Widening {
  typename Pose::Square covariance = Pose::Square::Zero();
  typename Pose::Tangent motion = Pose::Tangent::Zero();
};

template <class Pose>
class MotionTrust {
 public:
  static constexpr int kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using Point = typename Pose::Point;
  using PointSquare = Eigen::Matrix<double, Pose::kDim, Pose::kDim>;
  using ByPose = typename Witness<Pose>::ByPose;

  MotionTrust(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, const Thresholds& thresholds,
              const Log& log);

  // A landmark bears witness after it has agreed with the motion this often; other vehicles always do.
  bool is_witness(Index slot) const {
    return slot < map_.table().companions() || map_.table().observations(slot) >= kGrownUp;
  }

  // --- one frame, in this order ---
  // `map_frame` changes where what was heard before no longer applies: the map's frame is another one.
  void begin(std::uint64_t map_frame);
  void hear_nobody() { heard_ = 0; }
  Index heard() const { return heard_; }  // witnesses of the frame
  void agree() { forget(record()); }      // something else supports the pose
  // The residual of a witness, with its Jacobian by the error of the vehicle's pose and the lower triangle of its
  // covariance, before the gates. `source` tells witnesses apart. Returns false if the covariance is singular.
  bool hear(int rows, std::uint64_t source, const Pose& pose, const double* residual, const ByPose& J_pose,
            const double* S, Index ld);
  // Most witnesses contradict if the gates accepted this many.
  bool contradicts(Index accepted) const { return 2 * accepted < heard_; }
  // The same witness as a placed point, for errors of any size; asked for only if most witnesses contradict.
  void place(Index heard, const Point& difference, const Point& arm, const PointSquare& covariance);
  // After the gates, which accepted `accepted` of the witnesses. `J` (kDof columns, zero for rows of others) and `r`
  // are Jacobian and residual of the accepted rows, whitened together. If the motion has to be widened: true, and
  // `widening` says how.
  bool contradicted(Index accepted, const double* J, const double* r, Index rows, Widening<Pose>& widening);
  // The same after one witness that is no part of a frame.
  bool contradicted(bool accepted, Widening<Pose>& widening) {
    return contradicted(accepted ? 1 : 0, witnesses_[0].J.data(), witnesses_[0].r.data(), kMostRows, widening);
  }
  // Whether most witnesses agree on another pose, but in one frame only: another frame has to decide. Where a new
  // landmark is, is not known until then.
  bool undecided() const { return undecided_; }
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

  Record& record();  // of the active vehicle
  // Of the record at hand, and the same as placed points.
  Witness<Pose>* kept() const { return kept_ + (own_ - records_) * kKept; }
  Witness<Pose>* kept_placed() const { return kept_placed_ + (own_ - records_) * kKept; }
  static void forget(Record& record) { record.kept = record.judged = record.refused = 0; }
  void keep();
  Witness<Pose>* move_kept(const Witness<Pose>* kept, Witness<Pose>* witnesses) const;
  BoundsByRows bounds() const;
  bool unlikely() const;
  bool vote(Widening<Pose>& widening);
  enum class Support { none, one_frame, enough };
  Support support_of(const Witness<Pose>* witnesses, Index count, const MotionVote<Pose>& vote) const;
  double bound(int rows) const { return thresholds_.single(rows); }

  const FilterOptions<Pose>& options_;
  const LocalMap<Pose>& map_;
  const Thresholds& thresholds_;
  const Log& log_;
  Record* records_;                    // one a vehicle
  Witness<Pose>*kept_, *kept_placed_;  // kKept a vehicle
  Witness<Pose>*witnesses_, *placed_;  // of the frame; behind them room for those of a record
  Record* own_ = nullptr;              // the record at hand, if contradicted() has judged the frame
  Record next_ = {};                   // what commit() makes of it
  bool keeping_ = false;               // commit() keeps witnesses of the frame
  bool undecided_ = false;
  Index heard_ = 0;
  Pose pose_;  // of the last witness
  std::uint64_t frame_ = 0, map_frame_ = 0;
};

// Widens the motion that is held back; throws, with nothing changed, if the result is not finite.
template <class Pose>
void widen(State<Pose>& state, const typename Pose::Square& covariance);
// Moves the pose first.
template <class Pose>
void widen(State<Pose>& state, const Widening<Pose>& widening) {
  state.shift(widening.motion);
  widen(state, widening.covariance);
}

// Takes a widening of the motion back if the update that asked for it throws.
template <class Pose>
class PendingRestore {
 public:
  explicit PendingRestore(State<Pose>& state) : state_(state), before_(state.held()) {}
  ~PendingRestore() {
    if (!released_) state_.restore(before_);
  }
  PendingRestore(const PendingRestore&) = delete;
  PendingRestore& operator=(const PendingRestore&) = delete;
  void release() { released_ = true; }

 private:
  State<Pose>& state_;
  typename State<Pose>::Held before_;
  bool released_ = false;
};

extern template class MotionTrust<SE2>;
extern template class MotionTrust<SE3>;

}  // namespace cairn
