// SPDX-License-Identifier: BSD-3-Clause
// The course of the rover, and the places of landmarks along it.
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

  // Length of the whole drive, m.
  virtual double length() const = 0;
  // Place after `s` metres.
  virtual Place at(double s) const = 0;
  // `count` places in the strip along the course.
  virtual std::vector<Vector2> scatter(Random& random, std::size_t count) const = 0;
};

// Start of all courses except the circle (Mars paper, Table 1).
inline constexpr double kStartX = 100, kStartY = 20;

// Throws Error if the options contradict each other.
std::unique_ptr<Course> make_course(const cairn_world_options& options);
std::unique_ptr<Course> make_circle(const cairn_world_options& options);
std::unique_ptr<Course> make_laps(const cairn_world_options& options);
std::unique_ptr<Course> make_traverse(const cairn_world_options& options);

}  // namespace cairn::sim
