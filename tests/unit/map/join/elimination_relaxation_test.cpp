// SPDX-License-Identifier: BSD-3-Clause
// Relaxation on the elimination tree: motions that the tree postpones or carries along, and the predicted fall of the
// cost.
#include <doctest/doctest.h>

#include "map/join/elimination_growth.hpp"

namespace {

using namespace cairn;
using namespace cairn::test;

}  // namespace

TEST_CASE_TEMPLATE("elimination tree: motions that were kept are never lost", Pose, SE3, SE2) {
  for (unsigned seed = 10; seed < 16; ++seed) {
    CAPTURE(seed);
    Growth<Pose> growth(seed);
    Springs<Pose> springs(growth.leaves);
    growth.springs = &springs;
    std::size_t spared = 0;
    for (std::uint32_t i = 0; i < 60; ++i) {
      // Old leaves keep their variables here, so that their targets stay valid.
      growth.add(growth.anywhere(seed % 2 == 0 ? 100 : 1000), static_cast<int>(i % 3), 2, false);
      springs.pull(i, growth.columns(dimension<Pose>(growth.leaves.blocks[i].variables), 1));
      springs.tolerance = 0.3;
      spared += i + 1 - growth.relax();
      if (i % 12 != 11) continue;
      springs.tolerance = 0.0;  // everything now
      CHECK(growth.relax() == i + 1);
      CHECK(difference(springs.value(), springs.solution()) <= 1e-9);
    }
    CHECK(spared > 300);  // of 1830
  }
}

TEST_CASE_TEMPLATE("elimination tree: what is carried along is never lost either", Pose, SE3, SE2) {
  for (unsigned seed = 30; seed < 36; ++seed) {
    CAPTURE(seed);
    Growth<Pose> growth(seed);
    growth.leaves.relative = true;
    Springs<Pose> springs(growth.leaves);
    growth.springs = &springs;
    for (std::uint32_t i = 0; i < 60; ++i) {
      growth.add(growth.anywhere(seed % 2 == 0 ? 100 : 1000), static_cast<int>(i % 3), 2, false);
      springs.pull(i, 0.01 * growth.columns(dimension<Pose>(growth.leaves.blocks[i].variables), 1));
      // Only the first leaf knows absolute values: all other leaves follow it.
      if (i % 6 == 5) springs.pull(0, shifts<Pose>(growth.leaves.blocks[0].variables) * growth.columns(Pose::kDim, 1));
      if (i % 6 == 5) springs.visited.push_back(0);
      springs.tolerance = 0.3;
      growth.relax();
      if (i % 12 != 11) continue;
      springs.tolerance = 0.0;
      growth.relax();
      CHECK(difference(springs.value(), springs.solution()) <= 1e-8);
    }
    CHECK(springs.carried > 60);
  }
}

TEST_CASE_TEMPLATE("elimination tree: the fall of a quadratic cost is foretold", Pose, SE3, SE2) {
  for (unsigned seed = 20; seed < 24; ++seed) {
    CAPTURE(seed);
    Growth<Pose> growth(seed);
    Springs<Pose> springs(growth.leaves);
    growth.springs = &springs;
    for (std::uint32_t i = 0; i < 30; ++i) {
      growth.add(growth.anywhere(100), static_cast<int>(i % 3), 2, false);
      springs.pull(i, growth.columns(dimension<Pose>(growth.leaves.blocks[i].variables), 1));
      const double before = springs.cost();
      growth.relax();
      CHECK(growth.foreseen > 0.0);
      CHECK(std::abs(before - springs.cost() - growth.foreseen) <= 1e-10 * before);
    }
  }
}
