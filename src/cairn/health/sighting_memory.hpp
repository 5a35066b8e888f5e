// SPDX-License-Identifier: BSD-3-Clause
// The last sightings of each landmark that was seen lately, in a fixed block of memory.
#pragma once

#include "core/arena.hpp"
#include "core/id_table.hpp"
#include "health/contradiction.hpp"
#include "health/persistence.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

// Differences are taken over so many frames of a sensor: the noise of a motion that is small beside that of the sensor
// shows only over several frames.
constexpr Index kStrides = 3;
constexpr std::uint64_t kStride[kStrides] = {1, 4, 16};

template <class Pose>
class SightingMemory {
 public:
  using PointSquare = Eigen::Matrix<double, Pose::kDim, Pose::kDim>;

  // What an update left of an observation.
  struct Anchor {
    Index sensor = 0;
    std::uint64_t frame = 0;  // of the sensor; 0: there is none
    Vector3 residual = Vector3::Zero();
    Matrix3 noise = Matrix3::Zero();               // R - J P J^T: of the residual, for the stated noise R
    typename Pose::Point y = Pose::Point::Zero();  // the landmark in the body frame
    PointSquare P = PointSquare::Zero();           // of y
  };
  struct Sighting {
    std::uint64_t landmark = 0;
    bool used = false;
    Anchor anchors[kStrides];
    bool jumped = false;  // between its last two sightings
    PastErrors past;
    Contradiction contradiction;
  };

  SightingMemory(Arena& arena, Index capacity)
      : ids_(arena, static_cast<std::size_t>(capacity)),
        sightings_(arena.take<Sighting>(static_cast<std::size_t>(capacity))),
        capacity_(capacity) {}

  Sighting* find(std::uint64_t landmark) {
    const std::int32_t place = ids_.find(landmark);
    return place == IdTable::kAbsent ? nullptr : sightings_ + place;
  }
  // The landmark's sighting; if there is none, a new one takes the place of the one that was made first.
  Sighting& find_or_make(std::uint64_t landmark) {
    if (Sighting* known = find(landmark)) return *known;
    Sighting& place = sightings_[next_];
    if (place.used) ids_.erase(place.landmark);
    ids_.set(landmark, static_cast<std::int32_t>(next_));
    next_ = (next_ + 1) % capacity_;
    place = Sighting();
    place.landmark = landmark;
    place.used = true;
    return place;
  }

 private:
  IdTable ids_;
  Sighting* sightings_;
  Index capacity_, next_ = 0;
};

}  // namespace cairn
