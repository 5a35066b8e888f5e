// SPDX-License-Identifier: BSD-3-Clause
// One BLAS dsyrk: the arithmetic that every dense update needs. Lower triangle, one row for each state, one column for
// each row of the batch, one thread, alpha = -1, beta = 1, on its own matrix.
//
// Right after a step of the library the operands of dsyrk are not in the caches, because the covariance of the filter
// has just replaced them. Timed like this dsyrk would look slower, and our ratio better, than it is. Therefore dsyrk is
// called several times in a row, and the median of the calls after the first is used. The steps of the library get no
// such advantage; the step after such a series starts with cold caches. The cold time is stored too, but not used.
#pragma once

#include <cblas.h>

#include <cmath>
#include <vector>

#include "samples.hpp"

namespace bench {

class Syrk {
 public:
  Syrk(std::size_t max_states, std::size_t max_rows) : C_(max_states * max_states), W_(max_states * max_rows) {
    // Small enough that the values of C stay bounded after a thousand updates.
    for (std::size_t i = 0; i < W_.size(); ++i) W_[i] = 1e-4 * std::sin(static_cast<double>(i));
    openblas_set_num_threads(1);
  }

  void time(std::size_t n, std::size_t k) {
    constexpr int kHotCalls = 5;
    cold.add(call(n, k));
    Samples row;
    for (int i = 0; i < kHotCalls; ++i) row.add(call(n, k));
    hot.add(row.median());
  }

  Samples cold, hot;

 private:
  double call(std::size_t n, std::size_t k) {
    const int size = static_cast<int>(n);
    const Stopwatch watch;
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, size, static_cast<int>(k), -1.0, W_.data(), size, 1.0,
                C_.data(), size);
    return watch.milliseconds();
  }

  std::vector<double> C_, W_;
};

}  // namespace bench
