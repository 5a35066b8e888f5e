// SPDX-License-Identifier: BSD-3-Clause
#include "map/submap_innovation.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "sensor/sensor.hpp"

namespace cairn {

template <class Pose>
SubmapInnovation<Pose>::SubmapInnovation(const Pose& base, const Eigen::MatrixXd& P,
                                         const std::vector<typename Pose::Point>& points, const Submap<Pose>& submap,
                                         const std::vector<Eigen::Index>& locals, const Eigen::MatrixXd& noise) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  const auto known = static_cast<Eigen::Index>(locals.size()), m = kDim * known;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(m, kDof + m);
  residual.resize(m);
  sigma.resize(m, m);
  for (Eigen::Index a = 0; a < known; ++a) {
    const std::size_t number = static_cast<std::size_t>(a);
    Prediction<Pose> prediction;
    map_jacobians(base, points[number], Prediction<Pose>::ByLandmark::Identity(), prediction);
    by_base.push_back(prediction.J_z_pose.template topRows<kDim>());
    H.template block<kDim, kDof>(kDim * a, 0) = by_base.back();
    H.template block<kDim, kDim>(kDim * a, kDof + kDim * a) = prediction.J_z_landmark.template topRows<kDim>();
    residual.template segment<kDim>(kDim * a) =
        submap.landmarks[static_cast<std::size_t>(locals[number])] - base.inverse() * points[number];
    for (Eigen::Index b = 0; b < known; ++b)
      sigma.template block<kDim, kDim>(kDim * a, kDim * b) = noise.template block<kDim, kDim>(
          kDof + kDim * locals[number], kDof + kDim * locals[static_cast<std::size_t>(b)]);
  }
  S = sigma;
  S += H * P * H.transpose();
}

template <class Pose>
std::vector<double> noise_factors(const SubmapInnovation<Pose>& innovation, const RobustLoss& loss) {
  constexpr int kDim = Pose::kDim;
  constexpr int kMostIterations = 20;
  constexpr double kSettled = 0.01;
  using PointSquare = Eigen::Matrix<double, kDim, kDim>;
  const Eigen::Index known = innovation.count();
  std::vector<double> factors(static_cast<std::size_t>(known), 1.0);
  const auto distance = [&](const Eigen::VectorXd& residual, const Eigen::MatrixXd& covariance, Eigen::Index a) {
    const PointSquare block = covariance.template block<kDim, kDim>(kDim * a, kDim * a);
    const Eigen::Matrix<double, kDim, 1> r = residual.template segment<kDim>(kDim * a);
    return r.dot(block.ldlt().solve(r));
  };
  // The first weights count the uncertainty of the map, the next ones only that of the submap, at the new estimate.
  for (Eigen::Index a = 0; a < known; ++a)
    factors[static_cast<std::size_t>(a)] = loss.noise_factor(distance(innovation.residual, innovation.S, a), kDim);
  for (int i = 0; i < kMostIterations; ++i) {
    Eigen::VectorXd scale(kDim * known);
    for (Eigen::Index row = 0; row < scale.size(); ++row)
      scale(row) = std::sqrt(factors[static_cast<std::size_t>(row / kDim)]);
    const Eigen::MatrixXd weighted = scale.asDiagonal() * innovation.sigma * scale.asDiagonal();
    const Eigen::MatrixXd S = innovation.S - innovation.sigma + weighted;
    const Eigen::VectorXd left = weighted * S.ldlt().solve(innovation.residual);  // residual at the new estimate
    bool settled = true;
    for (Eigen::Index a = 0; a < known; ++a) {
      double& factor = factors[static_cast<std::size_t>(a)];
      const double next = loss.noise_factor(distance(left, innovation.sigma, a), kDim);
      settled = settled && std::abs(next - factor) <= kSettled * factor;
      factor = next;
    }
    if (settled) break;
  }
  return factors;
}

template <class Pose>
void inflate(Submap<Pose>& submap, Eigen::Index landmark, double factor) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof, kTurn = Pose::kTurn;
  const ErrorModel<Pose> model(submap.error);
  const Eigen::Index at = kDof + kDim * landmark;
  Eigen::MatrixXd& P = submap.covariance;
  model.to_ordinary_point(submap.landmarks[static_cast<std::size_t>(landmark)], at, P);
  P.middleRows<kDim>(at) *= std::sqrt(factor);
  P.middleCols<kDim>(at) *= std::sqrt(factor);
  if (!model.invariant()) return;
  const typename ErrorModel<Pose>::Arm G = model.arm(submap.landmarks[static_cast<std::size_t>(landmark)]);
  P.middleRows<kDim>(at) -= G * P.middleRows<kTurn>(kDim);
  P.middleCols<kDim>(at) -= P.middleCols<kTurn>(kDim) * G.transpose();
}

template <class Pose>
void widen(Submap<Pose>& submap, const typename Pose::Square& covariance) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof, kTurn = Pose::kTurn;
  // The invariant error is the same for every point: xi_x = dp, and xi_R = dtheta. The ordinary error has the arm, too.
  const ErrorModel<Pose> model(submap.error);
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(submap.covariance.rows(), kDof);
  const auto set = [&](Eigen::Index row, const typename Pose::Point& x) {
    U.block<kDim, kDim>(row, 0).setIdentity();
    if (!model.invariant()) U.block<kDim, kTurn>(row, kDim) = model.arm(x);
  };
  set(0, submap.T_base_end.translation());
  U.block<kTurn, kTurn>(kDim, kDim).setIdentity();
  for (Eigen::Index i = 0; i < submap.size(); ++i) set(kDof + kDim * i, submap.landmarks[static_cast<std::size_t>(i)]);
  submap.covariance += U * covariance * U.transpose();
}

template struct SubmapInnovation<SE2>;
template struct SubmapInnovation<SE3>;
template std::vector<double> noise_factors(const SubmapInnovation<SE2>&, const RobustLoss&);
template std::vector<double> noise_factors(const SubmapInnovation<SE3>&, const RobustLoss&);
template void inflate(Submap<SE2>&, Eigen::Index, double);
template void inflate(Submap<SE3>&, Eigen::Index, double);
template void widen(Submap<SE2>&, const SE2::Square&);
template void widen(Submap<SE3>&, const SE3::Square&);

}  // namespace cairn
