// SPDX-License-Identifier: BSD-3-Clause
// The place of a leaf in the elimination tree.
#pragma once

#include <cstdint>

#include "geometry/types.hpp"

namespace cairn {

// A leaf's path through the tree: the cell of space where its submap lies, as a Morton code, then its number.
struct TreeKey {
  static constexpr int kBits = 96;
  std::uint64_t place = 0;  // Morton code
  std::uint32_t leaf = 0;

  TreeKey() = default;
  // Cells are 1 m wide; `offset` counts from a point that stays the same for all of a tree's life.
  TreeKey(const Vector3& offset, std::uint32_t leaf_number);
  bool bit(int i) const { return i < 64 ? (place >> (63 - i)) & 1 : (leaf >> (95 - i)) & 1; }
  // The first bit in which two keys differ; kBits if there is none.
  int split(const TreeKey& other) const;
  bool operator<(const TreeKey& other) const { return place != other.place ? place < other.place : leaf < other.leaf; }
};

// The fronts on the path to a leaf, from the top down to this bit.
struct TreeTouch {
  TreeKey key;
  int bit;
};

}  // namespace cairn
