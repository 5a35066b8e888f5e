// SPDX-License-Identifier: BSD-3-Clause
// Pairs for a frame without ids after a motion that was far worse than its noise: no observation is near its landmark,
// but one rigid motion brings most of them onto well-known landmarks (docs/update.md, "Finding back").
#pragma once

#include "slam/frame_report.hpp"
#include "slam/local_map.hpp"
#include "slam/motion_trust.hpp"
#include "slam/placed_point.hpp"
#include "slam/sorted_frame.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

template <class Pose>
class SlipPairs {
 public:
  using Point = typename Pose::Point;
  using PointSquare = Eigen::Matrix<double, Pose::kDim, Pose::kDim>;
  using Tangent = typename Pose::Tangent;

  SlipPairs(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, const Thresholds& thresholds,
            const MotionTrust<Pose>& trust);

  // After association. If most landmarks that ought to be seen were not paired, and one motion explains the frame, then
  // `sorted` holds its pairs afterwards, and no observation is new. O(observations^2 landmarks), and only then.
  void find(const Frame<Pose>& frame, SortedFrame<Pose>& sorted, FrameReport& report);
  // The pairs that find() found in this frame, again. Returns false if it found none.
  bool repeat(const Frame<Pose>& frame, SortedFrame<Pose>& sorted, FrameReport& report) const;
  // The frame is done: remembers what was seen, if most of it was paired.
  void commit(const Frame<Pose>& frame, const FrameReport& report);

 private:
  static constexpr Index kObservations = 32, kLandmarks = 64, kFewest = 4;

  // What a sensor of a vehicle saw last.
  struct Memory {
    bool used;
    std::uint64_t vehicle, map_frame;
    Index count;
    std::uint64_t ids[kLandmarks];  // of well-known landmarks
    Vector3 least, most;            // of the values of all observations: what the sensor can see
  };
  struct Seen {
    Index observation;
    PlacedPoint<Pose> point;
  };
  struct Known {
    Index slot;
    Point from_vehicle;
    PointSquare covariance;  // relative to the vehicle
  };
  struct Pair {
    Index seen, known;
  };

  Memory& memory(int sensor) const;  // of the active vehicle
  bool lost(const Frame<Pose>& frame, const SortedFrame<Pose>& sorted) const;
  void gather(const Frame<Pose>& frame);
  void match(const Tangent& motion, double slack);
  Tangent fit();
  bool search(Index observations);
  double bound() const { return thresholds_.single(Pose::kDim); }

  const FilterOptions<Pose>& options_;
  const LocalMap<Pose>& map_;
  const Thresholds& thresholds_;
  const MotionTrust<Pose>& trust_;
  Memory* memories_;
  Seen* seen_;
  Known* known_;
  Index* taken_;              // by known landmark: the pair that has it
  double* distances_;         // by pair
  Pair* pairs_;               // of a hypothesis, or of what was found
  Witness<Pose>* witnesses_;  // by pair
  Index seen_count_ = 0, known_count_ = 0, pair_count_ = 0;
  bool found_ = false;
};

extern template class SlipPairs<SE2>;
extern template class SlipPairs<SE3>;

}  // namespace cairn
