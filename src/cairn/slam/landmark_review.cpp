// SPDX-License-Identifier: BSD-3-Clause
// Deferred and missed landmarks.
#include "slam/landmark_review.hpp"

#include <cmath>

#include "slam/image.hpp"

namespace cairn {

template <class Pose>
LandmarkReview<Pose>::LandmarkReview(const FilterOptions<Pose>& options, LocalMap<Pose>& map, FrameReport& report)
    : options_(options), map_(map), report_(report) {}

template <class Pose>
void LandmarkReview<Pose>::prepare(const Frame<Pose>& frame) {
  LandmarkTable& table = map_.table();
  if (options_.missed_frames == 0 || frame.view == nullptr) return;
  for (Index slot = table.companions(); slot < table.size(); ++slot)
    table.sightings(slot).in_view = in_view(frame, slot);
}

template <class Pose>
void LandmarkReview<Pose>::run(const Frame<Pose>& frame) {
  const bool defers = options_.deferred_sightings > 1, misses = options_.missed_frames > 0;
  map_.table().next_frame();
  if (!defers && !misses && map_.table().deferred() == 0) return;
  note_sightings(frame.landmarks);
  promote();
  if (defers) {
    remove_contradicted(frame.landmarks);
    remove_unconfirmed();
  } else {
    make_room();
  }
  if (misses && frame.view != nullptr) remove_missed(frame);
  report_.last().deferred = map_.table().deferred();
}

// A landmark that an observation was compared with is not missed, even if that observation was rejected.
template <class Pose>
void LandmarkReview<Pose>::note_sightings(Index observations) {
  LandmarkTable& table = map_.table();
  for (Index i = 0; i < observations; ++i) {
    const std::uint64_t id = report_.matches()[i].landmark;
    if (id == kNoId) continue;
    const std::optional<Index> slot = table.find(id);
    if (!slot) continue;
    table.sightings(*slot).seen = table.frame();
    table.sightings(*slot).missed = 0;
  }
}

template <class Pose>
void LandmarkReview<Pose>::promote() {
  LandmarkTable& table = map_.table();
  for (Index slot = table.first_deferred(); slot < table.size(); ++slot)
    if (table.observations(slot) >= static_cast<std::uint64_t>(options_.deferred_sightings) &&
        table.observations(slot) > table.sightings(slot).elsewhere)
      map_.count_from_now(slot);
}

template <class Pose>
void LandmarkReview<Pose>::remove(Index slot) {
  map_.forget(slot);
  ++report_.last().removed;
}

// Of a deferred landmark and a refused observation by its id, one is wrong, and nobody knows which: the next
// observation places it again.
template <class Pose>
void LandmarkReview<Pose>::remove_contradicted(Index observations) {
  if (options_.association != AssociationKind::known) return;
  for (Index i = 0; i < observations; ++i) {
    const Match& match = report_.matches()[i];
    if (match.reason != Reason::gate && match.reason != Reason::batch_gate) continue;
    const std::optional<Index> slot = map_.table().find(match.landmark);
    if (slot && !map_.table().counts(*slot)) remove(*slot);
  }
}

template <class Pose>
void LandmarkReview<Pose>::remove_unconfirmed() {
  LandmarkTable& table = map_.table();
  for (Index slot = table.size(); slot-- > table.first_deferred();)
    if (table.frame() - table.sightings(slot).placed > static_cast<std::uint64_t>(options_.deferred_frames))
      remove(slot);
}

// A submap that is full of landmarks of which none counts can neither grow nor be closed.
template <class Pose>
void LandmarkReview<Pose>::make_room() {
  LandmarkTable& table = map_.table();
  if (table.counting() > 0 || table.landmarks() < options_.local_landmarks()) return;
  while (table.deferred() > 0) remove(table.size() - 1);
}

template <class Pose>
void LandmarkReview<Pose>::remove_missed(const Frame<Pose>& frame) {
  LandmarkTable& table = map_.table();
  for (Index slot = table.size(); slot-- > table.companions();) {
    LandmarkTable::Sightings& own = table.sightings(slot);
    if (own.seen == table.frame() || !(frame.sensor.may_abort() ? own.in_view : in_view(frame, slot))) continue;
    if (++own.missed >= options_.missed_frames) remove(slot);
  }
}

// Whether the sensor should see a landmark: its image is at least three standard deviations inside the view.
template <class Pose>
bool LandmarkReview<Pose>::in_view(const Frame<Pose>& frame, Index slot) const {
  constexpr double kOff = 3.0;
  const View& view = *frame.view;
  Prediction<Pose> prediction;
  Matrix3 S;
  if (!image_of(map_.state(), frame.sensor, slot, prediction, S)) return false;
  for (int r = 0; r < frame.sensor.rows(); ++r) {
    const double off = kOff * std::sqrt(S(r, r));
    if (!(prediction.z[r] - off >= view.lower[r] && prediction.z[r] + off <= view.upper[r])) return false;
  }
  return true;
}

template class LandmarkReview<SE2>;
template class LandmarkReview<SE3>;

}  // namespace cairn
