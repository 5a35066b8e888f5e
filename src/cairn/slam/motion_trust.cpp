// SPDX-License-Identifier: BSD-3-Clause
#include "slam/motion_trust.hpp"

#include <algorithm>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "slam/vehicle_records.hpp"

namespace cairn {
namespace {

// log of P(X >= refused), X binomial with the chance `refusal`, by its largest term.
double log_chance(Index judged, Index refused, double refusal) {
  const double n = static_cast<double>(judged), q = static_cast<double>(refused);
  return log_gamma(n + 1) - log_gamma(q + 1) - log_gamma(n - q + 1) + q * std::log(refusal) +
         (n - q) * std::log1p(-refusal);
}

}  // namespace

template <class Pose>
MotionTrust<Pose>::MotionTrust(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map,
                               const Thresholds& thresholds, const Log& log)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      log_(log),
      records_(arena.take<Record>(static_cast<std::size_t>(options.max_companions + 1))),
      kept_(arena.take<Witness<Pose>>(static_cast<std::size_t>(kKept * (options.max_companions + 1)))),
      kept_placed_(arena.take<Witness<Pose>>(static_cast<std::size_t>(kKept * (options.max_companions + 1)))),
      witnesses_(arena.take<Witness<Pose>>(static_cast<std::size_t>(options.max_observations + kKept))),
      placed_(arena.take<Witness<Pose>>(static_cast<std::size_t>(options.max_observations + kKept))) {}

template <class Pose>
typename MotionTrust<Pose>::Record& MotionTrust<Pose>::record() {
  const std::uint64_t vehicle = map_.table().vehicle();
  Record& own = record_of(records_, options_.max_companions + 1, vehicle);
  if (!belongs(own, vehicle)) own = Record();
  own.used = true;
  own.vehicle = vehicle;
  return own;
}

template <class Pose>
void MotionTrust<Pose>::begin(std::uint64_t map_frame) {
  heard_ = 0;
  own_ = nullptr;
  undecided_ = false;
  ++frame_;
  if (map_frame == map_frame_) return;
  map_frame_ = map_frame;
  for (Index k = 0; k <= options_.max_companions; ++k) forget(records_[k]);
}

template <class Pose>
bool MotionTrust<Pose>::hear(int rows, std::uint64_t source, const Pose& pose, const double* residual,
                             const ByPose& J_pose, const double* S, Index ld) {
  pose_ = pose;
  Witness<Pose>& witness = witnesses_[heard_];
  witness.rows = rows;
  witness.frame = frame_;
  witness.source = source;
  witness.position = pose.translation();
  witness.placed = placed_[heard_].placed = false;
  if (!witness.whiten(residual, J_pose, S, ld)) return false;
  ++heard_;
  return true;
}

template <class Pose>
void MotionTrust<Pose>::place(Index heard, const Point& difference, const Point& arm, const PointSquare& covariance) {
  Witness<Pose> witness = witnesses_[heard];
  if (witness.place(difference, arm, covariance)) placed_[heard] = witness;
}

template <class Pose>
bool MotionTrust<Pose>::contradicted(Index accepted, const double* J, const double* r, Index rows,
                                     Widening<Pose>& widening) {
  widening = {};
  if (heard_ == 0) return false;
  own_ = &record();
  next_ = *own_;
  keeping_ = false;
  if (!contradicts(accepted)) {  // agreement
    const auto refuted = [&] {
      // A witness that agrees with the contradicting ones as well supports nothing: a heading says nothing of a slip.
      const MotionVote<Pose> other = vote_motion(move_kept(kept(), witnesses_), next_.kept, bounds());
      return witnesses_[0].distance(other.motion) > bound(witnesses_[0].rows);
    };
    if (heard_ > 1 || next_.kept == 0 || refuted()) forget(next_);
    return next_.evidence.weigh(ForgottenSums::shared(), J, r, rows, Pose::turn_axes(pose_.rotation()),
                                widening.covariance);
  }
  next_.judged += heard_;
  next_.refused += heard_ - accepted;
  for (Index a = 0; a < heard_; ++a)
    if (!placed_[a].placed) placed_[a] = witnesses_[a];
  keeping_ = !(unlikely() && vote(widening));
  return !keeping_;
}

template <class Pose>
void MotionTrust<Pose>::commit() {
  if (own_ == nullptr) return;
  *own_ = next_;
  if (keeping_) keep();
  own_ = nullptr;
}

template <class Pose>
void MotionTrust<Pose>::keep() {
  Record& own = *own_;
  const Index step = (heard_ + kKeptOfFrame - 1) / kKeptOfFrame, more = (heard_ + step - 1) / step;
  const Index drop = std::max<Index>(0, own.kept + more - kKept);  // the oldest
  std::move(kept() + drop, kept() + own.kept, kept());
  std::move(kept_placed() + drop, kept_placed() + own.kept, kept_placed());
  own.kept -= drop;
  for (Index a = 0; a < heard_; a += step) {
    kept()[own.kept] = witnesses_[a];
    kept_placed()[own.kept++] = placed_[a];
  }
}

// Copies the kept witnesses behind those of the frame, as witnesses of the pose where it is now.
template <class Pose>
Witness<Pose>* MotionTrust<Pose>::move_kept(const Witness<Pose>* kept, Witness<Pose>* witnesses) const {
  for (Index k = 0; k < next_.kept; ++k) {
    witnesses[heard_ + k] = kept[k];
    witnesses[heard_ + k].move_to(pose_.translation());
  }
  return witnesses + heard_;
}

template <class Pose>
BoundsByRows MotionTrust<Pose>::bounds() const {
  BoundsByRows bounds = {};
  for (int rows = 1; rows <= kMostRows; ++rows) bounds[static_cast<std::size_t>(rows)] = bound(rows);
  return bounds;
}

// (F1): whether so many refusals are unlikely if the estimate is right.
template <class Pose>
bool MotionTrust<Pose>::unlikely() const {
  constexpr double kChance = 1e-5;
  const double refusal = 1.0 - options_.gate_probability;
  return refusal > 0.0 && log_chance(next_.judged, next_.refused, refusal) <= std::log(kChance);
}

// Placed points are exact in the motion, but less so in their noise: both forms vote, and the one with more agreement
// decides.
template <class Pose>
bool MotionTrust<Pose>::vote(Widening<Pose>& widening) {
  const Index count = heard_ + next_.kept;
  move_kept(kept(), witnesses_);
  move_kept(kept_placed(), placed_);
  const MotionVote<Pose> linear = vote_motion(witnesses_, count, bounds());
  const MotionVote<Pose> placed = vote_motion(placed_, count, bounds());
  const bool is_placed = placed.agreeing > linear.agreeing;
  const MotionVote<Pose>& best = is_placed ? placed : linear;
  const Support support = support_of(is_placed ? placed_ : witnesses_, count, best);
  undecided_ = support == Support::one_frame && next_.kept + kKeptOfFrame <= kKept;
  if (support != Support::enough) return false;
  widening.motion = best.motion;
  widening.covariance = best.motion * best.motion.transpose();  // (F2): this motion is one standard deviation
  forget(next_);
  log_.say("update: %td of %td observations contradict the pose and agree on another one, %g m away", best.agreeing,
           count, best.motion.template head<Pose::kDim>().norm());
  return true;
}

// Most witnesses agree, in more than one frame, and different sources give more rows than a motion has freedoms: one
// wrong source agrees with itself.
template <class Pose>
typename MotionTrust<Pose>::Support MotionTrust<Pose>::support_of(const Witness<Pose>* witnesses, Index count,
                                                                  const MotionVote<Pose>& vote) const {
  if (2 * vote.agreeing <= count) return Support::none;
  const auto agrees = [&](Index a) { return witnesses[a].distance(vote.motion) <= bound(witnesses[a].rows); };
  Index rows = 0, now = 0, before = 0;
  int widest = 0;
  for (Index a = 0; a < count; ++a) {
    if (!agrees(a)) continue;
    (witnesses[a].frame == frame_ ? now : before) += 1;
    bool heard_before = false;
    for (Index b = 0; b < a && !heard_before; ++b)
      heard_before = witnesses[b].source == witnesses[a].source && agrees(b);
    if (heard_before) continue;
    rows += witnesses[a].rows;
    widest = std::max(widest, witnesses[a].rows);
  }
  if (rows < kDof + widest) return Support::none;
  return now > 0 && before > 0 ? Support::enough : Support::one_frame;
}

template <class Pose>
void widen(State<Pose>& state, const typename Pose::Square& covariance) {
  if (!state.widen(covariance))
    throw Error(ErrorCode::numerical, "update: the widened motion would not be finite; nothing was changed");
}

template void widen(State<SE2>&, const SE2::Square&);
template void widen(State<SE3>&, const SE3::Square&);
template class MotionTrust<SE2>;
template class MotionTrust<SE3>;

}  // namespace cairn
