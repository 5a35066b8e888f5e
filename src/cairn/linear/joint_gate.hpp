// SPDX-License-Identifier: BSD-3-Clause
// The chi-square gates of a batch of blocks of equal size: each block is tested by itself, then all blocks
// jointly. Frames and both joinings of submaps use this code (docs/update.md, "Gates").
#pragma once

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

[[noreturn]] inline void throw_not_definite() {
  throw Error(ErrorCode::numerical,
              "update: the covariance would not stay positive definite; nothing was changed. Is the noise realistic?");
}

// Squared Mahalanobis distance r^T S^-1 r of up to 3 values, from the lower triangle of S. The result is negative if S
// is not positive definite.
inline double squared_distance(const double* residual, const double* covariance, Index ld, Index rows) {
  double L[9], x[3];
  for (Index c = 0; c < rows; ++c) {
    x[c] = residual[c];
    for (Index r = c; r < rows; ++r) L[c * 3 + r] = covariance[c * ld + r];
  }
  if (!cholesky(L, 3, rows)) return -1.0;
  solve_lower(L, 3, rows, x);
  double sum = 0.0;
  for (Index r = 0; r < rows; ++r) sum += x[r] * x[r];
  return sum;
}

// r <- L^-1 r and J <- L^-1 J for S = L L^T of up to 3 rows, from the lower triangle of S. J has `columns` columns, 3
// rows apart. Returns false, with nothing changed, if S is not positive definite.
inline bool whiten_block(const double* S, Index ld, Index rows, double* r, double* J, Index columns) {
  double L[9];
  for (Index c = 0; c < rows; ++c)
    for (Index i = c; i < rows; ++i) L[c * 3 + i] = S[c * ld + i];
  if (!cholesky(L, 3, rows)) return false;
  solve_lower(L, 3, rows, r);
  for (Index c = 0; c < columns; ++c) solve_lower(L, 3, rows, J + 3 * c);
  return true;
}

// Removes blocks of `rows` rows from a batch of `count` blocks while the batch's distance exceeds `bound(rows left)`:
// each time the block without which the distance falls most. Removing block i lowers the distance by
// u_i^T (S^-1)_ii^-1 u_i. Inputs are the full S^-1, u = S^-1 r and the distance r^T u. Both arrays are overwritten.
// `refused(block)` tells which blocks are gone; `refuse(block, distance before, bound)` is called for each new one.
// `workspace` holds rows (rows + count rows) doubles. Returns the number of blocks that are left.
template <class Bound, class Refused, class Refuse>
Index gate_by_inverse(double* inverse, Index count, Index rows, double* u, double distance, double* workspace,
                      Bound&& bound, Refused&& refused, Refuse&& refuse) {
  const Index m = count * rows;
  Index left = count;
  while (left > 0 && distance > bound(left * rows)) {
    Index worst = -1;
    double largest = -1.0;
    for (Index a = 0; a < count; ++a) {
      if (refused(a)) continue;
      const double fall = squared_distance(u + a * rows, inverse + a * rows * (m + 1), m, rows);
      if (fall > largest) largest = fall, worst = a;
    }
    if (worst < 0) throw_not_definite();
    leave_out(inverse, m, worst * rows, rows, u, workspace);
    refuse(worst, distance, bound(left * rows));
    distance -= largest;
    --left;
  }
  return left;
}

enum class Gate { single, joint };

// A block that is so many standard deviations away is refused even if the gates are open: no estimate survives it.
constexpr double kAbsurdDistance = 1e24;  // squared

// The inverse innovation of a batch, which the joint gate needs if the batch is inconsistent.
struct InverseInnovation {
  double* inverse;  // full S^-1
  double* u;        // S^-1 r
  double distance;  // r^T u
  double* workspace;
};

// Both gates. `Batch` has
//   Index count() const                        blocks
//   double distance(Index block)               of one block by itself; negative, NaN or absurd is refused
//   void keep(const Index* blocks, Index n)    removes all other blocks
//   bool consistent(bound)                     whether the joint distance is within bound(rows); called once
//   InverseInnovation invert()                 after consistent() was false
//   void refactor()                            after the keep() that follows the joint gate
//   Index* kept(); bool* refused()             scratch of count() entries each
// `refuse(gate, block, distance, bound)` is called for every removed block, before keep(); the block's number is that
// of the moment.
template <class Batch, class Bound, class Refuse>
void gate_blocks(Batch& batch, Index rows, double single, Bound&& bound, Refuse&& refuse) {
  Index* kept = batch.kept();
  Index left = 0;
  for (Index a = 0; a < batch.count(); ++a) {
    const double distance = batch.distance(a);
    if (distance >= 0.0 && distance <= std::min(single, kAbsurdDistance))
      kept[left++] = a;
    else
      refuse(Gate::single, a, distance, single);
  }
  if (left < batch.count()) batch.keep(kept, left);
  if (batch.consistent(bound)) return;

  const InverseInnovation innovation = batch.invert();
  bool* refused = batch.refused();
  const Index count = batch.count();
  std::fill_n(refused, count, false);
  gate_by_inverse(
      innovation.inverse, count, rows, innovation.u, innovation.distance, innovation.workspace, bound,
      [&](Index a) { return refused[a]; },
      [&](Index a, double distance, double threshold) {
        refused[a] = true;
        refuse(Gate::joint, a, distance, threshold);
      });
  left = 0;
  for (Index a = 0; a < count; ++a)
    if (!refused[a]) kept[left++] = a;
  batch.keep(kept, left);
  batch.refactor();
}

}  // namespace cairn
