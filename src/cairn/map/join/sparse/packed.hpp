// SPDX-License-Identifier: BSD-3-Clause
// Symmetric matrices, stored as their lower triangle, column after column.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "linear/small_algebra.hpp"

namespace cairn {

// y += factor A x, for the n x n matrix A packed as below.
inline void add_packed_product(const double* A, Index n, double factor, const double* x, double* y) {
  for (Index c = 0; c < n; A += n - c, ++c) {
    const double f = factor * x[c];
    for (Index r = c; r < n; ++r) y[r] += A[r - c] * f;
    y[c] += factor * dot(A + 1, x + c + 1, n - c - 1);
  }
}

class Packed {
 public:
  Packed() = default;
  explicit Packed(const Eigen::MatrixXd& symmetric) : size_(symmetric.rows()) {
    values_.reserve(static_cast<std::size_t>(size_ * (size_ + 1) / 2));
    for (Eigen::Index c = 0; c < size_; ++c)
      values_.insert(values_.end(), symmetric.col(c).data() + c, symmetric.col(c).data() + size_);
  }
  Eigen::Index size() const { return size_; }
  double operator()(Eigen::Index r, Eigen::Index c) const { return r >= c ? column(c)[r] : column(r)[c]; }
  // Column c, to be indexed by rows from c on.
  const double* column(Eigen::Index c) const { return values_.data() + c * size_ - c * (c + 1) / 2; }

  // The dense block of these rows and columns.
  template <class Rows, class Columns>
  Eigen::MatrixXd block(const Rows& rows, const Columns& columns) const {
    Eigen::MatrixXd out(rows.size(), columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t r = 0; r < rows.size(); ++r)
        out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = (*this)(rows[r], columns[c]);
    return out;
  }

  // The square block on the diagonal that begins at this row.
  template <int size>
  Eigen::Matrix<double, size, size> diagonal_block(Eigen::Index first) const {
    Eigen::Matrix<double, size, size> block;
    for (Eigen::Index c = 0; c < size; ++c)
      for (Eigen::Index r = 0; r < size; ++r) block(r, c) = (*this)(first + r, first + c);
    return block;
  }

  // y = A x
  void times(const double* x, double* y) const {
    std::fill_n(y, size_, 0.0);
    add_packed_product(values_.data(), size_, 1.0, x, y);
  }

  std::size_t memory_bytes() const { return sizeof(double) * values_.capacity(); }

 private:
  Eigen::Index size_ = 0;
  std::vector<double> values_;
};

}  // namespace cairn
