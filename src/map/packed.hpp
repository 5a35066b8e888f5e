// SPDX-License-Identifier: BSD-3-Clause
// Symmetric matrices by their lower triangle alone, column after column.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cairn {

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

  // Rows and columns of 3-blocks and of whatever else, both triangles.
  template <class Rows, class Columns>
  Eigen::MatrixXd block(const Rows& rows, const Columns& columns) const {
    Eigen::MatrixXd out(rows.size(), columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t r = 0; r < rows.size(); ++r)
        out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = (*this)(rows[r], columns[c]);
    return out;
  }

  // y = A x
  void times(const double* x, double* y) const {
    std::fill_n(y, size_, 0.0);
    for (Eigen::Index c = 0; c < size_; ++c) {
      const double* A = column(c);
      const double factor = x[c];
      double sum = A[c] * factor;
      for (Eigen::Index r = c + 1; r < size_; ++r) {
        y[r] += A[r] * factor;
        sum += A[r] * x[r];
      }
      y[c] += sum;
    }
  }

  std::size_t memory_bytes() const { return sizeof(double) * values_.capacity(); }

 private:
  Eigen::Index size_ = 0;
  std::vector<double> values_;
};

}  // namespace cairn
