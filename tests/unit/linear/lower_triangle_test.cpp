// SPDX-License-Identifier: BSD-3-Clause
// Moves of rows and columns against dense symmetric matrices. NaN fills everything that may not be read, so that the
// tests find any use of it.
#include "linear/lower_triangle.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cstring>
#include <limits>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

using Dynamic = Eigen::MatrixXd;
constexpr double kPoison = std::numeric_limits<double>::quiet_NaN();

Dynamic random_symmetric(Random& random, Index n) {
  Dynamic A(n, n);
  for (Index c = 0; c < n; ++c)
    for (Index r = c; r < n; ++r) A(r, c) = A(c, r) = random.uniform(-1, 1);
  return A;
}

// The lower triangle of a dense matrix, in memory for `columns` columns of `ld` rows.
struct Stored {
  Stored(const Dynamic& A, Index ld, Index columns)
      : memory(static_cast<std::size_t>(ld * columns), kPoison), triangle(memory.data(), ld) {
    for (Index c = 0; c < A.cols(); ++c)
      for (Index r = c; r < A.rows(); ++r) triangle(r, c) = A(r, c);
  }
  Dynamic dense(Index n) const {
    Dynamic A(n, n);
    for (Index c = 0; c < n; ++c)
      for (Index r = 0; r < n; ++r) A(r, c) = triangle.symmetric(r, c);
    return A;
  }
  // Whether everything outside of the lower triangle of the first n rows still holds poison.
  bool poisoned_around(Index n) const {
    const Index ld = triangle.ld();
    for (std::size_t i = 0; i < memory.size(); ++i) {
      const Index r = static_cast<Index>(i) % ld, c = static_cast<Index>(i) / ld;
      if ((r < c || r >= n || c >= n) && memory[i] == memory[i]) return false;
    }
    return true;
  }

  std::vector<double> memory;
  LowerTriangle triangle;
};

}  // namespace

TEST_CASE("lower triangle: entries of both halves are those of the lower one") {
  Random random(1);
  const Dynamic A = random_symmetric(random, 5);
  Stored stored(A, 7, 5);
  CHECK(stored.triangle.ld() == 7);
  CHECK(stored.dense(5) == A);
  for (Index c = 0; c < 5; ++c)
    for (Index r = 0; r < 5; ++r) {
      CHECK(stored.triangle.symmetric(r, c) == A(r, c));
      CHECK(stored.triangle.entry(r, c) == A(r, c));
      CHECK(&stored.triangle.entry(r, c) == &stored.triangle.entry(c, r));
    }
  for (Index c = 0; c < 5; ++c) CHECK(stored.triangle.column(c)[4] == A(4, c));
  CHECK(stored.poisoned_around(5));
}

TEST_CASE("lower triangle: exchange is the permutation of a dense matrix") {
  Random random(2);
  for (Index n = 1; n <= 8; ++n)
    for (Index a = 0; a < n; ++a)
      for (Index b = 0; b < n; ++b) {
        CAPTURE(n);
        CAPTURE(a);
        CAPTURE(b);
        const Dynamic A = random_symmetric(random, n);
        Dynamic expected = A;
        expected.row(a).swap(expected.row(b));
        expected.col(a).swap(expected.col(b));
        Stored stored(A, n + n % 3, n);
        stored.triangle.exchange(a, b, n);
        CHECK(stored.dense(n) == expected);
        CHECK(stored.poisoned_around(n));
        stored.triangle.exchange(b, a, n);
        CHECK(stored.dense(n) == A);
      }
}

TEST_CASE("lower triangle: exchange touches only the first n rows and columns") {
  Random random(3);
  const Dynamic A = random_symmetric(random, 8);
  Stored stored(A, 8, 8);
  stored.triangle.exchange(1, 4, 6);
  Dynamic expected = A;
  Dynamic corner = A.topLeftCorner(6, 6);
  corner.row(1).swap(corner.row(4));
  corner.col(1).swap(corner.col(4));
  expected.topLeftCorner(6, 6) = corner;
  CHECK(stored.dense(8) == expected);
}

TEST_CASE("lower triangle: move_tail is the shift of a dense matrix along its diagonal") {
  Random random(4);
  for (Index from = 0; from <= 5; ++from)
    for (Index count = 0; count <= 5; ++count)
      for (Index by = -from; by <= 4; ++by) {
        CAPTURE(from);
        CAPTURE(count);
        CAPTURE(by);
        const Index n = from + count, kept = from + std::min<Index>(by, 0);  // rows before the tail that stay
        const Dynamic A = random_symmetric(random, n);
        Stored stored(A, n + 5, n + 5);
        stored.triangle.move_tail(from, count, by);
        CHECK(stored.dense(kept) == A.topLeftCorner(kept, kept));
        const Dynamic moved = stored.dense(n + by);
        CHECK(moved.bottomRightCorner(count, count) == A.bottomRightCorner(count, count));
        CHECK(moved.bottomLeftCorner(count, kept) == A.block(from, 0, count, kept));
      }
}

TEST_CASE("lower triangle: move_tail there and back gives the same bits") {
  Random random(5);
  const Index from = 4, count = 6;
  const Dynamic A = random_symmetric(random, from + count);
  Stored stored(A, 15, 15);
  for (const Index by : {1, 3, 5}) {
    stored.triangle.move_tail(from, count, by);
    stored.triangle.move_tail(from + by, count, -by);
    const Dynamic back = stored.dense(from + count);
    CHECK(std::memcmp(back.data(), A.data(), static_cast<std::size_t>(A.size()) * sizeof(double)) == 0);
  }
}
