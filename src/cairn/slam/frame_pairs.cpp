// SPDX-License-Identifier: BSD-3-Clause
// Finds the pairs of a frame.
#include "slam/frame_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "association/doubt.hpp"
#include "slam/image.hpp"

namespace cairn {

template <class Pose>
FramePairs<Pose>::FramePairs(Arena& arena, const FilterOptions<Pose>& options, const LocalMap<Pose>& map,
                             const Thresholds& thresholds)
    : options_(options),
      map_(map),
      thresholds_(thresholds),
      most_window_(AssociationCapacity<Pose>(options).window),
      index_(arena, AssociationCapacity<Pose>(options).observations) {
  const AssociationCapacity<Pose> most(options);
  images_ = arena.take<Image>(static_cast<std::size_t>(most.landmarks));
  candidates_ = arena.take<PairCandidate>(static_cast<std::size_t>(most.pairs));
  pairs_ = arena.take<Pair>(static_cast<std::size_t>(most.pairs));
  window_ = arena.take<Index>(static_cast<std::size_t>(most.window));
  nearest_ = arena.take<Nearest>(static_cast<std::size_t>(most.observations));
  noise_ = arena.take<Matrix3>(static_cast<std::size_t>(most.observations));
  found_ = arena.take<Index>(static_cast<std::size_t>(most.observations));
}

// The images of all landmarks that give one.
template <class Pose>
void FramePairs<Pose>::predict_images(const Sensor<Pose>& sensor) {
  image_count_ = 0;
  for (Index slot = map_.table().companions(); slot < map_.table().size(); ++slot) {
    Image& next = images_[image_count_];
    if (!image_of(map_.state(), sensor, slot, next.prediction, next.covariance)) continue;
    ++image_count_;
    next.slot = slot;
    next.in_window = false;
    if (sensor.mount_noise_mode() != MountNoise::none)
      next.covariance += next.prediction.J_z_mount * sensor.mount_noise() * next.prediction.J_z_mount.transpose();
  }
}

// A pair is within the bound only if nu_r^2 <= bound S_rr in each row r. Observations and images are sorted by one row,
// so that most pairs are never looked at.
template <class Pose>
void FramePairs<Pose>::find(const Frame<Pose>& frame) {
  constexpr double kRounding = 1.0 + 1e-9;
  predict_images(frame.sensor);
  const Index count = frame.landmarks;
  const int row = frame.sensor.plain_row();
  const double bound = thresholds_.new_landmark(frame.sensor.rows());
  double widest = 0.0;
  for (Index i = 0; i < count; ++i) {
    noise_[i] = frame.noise(i);
    found_[i] = 0;
    nearest_[i] = {kNoId, std::numeric_limits<double>::infinity()};
    if (row >= 0) widest = std::max(widest, noise_[i](row, row));
  }
  index_.build(count, [&](Index i) { return row >= 0 ? frame.observations[i].z[row] : 0.0; });
  for (Index e = 0; e < image_count_; ++e) {
    const Image& image = images_[e];
    const double centre = row >= 0 ? image.prediction.z[row] : 0.0;
    const double reach = row >= 0 ? std::sqrt(bound * (image.covariance(row, row) + widest)) * kRounding
                                  : std::numeric_limits<double>::infinity();
    index_.near(centre, reach, [&](Index i) { consider(frame, i, e); });
  }
  gather(count);
}

template <class Pose>
void FramePairs<Pose>::consider(const Frame<Pose>& frame, Index observation, Index image) {
  const Index rows = frame.sensor.rows(), begin = kMostOfOne * observation;
  const double bound = thresholds_.new_landmark(rows), gate = std::min(thresholds_.single(rows), bound);
  const Vector3 residual = frame.sensor.residual(frame.z(observation), images_[image].prediction.z);
  const Matrix3 S = images_[image].covariance + noise_[observation];
  const double distance = distance_within(residual, S, rows, bound);
  if (distance > bound) return;
  Nearest& nearest = nearest_[observation];
  if (distance < nearest.distance) nearest = {map_.table().id(images_[image].slot), distance};
  if (!(distance <= gate)) return;
  // The likelihood of a pair also depends on how wide its gate is: -2 log p = d^2 + log det S + constant.
  const double cost =
      options_.by_likelihood ? distance + std::log(S.topLeftCorner(rows, rows).determinant()) : distance;
  Index at = begin + found_[observation];  // sorted by cost; if there is no room, the worst pair is dropped
  if (at - begin == kMostOfOne && cost >= candidates_[--at].distance) return;
  for (; at > begin && cost < candidates_[at - 1].distance; --at) {
    candidates_[at] = candidates_[at - 1];
    pairs_[at] = pairs_[at - 1];
  }
  candidates_[at] = {observation, image, cost};
  pairs_[at] = {image, residual, S};
  found_[observation] = std::min(found_[observation] + 1, kMostOfOne);
}

// Closes the gaps that the fixed room of each observation left, and numbers the landmarks of all pairs. If there are
// more landmarks than the window holds, the landmarks of earlier observations are used.
template <class Pose>
void FramePairs<Pose>::gather(Index observations) {
  pair_count_ = window_count_ = 0;
  for (Index i = 0; i < observations; ++i)
    for (Index p = kMostOfOne * i; p < kMostOfOne * i + found_[i]; ++p) {
      Image& image = images_[pairs_[p].image];
      if (!image.in_window) {
        if (window_count_ == most_window_) continue;
        image.in_window = true;
        image.window = window_count_;
        window_[window_count_++] = image.slot;
      }
      candidates_[pair_count_] = candidates_[p];
      candidates_[pair_count_].landmark = image.window;
      pairs_[pair_count_++] = pairs_[p];
    }
}

template class FramePairs<SE2>;
template class FramePairs<SE3>;

}  // namespace cairn
