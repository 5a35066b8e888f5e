// SPDX-License-Identifier: BSD-3-Clause
// A submap that is about to join, against what the map knows of its landmarks: innovation, robust weights, and the
// widening of the motion that led to it (docs/submaps.md).
#pragma once

#include <Eigen/Cholesky>
#include <memory>
#include <vector>

#include "linear/joint_gate.hpp"
#include "linear/robust_loss.hpp"
#include "map/fixed_base.hpp"
#include "map/landmarks.hpp"
#include "map/submap.hpp"

namespace cairn {

// nu = y - R^T (l - p) of the known landmarks, y their estimates in the submap, and S = H P H^T + Sigma. If there were
// fixes in the submap, y moves by `gain` with the error of the base, and Sigma is that of y given this error.
template <class Pose>
struct SubmapInnovation {
  using Point = typename Pose::Point;
  using ByBase = Eigen::Matrix<double, Pose::kDim, Pose::kDof>;
  using ByPoint = Eigen::Matrix<double, Pose::kDim, Pose::kDim>;

  SubmapInnovation() = default;
  // `locals` are the known landmarks in the submap, `points` their places in the map, `P` the joint covariance of
  // [base; points] and `noise` the submap's covariance with ordinary errors of the known landmarks. What fixes in the
  // submap told about its base is applied first.
  SubmapInnovation(const Pose& base, const Eigen::MatrixXd& P, const std::vector<Point>& points,
                   const Submap<Pose>& submap, const std::vector<Eigen::Index>& locals, const Eigen::MatrixXd& noise);

  // Residual and Jacobians of landmarks that the submap has `seen` at these places.
  void linearise(const Pose& base, const std::vector<Point>& points, const std::vector<Point>& seen);
  // y depends on the error of the base; before linearise().
  void use(const FixedBase<Pose>& fixed, Eigen::MatrixXd gain_of_y) {
    at = fixed.at;
    value = fixed.value;
    gain = std::move(gain_of_y);
  }
  // P H^T and S, from sigma and the joint covariance of [base; points; anything else].
  void spread(const Eigen::MatrixXd& P);
  // H e, the change of the predicted y by errors of [base; points].
  Eigen::VectorXd change(const Eigen::VectorXd& errors) const;

  Eigen::Index count() const { return static_cast<Eigen::Index>(by_base.size()); }
  Eigen::VectorXd residual;
  Eigen::MatrixXd S, sigma;     // sigma: of y
  Eigen::MatrixXd cross;        // P H^T
  std::vector<ByBase> by_base;  // of the predicted y, by the error [dp; dtheta] of the base
  ByPoint by_point;             // and by the error of its own place in the map
  // Of y, by the error of the base against `at`; no rows if there were no fixes. y is right where the error is `value`.
  Eigen::MatrixXd gain;
  Pose at;
  typename Pose::Tangent value;
};

// The known landmarks as a batch for gate_blocks().
template <class Pose>
class InnovationBatch {
 public:
  explicit InnovationBatch(const SubmapInnovation<Pose>& innovation);

  Eigen::Index number(Eigen::Index block) const { return numbers_[static_cast<std::size_t>(block)]; }  // in innovation
  const std::vector<Eigen::Index>& numbers() const { return numbers_; }  // of those that are left

  Eigen::Index count() const { return static_cast<Eigen::Index>(numbers_.size()); }
  double distance(Eigen::Index block) const {
    const Eigen::Index m = innovation_.S.rows(), at = kDim * number(block);
    return squared_distance(innovation_.residual.data() + at, innovation_.S.data() + at * (m + 1), m, kDim);
  }
  void keep(const Eigen::Index* blocks, Eigen::Index count);
  template <class Bound>
  bool consistent(Bound&& bound) {
    return numbers_.empty() || joint_distance() <= bound(kDim * count());
  }
  InverseInnovation invert();
  void refactor() {}  // S is not needed again
  Eigen::Index* kept() { return kept_.data(); }
  bool* refused() { return refused_.get(); }

 private:
  static constexpr int kDim = Pose::kDim;

  double joint_distance();

  const SubmapInnovation<Pose>& innovation_;
  std::vector<Eigen::Index> numbers_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;  // of what is left of S
  Eigen::VectorXd u_;                    // S^-1 nu
  Eigen::MatrixXd inverse_;
  double distance_ = 0.0;
  std::vector<double> workspace_;
  std::vector<Eigen::Index> kept_;
  std::unique_ptr<bool[]> refused_;
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
extern template class InnovationBatch<SE2>;
extern template class InnovationBatch<SE3>;
extern template std::vector<double> noise_factors(const SubmapInnovation<SE2>&, const RobustLoss&);
extern template std::vector<double> noise_factors(const SubmapInnovation<SE3>&, const RobustLoss&);

}  // namespace cairn
