// SPDX-License-Identifier: BSD-3-Clause
// A symmetric matrix in memory that the caller owns; only the lower triangle is stored.
#pragma once

#include <algorithm>
#include <cstring>
#include <utility>

#include "linear/small_algebra.hpp"

namespace cairn {

// Column-major, `ld` rows apart. Entries above the diagonal may hold anything.
class LowerTriangle {
 public:
  LowerTriangle(double* data, Index ld) : data_(data), ld_(ld) {}

  Index ld() const { return ld_; }
  double* column(Index c) { return data_ + c * ld_; }
  const double* column(Index c) const { return data_ + c * ld_; }

  // On or below the diagonal: row >= column.
  double& operator()(Index row, Index column) { return data_[column * ld_ + row]; }
  double operator()(Index row, Index column) const { return data_[column * ld_ + row]; }
  // Anywhere.
  double symmetric(Index row, Index column) const {
    return row >= column ? (*this)(row, column) : (*this)(column, row);
  }
  double& entry(Index row, Index column) { return row >= column ? (*this)(row, column) : (*this)(column, row); }

  // Exchanges rows and columns a and b of an n x n matrix.
  void exchange(Index a, Index b, Index n) {
    if (a == b) return;
    if (a > b) std::swap(a, b);
    LowerTriangle& P = *this;
    for (Index c = 0; c < a; ++c) std::swap(P(a, c), P(b, c));
    for (Index i = a + 1; i < b; ++i) std::swap(P(i, a), P(b, i));
    for (Index r = b + 1; r < n; ++r) std::swap(P(r, a), P(r, b));
    std::swap(P(a, a), P(b, b));
  }

  // Moves the last `count` rows and columns, which begin at `from`, by `by` along the diagonal, together with their
  // entries in the columns before `from`.
  void move_tail(Index from, Index count, Index by) {
    const auto move_column = [&](Index to_column, Index column, Index row) {
      std::memmove(this->column(to_column) + row + by, this->column(column) + row,
                   static_cast<std::size_t>(from + count - row) * sizeof(double));
    };
    if (by > 0)
      for (Index c = from + count; c-- > from;) move_column(c + by, c, c);
    else
      for (Index c = from; c < from + count; ++c) move_column(c + by, c, c);
    for (Index c = 0; c < from + std::min<Index>(by, 0); ++c) move_column(c, c, from);
  }

 private:
  double* data_;
  Index ld_;
};

}  // namespace cairn
