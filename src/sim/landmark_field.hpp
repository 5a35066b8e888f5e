// SPDX-License-Identifier: BSD-3-Clause
// Landmarks on the ground with a grid of cells for queries by place.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/types.hpp"

namespace cairn::sim {

class LandmarkField {
 public:
  // `range`: the largest distance of a query.
  LandmarkField(std::vector<Vector3> positions, double range);

  std::size_t size() const { return positions_.size(); }
  const Vector3& operator[](std::size_t id) const { return positions_[id]; }
  const std::vector<Vector3>& positions() const { return positions_; }

  // Visits the ids of all landmarks within `range` of a place, and of some farther ones, in no particular order.
  template <class Visit>
  void near(double x, double y, Visit&& visit) const {
    const std::int64_t column = cell(x), row = cell(y);
    for (std::int64_t r = row - 1; r <= row + 1; ++r) each_in_row(r, column - 1, column + 1, visit);
  }

  // An upper bound of the number of landmarks that `near` visits.
  std::size_t most_near() const;

 private:
  struct Entry {
    std::uint64_t key;  // row, then column: the cells of a row are neighbours in the sorted array
    std::uint32_t id;
    bool operator<(const Entry& other) const { return key != other.key ? key < other.key : id < other.id; }
  };

  std::int64_t cell(double x) const;
  static std::uint64_t key(std::int64_t row, std::int64_t column);

  template <class Visit>
  void each_in_row(std::int64_t row, std::int64_t first, std::int64_t last, Visit&& visit) const {
    const std::uint64_t end = key(row, last);
    for (std::size_t i = begin_of(key(row, first)); i < entries_.size() && entries_[i].key <= end; ++i) {
      visit(entries_[i].id);
    }
  }
  std::size_t begin_of(std::uint64_t key) const;

  double size_;
  std::vector<Vector3> positions_;
  std::vector<Entry> entries_;
};

}  // namespace cairn::sim
