// SPDX-License-Identifier: BSD-3-Clause
// Where the rover drives, and where landmarks lie about its way.
#pragma once

#include <cairn/sim.h>

#include <memory>
#include <vector>

#include "geometry/types.hpp"
#include "sim/random.hpp"
#include "sim/rover.hpp"

namespace cairn::sim {

class Course {
 public:
  Course() = default;
  Course(const Course&) = delete;
  Course& operator=(const Course&) = delete;
  virtual ~Course() = default;

  // Of the whole drive, m.
  virtual double length() const = 0;
  // After `s` metres of it.
  virtual Place at(double s) const = 0;
  // `count` places in the strip along the course.
  virtual std::vector<Vector2> scatter(Random& random, std::size_t count) const = 0;
};

// Where courses other than the circle start (Mars paper, Table 1).
inline constexpr double kStartX = 100, kStartY = 20;

// Throws Error where the options contradict each other.
std::unique_ptr<Course> make_course(const cairn_world_options& options);
std::unique_ptr<Course> make_circle(const cairn_world_options& options);
std::unique_ptr<Course> make_laps(const cairn_world_options& options);
std::unique_ptr<Course> make_traverse(const cairn_world_options& options);

}  // namespace cairn::sim
