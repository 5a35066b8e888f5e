// SPDX-License-Identifier: BSD-3-Clause
// Robust losses: their weights, their efficiency, and the covariance that an estimate claims by them.
#include "linear/robust_loss.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

struct Scatter {
  double variance = 0.0, claimed = 0.0, largest = 0.0;  // means over the runs; the largest error
};

// The location of `count` observations of `Rows` independent rows with unit noise, by weights that are found in an
// iteration; `outliers` of them lie anywhere within 100 standard deviations.
template <int Rows>
Scatter locate(const RobustLoss& loss, int count, double outliers, int runs) {
  using Vector = Eigen::Matrix<double, Rows, 1>;
  Random random(11);
  Scatter scatter;
  std::vector<Vector> seen(static_cast<std::size_t>(count));
  for (int run = 0; run < runs; ++run) {
    for (Vector& z : seen) {
      z = random.normal_vector<Rows>();
      if (random.uniform(0, 1) >= outliers) continue;
      for (int i = 0; i < Rows; ++i) z[i] = random.uniform(-100, 100);
    }
    Vector estimate = Vector::Zero();
    double information = 0.0;
    for (int i = 0; i < 12; ++i) {
      Vector sum = Vector::Zero();
      information = 0.0;
      for (const Vector& z : seen) {
        const double weight = 1.0 / loss.noise_factor((z - estimate).squaredNorm(), Rows);
        sum += weight * z;
        information += weight;
      }
      estimate = sum / information;
    }
    scatter.variance += estimate.squaredNorm() / Rows / runs;
    scatter.claimed += 1.0 / information / runs;
    scatter.largest = std::max(scatter.largest, estimate.norm());
  }
  return scatter;
}

}  // namespace

TEST_CASE("robust loss: weights (L2)") {
  const RobustLoss none, huber(LossKind::huber, 1.5), cauchy(LossKind::cauchy, 2.0);
  CHECK(!none.robust());
  CHECK(none.weight(1e9) == 1.0);
  CHECK(none.noise_factor(1e9, 2) == 1.0);
  CHECK(huber.weight(0.0) == 1.0);
  CHECK(huber.weight(1.5 * 1.5) == 1.0);
  CHECK(huber.weight(9.0) == doctest::Approx(0.5));
  CHECK(cauchy.weight(0.0) == 1.0);
  CHECK(cauchy.weight(4.0) == doctest::Approx(0.5));
  CHECK(cauchy.weight(36.0) == doctest::Approx(0.1));
  // Rounding may give a negative square, and a gross outlier must not make the noise infinite.
  CHECK(huber.weight(-1e-20) == 1.0);
  CHECK(cauchy.weight(1e300) > 0.0);
  CHECK(std::isfinite(cauchy.noise_factor(1e300, 1)));
  CHECK(std::isfinite(huber.noise_factor(1e300, 3)));
}

TEST_CASE("robust loss: a wide loss is least squares") {
  for (const LossKind kind : {LossKind::huber, LossKind::cauchy})
    for (Index rows = 1; rows <= 3; ++rows)
      CHECK(RobustLoss(kind, 1e4).noise_factor(1.0, rows) == doctest::Approx(1.0).epsilon(1e-6));
}

// For one row all means have closed forms. Huber: A = P(|d| < k), B = A - 2 k phi(k) + 2 k^2 Q(k),
// E[w] = A + 2 k int_k^inf phi(d) / d. Cauchy with c = 1: E[w] = sqrt(pi / 2) e^(1/2) erfc(sqrt(1/2)).
TEST_CASE("robust loss: the efficiency of one row against closed forms (L3, L4)") {
  const double pi = 3.14159265358979323846, k = 1.345;
  const double inside = std::erf(k / std::sqrt(2.0)), beyond = 0.5 * std::erfc(k / std::sqrt(2.0));
  const double phi = std::exp(-0.5 * k * k) / std::sqrt(2 * pi);
  const double B = inside - 2 * k * phi + 2 * k * k * beyond;
  double tail = 0.0;  // int_k^inf phi(d) / d, with d = k / t
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    tail += std::exp(-0.5 * k * k / (t * t)) / std::sqrt(2 * pi) / t / kSteps;
  }
  const double huber = inside * inside / (B * (inside + 2 * k * tail));
  CHECK(inside * inside / B == doctest::Approx(0.95).epsilon(1e-3));  // the known efficiency of this width
  CHECK(RobustLoss(LossKind::huber, k).efficiency(1) == doctest::Approx(huber).epsilon(1e-4));

  // w d^2 = 1 - w and w^2 d^2 = w - w^2; m = E[w], and E[w^2] by the midpoint rule.
  const double m = std::sqrt(pi / 2) * std::exp(0.5) * std::erfc(std::sqrt(0.5));
  double square = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double d = 12.0 * (i + 0.5) / kSteps, w = 1 / (1 + d * d);
    square += w * w * 2 * std::exp(-0.5 * d * d) / std::sqrt(2 * pi) * 12.0 / kSteps;
  }
  const double cauchy = (1 - m) * (1 - m) / ((m - square) * m);
  CHECK(RobustLoss(LossKind::cauchy, 1.0).efficiency(1) == doctest::Approx(cauchy).epsilon(1e-4));
}

TEST_CASE_TEMPLATE("robust loss: the claimed covariance is the scatter of the estimate", Rows,
                   std::integral_constant<int, 1>, std::integral_constant<int, 2>, std::integral_constant<int, 3>) {
  for (const LossKind kind : {LossKind::huber, LossKind::cauchy})
    for (const double width : {1.0, 2.0}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(width);
      const Scatter scatter = locate<Rows::value>(RobustLoss(kind, width), 50, 0.0, 1500);
      CHECK(scatter.claimed == doctest::Approx(scatter.variance).epsilon(0.08));
      CHECK(scatter.claimed > 0.98 / 50);  // never better than least squares
      CHECK(scatter.claimed < 1.6 / 50);
    }
}

TEST_CASE("robust loss: outliers move the estimate little") {
  const Scatter plain = locate<2>(RobustLoss(), 50, 0.2, 500);
  const Scatter huber = locate<2>(RobustLoss(LossKind::huber, 1.5), 50, 0.2, 500);
  const Scatter cauchy = locate<2>(RobustLoss(LossKind::cauchy, 1.5), 50, 0.2, 500);
  CHECK(plain.largest > 5.0);
  CHECK(huber.largest < 2.0);
  CHECK(cauchy.largest < 1.0);
  CHECK(cauchy.claimed == doctest::Approx(cauchy.variance).epsilon(0.25));
}
