// SPDX-License-Identifier: BSD-3-Clause
#include "map/shared_errors.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "linear/joint_gate.hpp"

namespace cairn {

// With s = prior + L u, L L^T the prior's covariance, the prior's information on u is I. The posterior's is I + M, and
// M is what the submap found out: positive semidefinite.
ErrorRows found_out(const SubmapErrors& errors) {
  using Matrix = Eigen::MatrixXd;
  constexpr double kLeast = 1e-12;  // of the prior's information: rounding
  const Index g = errors.count();
  const Eigen::LLT<Matrix> prior(errors.prior_covariance);
  const Matrix L = prior.matrixL();
  const auto lower = prior.matrixL();
  const Matrix half = lower.solve(Matrix(errors.covariance.topLeftCorner(g, g)));
  Matrix posterior = lower.solve(Matrix(half.transpose()));  // covariance of u
  posterior = (0.5 * (posterior + posterior.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(posterior);
  const Eigen::VectorXd u = lower.solve(Eigen::VectorXd(errors.value - errors.prior));
  if (prior.info() != Eigen::Success || eigen.info() != Eigen::Success || !posterior.allFinite() || !u.allFinite() ||
      !(eigen.eigenvalues().minCoeff() > 0.0))
    throw_not_definite();
  ErrorRows out;
  std::vector<Index> informative;
  for (Index i = 0; i < g; ++i)
    if (1.0 / eigen.eigenvalues()(i) - 1.0 > kLeast) informative.push_back(i);
  const auto count = static_cast<Index>(informative.size());
  out.rows.resize(count, g);
  out.values.resize(count);
  for (Index r = 0; r < count; ++r) {
    const Index i = informative[static_cast<std::size_t>(r)];
    const double information = 1.0 / eigen.eigenvalues()(i) - 1.0, root = std::sqrt(information);
    const Eigen::VectorXd v = eigen.eigenvectors().col(i);
    // root v^T u = (1 + information) / root v^T u_hat, with u = L^-1 (s - prior)
    out.rows.row(r) = root * Eigen::VectorXd(prior.matrixU().solve(v)).transpose();
    out.values(r) = (1.0 + information) / root * v.dot(u) + out.rows.row(r).dot(errors.prior);
  }
  return out;
}

GivenErrors given_errors(const Eigen::MatrixXd& covariance, const SubmapErrors& errors) {
  using Matrix = Eigen::MatrixXd;
  const Index n = covariance.rows(), g = errors.count(), d = errors.walked.size();
  Matrix across(n + d, g), joint(n + d, n + d);  // of [end; landmarks; d]
  across << errors.cross.leftCols(g), errors.covariance.bottomLeftCorner(d, g);
  joint.topLeftCorner(n, n) = covariance;
  joint.bottomLeftCorner(d, n) = errors.cross.rightCols(d).transpose();
  joint.topRightCorner(n, d) = errors.cross.rightCols(d);
  joint.bottomRightCorner(d, d) = errors.covariance.bottomRightCorner(d, d);
  GivenErrors given;
  // Scaled to unit diagonal: metres per second and radians per second differ by orders of magnitude.
  const Eigen::VectorXd scale = errors.covariance.diagonal().head(g).cwiseSqrt();
  const Matrix own =
      scale.cwiseInverse().asDiagonal() * errors.covariance.topLeftCorner(g, g) * scale.cwiseInverse().asDiagonal();
  const Eigen::LDLT<Matrix> factor(own);
  const Matrix scaled = scale.cwiseInverse().asDiagonal() * across.transpose();
  given.K = (scale.cwiseInverse().asDiagonal() * Matrix(factor.solve(scaled))).transpose();
  given.covariance = joint - given.K * across.transpose();
  given.covariance = (0.5 * (given.covariance + given.covariance.transpose())).eval();
  if (!given.K.allFinite() || !given.covariance.allFinite()) throw_not_definite();
  return given;
}

}  // namespace cairn
