// SPDX-License-Identifier: BSD-3-Clause
// The chi-square distribution.
#pragma once

namespace cairn {

// log Gamma(a) for a > 0. Unlike std::lgamma it writes no global, so that threads may call it at the same time.
double log_gamma(double a);

// P(X <= x) of a chi-square variable X with `dof` > 0 degrees of freedom.
double chi_square_cdf(double dof, double x);

// The x with P(X <= x) = `probability`, which lies in [0, 1]. Infinity at 1.
double chi_square_quantile(double dof, double probability);

}  // namespace cairn
