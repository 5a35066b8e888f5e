// SPDX-License-Identifier: BSD-3-Clause
// One BLAS dsyrk: the arithmetic that no dense update can do without. Lower triangle, as many rows as the state has, as
// many columns as the batch had rows, one thread, alpha = -1, beta = 1, on a matrix of its own.
//
// Right after our step its operands are cold: our covariance has just gone through the caches. Timed that way it would
// look slower than it is, and our ratio better. It is therefore called several times in a row, and the median of the
// calls after the first counts, their operands as warm as they get. Our own steps get no such favour, and the step
// after such a row starts with cold caches. The cold time is kept too, and counts for nothing.
#pragma once

#include <cblas.h>

#include <cmath>
#include <vector>

#include "samples.hpp"

namespace bench {

class Syrk {
 public:
  Syrk(std::size_t max_states, std::size_t max_rows) : C_(max_states * max_states), W_(max_states * max_rows) {
    // Small enough for a thousand downdates of C not to lead anywhere.
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
