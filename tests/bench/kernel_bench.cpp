// SPDX-License-Identifier: BSD-3-Clause
// The library's rank-k update of a triangle compared with dsyrk of OpenBLAS, alternately and with one thread each.
// Prints useful operations (n^2 k) per second and the ratio of the times. This program is built with the library's
// baseline objects and with those for x86-64-v3.
#include <cblas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include "linear/triangle.hpp"
#include "samples.hpp"

namespace {

struct Rates {
  double ours, blas;  // milliseconds for each call, median
};

// Short calls are timed in batches; the median of the batches is used.
Rates measure(std::ptrdiff_t n, std::ptrdiff_t k) {
  const auto size = static_cast<std::size_t>(n), rank = static_cast<std::size_t>(k);
  std::vector<double> ours(size * size), blas(size * size), W(size * rank), minus_W(size * rank);
  std::vector<double> workspace(cairn::update_triangle_workspace(n, k));
  for (std::size_t i = 0; i < W.size(); ++i) {
    W[i] = 1e-4 * std::sin(static_cast<double>(i));
    minus_W[i] = -W[i];
  }
  const auto call_ours = [&] {
    cairn::update_triangle(ours.data(), n, n, minus_W.data(), n, W.data(), n, k, workspace.data());
  };
  const auto call_blas = [&] {
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, static_cast<int>(n), static_cast<int>(k), -1.0, W.data(),
                static_cast<int>(n), 1.0, blas.data(), static_cast<int>(n));
  };
  const double operations = static_cast<double>(n) * static_cast<double>(n) * static_cast<double>(k);
  const int batch = std::clamp(static_cast<int>(2e7 / operations), 1, 200);
  const int rounds = std::clamp(static_cast<int>(4e9 / (operations * batch)), 5, 101);
  const auto timed = [batch](const auto& call) {
    call();  // these operands evict those of the other function from the caches
    const bench::Stopwatch watch;
    for (int i = 0; i < batch; ++i) call();
    return watch.milliseconds() / batch;
  };
  bench::Samples ours_ms, blas_ms;
  for (int round = 0; round < rounds; ++round) {
    ours_ms.add(timed(call_ours));
    blas_ms.add(timed(call_blas));
  }
  return {ours_ms.median(), blas_ms.median()};
}

}  // namespace

int main() {
  openblas_set_num_threads(1);
  std::printf("OpenBLAS kernels for %s; times are medians\n", openblas_get_corename());
  std::printf("%6s %5s %12s %12s %10s %10s %8s\n", "n", "k", "ours ms", "dsyrk ms", "ours GF/s", "dsyrk GF/s", "ratio");
  for (std::ptrdiff_t n : {186, 606, 1068, 3006}) {
    for (std::ptrdiff_t k : {15, 36, 39, 60, 120}) {
      const Rates rates = measure(n, k);
      const double giga = 1e-6 * static_cast<double>(n * n * k);
      std::printf("%6td %5td %12.4f %12.4f %10.1f %10.1f %8.3f\n", n, k, rates.ours, rates.blas, giga / rates.ours,
                  giga / rates.blas, rates.ours / rates.blas);
    }
  }
  return 0;
}
