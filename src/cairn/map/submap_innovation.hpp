// SPDX-License-Identifier: BSD-3-Clause
// A submap that is about to join, against what the map knows of its landmarks: innovation, robust weights, and the
// widening of the motion that led to it (docs/submaps.md).
#pragma once

#include <vector>

#include "linear/robust_loss.hpp"
#include "map/landmarks.hpp"
#include "map/submap.hpp"

namespace cairn {

// nu = y - R^T (l - p) of the known landmarks, y their estimates in the submap, and S = H P H^T + Sigma.
template <class Pose>
struct SubmapInnovation {
  using ByBase = Eigen::Matrix<double, Pose::kDim, Pose::kDof>;

  // `locals` are the known landmarks in the submap, `points` their places in the map, `P` the joint covariance of
  // [base; points] and `noise` the submap's covariance with ordinary errors of the known landmarks.
  SubmapInnovation(const Pose& base, const Eigen::MatrixXd& P, const std::vector<typename Pose::Point>& points,
                   const Submap<Pose>& submap, const std::vector<Eigen::Index>& locals, const Eigen::MatrixXd& noise);

  Eigen::Index count() const { return static_cast<Eigen::Index>(by_base.size()); }
  Eigen::VectorXd residual;
  Eigen::MatrixXd S, sigma;     // sigma: of y
  std::vector<ByBase> by_base;  // of the predicted y, by the error [dp; dtheta] of the base
};

// The factors of a robust loss, by which the variance of each known landmark's y is multiplied (L5).
template <class Pose>
std::vector<double> noise_factors(const SubmapInnovation<Pose>& innovation, const RobustLoss& loss);

// Multiplies the ordinary error of one landmark of the submap: its variance by `factor`, its covariances by the root.
template <class Pose>
void inflate(Submap<Pose>& submap, Eigen::Index landmark, double factor);

// Adds an error of the submap's base to the submap: `covariance` of [dp; dtheta] in the axes of the submap moves its
// end and its landmarks together.
template <class Pose>
void widen(Submap<Pose>& submap, const typename Pose::Square& covariance);

extern template struct SubmapInnovation<SE2>;
extern template struct SubmapInnovation<SE3>;
extern template std::vector<double> noise_factors(const SubmapInnovation<SE2>&, const RobustLoss&);
extern template std::vector<double> noise_factors(const SubmapInnovation<SE3>&, const RobustLoss&);

}  // namespace cairn
