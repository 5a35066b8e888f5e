// SPDX-License-Identifier: BSD-3-Clause
// Chi-square probabilities and quantiles.
#include "core/chi_square.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace cairn;

namespace {

// All small degrees of freedom, then ever sparser ones.
int next_dof(int dof) {
  return dof < 60 ? dof + 1 : dof + dof / 7;
}

// P(X > x) in closed form. Even degrees: the Poisson sum. Odd ones: the normal's tail and the recurrence
// Q(a + 1, y) = Q(a, y) + y^a e^-y / Gamma(a + 1) (Abramowitz and Stegun 26.4.4, 26.4.5, 26.4.8), with y = x / 2.
double tail(int dof, double x) {
  const double y = 0.5 * x;
  double term = dof % 2 == 0 ? std::exp(-y) : std::sqrt(y) * std::exp(-y) / std::tgamma(1.5);
  double sum = dof % 2 == 0 ? 0 : std::erfc(std::sqrt(y));
  for (double a = dof % 2 == 0 ? 1 : 1.5; 2 * a <= dof; a += 1) {
    sum += term;
    term *= y / a;
  }
  return sum;
}

}  // namespace

TEST_CASE("chi-square: quantiles of the printed tables") {
  // The usual tables (Abramowitz and Stegun, Table 26.8), to six digits.
  struct {
    int dof;
    double probability, quantile;
  } const table[] = {{1, 0.95, 3.84146},  {1, 0.99, 6.63490},   {2, 0.95, 5.99147},  {2, 0.99, 9.21034},
                     {3, 0.95, 7.81473},  {3, 0.99, 11.3449},   {4, 0.95, 9.48773},  {5, 0.95, 11.0705},
                     {6, 0.95, 12.5916},  {6, 0.99, 16.8119},   {6, 0.975, 14.4494}, {6, 0.025, 1.23734},
                     {10, 0.95, 18.3070}, {10, 0.005, 2.15585}, {30, 0.95, 43.7729}, {100, 0.95, 124.342},
                     {100, 0.05, 77.9295}};
  for (const auto& row : table) {
    CAPTURE(row.dof);
    CHECK(chi_square_quantile(row.dof, row.probability) == doctest::Approx(row.quantile).epsilon(5e-6));
  }
}

TEST_CASE("chi-square: quantiles to all digits") {
  // scipy 1.10, scipy.stats.chi2.ppf(p, dof).
  CHECK(chi_square_quantile(1, 0.95) == doctest::Approx(3.841458820694124).epsilon(1e-14));
  CHECK(chi_square_quantile(3, 0.99) == doctest::Approx(11.344866730144373).epsilon(1e-14));
  CHECK(chi_square_quantile(6, 0.95) == doctest::Approx(12.591587243743977).epsilon(1e-14));
  // Two degrees of freedom: -2 ln(1 - p).
  for (double p : {1e-300, 1e-12, 0.025, 0.5, 0.975, 0.9999})
    CHECK(chi_square_quantile(2, p) == doctest::Approx(-2 * std::log1p(-p)).epsilon(1e-13));
}

TEST_CASE("chi-square: distribution against its closed forms") {
  for (int dof = 1; dof <= 300; dof = next_dof(dof))
    for (double factor : {0.01, 0.3, 0.8, 1.0, 1.1, 1.5, 3.0}) {
      const double x = factor * dof;
      CAPTURE(dof);
      CAPTURE(x);
      CHECK(1 - chi_square_cdf(dof, x) == doctest::Approx(tail(dof, x)).epsilon(1e-12));
    }
}

// The logarithms of the factors of the density grow with dof, and so does their rounding.
TEST_CASE("chi-square: the quantile inverts the distribution") {
  for (int dof = 1; dof <= 10000; dof = next_dof(dof))
    for (double p : {1e-6, 0.001, 0.025, 0.05, 0.3, 0.5, 0.8, 0.95, 0.975, 0.99, 0.9999, 1 - 1e-9}) {
      CAPTURE(dof);
      CAPTURE(p);
      const double x = chi_square_quantile(dof, p);
      CHECK(std::abs(chi_square_cdf(dof, x) - p) < 1e-13 + 1e-15 * dof);
    }
}

TEST_CASE("chi-square: both are increasing, and medians follow their series for many degrees") {
  for (int dof = 1; dof <= 10000; dof = next_dof(dof)) {
    CHECK(chi_square_quantile(dof, 0.95) < chi_square_quantile(dof + 1, 0.95));
    CHECK(chi_square_quantile(dof, 0.95) < chi_square_quantile(dof, 0.951));
    // Choi 1994, On the medians of gamma distributions. The next term decreases with the cube.
    const double k = dof, median = k - 2.0 / 3 + 32 / (405 * k) + 1472 / (25515 * k * k);
    CHECK(std::abs(chi_square_quantile(dof, 0.5) - median) < 0.02 / (k * k * k) + 4e-15 * k * std::sqrt(k));
  }
}

TEST_CASE("chi-square: limits of the range") {
  CHECK(chi_square_cdf(3, 0) == 0);
  CHECK(chi_square_cdf(3, -1) == 0);
  CHECK(chi_square_cdf(3, 1e4) == 1);
  CHECK(chi_square_quantile(3, 0) == 0);
  CHECK(chi_square_quantile(3, 1) == std::numeric_limits<double>::infinity());
}
