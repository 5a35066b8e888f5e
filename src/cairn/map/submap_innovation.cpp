// SPDX-License-Identifier: BSD-3-Clause
#include "map/submap_innovation.hpp"

#include <cmath>
#include <numeric>

#include "sensor/sensor.hpp"

namespace cairn {

template <class Pose>
SubmapInnovation<Pose>::SubmapInnovation(const Pose& base, const Eigen::MatrixXd& P, const std::vector<Point>& points,
                                         const Submap<Pose>& submap, const std::vector<Eigen::Index>& locals,
                                         const Eigen::MatrixXd& noise) {
  std::vector<Point> seen;
  for (const Eigen::Index i : locals) seen.push_back(submap.landmarks[static_cast<std::size_t>(i)]);
  const std::vector<Eigen::Index> rows = point_rows<Pose>(locals, Pose::kDof);
  sigma = noise(rows, rows);
  Pose corrected = base;
  std::vector<Point> places = points;
  Eigen::MatrixXd joint = P;
  if (submap.base) {
    const FixedBase<Pose> fixed(*submap.base, submap.errors);
    Eigen::MatrixXd by_error = submap.errors.cross.middleCols(submap.errors.count() - Pose::kDof, Pose::kDof);
    rows_to_ordinary(submap, locals, by_error);
    const Eigen::MatrixXd of_y = by_error(rows, Eigen::all);
    use(fixed, fixed.gain(of_y));
    sigma -= gain * of_y.transpose();
    fixed.correct(corrected, places, joint);
  }
  linearise(corrected, places, seen);
  spread(joint);
}

template <class Pose>
void SubmapInnovation<Pose>::linearise(const Pose& base, const std::vector<Point>& points,
                                       const std::vector<Point>& seen) {
  constexpr int kDim = Pose::kDim;
  residual.resize(static_cast<Eigen::Index>(kDim * points.size()));
  by_base.clear();
  const Pose T_base_map = base.inverse();
  for (std::size_t a = 0; a < points.size(); ++a) {
    Prediction<Pose> prediction;
    map_jacobians(base, points[a], Prediction<Pose>::ByLandmark::Identity(), prediction);
    by_base.push_back(prediction.J_z_pose.template topRows<kDim>());
    by_point = prediction.J_z_landmark.template topRows<kDim>();
    residual.template segment<kDim>(static_cast<Eigen::Index>(kDim * a)) = seen[a] - T_base_map * points[a];
  }
  if (gain.rows() == 0) return;
  residual += gain * (pose_error(base, at) - value);
  const Eigen::MatrixXd by_error = gain * pose_error_jacobian(base, at);
  for (Eigen::Index a = 0; a < count(); ++a)
    by_base[static_cast<std::size_t>(a)] -= by_error.template middleRows<kDim>(kDim * a);
}

template <class Pose>
void SubmapInnovation<Pose>::spread(const Eigen::MatrixXd& P) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  cross.resize(P.rows(), sigma.cols());
  S = sigma;
  for (Eigen::Index a = 0; a < count(); ++a)
    cross.template middleCols<kDim>(kDim * a) =
        P.template leftCols<kDof>() * by_base[static_cast<std::size_t>(a)].transpose() +
        P.template middleCols<kDim>(kDof + kDim * a) * by_point.transpose();
  for (Eigen::Index a = 0; a < count(); ++a)
    S.template middleRows<kDim>(kDim * a) += by_base[static_cast<std::size_t>(a)] * cross.template topRows<kDof>() +
                                             by_point * cross.template middleRows<kDim>(kDof + kDim * a);
}

template <class Pose>
Eigen::VectorXd SubmapInnovation<Pose>::change(const Eigen::VectorXd& errors) const {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  Eigen::VectorXd change(residual.size());
  for (Eigen::Index a = 0; a < count(); ++a)
    change.template segment<kDim>(kDim * a) = by_base[static_cast<std::size_t>(a)] * errors.template head<kDof>() +
                                              by_point * errors.template segment<kDim>(kDof + kDim * a);
  return change;
}

template <class Pose>
InnovationBatch<Pose>::InnovationBatch(const SubmapInnovation<Pose>& innovation)
    : innovation_(innovation),
      numbers_(static_cast<std::size_t>(innovation.count())),
      kept_(numbers_.size()),
      refused_(new bool[numbers_.size()]) {
  std::iota(numbers_.begin(), numbers_.end(), Eigen::Index{0});
}

template <class Pose>
void InnovationBatch<Pose>::keep(const Eigen::Index* blocks, Eigen::Index count) {
  for (Eigen::Index k = 0; k < count; ++k) numbers_[static_cast<std::size_t>(k)] = number(blocks[k]);
  numbers_.resize(static_cast<std::size_t>(count));
}

template <class Pose>
double InnovationBatch<Pose>::joint_distance() {
  const std::vector<Eigen::Index> rows = point_rows<Pose>(numbers_, 0);
  const Eigen::VectorXd residual = innovation_.residual(rows);
  factor_.compute(innovation_.S(rows, rows));
  u_ = factor_.solve(residual);
  distance_ = residual.dot(u_);
  return distance_;
}

template <class Pose>
InverseInnovation InnovationBatch<Pose>::invert() {
  const Eigen::Index m = u_.size();
  inverse_ = factor_.solve(Eigen::MatrixXd::Identity(m, m));
  workspace_.resize(static_cast<std::size_t>(kDim * (kDim + m)));
  return {inverse_.data(), u_.data(), distance_, workspace_.data()};
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
template class InnovationBatch<SE2>;
template class InnovationBatch<SE3>;
template std::vector<double> noise_factors(const SubmapInnovation<SE2>&, const RobustLoss&);
template std::vector<double> noise_factors(const SubmapInnovation<SE3>&, const RobustLoss&);
template void inflate(Submap<SE2>&, Eigen::Index, double);
template void inflate(Submap<SE3>&, Eigen::Index, double);
template void widen(Submap<SE2>&, const SE2::Square&);
template void widen(Submap<SE3>&, const SE3::Square&);

}  // namespace cairn
