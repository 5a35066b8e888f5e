// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/alignment_solver.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "map/merge/rigid_fit.hpp"
#include "map/merge/transform_iterate.hpp"

namespace cairn {
namespace {

constexpr int kIterations = 100;
constexpr int kHalvings = 12;
constexpr double kShort = 1e-3;  // standard deviations

// How long the last step may be, in standard deviations of the transform. If pairs contradict each other, the steps
// shrink slowly, and more digits of the result have no value.
double converged(double distance, int dof) {
  const double misfit = 1 + distance / std::max(dof, 1);
  return std::min(1e-9 * misfit * misfit * misfit, 0.1);
}

std::vector<double> weights_of(const PairedPoints& pairs) {
  const std::size_t k = pairs.size();
  const auto trace = [k](const PointsCovariance& covariance, std::size_t i) {
    if (covariance.full.empty()) return covariance.blocks[i].trace();
    return covariance.matrix(k).diagonal().segment<3>(row_of_point(i)).sum();
  };
  std::vector<double> weights;
  for (std::size_t i = 0; i < k; ++i)
    weights.push_back(1 / std::max(trace(pairs.covariance_a, i) + trace(pairs.covariance_b, i), 1e-100));
  return weights;
}

}  // namespace

void solve_alignment(const PairedPoints& pairs, const TransformPrior* prior, const SE3* start,
                     AlignmentSolution& solution) {
  const std::size_t k = pairs.size();
  Alignment& result = solution.alignment;
  LinearisedPairs& now = solution.linearised;
  result = Alignment{};
  if (k < (prior == nullptr ? 3u : 1u)) return;
  result.dof = 3 * static_cast<int>(k) - (prior == nullptr ? 6 : 0);

  TransformIterate iterate(prior);
  if (prior == nullptr) {
    result.status = AlignmentStatus::degenerate;
    SE3 first;
    if (start != nullptr) {
      first = *start;
    } else if (!align_by_weights(pairs.a, pairs.b, weights_of(pairs), first)) {
      return;
    }
    iterate.begin_at(first);
  }
  double distance = 0;
  result.status = AlignmentStatus::singular;
  if (!now.evaluate(pairs, iterate.T(), distance)) return;
  result.status = AlignmentStatus::diverged;

  bool stalled = false;
  for (int i = 0; i < kIterations; ++i) {
    now.linearise(pairs, iterate.T());
    const Matrix6 chain = iterate.chain(now.centre());
    Matrix6 A = chain.transpose() * (now.J().transpose() * now.V()) * chain;
    Vector6 gradient = chain.transpose() * (now.J().transpose() * now.lambda());
    if (prior != nullptr) {
      A += Matrix6::Identity();
      gradient += iterate.u();
    }
    // Scaled to a unit diagonal, so that metres and radians weigh alike.
    const Vector6 scale = A.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(Matrix6(scale.asDiagonal() * A * scale.asDiagonal()));
    if (!(eigen.eigenvalues()[0] > 1e-12)) {
      result.status = AlignmentStatus::degenerate;
      return;
    }
    const Matrix6 root = scale.asDiagonal() * eigen.eigenvectors();
    const Matrix6 inverse = root * eigen.eigenvalues().cwiseInverse().asDiagonal() * root.transpose();
    const Vector6 step = -inverse * gradient;
    const double length = std::sqrt(step.dot(A * step));
    if (stalled || length <= converged(distance, result.dof)) {
      result.status = AlignmentStatus::ok;
      result.T_a_b = iterate.T();
      result.distance = distance + iterate.u().squaredNorm();
      solution.centred_covariance = chain * inverse * chain.transpose();
      result.covariance = now.to_ordinary() * solution.centred_covariance * now.to_ordinary().transpose();
      // The rotation about a line of points is unknown. But noise gives the line some width: a variance of one for each
      // point and each of two directions, in units of the points' covariances. The rotation must be known twice as
      // well as that width suggests.
      const double turn_variance =
          Eigen::SelfAdjointEigenSolver<Matrix3>(solution.centred_covariance.bottomRightCorner<3, 3>())
              .eigenvalues()[2];
      if (prior == nullptr && !(turn_variance * 4 * static_cast<double>(k) < 1))
        result.status = AlignmentStatus::degenerate;
      return;
    }
    double factor = 1;
    const double before = distance + iterate.u().squaredNorm();
    TransformIterate next = iterate;
    bool fell = false;
    for (int halving = 0; halving < kHalvings && !fell; ++halving, factor /= 2) {
      next = iterate.moved(factor * step, now.centre());
      // Rounding errors of the distance must not prevent the last steps.
      fell =
          now.evaluate(pairs, next.T(), distance) && distance + next.u().squaredNorm() <= before * (1 + 1e-12) + 1e-12;
    }
    if (!fell) {
      // In maps that have drifted far, S is ill-conditioned, and rounding hides the gain of such a short step.
      if (!(length <= kShort) || !now.evaluate(pairs, iterate.T(), distance)) return;
      stalled = true;
      continue;
    }
    iterate = next;
  }
}

}  // namespace cairn
