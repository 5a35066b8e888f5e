// SPDX-License-Identifier: BSD-3-Clause
// Where refused observations say that young landmarks are. A landmark that was placed by a gross outlier is refused at
// every honest sighting: it does not count any more where as many sightings agree on another place, and is placed there
// where more of them do (docs/update.md, "A landmark that was placed wrongly").
#pragma once

#include <algorithm>

#include "core/id_table.hpp"
#include "slam/frame_report.hpp"
#include "slam/motion_trust.hpp"
#include "slam/sorted_frame.hpp"

namespace cairn {

template <class Pose>
class OtherPlaces {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Square = typename Pose::Square;
  using PointSquare = typename LocalMap<Pose>::PointSquare;

  OtherPlaces(Arena& arena, const FilterOptions<Pose>& options, LocalMap<Pose>& map, const Thresholds& thresholds,
              const MotionTrust<Pose>& trust, FrameReport& report);

  void moved(const Increment<Pose>& increment);  // the active vehicle
  void forget() { ++generation_; }               // all places: the motion was not as stated

  // Whether gross errors were so many in earlier frames that an observation alone should place no landmark.
  bool gross_errors_are_many() const { return share_.large(); }

  // --- one frame with known ids, in this order ---
  // After the gates. Observations that place their landmark again are added to the new ones of `sorted`. Asks the
  // sensor, and changes nothing else: the update may still throw.
  void judge(const Frame<Pose>& frame, SortedFrame<Pose>& sorted);
  // After the update and the placing.
  void commit();

 private:
  bool judges() const { return options_.association == AssociationKind::known; }

  static constexpr Index kPlaces = 3;  // of a landmark
  struct Place {
    Point position;           // by dead reckoning
    PointSquare noise;        // of the observation
    PointSquare drift;        // of the dead reckoning until then
    std::uint64_t sightings;  // that agree
  };
  struct Landmark {
    std::uint64_t id, vehicle, generation;
    bool used;
    Index count;
    Place places[kPlaces];
  };
  struct Judged {
    std::uint64_t id;
    Place place;
    Index agrees;  // with this place of the landmark; kPlaces: with none
    bool again;    // the landmark is placed again
    bool contested;
  };
  // Pose by dead reckoning, and the covariance of its error. The error is the invariant one, to which each step only
  // adds: the difference of two covariances is that of the motion between.
  struct Reckoning {
    std::uint64_t vehicle;
    bool used;
    Pose pose;
    Square drift;
  };

  // What the refused observations of a frame may do, by how far the frame agrees with the estimate. Their places are
  // remembered if they may do anything.
  struct Trust {
    bool contest, place;
  };

  // The share of gross errors among the latest observations of known landmarks. Frames that say nothing do not count.
  class GrossShare {
   public:
    void add(Index gross, Index compared) {
      constexpr double kFades = 300.0;  // observations
      const double kept = std::max(0.0, 1.0 - static_cast<double>(compared) / kFades);
      gross_ = kept * gross_ + static_cast<double>(gross);
      compared_ = kept * compared_ + static_cast<double>(compared);
    }
    bool large() const {
      constexpr double kLarge = 0.05, kFewest = 20.0;  // of so many observations
      return gross_ > kLarge * std::max(compared_, kFewest);
    }

   private:
    double gross_ = 0.0, compared_ = 0.0;
  };

  Reckoning& reckoning();
  const Landmark* find(std::uint64_t id) const;
  Landmark& find_or_make(std::uint64_t id);
  Trust trust_in(const Frame<Pose>& frame) const;
  bool is_gross(const Frame<Pose>& frame, const Match& match) const;
  bool judge_one(const Frame<Pose>& frame, Index observation, const Trust& trust, Judged& judged);
  bool same(const Frame<Pose>& frame, const Reckoning& now, const Vector3& z, const Matrix3& R,
            const Place& place) const;
  static PointSquare drift_at(const Point& position, const Square& drift);

  const FilterOptions<Pose>& options_;
  LocalMap<Pose>& map_;
  const Thresholds& thresholds_;
  const MotionTrust<Pose>& trust_;
  FrameReport& report_;
  IdTable ids_;
  Landmark* landmarks_;
  Reckoning* reckonings_;  // one a vehicle
  Judged* judged_;         // of the frame
  GrossShare share_;
  Index frame_gross_ = 0, frame_compared_ = 0;  // of the frame that judge() saw
  Index capacity_, next_ = 0, count_ = 0;
  std::uint64_t generation_ = 0;
  double gross_[kMostRows + 1] = {};  // by rows
};

extern template class OtherPlaces<SE2>;
extern template class OtherPlaces<SE3>;

}  // namespace cairn
