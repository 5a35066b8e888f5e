// SPDX-License-Identifier: BSD-3-Clause
// The world behind cairn/sim.h: moves a rover along its course and makes its measurements, frame by frame.
#pragma once

#include <cairn/sim.h>

#include <memory>
#include <vector>

#include "sim/course.hpp"
#include "sim/landmark_field.hpp"
#include "sim/rover.hpp"
#include "sim/terrain.hpp"

namespace cairn::sim {

class World {
 public:
  // The fields of `options` have been checked. Throws Error if they contradict each other.
  explicit World(const cairn_world_options& options);

  const cairn_world_options& options() const { return options_; }
  const Terrain& terrain() const { return terrain_; }
  const LandmarkField& landmarks() const { return landmarks_; }
  std::size_t steps() const { return steps_; }
  double duration() const { return static_cast<double>(steps_ - 1) * options_.frame_period; }
  Stance stance(double time) const;
  void extent(Vector2& lower, Vector2& upper) const;
  // Number of IMU samples in one motion sample.
  int samples_per_motion() const { return samples_per_motion_; }

  // Throws Error (state) after the last step.
  void next(cairn_world_step& step);
  void rewind();
  // Of the last step; empty before the first one.
  const std::vector<cairn_world_motion>& motions() const { return motions_; }
  const std::vector<cairn_observation>& observations() const { return observations_; }

 private:
  // Measured and true motion of one IMU sample.
  struct Sample {
    Vector3 velocity, rate, true_velocity, true_rate;
    Vector2 wheels, true_wheels;
  };
  // State of the dead reckoning with an accelerometer that measures m/s^2.
  struct Strapdown {
    SO3 R_map_body;
    Vector3 velocity, true_velocity;  // in the map
  };

  SE3 pose(std::int64_t sample) const;
  void move();
  Sample measure(const SE3& before, const SE3& after);
  Vector3 reckon(const SE3& before, const SE3& after, const Vector3& noise, const Vector3& rate);
  cairn_world_motion compose(const std::vector<Sample>& samples, const SE3& T_before_after) const;
  void look(const SE3& T_map_body);
  void write_noise(cairn_world_step& step) const;

  cairn_world_options options_;
  Terrain terrain_;
  std::unique_ptr<Course> course_;
  LandmarkField landmarks_;
  int samples_per_motion_, motions_per_frame_;
  std::size_t steps_;

  std::size_t step_ = 0;     // number of the next step
  std::int64_t sample_ = 0;  // IMU samples so far
  SE3 pose_;                 // after these samples
  Strapdown strapdown_{};
  std::vector<Sample> samples_;
  std::vector<cairn_world_motion> motions_;
  std::vector<cairn_observation> observations_;
  std::vector<cairn_world_motion> spare_motions_;  // the step that is being made must not destroy the last one
  std::vector<cairn_observation> spare_observations_;
};

}  // namespace cairn::sim
