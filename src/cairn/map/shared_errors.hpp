// SPDX-License-Identifier: BSD-3-Clause
// Systematic errors that all submaps of a map share (docs/systematic_errors.md): numbers s. Two submaps that depend on
// the same error are not independent. Therefore the map holds s, and a submap joins as what it says *given* s, together
// with what it says about s itself. The error of a submap's base, about which absolute fixes tell, is treated in the
// same way.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cairn {

// The errors of a map: their standard deviations at its start (their values are zero there), and the numbers of those
// that walk.
struct SharedErrorOptions {
  std::vector<double> sigma;
  std::vector<Eigen::Index> walking;

  Eigen::Index count() const { return static_cast<Eigen::Index>(sigma.size()); }
};

// The errors in a submap: s when it began, and d, what the walking ones have walked in it.
struct SubmapErrors {
  Eigen::VectorXd prior;             // of s, with which the submap began
  Eigen::MatrixXd prior_covariance;  // of s
  Eigen::VectorXd value, walked;     // estimates of s and of d
  Eigen::MatrixXd cross;             // covariance of [end; landmarks] with [s; d]
  Eigen::MatrixXd covariance;        // of [s; d]

  Eigen::Index count() const { return prior.size(); }
};

// A Gaussian of errors as independent rows of unit noise: rows s = values. Directions without information have no row.
struct ErrorRows {
  Eigen::MatrixXd rows;
  Eigen::VectorXd values;
};

// What the submap found out about s: its posterior without the prior that it began with (eq. 12).
ErrorRows found_out(const SubmapErrors& errors);

// A submap given s: its estimates move by K (s - value), and their covariance is that of the rest (eq. 13). The rows
// are [end; landmarks; d].
struct GivenErrors {
  Eigen::MatrixXd K, covariance;
};
// `covariance`: of [end; landmarks], in the coordinates of `cross`.
GivenErrors given_errors(const Eigen::MatrixXd& covariance, const SubmapErrors& errors);

}  // namespace cairn
