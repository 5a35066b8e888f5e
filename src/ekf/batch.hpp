// SPDX-License-Identifier: BSD-3-Clause
// The rows of one update: residual, noise, and of the Jacobian only the blocks that are not zero, with the columns that
// they belong to. Columns count the states of the batch's window (ekf.hpp), not of the whole filter.
#pragma once

#include <algorithm>

#include "core/arena.hpp"
#include "ekf/small_algebra.hpp"

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
      for (Index r = 0; r < block.rows; ++r)
        accumulate(P + block.column * ldp, ldp, n, block.value + r, block.rows, block.columns, fresh,
                   Y + (block.row + r) * ldy);
    }
  }

  // Lower triangle of S = H T + R, for T = P H^T.
  void innovation_covariance(const double* T, Index ldt, double* S, Index lds) const {
    for (Index j = 0; j < rows_; ++j) std::fill(S + j * lds + j, S + j * lds + rows_, 0.0);
    for (Index b = 0; b < jacobian_count_; ++b) {
      const Block& block = jacobian_[b];
      for (Index j = 0; j < block.row + block.rows; ++j)
        for (Index c = 0; c < block.columns; ++c) {
          const double t = T[j * ldt + block.column + c];
          const double* J = block.value + c * block.rows;
          double* target = S + j * lds + block.row;
          for (Index r = std::max<Index>(0, j - block.row); r < block.rows; ++r) target[r] += J[r] * t;
        }
    }
    for (Index b = 0; b < noise_count_; ++b) {
      const Block& block = noise_[b];
      for (Index c = 0; c < block.columns; ++c)
        for (Index r = c; r < block.rows; ++r)
          S[(block.row + c) * lds + block.row + r] += block.value[c * block.rows + r];
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

 private:
  struct Block {
    Index row, rows, column, columns;
    double* value;
  };

  static double* add(Block* blocks, Index& count, double* pool, Index& used, Index row, Index rows, Index column,
                     Index columns) {
    double* value = pool + used;
    blocks[count++] = {row, rows, column, columns, value};
    used += rows * columns;
    return value;
  }

  // y += P(:, 0..columns) j, with the entries of j `stride` apart; y = it where `fresh`. Three columns a pass: a
  // landmark, half a pose.
  static void accumulate(const double* P, Index ldp, Index n, const double* j, Index stride, Index columns, bool fresh,
                         double* y) {
    Index c = 0;
    if (fresh && columns >= 3) {
      const double a = j[0], b = j[stride], d = j[2 * stride];
      const double *p = P, *q = P + ldp, *r = P + 2 * ldp;
      for (Index i = 0; i < n; ++i) y[i] = a * p[i] + b * q[i] + d * r[i];
      c = 3;
    } else if (fresh) {
      std::fill_n(y, n, 0.0);
    }
    for (; c + 3 <= columns; c += 3) {
      const double a = j[c * stride], b = j[(c + 1) * stride], d = j[(c + 2) * stride];
      const double *p = P + c * ldp, *q = p + ldp, *r = q + ldp;
      for (Index i = 0; i < n; ++i) y[i] += a * p[i] + b * q[i] + d * r[i];
    }
    for (; c < columns; ++c) {
      const double a = j[c * stride];
      const double* p = P + c * ldp;
      for (Index i = 0; i < n; ++i) y[i] += a * p[i];
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
