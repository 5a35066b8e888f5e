// SPDX-License-Identifier: BSD-3-Clause
// Compares the small algebra with Eigen. Memory that must not be read or written holds values that reveal an access.
#include "linear/small_algebra.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

using Dynamic = Eigen::MatrixXd;
using DynamicVector = Eigen::VectorXd;
constexpr double kPoison = std::numeric_limits<double>::quiet_NaN();
// One panel of the factorisation and less, and several panels. None is a multiple of a vector register except by
// chance.
constexpr Index kSizes[] = {1, 2, 3, 4, 5, 7, 12, 15, 16, 17, 33, 47, 48, 49, 64, 96, 97, 131, 150};

Dynamic random_matrix(Random& random, Index rows, Index columns) {
  Dynamic A(rows, columns);
  for (Index c = 0; c < columns; ++c)
    for (Index r = 0; r < rows; ++r) A(r, c) = random.uniform(-1, 1);
  return A;
}

Dynamic random_definite(Random& random, Index m) {
  const Dynamic A = random_matrix(random, m, m);
  return A * A.transpose() + 0.1 * Dynamic::Identity(m, m);
}

// The lower triangle of S with leading dimension ld, and poison everywhere else.
std::vector<double> lower_of(const Dynamic& S, Index ld) {
  std::vector<double> values(static_cast<std::size_t>(ld * S.cols()), kPoison);
  for (Index c = 0; c < S.cols(); ++c)
    for (Index r = c; r < S.rows(); ++r) values[static_cast<std::size_t>(c * ld + r)] = S(r, c);
  return values;
}

std::vector<double> workspace_of(std::size_t size) {
  return std::vector<double>(size + 1, kPoison);
}

// The factor and the memory around it. False if the memory around it changed.
bool factor(const Dynamic& S, Index ld, Dynamic& L) {
  const Index m = S.rows();
  std::vector<double> values = lower_of(S, ld), workspace = workspace_of(cholesky_workspace(m));
  workspace.back() = -7.25;
  if (!cholesky(values.data(), ld, m, workspace.data()) || workspace.back() != -7.25) return false;
  L = Dynamic::Zero(m, m);
  for (Index c = 0; c < m; ++c)
    for (Index r = 0; r < ld; ++r) {
      const double value = values[static_cast<std::size_t>(c * ld + r)];
      if (r >= c && r < m) {
        L(r, c) = value;
      } else if (value == value) {
        return false;
      }
    }
  return true;
}

}  // namespace

TEST_CASE("small algebra: partial Cholesky factor") {
  Random random(2);
  for (const Index n : kSizes)
    for (const Index e : {Index{0}, n / 3, n / 2, n}) {
      CAPTURE(n);
      CAPTURE(e);
      const Dynamic S = random_definite(random, n);
      std::vector<double> values = lower_of(S, n + 1), workspace = workspace_of(eliminate_workspace(n));
      workspace.back() = -7.25;
      REQUIRE(eliminate(values.data(), n + 1, n, e, workspace.data()));
      CHECK(workspace.back() == -7.25);
      Dynamic expected = S;
      if (e > 0) {
        const Dynamic L = S.topLeftCorner(e, e).llt().matrixL();
        const Dynamic below = L.triangularView<Eigen::Lower>().solve(S.topRightCorner(e, n - e)).transpose();
        expected.topLeftCorner(e, e) = L;
        expected.bottomLeftCorner(n - e, e) = below;
        expected.bottomRightCorner(n - e, n - e) -= below * below.transpose();
      }
      double difference = 0.0;
      for (Index c = 0; c < n; ++c)
        for (Index r = c; r < n; ++r)
          difference =
              std::max(difference, std::abs(values[static_cast<std::size_t>(c * (n + 1) + r)] - expected(r, c)));
      CHECK(difference <= 1e-12 * S.norm());
    }
  Dynamic S = -Dynamic::Identity(4, 4);
  std::vector<double> workspace = workspace_of(eliminate_workspace(4));
  CHECK(!eliminate(S.data(), 4, 4, 1, workspace.data()));
}

TEST_CASE("small algebra: Cholesky factor") {
  Random random(1);
  for (Index m : kSizes) {
    CAPTURE(m);
    const Dynamic S = random_definite(random, m);
    const Dynamic expected = S.llt().matrixL();
    Dynamic L;
    REQUIRE(factor(S, m + m % 3, L));
    CHECK((L - expected).norm() < 1e-12 * expected.norm());
    CHECK((L * L.transpose() - S).norm() < 1e-14 * static_cast<double>(m + 1) * S.norm());
  }
}

TEST_CASE("small algebra: a matrix that is not positive definite has no factor") {
  Random random(2);
  Dynamic L;
  for (Index m : kSizes)
    for (Index bad : {Index(0), m / 2, m - 1}) {
      CAPTURE(m);
      CAPTURE(bad);
      Dynamic S = random_definite(random, m);
      REQUIRE(factor(S, m, L));
      const double pivot = L(bad, bad) * L(bad, bad);
      S(bad, bad) -= 1.001 * pivot;  // this pivot falls below zero
      CHECK_FALSE(factor(S, m, L));
      S(bad, bad) = kPoison;
      CHECK_FALSE(factor(S, m, L));
      S(bad, bad) = std::numeric_limits<double>::infinity();
      CHECK_FALSE(factor(S, m, L));
    }
  CHECK_FALSE(factor(Dynamic::Zero(3, 3), 3, L));
}

TEST_CASE("small algebra: solves with the factor and its transpose") {
  Random random(3);
  for (Index m : kSizes) {
    CAPTURE(m);
    const Dynamic S = random_definite(random, m);
    const Dynamic L = S.llt().matrixL();
    const DynamicVector b = random_matrix(random, m, 1);
    const std::vector<double> values = lower_of(L, m + 2);
    DynamicVector x = b;
    solve_lower(values.data(), m + 2, m, x.data());
    CHECK((L * x - b).norm() < 1e-11 * b.norm());
    x = b;
    solve_lower_transposed(values.data(), m + 2, m, x.data());
    CHECK((L.transpose() * x - b).norm() < 1e-11 * b.norm());
  }
}

TEST_CASE("small algebra: the right solve, and the sums that it gives besides") {
  Random random(4);
  for (Index m : {1, 2, 3, 6, 15, 36, 49})
    for (Index n : {1, 3, 11, 12, 13, 15, 16, 17, 24, 25, 31, 32, 50, 121}) {
      CAPTURE(m);
      CAPTURE(n);
      const Dynamic L = random_definite(random, m).llt().matrixL();
      const Dynamic given = random_matrix(random, n, m);
      const DynamicVector y = random_matrix(random, m, 1);
      const Index ld = n + 3;
      Dynamic W = Dynamic::Constant(ld, m, -7.25);
      W.topRows(n) = given;
      Dynamic again = W;
      DynamicVector squares = DynamicVector::Constant(n + 1, -7.25), products = squares;
      const std::vector<double> values = lower_of(L, m + 1);
      std::vector<double> workspace = workspace_of(solve_workspace(m));
      workspace.back() = -7.25;
      solve_right_transposed(values.data(), m + 1, m, W.data(), ld, n, workspace.data());
      const RowSums sums{y.data(), squares.data(), products.data()};
      solve_right_transposed(values.data(), m + 1, m, again.data(), ld, n, workspace.data(), &sums);
      CHECK(workspace.back() == -7.25);
      const Dynamic X = W.topRows(n);
      CHECK((X * L.transpose() - given).norm() < 1e-10 * given.norm());
      CHECK(W == again);
      CHECK(W.bottomRows(3) == Dynamic::Constant(3, m, -7.25));
      CHECK((squares.head(n) - X.rowwise().squaredNorm()).norm() < 1e-13 * X.squaredNorm());
      CHECK((products.head(n) - X * y).norm() < 1e-13 * X.norm() * y.norm());
      CHECK(squares[n] == -7.25);
      CHECK(products[n] == -7.25);
    }
}

TEST_CASE("small algebra: the inner product, whatever the length") {
  Random random(6);
  for (Index n = 0; n < 40; ++n) {
    CAPTURE(n);
    const DynamicVector x = random_matrix(random, n + 1, 1),
                        y = random_matrix(random, n + 1, 1);  // the last one is beyond the bound
    CHECK(std::abs(dot(x.data(), y.data(), n) - x.head(n).dot(y.head(n))) <= 1e-14 * x.norm() * y.norm());
  }
}

TEST_CASE("small algebra: the full inverse from the factor") {
  Random random(5);
  for (Index m : kSizes) {
    CAPTURE(m);
    const Dynamic S = random_definite(random, m);
    const std::vector<double> L = lower_of(S.llt().matrixL(), m);
    Dynamic inverse = Dynamic::Constant(m + 1, m, kPoison);
    inverse_from_cholesky(L.data(), m, m, inverse.data(), m + 1);
    CHECK((S * inverse.topRows(m) - Dynamic::Identity(m, m)).norm() < 1e-10 * static_cast<double>(m));
    CHECK((inverse.topRows(m) - inverse.topRows(m).transpose()).norm() < 1e-10 * inverse.topRows(m).norm());
    CHECK(inverse.bottomRows(1).array().isNaN().all());
  }
}
