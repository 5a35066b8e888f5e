// SPDX-License-Identifier: BSD-3-Clause
// The grid of cells of the landmarks.
#include "sim/landmark_field.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::sim {

LandmarkField::LandmarkField(std::vector<Vector3> positions, double range)
    : size_(range), positions_(std::move(positions)) {
  entries_.reserve(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    const Vector3& p = positions_[i];
    entries_.push_back({key(cell(p.y()), cell(p.x())), static_cast<std::uint32_t>(i)});
  }
  std::sort(entries_.begin(), entries_.end());
}

std::int64_t LandmarkField::cell(double x) const {
  // The clamp gives every place a cell, however far away it is. No landmark is that far away.
  return static_cast<std::int64_t>(std::floor(std::clamp(x / size_, -1e9, 1e9)));
}

std::uint64_t LandmarkField::key(std::int64_t row, std::int64_t column) {
  constexpr std::int64_t kOffset = std::int64_t{1} << 31;
  return static_cast<std::uint64_t>(row + kOffset) << 32 | static_cast<std::uint64_t>(column + kOffset);
}

std::size_t LandmarkField::begin_of(std::uint64_t key) const {
  return std::lower_bound(entries_.begin(), entries_.end(), Entry{key, 0}) - entries_.begin();
}

// The largest number of landmarks in a block of 3 x 3 cells. The middle of a block that is not empty is an occupied
// cell or a neighbour of one, so only these blocks are counted.
std::size_t LandmarkField::most_near() const {
  std::size_t most = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (i > 0 && entries_[i].key == entries_[i - 1].key) continue;
    const Vector3& p = positions_[entries_[i].id];
    const std::int64_t column = cell(p.x()), row = cell(p.y());
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      for (std::int64_t c = column - 1; c <= column + 1; ++c) {
        std::size_t count = 0;
        for (std::int64_t k = r - 1; k <= r + 1; ++k) each_in_row(k, c - 1, c + 1, [&](std::uint32_t) { ++count; });
        most = std::max(most, count);
      }
    }
  }
  return most;
}

}  // namespace cairn::sim
