// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/tree_key.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr int kCells = 21;  // bits of a coordinate

// Every third bit from bit 0 on.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

std::uint64_t cell(double offset) {
  // The origin lies at a third of the width of cells of every size, so that no boundary of a large cell is near it.
  constexpr double kOrigin = (1 << kCells) / 3.0;
  constexpr double kLast = (1 << kCells) - 1;
  const double c = std::floor(offset + kOrigin);
  return static_cast<std::uint64_t>(c > 0.0 ? std::min(c, kLast) : 0.0);
}

int leading_zeros(std::uint64_t x) {
  if (x == 0) return 64;
  int zeros = 0;
  for (int width = 32; width > 0; width /= 2) {
    if (x >> (64 - width) != 0) continue;
    zeros += width;
    x <<= width;
  }
  return zeros;
}

}  // namespace

TreeKey::TreeKey(const Vector3& offset, std::uint32_t leaf_number)
    : place((spread(cell(offset.x())) << 2 | spread(cell(offset.y())) << 1 | spread(cell(offset.z()))) << 1),
      leaf(leaf_number) {}

int TreeKey::split(const TreeKey& other) const {
  if (place != other.place) return leading_zeros(place ^ other.place);
  return 32 + leading_zeros(leaf ^ other.leaf);  // 96 if both are equal
}

}  // namespace cairn
