// SPDX-License-Identifier: BSD-3-Clause
#include "slam/other_places.hpp"

#include "core/chi_square.hpp"
#include "slam/placed_point.hpp"
#include "slam/vehicle_records.hpp"

namespace cairn {
namespace {

// Landmarks whose other places are kept: those of some frames with nothing but young landmarks. None without known ids.
template <class Pose>
Index most_landmarks(const FilterOptions<Pose>& options) {
  constexpr Index kFrames = 4;
  return options.association == AssociationKind::known ? kFrames * options.max_observations : 1;
}

bool refused(const Match& match) {
  return match.reason == Reason::gate || match.reason == Reason::batch_gate || match.reason == Reason::no_image;
}

}  // namespace

template <class Pose>
OtherPlaces<Pose>::OtherPlaces(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map,
                               const Thresholds& thresholds, const MotionTrust<Pose>& trust, FrameReport& report)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      trust_(trust),
      report_(report),
      ids_(arena, static_cast<std::size_t>(most_landmarks(options))),
      landmarks_(arena.take<Landmark>(static_cast<std::size_t>(most_landmarks(options)))),
      reckonings_(arena.take<Reckoning>(static_cast<std::size_t>(options.max_companions + 1))),
      judged_(arena.take<Judged>(static_cast<std::size_t>(options.max_observations))),
      capacity_(most_landmarks(options)) {
  for (int rows = 1; rows <= kMostRows && !arena.measuring(); ++rows)
    gross_[rows] = chi_square_quantile(rows, 1.0 - kGrossChance);
}

template <class Pose>
typename OtherPlaces<Pose>::Reckoning& OtherPlaces<Pose>::reckoning() {
  const std::uint64_t vehicle = map_.table().vehicle();
  Reckoning& own = record_of(reckonings_, options_.max_companions + 1, vehicle);
  if (!belongs(own, vehicle)) {
    if (own.used) forget();
    own = {vehicle, true, Pose(), Square::Zero()};
  }
  return own;
}

template <class Pose>
void OtherPlaces<Pose>::moved(const Increment<Pose>& increment) {
  constexpr double kFarthest = 1e4;  // m: beyond it, rounding would count beside the noise of an observation
  if (!judges()) return;
  Reckoning& own = reckoning();
  const Pose before = own.pose;
  own.pose = own.pose * increment.T_before_after;
  const Square B = ErrorModel<Pose>(ErrorKind::invariant).by_increment(before, own.pose);
  own.drift += B * increment.covariance * B.transpose();
  if (own.pose.translation().norm() <= kFarthest && own.drift.trace() <= kFarthest * kFarthest) return;
  own.used = false;  // starts again
  forget();
}

// Covariance of the drift of a point that stays where it is: e_x = xi_p + G(x) xi_R.
template <class Pose>
typename OtherPlaces<Pose>::PointSquare OtherPlaces<Pose>::drift_at(const Point& position, const Square& drift) {
  typename State<Pose>::PointByPose J;
  J.template leftCols<kDim>().setIdentity();
  J.template rightCols<kTurn>() = ErrorModel<Pose>::arm(position);
  return J * drift * J.transpose();
}

template <class Pose>
const typename OtherPlaces<Pose>::Landmark* OtherPlaces<Pose>::find(std::uint64_t id) const {
  const std::int32_t at = ids_.find(id);
  if (at == IdTable::kAbsent) return nullptr;
  const Landmark& landmark = landmarks_[at];
  return landmark.generation == generation_ && landmark.vehicle == map_.table().vehicle() ? &landmark : nullptr;
}

// If there is none, a new one takes the place of the one that was made first.
template <class Pose>
typename OtherPlaces<Pose>::Landmark& OtherPlaces<Pose>::find_or_make(std::uint64_t id) {
  std::int32_t at = ids_.find(id);
  if (find(id) != nullptr) return landmarks_[at];
  if (at == IdTable::kAbsent) {
    at = static_cast<std::int32_t>(next_);
    if (landmarks_[at].used) ids_.erase(landmarks_[at].id);
    ids_.set(id, at);
    next_ = (next_ + 1) % capacity_;
  }
  Landmark& landmark = landmarks_[at];
  landmark.id = id;
  landmark.vehicle = map_.table().vehicle();
  landmark.generation = generation_;
  landmark.used = true;
  landmark.count = 0;
  return landmark;
}

// A refused observation of a landmark that was seen once says nothing about the frame: either of the two may be wrong.
// One or two such landmarks, alone in a frame, may all be wrong; if there are more, rather the pose is.
template <class Pose>
typename OtherPlaces<Pose>::Trust OtherPlaces<Pose>::trust_in(const Frame<Pose>& frame) const {
  const LandmarkTable& table = map_.table();
  constexpr Index kAlone = 2;
  Index known = 0, accepted = 0, against = 0, witnesses = 0, refused_witnesses = 0;
  for (Index i = 0; i < frame.landmarks; ++i) {
    const Match& match = report_.match(i);
    if (match.landmark == kNoId) continue;
    const std::optional<Index> slot = table.find(match.landmark);
    if (!slot) continue;
    const bool out = refused(match);
    ++known;
    if (!out) ++accepted;
    if (out && table.observations(*slot) > 1) ++against;
    if (!trust_.is_witness(*slot)) continue;
    ++witnesses;
    if (out) ++refused_witnesses;
  }
  if (accepted == 0) return {false, against == 0 && known <= kAlone};
  const bool agrees = 2 * accepted >= against && 2 * refused_witnesses <= witnesses;
  return {agrees, agrees && accepted > against};
}

// Whether an observation with the noise R agrees with a place.
template <class Pose>
bool OtherPlaces<Pose>::same(const Frame<Pose>& frame, const Reckoning& now, const Vector3& z, const Matrix3& R,
                             const Place& place) const {
  constexpr double kWiden = 4.0;  // a motion that adds more to a variance makes the test say nothing
  Prediction<Pose> prediction;
  if (!frame.sensor.predict(now.pose, place.position, MountError<Pose>::Zero(), prediction)) return false;
  const Vector3 residual = frame.sensor.residual(z, prediction.z);
  const auto& J = prediction.J_z_landmark;
  const Matrix3 still = R + J * place.noise * J.transpose();
  const Matrix3 S = still + J * (drift_at(place.position, now.drift) - place.drift) * J.transpose();
  const int rows = frame.sensor.rows();
  for (int r = 0; r < rows; ++r)
    if (!(S(r, r) <= kWiden * still(r, r))) return false;
  const double distance = squared_distance(residual.data(), S.data(), kMostRows, rows);
  return distance >= 0.0 && distance <= thresholds_.single(rows);
}

template <class Pose>
bool OtherPlaces<Pose>::is_gross(const Frame<Pose>& frame, const Match& match) const {
  return match.reason == Reason::no_image ||
         (match.reason == Reason::gate && match.distance > gross_[frame.sensor.rows()]);
}

template <class Pose>
bool OtherPlaces<Pose>::judge_one(const Frame<Pose>& frame, Index observation, const Trust& trust, Judged& judged) {
  const Match& match = report_.match(observation);
  const std::optional<Index> slot = map_.table().find(match.landmark);
  if (!slot || trust_.is_witness(*slot)) return false;
  const Reckoning& now = reckoning();
  const Vector3 z = frame.z(observation);
  PlacedPoint<Pose> seen;
  if (!seen.place(frame, observation, now.pose, 1.0)) return false;
  const Point position = now.pose.translation() + seen.arm;
  Matrix3 R = frame.noise(observation);
  if (frame.sensor.mount_noise_mode() != MountNoise::none) {
    Prediction<Pose> prediction;
    if (!frame.sensor.predict(now.pose, position, MountError<Pose>::Zero(), prediction)) return false;
    R += prediction.J_z_mount * frame.sensor.mount_noise() * prediction.J_z_mount.transpose();
  }
  judged = {match.landmark, {position, seen.noise, drift_at(position, now.drift), 1}, kPlaces, false, false};
  const Landmark* known = find(match.landmark);
  for (Index k = 0; known != nullptr && k < known->count; ++k) {
    const Place& place = known->places[k];
    if (place.sightings < judged.place.sightings || !same(frame, now, z, R, place)) continue;
    judged.place.sightings = place.sightings + 1;
    judged.agrees = k;
  }
  const std::uint64_t here = map_.table().observations(*slot);
  judged.again = trust.place && judged.place.sightings > here;
  judged.contested = trust.contest && !judged.again && judged.place.sightings >= here && is_gross(frame, match);
  return true;
}

template <class Pose>
void OtherPlaces<Pose>::judge(const Frame<Pose>& frame, SortedFrame<Pose>& sorted) {
  count_ = frame_gross_ = frame_compared_ = 0;
  if (!judges() || !frame.sensor.relative()) return;
  const Trust trust = trust_in(frame);
  if (!trust.contest && !trust.place) return;
  for (Index i = 0; i < frame.landmarks; ++i) {
    const Match& match = report_.match(i);
    if (match.landmark == kNoId) continue;
    if (trust.contest) ++frame_compared_;
    if (!refused(match)) continue;
    if (trust.contest && is_gross(frame, match)) ++frame_gross_;
    if (!judge_one(frame, i, trust, judged_[count_])) continue;
    if (judged_[count_].again) sorted.add_again(i);
    ++count_;
  }
}

template <class Pose>
void OtherPlaces<Pose>::commit() {
  share_.add(frame_gross_, frame_compared_);
  for (Index i = 0; i < count_; ++i) {
    const Judged& judged = judged_[i];
    Landmark& landmark = find_or_make(judged.id);
    if (judged.again) {
      landmark.count = 0;
      continue;
    }
    Index at = judged.agrees;
    if (at == kPlaces && landmark.count < kPlaces) at = landmark.count++;
    if (at == kPlaces) {  // the oldest of those on which the fewest agree
      at = 0;
      for (Index k = 1; k < kPlaces; ++k)
        if (landmark.places[k].sightings < landmark.places[at].sightings) at = k;
    }
    std::move(landmark.places + at + 1, landmark.places + landmark.count, landmark.places + at);
    landmark.places[landmark.count - 1] = judged.place;
    if (judged.contested) map_.contest(map_.slot_at(judged.id), judged.place.sightings);
  }
  count_ = 0;
}

template class OtherPlaces<SE2>;
template class OtherPlaces<SE3>;

}  // namespace cairn
