// SPDX-License-Identifier: BSD-3-Clause
// Packed triangles.
#include "linear/triangle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace cairn;

namespace {

using Index = std::ptrdiff_t;

// Fills memory that the update must not write.
constexpr double kUntouched = -7.25;
// Fills memory that the update must not read: any use of it makes the result NaN.
const double kPoison = std::numeric_limits<double>::quiet_NaN();

struct Case {
  Index n, k;
  Index extra_c, extra_a, extra_b;  // leading dimension beyond n
};

// n x k values between -1 and 1, with poison in the padding.
std::vector<double> random_matrix(std::mt19937& engine, Index n, Index k, Index ld) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> matrix(static_cast<std::size_t>(ld * k), kPoison);
  for (Index p = 0; p < k; ++p) {
    for (Index i = 0; i < n; ++i) matrix[i + p * ld] = uniform(engine);
  }
  return matrix;
}

// Compares one case with a triple loop. False if an entry is wrong or was written without need.
bool agrees(const Case& c, unsigned seed) {
  std::mt19937 engine(seed);
  const Index ldc = c.n + c.extra_c, lda = c.n + c.extra_a, ldb = c.n + c.extra_b;
  const std::vector<double> A = random_matrix(engine, c.n, c.k, lda), B = random_matrix(engine, c.n, c.k, ldb);
  std::vector<double> C = random_matrix(engine, c.n, c.n, ldc);
  for (Index j = 0; j < c.n; ++j) {
    for (Index i = 0; i < ldc; ++i) {
      if (i < j || i >= c.n) C[i + j * ldc] = kUntouched;
    }
  }
  std::vector<double> expected = C;
  for (Index j = 0; j < c.n; ++j) {
    for (Index i = j; i < c.n; ++i) {
      for (Index p = 0; p < c.k; ++p) expected[i + j * ldc] += A[i + p * lda] * B[j + p * ldb];
    }
  }

  const std::size_t size = update_triangle_workspace(c.n, c.k);
  std::vector<double> workspace(size + 1, kPoison);
  workspace[size] = kUntouched;
  update_triangle(C.data(), ldc, c.n, A.data(), lda, B.data(), ldb, c.k, workspace.data());
  if (workspace[size] != kUntouched) return false;

  const double tolerance = 1e-15 * static_cast<double>(c.k + 1);  // one rounding of order one for each term
  for (Index j = 0; j < c.n; ++j) {
    for (Index i = 0; i < ldc; ++i) {
      const double value = C[i + j * ldc];
      const bool ours = i >= j && i < c.n;
      if (ours ? !(std::abs(value - expected[i + j * ldc]) <= tolerance) : value != kUntouched) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("triangle: the rank-k update equals a triple loop and keeps to the lower triangle") {
  unsigned seed = 1;
  for (Index n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 15, 16, 17, 23, 24, 25, 36, 47, 61, 96, 119, 121, 150}) {
    for (Index k : {0, 1, 2, 3, 5, 15, 36, 39, 64}) {
      const Case c{n, k, n % 4, k % 5, (n + k) % 3};
      CAPTURE(n);
      CAPTURE(k);
      CHECK(agrees(c, ++seed));
    }
  }
}

TEST_CASE("triangle: ranks and sizes beyond one slice and one block") {
  CHECK(agrees({37, 191, 1, 0, 2}, 1));
  CHECK(agrees({37, 192, 0, 3, 0}, 2));
  CHECK(agrees({38, 193, 2, 1, 1}, 3));
  CHECK(agrees({261, 192, 0, 0, 0}, 4));  // more than one block of 120 rows
  CHECK(agrees({247, 401, 1, 2, 3}, 5));
  CHECK(agrees({701, 39, 3, 0, 1}, 6));
}

TEST_CASE("triangle: a workspace for the largest size serves every smaller one") {
  for (Index n = 1; n < 130; n += 7) {
    for (Index k = 0; k < 400; k += 57) {
      CHECK(update_triangle_workspace(n, k) <= update_triangle_workspace(n + 1, k));
      CHECK(update_triangle_workspace(n, k) <= update_triangle_workspace(n, k + 1));
    }
  }
}

TEST_CASE("triangle: the same inputs give the same bits, wherever the workspace lies") {
  const Index n = 45, k = 21;
  std::mt19937 engine(5);
  const std::vector<double> A = random_matrix(engine, n, k, n), start = random_matrix(engine, n, n, n);
  std::vector<double> workspace(update_triangle_workspace(n, k) + 8);
  std::vector<double> first = start;
  update_triangle(first.data(), n, n, A.data(), n, A.data(), n, k, workspace.data());
  for (int offset = 1; offset < 8; ++offset) {
    std::vector<double> again = start;
    update_triangle(again.data(), n, n, A.data(), n, A.data(), n, k, workspace.data() + offset);
    CHECK(again == first);
  }
}
