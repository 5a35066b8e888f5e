// SPDX-License-Identifier: BSD-3-Clause
// A random drive among landmarks. It gives the filter and the reference the same motions and observations, and compares
// them after each step.
#pragma once

#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "numerical.hpp"
#include "reference_filter.hpp"
#include "slam/filter.hpp"

namespace cairn::test {

// Relative differences: positions relative to 1 m plus their own size, covariances relative to the standard deviations.
struct Difference {
  double state = 0, covariance = 0;
};

class Pair {
 public:
  Pair(const FilterOptions<SE3>& options);

  Filter<SE3>& filter() { return *filter_; }
  ReferenceFilter& reference() { return reference_; }
  int add(const Sensor<SE3>& sensor);

  void predict_twist(const Vector3& v, const Vector3& w, double dt);
  void predict_wheels(double left, double right, double dt);
  void predict_increment(const SE3& T, const Matrix6& covariance);
  void set_noise(const TwistNoise& twist, const Wheels& wheels);
  // False if a match, a distance, the NIS or the number of linearisations differs.
  bool update(int sensor, const std::vector<Seen>& frame);
  void remove(std::uint64_t id);
  Difference difference();

 private:
  std::unique_ptr<Arena> arena_;
  std::unique_ptr<Filter<SE3>> filter_;
  ReferenceFilter reference_;
  std::vector<const Sensor<SE3>*> sensors_;
  TwistNoise twist_noise_;
  Wheels wheels_;
};

// Sensors whose axes differ from those of the body.
StereoHead scenario_head(double encoder_sigma, bool per_frame);
StereoCamera scenario_camera();
Cartesian<SE3> scenario_points();
// Observes landmarks in the axes of the map, as with a compass: it depends not only on the point in the body frame.
CustomSensor<SE3> scenario_compass();

// Options with a random start that is uncertain by centimetres to metres and by some degrees. The gates are open.
FilterOptions<SE3> random_options(ErrorKind error, Random& random);
Matrix6 random_covariance(Random& random, double metres, double radians);

class Drive {
 public:
  Drive(unsigned seed, const FilterOptions<SE3>& options, int landmarks = 16);

  // One to four motions, of the same kind or of different kinds.
  void move(Pair& pair);
  // One motion. Returns its increment without noise.
  SE3 advance(const Vector6& tau);
  // Observations of up to `most` landmarks between 2 m and 25 m, with `scale` times the stated noise. `mount` is the
  // error of the mount angles of a head.
  std::vector<Seen> look(const Sensor<SE3>& sensor, std::size_t most, double scale = 1,
                         const Vector2& mount = Vector2::Zero());
  const SE3& truth() const { return truth_; }
  Random& random() { return random_; }

 private:
  Random random_;
  SE3 truth_;
  std::vector<Vector3> landmarks_;
};

}  // namespace cairn::test
