// SPDX-License-Identifier: BSD-3-Clause
#include "map/refusals.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace cairn;

TEST_CASE("refusals: each landmark has the distance that it adds") {
  Refusals none;
  CHECK(none.worst() == 0.0);
  Refusals single = none;
  single.add(Gate::single, 20.0, 14.0);
  single.add(Gate::single, 17.0, 14.0);
  CHECK(single.worst() == 20.0);
  Refusals joint = single;
  joint.add(Gate::joint, 120.0, 40.0);
  CHECK(joint.worst() == 80.0);  // at least
  joint.add(Gate::joint, 60.0, 38.0);
  CHECK(joint.worst() == 60.0);  // the fall by the first one is known now
  joint.add(Gate::joint, 55.0, 36.0);
  CHECK(joint.worst() == 60.0);
  for (const double bad : {-1.0, std::nan("")}) {
    Refusals indefinite;
    indefinite.add(Gate::single, bad, 14.0);
    CHECK(std::isinf(indefinite.worst()));
  }
}
