// SPDX-License-Identifier: BSD-3-Clause
// Chi-square distribution by the incomplete gamma function.
#include "core/chi_square.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {

// Stirling's series with a shift (Abramowitz and Stegun 6.1.41, 6.1.15).
double log_gamma(double a) {
  double shift = 0.0;
  while (a < 12.0) shift -= std::log(a), a += 1.0;
  const double r = 1.0 / (a * a);
  const double series =
      (1.0 / 12 - r * (1.0 / 360 - r * (1.0 / 1260 - r * (1.0 / 1680 - r * (1.0 / 1188 - r * 691.0 / 360360))))) / a;
  return shift + (a - 0.5) * std::log(a) - a + 0.91893853320467274178 + series;
}

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// x^a e^-x / Gamma(a)
double gamma_factor(double a, double x) {
  return std::exp(a * std::log(x) - x - log_gamma(a));
}

// Regularised lower incomplete gamma function P(a, x) for x < a + 1, by its power series (Abramowitz and
// Stegun 6.5.29).
double gamma_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double n = a + 1.0; term > sum * kEpsilon; n += 1.0) {
    term *= x / n;
    sum += term;
  }
  return sum * gamma_factor(a, x);
}

// Regularised upper incomplete gamma function Q(a, x) = 1 - P(a, x) for x >= a + 1, by its continued fraction
// (Abramowitz and Stegun 6.5.31) with the modified Lentz method.
double gamma_fraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1.0 - a;
  double c = 1.0 / kTiny;
  double d = 1.0 / b;
  double h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2.0;
    d = an * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1.0 / d;
    const double factor = d * c;
    h *= factor;
    if (std::abs(factor - 1.0) <= 4.0 * kEpsilon) break;
  }
  return h * gamma_factor(a, x);
}

// P(X <= x) - probability, computed from the smaller tail, so that no digits are lost near 1.
double excess(double dof, double x, double probability) {
  const double a = 0.5 * dof;
  const double half = 0.5 * x;
  if (half <= 0.0) return -probability;
  return half < a + 1.0 ? gamma_series(a, half) - probability : (1.0 - probability) - gamma_fraction(a, half);
}

}  // namespace

double chi_square_cdf(double dof, double x) {
  return x <= 0.0 ? 0.0 : std::min(1.0, excess(dof, x, 0.0));
}

double chi_square_quantile(double dof, double probability) {
  if (probability <= 0.0) return 0.0;
  if (probability >= 1.0) return std::numeric_limits<double>::infinity();
  double lower = 0.0;
  double upper = dof + 10.0;
  while (excess(dof, upper, probability) < 0.0) lower = upper, upper *= 2.0;
  // Newton's method in a bracket. A step that would leave the bracket is replaced by bisection.
  double x = 0.5 * (lower + upper);
  for (int i = 0; i < 200; ++i) {
    const double off = excess(dof, x, probability);
    (off < 0.0 ? lower : upper) = x;
    const double density = gamma_factor(0.5 * dof, 0.5 * x) / x;
    double next = x - off / density;
    if (!(next > lower && next < upper)) next = 0.5 * (lower + upper);
    if (std::abs(next - x) <= kEpsilon * x || next <= lower || next >= upper) return next;
    x = next;
  }
  return x;
}

}  // namespace cairn
