// SPDX-License-Identifier: BSD-3-Clause
// The pairs of a frame without ids: observations and landmarks that pass the gate of a single pair, and for each
// observation the nearest landmark (docs/association.md).
#pragma once

#include "association/association.hpp"
#include "association/frame_index.hpp"
#include "slam/frame.hpp"
#include "slam/local_map.hpp"
#include "slam/thresholds.hpp"

namespace cairn {

template <class Pose>
class FramePairs {
 public:
  static constexpr Index kMostOfOne = 8;  // pairs of one observation: the best ones

  // The predicted observation of a landmark.
  struct Image {
    Index slot;
    bool in_window;  // it belongs to a pair
    Index window;    // its number among the landmarks of all pairs
    Prediction<Pose> prediction;
    Matrix3 covariance;  // of the prediction
  };
  struct Pair {
    Index image;
    Vector3 residual;
    Matrix3 innovation;  // covariance of the residual: that of the prediction and the observation's noise
  };
  struct Nearest {
    std::uint64_t landmark;
    double distance;  // infinite: no landmark is within the threshold of a new one
  };

  FramePairs(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map, const Thresholds& thresholds);

  void find(const Frame<Pose>& frame);

  Index images() const { return image_count_; }
  const Image& image(Index number) const { return images_[number]; }
  const Image& image_of_pair(Index pair) const { return images_[pairs_[pair].image]; }
  Index pairs() const { return pair_count_; }
  const Pair& pair(Index number) const { return pairs_[number]; }
  const PairCandidate* candidates() const { return candidates_; }  // one a pair
  const Nearest& nearest(Index observation) const { return nearest_[observation]; }
  const Matrix3& noise(Index observation) const { return noise_[observation]; }
  const Index* window() const { return window_; }  // slots of the landmarks of all pairs
  Index window_count() const { return window_count_; }

 private:
  void predict_images(const Sensor<Pose>& sensor);
  void consider(const Frame<Pose>& frame, Index observation, Index image);
  void gather(Index observations);

  const FilterOptions<Pose>& options_;
  const LocalMap<Pose>& map_;
  const Thresholds& thresholds_;
  Index most_window_;
  FrameIndex index_;
  Image* images_;
  PairCandidate* candidates_;
  Pair* pairs_;
  Index* window_;
  Nearest* nearest_;  // by observation, as are the next two
  Matrix3* noise_;
  Index* found_;  // number of pairs
  Index image_count_ = 0, pair_count_ = 0, window_count_ = 0;
};

extern template class FramePairs<SE2>;
extern template class FramePairs<SE3>;

// The capacity of association.
template <class Pose>
struct AssociationCapacity {
  explicit AssociationCapacity(const FilterOptions<Pose>& options)
      : landmarks(options.association == AssociationKind::known ? 0 : options.local_landmarks()),
        observations(landmarks == 0 ? 0 : options.max_observations),
        pairs(FramePairs<Pose>::kMostOfOne * observations),
        window(std::min(landmarks, 2 * observations)) {}
  Index landmarks, observations, pairs, window;
};

}  // namespace cairn
