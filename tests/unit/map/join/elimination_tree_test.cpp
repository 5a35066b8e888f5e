// SPDX-License-Identifier: BSD-3-Clause
// The sparse factor against a dense inverse, while leaves come, grow and share more and more variables.
#include "map/join/sparse/elimination_tree.hpp"

#include <doctest/doctest.h>

#include "map/join/elimination_growth.hpp"

namespace {

using namespace cairn;
using namespace cairn::test;

}  // namespace

TEST_CASE_TEMPLATE("elimination tree: equal to a dense inverse while it grows", Pose, SE3, SE2) {
  SUBCASE("places anywhere, landmarks of anywhere") {
    Growth<Pose> growth(1);
    for (int i = 0; i < 24; ++i) {
      growth.add(growth.anywhere(300), i % 4, 1 + i % 3, i % 3 == 2);
      check_tree(growth.tree, growth.leaves, growth);
    }
  }
  SUBCASE("all in one cell") {
    Growth<Pose> growth(2);
    for (int i = 0; i < 12; ++i) {
      growth.add(Vector3(0.5, 0.5, 0.5), 3, 2, i % 2 == 1);
      check_tree(growth.tree, growth.leaves, growth);
    }
  }
  SUBCASE("along a line, and home again") {
    Growth<Pose> growth(3);
    for (int i = 0; i < 20; ++i) {
      growth.add(Vector3(i < 10 ? 40.0 * i : 40.0 * (19 - i), 0, 0), 2, 2, false);
      check_tree(growth.tree, growth.leaves, growth);
    }
  }
  SUBCASE("farther out than there are cells") {
    Growth<Pose> growth(4);
    for (const double x : {0.0, 1e5, -1e7, 1e9, 1e300, -1e300}) {
      growth.add(Vector3(x, -x, x), 2, 2, true);
      check_tree(growth.tree, growth.leaves, growth);
    }
  }
}

TEST_CASE_TEMPLATE("elimination tree: leaves are taken out", Pose, SE3, SE2) {
  for (const bool one_place : {false, true}) {
    Growth<Pose> growth(8);
    const auto place = [&] { return one_place ? Vector3(0.5, 0.5, 0.5) : growth.anywhere(100); };
    for (int i = 0; i < 12; ++i) growth.add(place(), 3, 2, i % 2 == 0);
    const EliminationTree<Pose> copy = growth.tree;
    const Leaves<Pose> before = growth.leaves;
    for (const std::uint32_t number : {3u, 4u, 0u, 10u}) {  // neighbours, the first one, one of the newest
      growth.remove(number);
      check_tree(growth.tree, growth.leaves, growth);
      growth.add(place(), 3, 1, false);
      check_tree(growth.tree, growth.leaves, growth);
    }
    check_tree(copy, before, growth);
    for (std::uint32_t number = 0; number + 1 < growth.leaves.blocks.size(); ++number)
      if (!growth.leaves.blocks[number].variables.empty()) growth.remove(number);
    check_tree(growth.tree, growth.leaves, growth);  // one leaf is left
  }
}

TEST_CASE_TEMPLATE("elimination tree: a copy is a tree of its own", Pose, SE3, SE2) {
  Growth<Pose> growth(5);
  for (int i = 0; i < 10; ++i) growth.add(growth.anywhere(100), 3, 2, i % 2 == 0);
  const EliminationTree<Pose> copy = growth.tree;
  const Leaves<Pose> before = growth.leaves;
  for (int i = 0; i < 6; ++i) growth.add(growth.anywhere(100), 3, 2, true);
  check_tree(copy, before, growth);
  check_tree(growth.tree, growth.leaves, growth);
  growth.tree = copy;
  growth.leaves = before;
  growth.add(growth.anywhere(100), 4, 1, true);  // the restored tree can grow, too
  check_tree(growth.tree, growth.leaves, growth);
}

TEST_CASE_TEMPLATE("elimination tree: an update that fails changes nothing", Pose, SE3, SE2) {
  Growth<Pose> growth(6);
  for (int i = 0; i < 10; ++i) growth.add(growth.anywhere(100), 3, 2, i % 2 == 0);
  const Leaves<Pose> before = growth.leaves;
  Blocks<Pose> expected, actual;
  std::vector<TreeKey> keys;
  for (const LeafBlock& block : before.blocks) keys.push_back(block.key);
  growth.tree.covariances(keys, expected);
  growth.leaves.blocks[4].information *= -100.0;
  std::size_t refactored = 4711;
  std::vector<std::uint32_t> assembled;
  CHECK(!growth.tree.update(growth.leaves, {{keys[4]}, {}, {}}, refactored, assembled));
  CHECK(refactored == 4711);
  growth.tree.covariances(keys, actual);
  CHECK(actual.of == expected.of);
  growth.leaves = before;
  CHECK(growth.tree.update(growth.leaves, {{keys[4]}, {}, {}}, refactored, assembled));
  check_tree(growth.tree, growth.leaves, growth);
}

TEST_CASE_TEMPLATE("elimination tree: nothing to change, nothing to ask", Pose, SE3, SE2) {
  EliminationTree<Pose> tree;
  Leaves<Pose> none;
  std::size_t refactored = 0;
  std::vector<std::uint32_t> assembled;
  CHECK(tree.update(none, {}, refactored, assembled));
  CHECK(tree.memory_bytes() == 0);
  Blocks<Pose> blocks;
  tree.covariances({}, blocks);
  CHECK(blocks.of.empty());
}

TEST_CASE_TEMPLATE("elimination tree: a change reaches one path", Pose, SE3, SE2) {
  Growth<Pose> growth(7);
  for (int i = 0; i < 40; ++i) growth.add(Vector3(30.0 * i, 0, 0), 0, 3, false);
  std::size_t refactored = 0;
  std::vector<std::uint32_t> assembled;
  const LeafBlock& block = growth.leaves.blocks[17];
  REQUIRE(growth.tree.update(growth.leaves, {{block.key}, {}, {}}, refactored, assembled));
  CHECK(refactored >= 3);
  CHECK(refactored <= 12);       // of 40: the trie's depth and the crown
  CHECK(assembled.size() <= 2);  // its own leaf, and at most the sibling's
  check_tree(growth.tree, growth.leaves, growth);
}
