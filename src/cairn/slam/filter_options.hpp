// SPDX-License-Identifier: BSD-3-Clause
// The options that a filter is created with.
#pragma once

#include <cstdint>

#include "ekf/error_model.hpp"
#include "linear/robust_loss.hpp"
#include "motion/motion.hpp"

namespace cairn {

enum class JoinKind { automatic, dense, sparse };
enum class AssociationKind { known, nearest, joint };

// The defaults of all numbers that callers can set, from the one table of them.
struct FilterDefaults {
#define FILTER_WHOLE(field, initial, lower, upper, flag) static constexpr Index field = initial;
#define FILTER_REAL(field, initial, bounds, flag) static constexpr double field = initial;
#include "options/filter_options.def"
};

struct CapacityOptions {
  Index max_landmarks = FilterDefaults::max_landmarks;
  Index max_observations = FilterDefaults::max_observations;
  Index max_sensors = FilterDefaults::max_sensors;
  Index trajectory_poses = FilterDefaults::trajectory_poses;
  Index max_sensor_errors = FilterDefaults::max_sensor_errors;  // numbers of the calibrations of all sensors
  Index max_companions = 0;                                     // poses of other vehicles in the state of a single map
};

// An update: linearisations, chi-square gates, and the number of consecutive observations of a landmark whose errors
// are fully correlated. Updates multiply the noise by this number; association and the placing of landmarks do not.
struct UpdateOptions {
  int iterations = FilterDefaults::iterations;
  double iteration_tolerance = FilterDefaults::iteration_tolerance;
  double gate_probability = FilterDefaults::gate_probability;
  double batch_gate_probability = FilterDefaults::batch_gate_probability;
  double error_persistence = FilterDefaults::error_persistence;
};

// The limits at which a submap is closed (0: no limit), and how it joins the map.
struct SubmapOptions {
  Index submap_landmarks = FilterDefaults::submap_landmarks;  // 0: a single map
  double submap_distance = FilterDefaults::submap_distance;
  double submap_extent = FilterDefaults::submap_extent;
  double submap_sigma = FilterDefaults::submap_sigma;
  JoinKind join = JoinKind::automatic;
  LossKind join_loss = LossKind::none;
  double join_loss_width = FilterDefaults::join_loss_width;
  double step_tolerance = 1e-2;  // of the sparse joining, see MapOptions
};

// With any association but `known` the filter does not read the ids of observations.
struct AssociationOptions {
  AssociationKind association = AssociationKind::known;
  Index association_nodes = FilterDefaults::association_nodes;  // joint tests of one frame, at most
  Index association_support = 3;  // doubtful pairs of a frame are accepted if there are at least this many
  double new_probability = FilterDefaults::new_probability;  // a new landmark is farther than this from all others
  bool by_likelihood = false;  // nearest neighbour: compare d^2 + log det S instead of d^2
};

// The life of a landmark.
struct LandmarkOptions {
  Index deferred_sightings = FilterDefaults::deferred_sightings;  // it counts after this many observations
  Index deferred_frames = FilterDefaults::deferred_frames;        // it is removed if it does not count by then
  Index missed_frames = FilterDefaults::missed_frames;  // it is removed if in view and not seen this often; 0: never
};

// Systematic errors of the motion that are states: by their numbers in MotionErrors, standard deviation at the start
// (0: no state) and random walk in the square root of a second.
struct SystematicOptions {
  double motion_sigma[MotionErrors::kCount] = {};
  double motion_walk[MotionErrors::kCount] = {};
};

// What becomes of the noise that is learned (docs/trust.md).
struct NoiseOptions {
  bool apply_noise = false;  // scales the stated noise; otherwise it is only reported
};

template <class Pose>
struct FilterOptions : CapacityOptions,
                       UpdateOptions,
                       SubmapOptions,
                       AssociationOptions,
                       LandmarkOptions,
                       NoiseOptions {
  using PoseType = Pose;
  SystematicOptions systematic;
  ErrorKind error = ErrorKind::invariant;
  Pose initial_pose;
  typename Pose::Square initial_covariance = Pose::Square::Zero();

  bool single_map() const { return submap_landmarks == 0; }
  bool sparse() const;
  // Landmarks of the filter's own covariance: a frame may exceed the limit at which a submap is closed.
  Index local_landmarks() const { return single_map() ? max_landmarks : submap_landmarks + max_observations; }
  Index slots() const { return max_companions + local_landmarks(); }
};

}  // namespace cairn
