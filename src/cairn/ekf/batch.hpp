// SPDX-License-Identifier: BSD-3-Clause
// The rows of one update: residual, noise, and the blocks of the Jacobian that are not zero, with their columns.
// Columns count the states of the batch's window (ekf.hpp), not of the whole filter.
#pragma once

#include <algorithm>
#include <cstring>

#include "core/arena.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

class Batch {
 public:
  Batch(Arena& arena, Index max_rows, Index max_columns, Index max_blocks)
      : residual_(arena.take<double>(max_rows)),
        jacobian_pool_(arena.take<double>(max_rows * max_columns)),
        jacobian_(arena.take<Block>(max_blocks)),
        noise_pool_(arena.take<double>(max_rows * max_rows)),
        noise_(arena.take<Block>(max_blocks)) {}

  void clear() { rows_ = jacobian_count_ = noise_count_ = jacobian_used_ = noise_used_ = 0; }

  // Appends rows and returns the first one's number.
  Index add_rows(Index rows) {
    rows_ += rows;
    return rows_ - rows;
  }
  // Room for a column-major block of the Jacobian; one of the noise (symmetric).
  double* add_jacobian(Index row, Index rows, Index column, Index columns) {
    return add(jacobian_, jacobian_count_, jacobian_pool_, jacobian_used_, row, rows, column, columns);
  }
  double* add_noise(Index row, Index rows) {
    return add(noise_, noise_count_, noise_pool_, noise_used_, row, rows, row, rows);
  }

  void scale_noise(Index row, double factor) {  // of the block that begins at this row
    for (Index b = 0; b < noise_count_; ++b)
      if (noise_[b].row == row)
        for (Index i = 0; i < noise_[b].rows * noise_[b].rows; ++i) noise_[b].value[i] *= factor;
  }

  // Keeps only the given blocks of `rows` rows, in rising order, and closes the gaps. No Jacobian block of the batch
  // may span two of them.
  void keep(const Index* blocks, Index count, Index rows) {
    for (Index k = 0; k < count; ++k)
      std::memmove(residual_ + k * rows, residual_ + blocks[k] * rows, rows * sizeof(double));
    keep(blocks, count, rows, jacobian_, jacobian_count_);
    keep(blocks, count, rows, noise_, noise_count_);
    rows_ = count * rows;
  }

  Index rows() const { return rows_; }
  double* residual() { return residual_; }
  const double* residual() const { return residual_; }

  // Y = P H^T, for the n x columns matrix P; Y is n x rows.
  void times_transposed(const double* P, Index ldp, Index n, double* Y, Index ldy) const {
    Index done = 0;  // rows whose columns of Y have been started; blocks come in the order of their rows
    for (Index b = 0; b < jacobian_count_; ++b) {
      const Block& block = jacobian_[b];
      const bool fresh = block.row + block.rows > done;
      done = block.row + block.rows;
      add_block(block, P + block.column * ldp, ldp, n, fresh, Y + block.row * ldy, ldy);
    }
  }

  // Lower triangle of S = H P H^T + R, for the rows x columns matrix H P. A double cannot hold noise that is too small
  // beside the variances that are added to it: its variance is raised to kLeastNoise of H P H^T, and to kLeastRest of
  // the variances whose difference H P H^T is. `prior` are the variances of the window's first `count` columns.
  void innovation_covariance(const double* HP, Index ld, double* S, Index lds, const double* prior, Index count) const {
    Index done = 0;
    for (Index b = 0; b < jacobian_count_; ++b) {
      const Block& block = jacobian_[b];
      const bool fresh = block.row + block.rows > done;
      done = block.row + block.rows;
      add_block(block, HP + block.column * ld + block.row, ld, rows_ - block.row, fresh, S + block.row * (lds + 1),
                lds);
    }
    for (Index b = 0; b < noise_count_; ++b) {
      const Block& block = noise_[b];
      for (Index c = 0; c < block.rows; ++c) {
        double* column = S + (block.row + c) * lds + block.row;
        const double least = least_noise(block.row + c, column[c], prior, count);
        const double noise = block.value[c * (block.rows + 1)];
        column[c] += noise < 0.0 ? noise : std::max(noise, least);  // a negative one shall find no factor
        for (Index r = c + 1; r < block.rows; ++r) column[r] += block.value[c * block.rows + r];
      }
    }
  }

  // y += factor H x.
  void add_product(double factor, const double* x, double* y) const {
    for (Index b = 0; b < jacobian_count_; ++b) {
      const Block& block = jacobian_[b];
      for (Index c = 0; c < block.columns; ++c)
        for (Index r = 0; r < block.rows; ++r)
          y[block.row + r] += factor * block.value[c * block.rows + r] * x[block.column + c];
    }
  }

  // Variance of one row's noise.
  double noise_variance(Index row) const {
    for (Index b = 0; b < noise_count_; ++b) {
      const Block& block = noise_[b];
      if (row >= block.row && row < block.row + block.rows) return block.value[(row - block.row) * (block.rows + 1)];
    }
    return 0.0;
  }

  // y += R x.
  void add_noise_product(const double* x, double* y) const {
    for (Index b = 0; b < noise_count_; ++b) {
      const Block& block = noise_[b];
      for (Index c = 0; c < block.rows; ++c)
        for (Index r = 0; r < block.rows; ++r) y[block.row + r] += block.value[c * block.rows + r] * x[block.row + c];
    }
  }

 private:
  static constexpr double kLeastNoise = 1e-12, kLeastRest = 1e-14;

  struct Block {
    Index row, rows, column, columns;
    double* value;
  };

  static void keep(const Index* blocks, Index count, Index rows, Block* all, Index& all_count) {
    Index kept = 0, k = 0;
    for (Index b = 0; b < all_count; ++b) {
      const Index number = all[b].row / rows;
      while (k < count && blocks[k] < number) ++k;
      if (k == count || blocks[k] != number) continue;
      all[kept] = all[b];
      all[kept++].row += (k - number) * rows;
    }
    all_count = kept;
  }

  double least_noise(Index row, double variance, const double* prior, Index count) const {
    double rest = 0.0;
    for (Index b = 0; b < jacobian_count_ && count > 0; ++b) {
      const Block& block = jacobian_[b];
      if (row < block.row || row >= block.row + block.rows) continue;
      for (Index c = 0; c < block.columns && block.column + c < count; ++c) {
        const double J = block.value[c * block.rows + row - block.row];
        rest += J * J * prior[block.column + c];
      }
    }
    return std::max(kLeastNoise * variance, kLeastRest * rest);
  }

  static double* add(Block* blocks, Index& count, double* pool, Index& used, Index row, Index rows, Index column,
                     Index columns) {
    double* value = pool + used;
    blocks[count++] = {row, rows, column, columns, value};
    used += rows * columns;
    return value;
  }

  // Y(:, 0..block.rows) += P(:, 0..block.columns) J^T; if `fresh`, Y is set to the product.
  static void add_block(const Block& block, const double* P, Index ldp, Index n, bool fresh, double* Y, Index ldy) {
    Index c = 0;
    if (fresh && block.columns < 3) {
      for (Index r = 0; r < block.rows; ++r) std::fill_n(Y + r * ldy, n, 0.0);
    } else if (fresh) {
      add_columns<true>(block.value, block.rows, P, ldp, n, Y, ldy);
      c = 3;
    }
    for (; c + 3 <= block.columns; c += 3)
      add_columns<false>(block.value + c * block.rows, block.rows, P + c * ldp, ldp, n, Y, ldy);
    for (; c < block.columns; ++c)
      for (Index r = 0; r < block.rows; ++r) {
        const double factor = block.value[c * block.rows + r];
        for (Index i = 0; i < n; ++i) Y[r * ldy + i] += factor * P[c * ldp + i];
      }
  }

  // Each pass reads three columns of P (a landmark, half a pose) once for all rows of the block.
  template <bool kFresh>
  static void add_columns(const double* J, Index rows, const double* P, Index ldp, Index n, double* Y, Index ldy) {
    if (rows == 3) return add_columns<kFresh, 3>(J, P, ldp, n, Y, ldy);
    if (rows == 2) return add_columns<kFresh, 2>(J, P, ldp, n, Y, ldy);
    for (Index r = 0; r < rows; ++r) {
      const double single[3] = {J[r], J[rows + r], J[2 * rows + r]};
      add_columns<kFresh, 1>(single, P, ldp, n, Y + r * ldy, ldy);
    }
  }

  template <bool kFresh, int kRows>
  static void add_columns(const double* J, const double* __restrict P, Index ldp, Index n, double* __restrict Y,
                          Index ldy) {
    double j[3 * kRows];
    std::copy_n(J, 3 * kRows, j);
    for (Index i = 0; i < n; ++i) {
      const double p = P[i], q = P[ldp + i], r = P[2 * ldp + i];
      for (int k = 0; k < kRows; ++k) {
        const double sum = j[k] * p + j[kRows + k] * q + j[2 * kRows + k] * r;
        Y[k * ldy + i] = kFresh ? sum : Y[k * ldy + i] + sum;
      }
    }
  }

  double* residual_;
  double* jacobian_pool_;
  Block* jacobian_;
  double* noise_pool_;
  Block* noise_;
  Index rows_ = 0, jacobian_count_ = 0, noise_count_ = 0, jacobian_used_ = 0, noise_used_ = 0;
};

}  // namespace cairn
