// SPDX-License-Identifier: BSD-3-Clause
#include "slam/slip_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "linear/joint_gate.hpp"
#include "slam/vehicle_records.hpp"

namespace cairn {
namespace {

template <class Pose>
std::size_t room(const FilterOptions<Pose>& options, Index count) {
  return options.association == AssociationKind::known ? 0 : static_cast<std::size_t>(count);
}

}  // namespace

template <class Pose>
SlipPairs<Pose>::SlipPairs(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map,
                           const Thresholds& thresholds, const MotionTrust<Pose>& trust)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      trust_(trust),
      memories_(arena.take<Memory>(room(options, (options.max_companions + 1) * options.max_sensors))),
      seen_(arena.take<Seen>(room(options, kObservations))),
      known_(arena.take<Known>(room(options, kLandmarks))),
      taken_(arena.take<Index>(room(options, kLandmarks))),
      distances_(arena.take<double>(room(options, kObservations))),
      pairs_(arena.take<Pair>(room(options, kObservations))),
      witnesses_(arena.take<Witness<Pose>>(room(options, kObservations))) {}

template <class Pose>
typename SlipPairs<Pose>::Memory& SlipPairs<Pose>::memory(int sensor) const {
  const Index vehicles = options_.max_companions + 1;
  const std::uint64_t vehicle = map_.table().vehicle();
  Memory& own = record_of(memories_ + sensor * vehicles, vehicles, vehicle);
  if (!belongs(own, vehicle) || own.map_frame != map_.starts()) {
    own.count = 0;
    own.used = true;
    own.vehicle = vehicle;
    own.map_frame = map_.starts();
  }
  return own;
}

template <class Pose>
void SlipPairs<Pose>::commit(const Frame<Pose>& frame, const FrameReport& report) {
  if (options_.association == AssociationKind::known || frame.landmarks == 0) return;
  const Match* matches = report.matches();
  const auto matched = [&](Index i) { return matches[i].decision == Decision::matched; };
  Index count = 0;
  for (Index i = 0; i < frame.landmarks; ++i) count += matched(i) ? 1 : 0;
  if (2 * count < frame.landmarks) return;
  Memory& memory = this->memory(frame.number);
  memory.count = 0;
  memory.least = memory.most = frame.z(0);
  for (Index i = 0; i < frame.landmarks; ++i) {
    memory.least = memory.least.cwiseMin(frame.z(i));
    memory.most = memory.most.cwiseMax(frame.z(i));
    if (!matched(i) || memory.count == kLandmarks) continue;
    const std::optional<Index> slot = map_.table().find(matches[i].landmark);
    if (slot && trust_.is_witness(*slot)) memory.ids[memory.count++] = matches[i].landmark;
  }
}

// Whether most of what was seen last ought to be seen now, and is not paired.
template <class Pose>
bool SlipPairs<Pose>::lost(const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) const {
  if (frame.landmarks < kFewest || 2 * sorted.candidates() >= frame.landmarks) return false;
  const Memory& memory = this->memory(frame.number);
  const State<Pose>& state = map_.state();
  const int rows = frame.sensor.rows();
  Index expected = 0, paired = 0;
  for (Index k = 0; k < memory.count; ++k) {
    const std::optional<Index> slot = map_.table().find(memory.ids[k]);
    Prediction<Pose> image;
    if (!slot || !frame.sensor.predict(state.pose(), state.landmark(*slot), MountError<Pose>::Zero(), image)) continue;
    bool inside = true;
    for (int r = 0; r < rows; ++r) inside = inside && image.z[r] >= memory.least[r] && image.z[r] <= memory.most[r];
    if (!inside) continue;
    ++expected;
    paired += std::any_of(sorted.begin(), sorted.end(), [&](const Candidate<Pose>& c) { return c.slot == *slot; });
  }
  return expected >= kFewest && 2 * paired < expected;
}

// The points that the observations place, and the well-known landmarks in reach.
template <class Pose>
void SlipPairs<Pose>::gather(const Frame<Pose>& frame) {
  constexpr double kReach = 1.5;  // by the distance of the farthest observation
  const State<Pose>& state = map_.state();
  const Point vehicle = state.pose().translation();
  seen_count_ = known_count_ = 0;
  double reach = 0.0;
  const Index step = (frame.landmarks + kObservations - 1) / kObservations;
  for (Index i = 0; i < frame.landmarks; i += step) {
    Seen& seen = seen_[seen_count_];
    seen.observation = i;
    if (!seen.point.place(frame, i, state.pose(), options_.error_persistence)) continue;
    ++seen_count_;
    reach = std::max(reach, kReach * seen.point.arm.norm());
  }
  for (Index slot = map_.table().companions(); slot < map_.table().size() && known_count_ < kLandmarks; ++slot) {
    const Point from_vehicle = state.landmark(slot) - vehicle;
    if (!trust_.is_witness(slot) || !(from_vehicle.norm() <= reach)) continue;
    known_[known_count_++] = {slot, from_vehicle, state.relative_covariance(slot)};
  }
}

// Pairs each observation with the nearest landmark within `slack` times the gate after this motion, each landmark once.
template <class Pose>
void SlipPairs<Pose>::match(const Tangent& motion, double slack) {
  const typename Pose::Rotation turn = Pose::Rotation::exp(motion.template tail<Pose::kTurn>());
  const double most = slack * bound();
  std::fill_n(taken_, known_count_, Index(-1));
  pair_count_ = 0;
  for (Index i = 0; i < seen_count_; ++i) {
    const PlacedPoint<Pose>& point = seen_[i].point;
    const Point at = motion.template head<Pose::kDim>() + turn * point.arm;
    Index best = -1;
    double nearest = most;
    for (Index e = 0; e < known_count_; ++e) {
      const Point off = known_[e].from_vehicle - at;
      const PointSquare S = known_[e].covariance + point.noise;
      if (off.squaredNorm() > most * S.trace()) continue;  // d^2 is at least that over the trace
      const double distance = squared_distance(off.data(), S.data(), Pose::kDim, Pose::kDim);
      if (distance >= 0.0 && distance <= nearest) nearest = distance, best = e;
    }
    if (best < 0) continue;
    Index& taken = taken_[best];
    if (taken >= 0 && distances_[taken] <= nearest) continue;
    if (taken < 0) taken = pair_count_++;
    pairs_[taken] = {i, best};
    distances_[taken] = nearest;
  }
}

template <class Pose>
typename SlipPairs<Pose>::Tangent SlipPairs<Pose>::fit() {
  Index count = 0;
  for (Index k = 0; k < pair_count_; ++k) {
    const PlacedPoint<Pose>& point = seen_[pairs_[k].seen].point;
    const Known& known = known_[pairs_[k].known];
    if (witnesses_[count].place(known.from_vehicle - point.arm, point.arm, known.covariance + point.noise)) ++count;
  }
  if (count == 0) return Tangent::Zero();
  return fit_motion(witnesses_, count, weak_prior(witnesses_, count), [](Index) { return true; });
}

// Hypotheses come from two observations and two landmarks as far apart as these. The best one has to explain more than
// half of the observations, and clearly more of them than any other motion does.
template <class Pose>
bool SlipPairs<Pose>::search(Index observations) {
  constexpr Index kCouples = 8, kHypotheses = 2000;
  constexpr int kRefinements = 3;
  constexpr double kSlack = 4.0;
  if (seen_count_ < kFewest || known_count_ < kFewest) return false;
  Point centre = Point::Zero();
  for (Index i = 0; i < seen_count_; ++i) centre += seen_[i].point.arm / static_cast<double>(seen_count_);
  const auto moved = [&](const Tangent& m) {
    return Point(m.template head<Pose::kDim>() + Pose::Rotation::exp(m.template tail<Pose::kTurn>()) * centre);
  };
  double widest = 0.0;
  for (Index i = 0; i < seen_count_; ++i) widest = std::max(widest, seen_[i].point.noise.trace());
  const double apart = kSlack * std::sqrt(bound() * widest);  // motions that differ by less are one

  Tangent best = Tangent::Zero();
  Index most = 0, second = 0, hypotheses = 0;
  for (Index c = 0; c < std::min(kCouples, seen_count_ / 2); ++c) {
    const Index i = c, j = c + seen_count_ / 2;
    const double length = (seen_[i].point.arm - seen_[j].point.arm).norm();
    for (Index e = 0; e < known_count_; ++e)
      for (Index f = 0; f < known_count_ && hypotheses < kHypotheses; ++f) {
        if (e == f) continue;
        const double other = (known_[e].from_vehicle - known_[f].from_vehicle).norm();
        const double variance =
            (seen_[i].point.noise + seen_[j].point.noise + known_[e].covariance + known_[f].covariance).trace();
        if ((length - other) * (length - other) > bound() * variance) continue;
        ++hypotheses;
        pairs_[0] = {i, e};
        pairs_[1] = {j, f};
        pair_count_ = 2;
        const Tangent motion = fit();
        if (!motion.allFinite()) continue;
        match(motion, kSlack);
        const bool same = most > 0 && (moved(motion) - moved(best)).norm() <= apart;
        if (pair_count_ > most) {
          if (!same) second = most;
          best = motion;
          most = pair_count_;
        } else if (!same) {
          second = std::max(second, pair_count_);
        }
      }
  }
  if (most < kFewest) return false;
  for (int k = 0; k < kRefinements; ++k) {
    match(best, k == 0 ? kSlack : 1.0);
    if (pair_count_ < kFewest) return false;
    best = fit();
  }
  match(best, 1.0);
  return pair_count_ >= kFewest && 2 * pair_count_ > observations && 2 * pair_count_ >= 3 * second;
}

template <class Pose>
void SlipPairs<Pose>::find(const Frame<Pose>& frame, SortedFrame<Pose>& sorted, FrameReport& report) {
  found_ = false;
  if (!lost(frame, sorted)) return;
  gather(frame);
  found_ = search(std::min(frame.landmarks, kObservations));
  repeat(frame, sorted, report);
}

template <class Pose>
bool SlipPairs<Pose>::repeat(const Frame<Pose>& frame, SortedFrame<Pose>& sorted, FrameReport& report) const {
  if (!found_) return false;
  sorted.clear();
  const State<Pose>& state = map_.state();
  for (Index i = 0; i < frame.landmarks; ++i)
    report.match(i) = {kNoId, Decision::rejected, Reason::contradicted, 0.0, 0.0};
  for (Index k = 0; k < pair_count_; ++k) {
    const Index observation = seen_[pairs_[k].seen].observation, slot = known_[pairs_[k].known].slot;
    Prediction<Pose> image;
    Match& match = report.match(observation);
    match.landmark = map_.table().id(slot);
    if (frame.sensor.predict(state.pose(), state.landmark(slot), MountError<Pose>::Zero(), image))
      sorted.add_candidate(frame, observation, slot, image);
    else
      match.reason = Reason::no_image;
  }
  return true;
}

template class SlipPairs<SE2>;
template class SlipPairs<SE3>;

}  // namespace cairn
