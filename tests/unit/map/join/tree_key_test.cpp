// SPDX-License-Identifier: BSD-3-Clause
// Keys of the elimination tree: cells of space, and their order.
#include "map/join/sparse/tree_key.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "numerical.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;

}  // namespace

TEST_CASE("tree key: splits, bits and order agree") {
  Random random(8);
  std::vector<TreeKey> keys;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const double extent = i < 20 ? 2 : i < 40 ? 500 : 3e6;
    keys.emplace_back(extent * random.normal_vector<3>(), i);
    keys.emplace_back(Vector3(0, 0, 0), 1000 + i);
  }
  for (const TreeKey& a : keys)
    for (const TreeKey& b : keys) {
      const int split = a.split(b);
      CHECK(split == b.split(a));
      if (&a == &b) {
        CHECK(split == TreeKey::kBits);
        CHECK(!(a < b));
        continue;
      }
      REQUIRE(split < TreeKey::kBits);
      for (int i = 0; i < split; ++i) CHECK(a.bit(i) == b.bit(i));
      CHECK(a.bit(split) != b.bit(split));
      CHECK((a < b) == b.bit(split));
    }
}

TEST_CASE("tree key: neighbours are parted late") {
  // Two places 1 m apart may be on both sides of a cell boundary, but near the origin not of a large cell's.
  for (const double x : {0.0, -3.0, 5.0, 20.0}) {
    const TreeKey a(Vector3(x, 1, 0), 1), b(Vector3(x + 1, 1, 0), 2), far(Vector3(x + 4000, 1, 0), 3);
    CHECK(a.split(b) > a.split(far));
    CHECK(a.split(b) >= 63 - 3 * 6);
  }
}
