// SPDX-License-Identifier: BSD-3-Clause
// Which landmark each observation of a frame is of, where the frame brings no names (docs/association.md). Included by
// filter.cpp alone.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "association/doubt.hpp"
#include "slam/filter.hpp"

namespace cairn {

template <class Pose>
Filter<Pose>::Unknowns::Unknowns(Arena& arena, const FilterOptions<Pose>& options)
    : most_landmarks(options.association == AssociationKind::known ? 0 : options.local_landmarks()),
      most_observations(most_landmarks == 0 ? 0 : options.max_observations),
      most_pairs(kPairs * most_observations),
      most_window(std::min(most_landmarks, 2 * most_observations)),
      association(arena, {most_observations, most_pairs, most_window}),
      frame(arena, most_observations),
      expected(arena.take<Expected>(static_cast<std::size_t>(most_landmarks))),
      pairs(arena.take<PairCandidate>(static_cast<std::size_t>(most_pairs))),
      details(arena.take<Pair>(static_cast<std::size_t>(most_pairs))),
      window(arena.take<Index>(static_cast<std::size_t>(most_window))),
      covariance(arena.take<double>(
          most_landmarks == 0 ? 0
                              : static_cast<std::size_t>((kDof + kDim * most_window) * (kDof + kDim * most_window)))),
      nearest(arena.take<Match>(static_cast<std::size_t>(most_observations))),
      noise(arena.take<Matrix3>(static_cast<std::size_t>(most_observations))),
      pairs_of(arena.take<Index>(static_cast<std::size_t>(most_observations))) {}

// Of the pairs that were found.
template <class Pose>
class Filter<Pose>::PairInnovations final : public Innovations {
 public:
  PairInnovations(Filter& filter, const Sensor<Pose>& sensor)
      : filter_(filter),
        unknowns_(filter.unknowns_),
        rows_(sensor.rows()),
        common_mount_(sensor.mount_noise_mode() == MountNoise::per_frame
                          ? sensor.mount_noise()
                          : MountSquare<Pose>(MountSquare<Pose>::Zero())) {}

  Index rows() const override { return rows_; }
  double threshold(Index rows) const override { return filter_.batch_threshold(rows); }
  void innovation(Index a, double* nu) const override { std::copy_n(unknowns_.details[a].residual.data(), rows_, nu); }
  // J_a P J_b^T, and the noise of the mount's angles where all of a frame have it in common.
  void covariance(Index a, Index b, double* block) const override {
    Matrix3 S;
    if (a == b) {
      S = unknowns_.details[a].innovation;
    } else {
      const Expected &first = expected(a), &second = expected(b);
      const Index n = kDof + kDim * unknowns_.window_count;
      S = image_covariance(Eigen::Map<const Eigen::MatrixXd>(unknowns_.covariance, n, n), first.prediction,
                           first.window, second.prediction, second.window) +
          first.prediction.J_z_mount * common_mount_ * second.prediction.J_z_mount.transpose();
    }
    for (Index c = 0; c < rows_; ++c) std::copy_n(S.data() + 3 * c, rows_, block + rows_ * c);
  }

 private:
  const Expected& expected(Index pair) const { return unknowns_.expected[unknowns_.details[pair].expected]; }

  Filter& filter_;
  const Unknowns& unknowns_;
  Index rows_;
  MountSquare<Pose> common_mount_;
};

template <class Pose>
bool Filter<Pose>::image_of(const Sensor<Pose>& sensor, Index slot, Prediction<Pose>& prediction,
                            Matrix3& covariance) const {
  if (!sensor.predict(ekf_.pose(), ekf_.landmark(slot), Mount::Zero(), prediction)) return false;
  if (sensor.relative()) {
    const auto& J = prediction.J_z_landmark;
    covariance.noalias() = J.lazyProduct((ekf_.relative_covariance(slot).lazyProduct(J.transpose())).eval());
    return true;
  }
  constexpr Index n = kDof + kDim;
  double P[n * n];
  ekf_.gather_ordinary(&slot, 1, P, n);
  covariance = image_covariance(Eigen::Map<const Eigen::MatrixXd>(P, n, n), prediction, 0, prediction, 0);
  return true;
}

// Images of all landmarks that give one, with their covariance.
template <class Pose>
void Filter<Pose>::predict_all(const Sensor<Pose>& sensor) {
  unknowns_.expected_count = 0;
  for (Index slot = ekf_.companions(); slot < ekf_.size(); ++slot) {
    Expected& next = unknowns_.expected[unknowns_.expected_count];
    if (!image_of(sensor, slot, next.prediction, next.innovation)) continue;
    ++unknowns_.expected_count;
    next.slot = slot;
    next.window = kUnpaired;
    next.paired = false;
    if (sensor.mount_noise_mode() != MountNoise::none)
      next.innovation += next.prediction.J_z_mount * sensor.mount_noise() * next.prediction.J_z_mount.transpose();
  }
}

// Pairs that pass the gate of one, the nearest of each observation; and the nearest landmark of each whatever it
// passes. No pair is within the bound whose values of one row are farther apart than that row's variance lets them be:
// nu_r^2 <= bound S_rr.
template <class Pose>
void Filter<Pose>::find_pairs(const Sensor<Pose>& sensor, Index count) {
  constexpr double kRounding = 1.0 + 1e-9;
  Unknowns& u = unknowns_;
  const int row = sensor.plain_row();
  const double bound = new_thresholds_[sensor.rows()];
  double widest = 0.0;
  for (Index i = 0; i < count; ++i) {
    u.noise[i] = noise_of(sensor, observations_[i]);
    u.pairs_of[i] = 0;
    u.nearest[i] = Match();
    u.nearest[i].distance = std::numeric_limits<double>::infinity();
    if (row >= 0) widest = std::max(widest, u.noise[i](row, row));
  }
  u.frame.build(count, [&](Index i) { return row >= 0 ? observations_[i].z[row] : 0.0; });
  for (Index e = 0; e < u.expected_count; ++e) {
    const Expected& expected = u.expected[e];
    const double centre = row >= 0 ? expected.prediction.z[row] : 0.0;
    const double reach = row >= 0 ? std::sqrt(bound * (expected.innovation(row, row) + widest)) * kRounding
                                  : std::numeric_limits<double>::infinity();
    u.frame.near(centre, reach, [&](Index i) { consider_pair(sensor, i, e); });
  }
  gather_pairs(count);
}

template <class Pose>
void Filter<Pose>::consider_pair(const Sensor<Pose>& sensor, Index observation, Index e) {
  Unknowns& u = unknowns_;
  const Index rows = sensor.rows(), begin = Unknowns::kPairs * observation;
  const double bound = new_thresholds_[rows], gate = std::min(gate_thresholds_[rows], bound);
  const Vector3 residual = sensor.residual(Vector3(observations_[observation].z), u.expected[e].prediction.z);
  const Matrix3 S = u.expected[e].innovation + u.noise[observation];
  const double distance = distance_within(residual, S, rows, bound);
  if (distance > bound) return;
  Match& nearest = u.nearest[observation];
  if (distance < nearest.distance) {
    nearest.distance = distance;
    nearest.landmark = ids_[u.expected[e].slot];
  }
  if (!(distance <= gate)) return;
  // The likelihood of a pair also asks how wide its gate is: -2 log p = d^2 + log det S but for a constant.
  const double cost =
      options_.by_likelihood ? distance + std::log(S.topLeftCorner(rows, rows).determinant()) : distance;
  Index at = begin + u.pairs_of[observation];  // sorted by cost; the worst goes where there is no room
  if (at - begin == Unknowns::kPairs && cost >= u.pairs[--at].distance) return;
  for (; at > begin && cost < u.pairs[at - 1].distance; --at) {
    u.pairs[at] = u.pairs[at - 1];
    u.details[at] = u.details[at - 1];
  }
  u.pairs[at] = {observation, e, cost};
  u.details[at] = {e, residual, S};
  u.pairs_of[observation] = std::min(u.pairs_of[observation] + 1, Unknowns::kPairs);
}

// Closes the gaps that each observation's room left, and gathers the landmarks of all pairs; of more than there is room
// for, those of earlier observations.
template <class Pose>
void Filter<Pose>::gather_pairs(Index count) {
  Unknowns& u = unknowns_;
  u.pair_count = u.window_count = 0;
  for (Index i = 0; i < count; ++i)
    for (Index p = Unknowns::kPairs * i; p < Unknowns::kPairs * i + u.pairs_of[i]; ++p) {
      Expected& expected = u.expected[u.details[p].expected];
      if (expected.window == kUnpaired) {
        if (u.window_count == u.most_window) continue;
        expected.window = u.window_count;
        u.window[u.window_count++] = expected.slot;
      }
      u.pairs[u.pair_count] = u.pairs[p];
      u.pairs[u.pair_count].landmark = expected.window;
      u.details[u.pair_count++] = u.details[p];
    }
}

template <class Pose>
bool Filter<Pose>::confusable(const Sensor<Pose>& sensor, Index count, Index observation, const Pair& pair) const {
  const Index rows = sensor.rows();
  const Expected& own = unknowns_.expected[pair.expected];
  const Matrix3 noise = pair.innovation - own.innovation;
  const Doubt doubt(pair.innovation, noise, rows, new_thresholds_[rows]);
  if (!doubt.stale()) return false;
  for (Index e = 0; e < unknowns_.expected_count; ++e)
    if (e != pair.expected && doubt.confuses(sensor.residual(unknowns_.expected[e].prediction.z, own.prediction.z)))
      return true;
  for (Index o = 0; o < count; ++o)
    if (o != observation && doubt.confuses(sensor.residual(Vector3(observations_[o].z), own.prediction.z))) return true;
  return false;
}

// Whether the observation is of a landmark that the map lacks, though it lies near some: each of those was seen in this
// frame by itself, a landmark is seen once a frame, and noise does not make one of two observations.
template <class Pose>
bool Filter<Pose>::other_than_paired(const Sensor<Pose>& sensor, Index count, Index observation) const {
  const Index rows = sensor.rows();
  const double bound = new_thresholds_[rows];
  const Vector3 z(observations_[observation].z);
  const Matrix3& noise = unknowns_.noise[observation];
  for (Index e = 0; e < unknowns_.expected_count; ++e) {
    const Expected& expected = unknowns_.expected[e];
    if (!expected.paired &&
        within_bound(sensor.residual(z, expected.prediction.z), expected.innovation + noise, rows, bound))
      return false;
  }
  for (Index o = 0; o < count; ++o)
    if (o != observation && within_bound(sensor.residual(z, Vector3(observations_[o].z)), noise + unknowns_.noise[o],
                                         rows, gate_thresholds_[rows]))
      return false;
  return true;
}

// What was paired goes to the batch; of the rest, what is far from every landmark is new.
template <class Pose>
void Filter<Pose>::settle_pairs(const Sensor<Pose>& sensor, Index count) {
  const Index rows = sensor.rows();
  for (Index i = 0; i < count; ++i) {
    const Index chosen = unknowns_.association.chosen(i);
    if (chosen != kUnpaired) unknowns_.expected[unknowns_.details[chosen].expected].paired = true;
  }
  for (Index i = 0; i < count; ++i) {
    Match& match = next_matches_[i];
    const Match& nearest = unknowns_.nearest[i];
    const Index chosen = unknowns_.association.chosen(i);
    if (chosen != kUnpaired) {
      const Expected& expected = unknowns_.expected[unknowns_.details[chosen].expected];
      match.landmark = ids_[expected.slot];
      add_candidate(sensor, i, expected.slot, expected.prediction);
    } else if (nearest.distance > new_thresholds_[rows]) {
      add_new_one(sensor, i);
    } else {
      match = nearest;
      match.threshold = std::min(gate_thresholds_[rows], new_thresholds_[rows]);
      match.reason = nearest.distance <= match.threshold ? Reason::ambiguous : Reason::gate;
      if (other_than_paired(sensor, count, i)) add_new_one(sensor, i);
    }
  }
}

template <class Pose>
void Filter<Pose>::sort_by_association(const Sensor<Pose>& sensor, Index count) {
  const auto start = std::chrono::steady_clock::now();
  Unknowns& u = unknowns_;
  predict_all(sensor);
  find_pairs(sensor, count);
  if (options_.association == AssociationKind::nearest) {
    u.association.nearest_neighbour(u.pairs, u.pair_count, count);
  } else {
    ekf_.gather_ordinary(u.window, u.window_count, u.covariance, kDof + kDim * u.window_count);
    const PairInnovations innovations(*this, sensor);
    u.association.joint_compatibility(u.pairs, u.pair_count, count, innovations, options_.association_nodes);
    next_report_.association_nodes = u.association.nodes();
    next_report_.association_exhausted = u.association.exhausted();
    if (u.association.exhausted())
      say("update: association stopped at %td joint tests, with %td of %td observations paired", u.association.nodes(),
          u.association.pairs(), count);
  }
  u.association.demand_support(options_.association_support, [&](Index observation, Index pair) {
    return confusable(sensor, count, observation, u.details[pair]);
  });
  settle_pairs(sensor, count);
  next_report_.association_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace cairn
