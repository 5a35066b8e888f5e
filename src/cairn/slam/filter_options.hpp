// SPDX-License-Identifier: BSD-3-Clause
// What a filter is created with.
#pragma once

#include <cstdint>

#include "ekf/error_model.hpp"

namespace cairn {

enum class JoinKind { automatic, dense, sparse };
enum class AssociationKind { known, nearest, joint };

template <class Pose>
struct FilterOptions {
  using PoseType = Pose;
  ErrorKind error = ErrorKind::invariant;
  Index max_landmarks = 1000;
  Index max_observations = 64;
  Index max_sensors = 8;
  Index max_companions = 0;  // other vehicles of a single map
  int iterations = 3;
  double iteration_tolerance = 0.1;
  double gate_probability = 0.99;
  double batch_gate_probability = 0.9999;
  double error_persistence = 1.0;  // so many sightings of a landmark in a row have one error between them: updates take
                                   // noise times it, association and placing as it is
  Pose initial_pose;
  typename Pose::Square initial_covariance = Pose::Square::Zero();
  Index submap_landmarks = 0;  // 0: a single map
  JoinKind join = JoinKind::automatic;
  double submap_distance = 0.0, submap_extent = 0.0, submap_sigma = 0.0;  // 0: no matter

  AssociationKind association = AssociationKind::known;  // otherwise observations' ids are not looked at
  Index association_nodes = 2000;
  Index association_support = 3;    // pairs of a frame that could be chance are taken where there are so many
  double new_probability = 0.9999;  // what is nearer than that to a landmark places none
  bool by_likelihood = false;       // nearest neighbour: least d^2 + log det S, instead of least d^2

  Index deferred_sightings = 1;  // a landmark counts once it was observed so often
  Index deferred_frames = 20;    // and goes if it does not within so many frames
  Index missed_frames = 0;       // one that was in view and not seen so many times in a row goes; 0: never

  double step_tolerance = 1e-2;  // of the sparse joining, see MapOptions

  bool single_map() const { return submap_landmarks == 0; }
  bool sparse() const;
  // Landmarks of the filter's own covariance: a frame may exceed what closes a submap.
  Index local_landmarks() const { return single_map() ? max_landmarks : submap_landmarks + max_observations; }
  Index slots() const { return max_companions + local_landmarks(); }
};

}  // namespace cairn
